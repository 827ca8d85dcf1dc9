"""Claims about convection in three dimensions, in a box of 2:2:1 at Ra 5000."""
import numpy as np

from studies.kit.ask import Value, largest, one
from studies.kit.claim import Claim
from studies.rb.tables import grid

TABLE, AT = "three_dimensions", {"ra": 5e3}
SOURCE, BOX = "RR98 Sec. III", "Ra 5000, box 2:2:1"
#: what is right in two dimensions
PLANE = one("means", "ke", **grid(5e3, 28) | {"method": "spectral-gas", "variant": ""})
WORDS = {"rolls": "uniform rolls", "crossed": "rolls and others across, half as strong",
         "squares": "two equal sets of rolls across each other"}


def limit(method: str, start: str) -> Value:
    """K, extrapolated."""
    return one(TABLE, "ke", method=method, start=start, resolution=np.inf, **AT)


CLAIMS = (
    *(Claim(id=f"own-rb-space-{start}", source=SOURCE, at_most=0.01,
            value=abs(limit("dih", start)/(PLANE if start == "rolls" else limit("spectral-gas", start)) - 1),
            because="1 %: in the plane 20 rows are off by 4 %, of which a quarter is left after 1/rows^2",
            statement="the equations on a lattice in three dimensions converge on those of the gas: "
                      f"|K/K_spectral - 1|, extrapolated, {BOX}, from {words}",
            after="8, 12 and 16 rows had left it open, and 20 were run"*(start == "crossed"))
      for start, words in WORDS.items()),
    Claim(id="own-rb-space-plane", source=SOURCE, value=abs(limit("spectral-gas", "rolls")/PLANE - 1),
          at_most=0.001, because="eight waves: a tenth of what a lattice is judged by",
          after="it had been seen with 11 and 13 functions",
          statement=f"the spectral gas in space has the rolls of that in the plane: |K/K_plane - 1|, {BOX}"),
    Claim(id="own-rb-space-rolls-win", source="Schlueter, Lortz & Busse 1965", at_most=0.01,
          value=largest(TABLE, "across", err="0", start="crossed", **AT),
          because="a hundredth of the stronger wave, from a half: it dies",
          after="the decay had been seen with 11 functions, and runs were made long enough for it",
          statement="rolls are stable to others across them: amplitude of the weaker waves over the stronger "
                    f"at the end, largest of all sizes, lattice and spectral gas, {BOX}"),
)
