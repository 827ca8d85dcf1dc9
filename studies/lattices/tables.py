"""Tables of the study. Lengths in spacings, masses of particles, T = 1 or as said; `_err` 95 % half widths.
"""
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from studies.kit.stats import over_seeds
from studies.kit.table import Table, Tables

#: shear over bulk modulus: by lattice sums, and by the compiled sums of particles (ranges to 6); lattice
#: "diagonal": sheared at 45 degrees
MODULI = Table("moduli",
               key=["lattice", "weight", "h"], columns=["lattice", "weight", "h", "exact", "measured"])

CRYSTAL = ["lattice", "weight", "h", "eos", "T", "rho"]
RATES = ["predicted", "measured", "measured_err"]
#: rate of the fastest growing motion: by lattice sums, and measured
GROWTH = Table("growth", key=CRYSTAL, columns=[*CRYSTAL, *RATES])
#: value of a parameter (h or T, its own column is then 0) at which motions begin to grow
ONSETS = Table("onsets", key=[*CRYSTAL, "parameter", "seed"], columns=[*CRYSTAL, "parameter", "seed", *RATES])
#: particles a site: of least energy, and the median of runs; shared: part of the particles that share a site,
#: chance: the part of particles at random that would; ratio: median of second over first neighbour distance
FATES = Table("fates", key=["weight", "h", "seed"],
              columns=["weight", "h", "seed", "predicted", "sites", "shared", "ratio", "chance"])

#: step: over that of other studies
LAYER = ["eos", "weight", "ra", "seed", "step"]
#: K of the mean flow and of the particles over that of the grid's smoothed field, fluctuation of distances of
#: neighbours over their mean, at pressures P; nothing where a run diverged
FREEZING = Table("freezing", key=[*LAYER, "P"],
                 columns=[*LAYER, "P", "flow", "flow_err", "kp", "kp_err", "lindemann"])
#: P at which K of the mean flow falls below a tenth; K of the grid, and P at which 2 K is 2 P w(0), 2 P
#: [w(0.9) - w(1)]
FREEZING_LIMITS = Table("freezing_limits", key=LAYER,
                        columns=[*LAYER, "measured", "measured_err", "K", "barrier", "melting"])

#: rms distance of places of the same path by smooth particles and as molecules
TWINS = Table("twins", key=["weight", "seed", "time"], columns=["weight", "seed", "time", "apart"])
#: rms distance from the start, and part of the coordinates that are it to the last bit, after so much time
#: there and back
REVERSAL = Table("reversal", key=["integrator", "weight", "seed", "time"],
                 columns=["integrator", "weight", "seed", "time", "apart", "equal"])

#: speed of the longest waves along x over the fluid's
SPEEDS = Table("sound_speeds", key=["lattice", "weight"], columns=["lattice", "weight", "speed"])
WAVE = ["lattice", "weight", "h", "length", "seed"]
#: rate of the fastest growing motion; time: that the wave rings; rms velocities then: wave: of the exact
#: wave; foretold, across: along y, where the wave has none, by linear theory from round-off and measured
RINGING = Table("ringing", key=WAVE, columns=[*WAVE, *RATES, "time", "wave", "foretold", "across"])
#: length of the wave from which what grows is as fast as the wave when it has rung, over seeds
LOST = Table("ringing_lost", key=["lattice", "weight"], columns=["lattice", "weight", "seeds", *RATES])

ALL = (MODULI, GROWTH, ONSETS, FATES, FREEZING, FREEZING_LIMITS, TWINS, REVERSAL, SPEEDS, RINGING, LOST)


# --- rows that follow -----------------------------------------------------------------------------

USUAL = 3.0         # range of the weight of waves of many lengths


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows of the study."""
    return {"ringing_lost": list(ringing_lost(tables["ringing"]))} if "ringing" in tables else {}


def ringing_lost(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Where waves are lost, of the lattices and weights of which many lengths ring."""
    for (kind, weight), group in rows[rows["h"] == USUAL].groupby(["lattice", "weight"]):
        seeds = [one.sort_values("length") for _, one in group.groupby("seed") if one["length"].nunique() > 2]
        predicted = [crossing(one, "foretold") for one in seeds]
        measured = [crossing(one, "across") for one in seeds]
        if len(seeds) > 1 and np.isfinite([predicted, measured]).all():
            length = over_seeds(measured)
            yield {"lattice": kind, "weight": weight, "seeds": len(seeds), "predicted": float(np.mean(predicted)),
                   "measured": length.value, "measured_err": length.err}


def crossing(rows: pd.DataFrame, name: str) -> float:
    """Length at which a velocity passes that of the wave, its logarithm interpolated; nan if it does not."""
    ratio = np.log(rows[name].to_numpy()/rows["wave"].to_numpy())
    i = int(np.argmax(ratio > 0))
    lengths = rows["length"].to_numpy(float)
    return float(np.interp(0.0, ratio[i - 1:i + 1], lengths[i - 1:i + 1])) if i else np.nan
