"""Claims about the spectral method, in the plane and in a box of 2:2:1 at Ra 5000, and what is beside it."""
from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from studies.kit.ask import Value, largest, largest_per, of, one, rows
from studies.kit.claim import Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.rb.claims.grid import SPECTRAL
from studies.rb.tables import SCENE, STILL

LIMITS = {"gas": "variant == 'flux-form'", "boussinesq": "variant == 'mac'"}    # kind -> grids
HIGH = (5e3, 6e3, 6830.0, 1e4, 2e4)     # Ra at which 16 functions leave more than round-off

TABLE, AT = "three_dimensions", {"ra": 5e3}
SOURCE, BOX = "RR98 Sec. III", "Ra 5000, box 2:2:1"
#: what is right in two dimensions
PLANE = one("means", "ke", **SPECTRAL | {"ra": 5e3})
WORDS = {"rolls": "uniform rolls", "crossed": "rolls and others across, half as strong",
         "squares": "two equal sets of rolls across each other"}


def limit(method: str, start: str) -> Value:
    """K, extrapolated."""
    return one(TABLE, "ke", method=method, start=start, resolution=np.inf, **AT)


def from_truth(kind: str, column: str, number: Callable[[pd.Series], Any], words: str) -> Value:
    """A number of |limit of grids - spectral method|/(error of the limit) of all flows."""
    def answer(tables: Tables) -> Measured:
        flows = rows(tables, "means", f"ke > {STILL}", sides="periodic").sort_values("resolution")
        truth = flows[flows.method == f"spectral-{kind}"].drop_duplicates(SCENE, keep="last")
        limits = flows[np.isinf(flows.resolution)].query(LIMITS[kind])
        both = limits.merge(truth, on=SCENE, suffixes=("", "_true"))
        rows(Tables(both=both), "both")     # raises where there are none
        return Measured(float(number((both[column] - both[f"{column}_true"]).abs()/both[f"{column}_err"])))
    answer.__doc__ = f"{words} |{column} - that of spectral-{kind}|/error, limits in means"
    return of(answer)


def spectral() -> Iterator[Claim]:
    """Of the spectral method, and of limits beside it."""
    own: dict[str, Any] = {"source": "KHP95 Secs V, VI",
                           "after": "limits beside the spectral method, and its errors at Ra 10 000"}
    for kind, (column, name) in product(LIMITS, (("ke", "K"), ("nu", "Nu"))):
        yield Claim(id=f"own-rb-limits-{kind}-{column}", **own, because="intervals are of 95 %", at_most=0.05,
                    value=from_truth(kind, column, lambda apart: (apart > 1).mean(), "share above 1 of"),
                    statement=f"{name} of the spectral method lies in the intervals of the grids' limits, "
                              f"{kind}: share of flows where it does not")
    for kind in LIMITS:
        yield Claim(id=f"own-rb-widths-{kind}", **own, at_least=1/3,
                    value=from_truth(kind, "ke", pd.Series.median, "median of"),
                    because="half is meant, of four grids; the rest is for chance",
                    statement=f"intervals of K of the grids' limits are not too wide, {kind}: distance from "
                              "the spectral method over error, median of all flows")
    few, many = (one("kinetic_energy", "ke_err", err="0", **SPECTRAL | {"resolution": n, "ra": HIGH})
                 for n in (16, 24))
    yield Claim(id="own-rb-spectral-exponential", **own, value=largest_per("ra", many/few), at_most=0.01,
                because="a tenth with every four functions; second order would leave 0.44",
                statement="the error of the spectral method falls exponentially: of K with 24 functions over "
                          "that with 16, gas, worst Ra of 5000 to 20 000")
    finest = "(resolution > 32 or resolution == 28 and ra < 5e4)"
    digits = largest("kinetic_energy", "ke_err/ke", err="0", such=f"{finest} and ke > {STILL}",
                     method=tuple(f"spectral-{kind}" for kind in LIMITS))
    yield Claim(id="own-rb-spectral-digits", **own, value=digits, at_most=5e-9,
                because="half of the eighth digit of a number that begins with nine",
                statement="K of the spectral method has eight digits: what the last four functions change, "
                          "relative, largest of all Ra")


CLAIMS = (
    *spectral(),
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
