"""Tables of known content, for the tests of claims: lines, energies, fields, crystals, numbers without a flow."""
import math
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd

from studies.kit.claim import judge
from studies.kit.table import Tables
from studies.rb.claims import RB_CLAIMS
from studies.rb.claims.curves import ONSET
from studies.rb.runs import lattices
from studies.rb.runs.arithmetic import SUBJECTS, WithoutFlow
from studies.rb.tables import SCENE, grid, particles

BY_ID = {claim.id: claim for claim in RB_CLAIMS}
RA = (1750.0, 2000.0, 2500.0, 3500.0, 4200.0, 5000.0, 6830.0, 10000.0)


def judged(name: str, tables: Tables) -> dict:
    """The whole row of a claim."""
    return judge([BY_ID[name]], tables, "rb")[0]


def verdict(name: str, tables: Tables) -> str:
    return judged(name, tables)["verdict"]


def means(rows: list[dict], kept: float = 1.0) -> Tables:
    """Tables `means` from points and K, and `errors` of particles' fields: smoothing leaves `kept` of the grid's K."""
    full = [{"particles": 0, "seeds": 3, "mixed": 0, "rolls": 2, "ke_fluctuation": 1e-4, "nu": 1.5, "nu_err": 0.0,
             "ke_field": row["ke"], "ke_field_err": row["ke_err"], "ke_mean": row["ke"],
             "ke_mean_err": row["ke_err"], **row} for row in rows]
    return Tables({"means": pd.DataFrame(full), "errors": errors(pd.DataFrame(full), kept)})


def errors(means: pd.DataFrame, kept: float) -> pd.DataFrame:
    """Rows Kg of the table `errors`: the particles of `means` against the extrapolated grid of the same scene."""
    limits = means[np.isinf(means["resolution"]) & (means["variant"] == "flux-form")]
    limits = limits[[*SCENE, "ke"]].rename(columns={"ke": "reference"})
    rows = means[means["method"] == "spam"].merge(limits, on=SCENE)
    return rows.assign(energy="Kg", reference=kept*rows["reference"], reference_err=0.0)


def seeds(point: dict, ke: tuple[float, ...], **more) -> pd.DataFrame:
    """Rows of `kinetic_energy`, one a seed with its K."""
    return pd.DataFrame([{**point, "seed": seed, "ke": k, "ke_err": 1e-3*k, "ke_field": k, "ke_field_err": 1e-3*k, "ke_mean": k,
                          "ke_mean_err": 1e-3*k, "rolls": 2,
                          "ke_fluctuation": 1e-4, "converged": True, **more} for seed, k in enumerate(ke, 1)])


def straight(ra: float, bend: float = 0.0) -> float:
    """K on a line that gives 0.00340 at Ra 5000, bent by a parabola that is zero at onset and at Ra 5000."""
    s, s5 = (1 - math.sqrt(ONSET["periodic"]/at) for at in (ra, 5000.0))
    return 0.0034*s/s5 + bend*s*(s - s5)


def grids(bend: float = 0.0, order: float = 2.0) -> list[dict]:
    """The compressible grid on 24, 32, 48 rows and its limit."""
    return [{**grid(ra, rows), "ke": straight(ra, bend) + 0.03*rows**-order*(1 + math.sqrt(5000/ra)), "ke_err": 1e-8}
            for ra in RA for rows in (24, 32, 48, math.inf)]


def flow(shift: float, share: float = 1.0, noise: float = 0.0) -> dict[str, np.ndarray]:
    """Two rolls on 30 x 60 places, moved along x (in L), their velocity times `share`."""
    x, y = (np.arange(60) + 0.5)/30 - 1 - shift, ((np.arange(30) + 0.5)/30 - 0.5)[:, None]
    wave = np.cos(np.pi*x)
    random = np.random.default_rng(1).standard_normal((2, 30, 60))*noise
    return {"rho": 1 + 0.1*y - 0.1*wave*np.cos(np.pi*y), "T": 1 - y + 0.2*wave*np.cos(np.pi*y),
            "vx": share*0.1*np.sin(np.pi*x)*np.sin(2*np.pi*y) + random[0],
            "vy": share*0.1*wave*np.cos(np.pi*y) + random[1]}


def kept(point: dict, at: dict[str, np.ndarray], rows: float) -> pd.DataFrame:
    """Rows of the table `fields`."""
    x, y = np.meshgrid((np.arange(60) + 0.5)/30 - 1, (np.arange(30) + 0.5)/30 - 0.5)
    return pd.DataFrame({**point, "resolution": rows, "seed": 1, "x": x.ravel(), "y": y.ravel(),
                         **{name: f.ravel() for name, f in at.items()}})


def crystal(per_site: int, height: float = 30.0) -> pd.DataFrame:
    """Rows of the table `particles`: hexagonal sites of density 1, the particles of a site 0.05 apart, with images."""
    x, y = lattices.lattice("hexagonal", per_site, reach=3*height)
    inside = (np.abs(x) < height + 3) & (np.abs(y) < height/2 + 3)
    x, y = (np.concatenate([q[inside] + 0.05*n*(q is x) for n in range(per_site)]) for q in (x, y))
    fluid = (np.abs(x) < height) & (np.abs(y) < height/2)
    return pd.DataFrame({**particles(1e4), "seed": 1, "number": np.arange(len(x)), "x": x/50, "y": y/50, "vx": 0.1,
                         "vy": 0.0, "kind": np.where(fluid, "fluid", "image")})


def seen(ra: float, kept: float) -> pd.DataFrame:
    """The finest grid's K as 50 rows of the printed weight see it: the share `kept` of it."""
    return pd.DataFrame([{**grid(ra, 48), "weight": "Lucy", "h": 3.0, "rows": 50, "ke": 1.0, "ke_smoothed": kept}])


@cache
def numbers() -> pd.DataFrame:
    """The table `arithmetic`, computed."""
    outcomes = [WithoutFlow(numbers=subject).run(lambda done: None, Path()) for subject in SUBJECTS]
    return pd.DataFrame([row for outcome in outcomes for row in outcome.rows["arithmetic"]])
