"""Tables of known content, for the tests of claims: lines, energies, fields, crystals, histories, a row for every question."""
import itertools
import math
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd

from studies.build.fixed import SCHEMES
from studies.build.moving import MOTIONS
from studies.build.rr98_moving import DRIFT_MOTIONS
from studies.kit.claim import judge
from studies.kit.table import Tables
from studies.rb.claims import RB_CLAIMS
from studies.rb.claims.grid import PYPDE
from studies.rb.claims.points import LATTICES
from studies.rb.flows import ONSET, grid, particles, points, scene
from studies.rb.runs import lattices
from studies.rb.runs.arithmetic import SUBJECTS, Arithmetic
from studies.rb.snapshots import field_errors, snapshots

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
    scene = ["eos", "transport", "sides", "ra", "pr"]
    limits = means[np.isinf(means["resolution"]) & (means["variant"] == "flux-form")].set_index(scene)["ke"]*kept
    found = [{**row, "energy": "Kg", "reference": limits[where], "reference_err": 0.0,
              "error": row["ke_field"]/limits[where] - 1, "error_err": row["ke_field_err"]/limits[where]}
             for row in means[means["method"] == "spam"].to_dict("records")
             for where in [tuple(row[name] for name in scene)] if where in limits.index]
    return pd.DataFrame(found, columns=[*means.columns, "energy", "reference", "reference_err", "error", "error_err"])


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


# --- a row for every question ----------------------------------------------------------------------------------

SCENES: list[dict] = [{}, {"transport": "const-nu"}, {"eos": "vdw"}, {"eos": "dense"}, {"sides": "walls"}]
MANY = (2000.0, 2500.0, 3000.0, 3500.0, 4200.0, 5000.0, 6000.0, 6830.0, 7000.0, 10000.0, 14000.0, 20000.0, 5e4)
VARIANTS = ("printed", "printed-half-step", "printed-from-flow", "printed-fixed-rows", "printed-monaghan",
            "arithmetic-mean", "range-6", "less-static-50", "more-static-100", "more-static-400")


def every_point() -> list[dict]:
    """Every point that a claim asks for, and many more."""
    scenes = list(itertools.product(MANY, SCENES))
    grids = [grid(ra, rows, **where)
             for (ra, where), rows in itertools.product(scenes, (24, 32, 48, 50, 100, math.inf))]
    runs = [particles(ra, rows, variant, **where)
            for (ra, where), rows, variant in itertools.product(scenes, (16, 25, 40, 50), VARIANTS)]
    fixed = [points(ra, name, rows) for ra, name, rows in itertools.product((5e3, 1e4), (*SCHEMES, "moving"),
                                                                               (*LATTICES, math.inf))]
    wrong = [{"method": "compressible", "variant": "edge-heat", "resolution": math.inf, **scene(ra)} for ra in (5e3, 1e4)]
    thick = {**points(1e4, "fixed-lattice"), "transport": "const-nu"}
    moved = [points(1e4, name, rows) for name, rows in itertools.product((*DRIFT_MOTIONS, *MOTIONS), (25, 40))
             if name != "moving"]
    return [*grids, *runs, *fixed, *moved, *wrong, thick, PYPDE, grid(1e4, 48, "paper-form"),
            grid(67150.3, 48, "fig10", sides="walls"),
            grid(67150.3, 48, "fig10", sides="walls", eos="dense"), grid(7000, 48, "two-rolls", sides="walls")]


def measured(point: dict) -> dict:
    """Columns of `means` and `kinetic_energy` at any point: frozen under high pressure, else some flow."""
    share = 1 if point["method"] != "spam" else 0.2 if point["variant"] == "more-static-400" else 0.8
    share *= 1 - 0.5/point["resolution"]*point["variant"].endswith("-delaunay")     # images off a lattice: first order
    ke = share*(straight(point["ra"]) + 1e-3) + 0.01/point["resolution"]**2*(1 + 50/math.sqrt(point["ra"]))
    return {**point, "particles": 2*min(point["resolution"], 100)**2, "seed": 1, "seeds": 3, "mixed": 0,
            "ke": ke, "ke_err": 1e-8, "ke_field": 0.9*ke, "ke_field_err": 1e-8, "ke_mean": 0.9*ke,
            "ke_mean_err": 1e-8, "ke_fluctuation": 1e-4, "nu": 1.5, "nu_err": 0.01,
            "rolls": 1 if point["sides"] == "walls" else 2, "mass_drift": 1e-4, "t_end": 5000.0, "converged": True}


def history(point: dict, seed: int) -> pd.DataFrame:
    """K(t) that settles, but in the dense fluid."""
    t = np.linspace(0, 4500, 60)
    ke = 0.004*(1 - np.exp(-t/300/seed))*(1 + 0.1*np.sin(t)*(point["ra"] == 5e4))*(1 + t/4500*(point["eos"] == "dense"))
    return pd.DataFrame({**point, "seed": seed, "t": t, "t_viscous": t/200, "ke": ke + 1e-4, "ke_field": ke})


def seen(ra: float, kept: float) -> pd.DataFrame:
    """The finest grid's K as 50 rows of the printed weight see it: the share `kept` of it."""
    return pd.DataFrame([{**grid(ra, 48), "weight": "Lucy", "h": 3.0, "rows": 50, "ke": 1.0, "ke_smoothed": kept}])


@cache
def numbers() -> pd.DataFrame:
    """The table `arithmetic`, computed."""
    outcomes = [Arithmetic(subject=subject).run(lambda done: None, Path()) for subject in SUBJECTS]
    return pd.DataFrame([row for outcome in outcomes for row in outcome.rows["arithmetic"]])


def everything() -> Tables:
    """All tables with a row for every question."""
    wanted = every_point()
    means = pd.DataFrame([measured(point) for point in wanted])
    runs = [point for point in wanted if point["variant"] in ("printed", "flux-form")
            and point["ra"] in (3000, 1e4, 5e4) and point["resolution"] in (16, 50, 100)]
    kept_runs = [point for point in wanted if point["ra"] in (3000, 5000, 1e4) and point["resolution"] in (16, 48, 50)]
    fixed = particles(1e4, variant="printed-fixed-rows")
    frozen = [particles(3000, 16, variant, eos="dense") for variant in ("printed", "printed-monaghan")]
    literal = points(1e4, "moving-literal", 40)
    ends = [particles(1e4), fixed, particles(1e4, variant="printed-monaghan"), *frozen]
    layers = [{**point, "seed": seed, "plate": plate, "rho_layer": 1 + 0.1*seed, "T_layer": 1.0, "reflections": 0,
               "nu_plate": 1.5 + 0.01*seed}
              for point in (fixed, particles(5e3), particles(1e4)) for seed in (1, 2) for plate in ("lower", "upper")]
    tables = Tables(
        means=means, kinetic_energy=pd.concat([means, means[means["method"] == "spam"].assign(seed=2)]),
        walls=pd.DataFrame(layers), errors=errors(means, 0.9),
        history=pd.concat([history(point, seed)
                           for point in [*runs, literal] for seed in (1, 2)[:1 + (point["method"] == "spam")]]),
        profiles=pd.DataFrame([{**literal, "seed": 1, "y": y, "rho": 1 - 0.2*y} for y in (-0.25, 0.25)]),
        fields=pd.concat([kept(point, flow(0.1, 0.9), point["resolution"]) for point in kept_runs]),
        smoothed=seen(5e4, 0.9),
        particles=pd.concat([crystal(1).assign(T=1.0, **point) for point in ends]))
    return Tables({**tables, "arithmetic": numbers(), "snapshots": pd.DataFrame(snapshots(tables)),
                   "field_errors": pd.DataFrame(field_errors(tables, means))})
