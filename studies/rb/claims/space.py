"""Claims about convection in three dimensions, in a box of 2:2:1 at Ra 5000."""
import numpy as np

from studies.kit.ask import Value, largest, one
from studies.kit.claim import Claim
from studies.rb.tables import grid

RA, TABLE = 5e3, "three_dimensions"
#: what is right in two dimensions
PLANE = one("means", "ke", **grid(RA, 28) | {"method": "spectral-gas", "variant": ""})


def K(method: str, start: str) -> Value:
    """K of the limit."""
    return one(TABLE, "ke", method=method, start=start, ra=RA, resolution=np.inf)


WORDS = {"rolls": "uniform rolls", "crossed": "rolls and others across, half as strong",
         "squares": "two equal sets of rolls across each other"}
SOURCE = "RR98 Sec. III"
CLAIMS = (
    *(Claim(id=f"own-rb-space-{start}", source=SOURCE, at_most=0.01,
            value=abs(K("dih", start)/(PLANE if start == "rolls" else K("spectral-gas", start)) - 1),
            because="1 %: in the plane 20 rows are off by 4 %, of which a quarter is left after 1/rows^2",
            statement="the equations on a lattice in three dimensions converge on those of the gas: |K/K_spectral "
                      f"- 1|, extrapolated, Ra 5000, box 2:2:1, from {words}")
      for start, words in WORDS.items()),
    Claim(id="own-rb-space-plane", source=SOURCE, value=abs(K("spectral-gas", "rolls")/PLANE - 1), at_most=0.001,
          because="eight waves: a tenth of what a lattice is judged by",
          statement="the spectral gas in three dimensions has the rolls of that in two: |K/K_plane - 1|, Ra 5000"),
    Claim(id="own-rb-space-rolls-win", source="Schlueter, Lortz & Busse 1965", at_most=0.01,
          value=largest(TABLE, "across", err="0", start="crossed", ra=RA),
          because="a hundredth of the stronger wave, from a half: it dies",
          after="the decay had been seen with 11 functions, and runs were made long enough for it",
          statement="rolls are stable to others across them: amplitude of the weaker waves over the stronger at "
                    "the end, largest of all sizes, lattice and spectral gas, Ra 5000"),
)
