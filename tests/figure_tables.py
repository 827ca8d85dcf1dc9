"""Made-up tables of the study rb, from which its figures are drawn."""
import itertools
import math

import numpy as np
import pandas as pd

from studies.build.names import VALUES
from studies.rb import tables
from studies.rb.figures import RA_C

SCENES = {"layer": ("ideal", "const-eta", "periodic"), "nu": ("ideal", "const-nu", "periodic"),
          "vdw": ("vdw", "const-eta", "periodic"), "box": ("ideal", "const-eta", "walls")}
RAS = (1500.0, 2000.0, 2500.0, 5000.0, 10000.0, 20000.0)
SPAM, GRID = ("spam", "printed"), ("compressible", "flux-form")
RULES = ("printed", "printed-fixed-rows", "walls-odd", "walls-own-pressure", "walls-odd-own-pressure")
#: all runs of one variant diverge, one seed of another, one has not settled, one is far too energetic
LOST, PARTLY, RESTLESS, WILD = "more-static-400", "less-static-90", "range-6", "printed-half-step"
OTHERS = ("direct", PARTLY, "wendland-c2", "more-static-100", RESTLESS, WILD)


def point(method, scene, ra, resolution, pr=1.0):
    name, variant = method
    eos, transport, sides = SCENES[scene] if name != "boussinesq" else ("", "", "periodic")
    return {"method": name, "variant": variant, "eos": eos, "transport": transport, "sides": sides, "ra": ra, "pr": pr,
            "resolution": float(resolution)}


def k(ra, scene="layer"):
    """K of a made-up fluid: the line A (1 - sqrt(Ra_c/Ra)) to 4 Ra_c, a little less beyond."""
    top = {"layer": 0.0082, "nu": 0.0079, "vdw": 0.0051, "box": 0.0043}[scene]
    onset = 3500 if scene == "box" else RA_C
    return top*max(0.0, 1 - math.sqrt(onset/ra))*(1 - 0.02*max(0, ra/(4*onset) - 1))


def energies(method, scene, ra, resolution, kp, kg, seed=0, **more):
    return {**point(method, scene, ra, resolution), "particles": 0, "seed": seed, "ke": kp, "ke_err": 0.02*kp,
            "ke_field": kg, "ke_field_err": 0.02*kg, "ke_mean": kg, "ke_mean_err": 0.02*kg,
            "ke_fluctuation": kp - kg, "nu": 1 + 100*kg, "nu_err": 0.02,
            "rolls": 2, "converged": True, "t_end": 4500.0, "cpu_s": 1e-4*resolution**3, **more}


def grid_rows():
    for scene in SCENES:
        for ra in RAS:
            for resolution in (24, 32, 48, math.inf):
                ke = k(ra, scene)*(1 + 7/resolution**2)
                yield energies(GRID, scene, ra, resolution, ke, ke, cpu_s=1e-4*min(resolution, 48)**3)
    for ra in RAS:
        ke = 2*k(ra)*1.03
        yield energies(("boussinesq", "mac"), "layer", ra, math.inf, ke, ke) | {"pr": 2.0, "cpu_s": 3.0}


def kept_by_smoothing(rows):
    """K of the made-up fluid's smoothed field over that of the field itself."""
    return 1 - 60/rows**2


def spam_rows(variant, scene, ra, rows, worse=1.0):
    for seed in (1, 2, 3):
        kg = k(ra, scene)*kept_by_smoothing(rows)*(1 - 9*min(worse, 1.0)/rows)*(1 + 0.01*seed)
        yield energies(("spam", variant), scene, ra, rows, kg + 1.6*worse/rows**2, kg, seed,
                       particles=rows**2*(1 if scene == "box" else 2))


def kinetic():
    yield from grid_rows()
    for ra in RAS[:1] + RAS[2:]:
        for rows in (25, 35, 50):
            yield from spam_rows("printed", "layer", ra, rows)
        for rows in (20, 28, 40):
            yield from spam_rows("printed", "box", ra, rows)
        for scene in ("nu", "vdw"):
            yield from spam_rows("printed", scene, ra, 50)
    for ra in (5000.0, 10000.0):
        for number, variant in enumerate((*RULES[1:], *OTHERS)):
            for rows in (25, 50):
                yield from spam_rows(variant, "layer", ra, rows, 25.0 if variant == WILD else 0.3 + 0.15*number)
        yield from fallen(LOST, ra, 25)
        yield from fallen(LOST, ra, 50)
    yield from point_rows()


def point_rows():
    """Fixed and moving points: second order, the moving ones from below."""
    signs = {"fixed-lattice": 1, "moving": -1, "moving-no-shift": -1}
    for ra, rows, (variant, sign) in itertools.product((5000.0, 10000.0), (25, 40, 50), signs.items()):
        ke = k(ra)*(1 + sign*15/rows**2)
        yield energies(("dih", variant), "layer", ra, rows, ke, ke, particles=2*rows**2)


def fallen(variant, ra, rows):
    """Rows of runs that diverged, as the study writes them."""
    for row in spam_rows(variant, "layer", ra, rows):
        yield row | dict.fromkeys((*VALUES, "cpu_s"),
                                  math.nan) | {"rolls": 0, "converged": False, "t_end": 30.0 + row["seed"]}


def runs():
    """All rows of kinetic_energy: some have not settled, one seed has diverged."""
    for row in kinetic():
        one = (row["variant"], row["ra"], row["resolution"], row["seed"])
        if one == (PARTLY, 10000.0, 25, 2):
            yield from (lost for lost in fallen(*one[:3]) if lost["seed"] == 2)
        else:
            yield row | {"converged": bool(row["converged"] and one[0] != RESTLESS and one != ("printed", 10000.0, 35, 1))}


def means(runs):
    """Means over seeds as the study has them: without runs that diverged."""
    for _, group in pd.DataFrame(runs).dropna(subset="ke").groupby(tables.POINT):
        row = group.iloc[0].to_dict()
        yield {name: row[name] for name in tables.MEANS.columns if name in row} | {
            "seeds": len(group), **{name: group[name].mean() for name in ("ke", "ke_field", "ke_mean", "nu", "ke_fluctuation")}}


def history():
    t = np.linspace(0, 4500, 60)
    for method, seeds in ((SPAM, (1, 2, 3)), (GRID, (0,))):
        for seed in seeds:
            ke = 0.0048 + 0.003*np.exp(-t/800)*np.cos(t/300 + 0.1*seed)
            for at, value in zip(t, ke):
                yield {**point(method, "layer", 1e4, 50), "seed": seed, "t": at, "t_viscous": at/5000, "ke": value*1.1,
                       "ke_field": value}


def flow(x, y):
    return np.sin(np.pi*x)*np.sin(2*np.pi*y)*0.1, np.cos(np.pi*x)*np.cos(np.pi*y)*0.1


def fields():
    x, y = (q.ravel() for q in np.meshgrid((np.arange(20) + 0.5)/10 - 1, (np.arange(10) + 0.5)/10 - 0.5))
    vx, vy = flow(x, y)
    names = ("x", "y", "rho", "T", "vx", "vy")
    for method, scene, rows in ((SPAM, "layer", 12), (GRID, "layer", 48), (SPAM, "vdw", 8)):
        for values in zip(x, y, 1 - 2*vy*y, 1 - y + 2*vy, vx, vy):
            yield {**point(method, scene, 1e4, rows), "seed": 1, **dict(zip(names, values))}


def particles():
    for variant, scene, rows, behind in (("printed", "layer", 12, "image"), ("printed", "vdw", 8, "image"),
                                         ("printed-fixed-rows", "layer", 12, "fixed")):
        x, y = (q.ravel() for q in np.meshgrid((np.arange(-3, 2*rows + 3) + 0.5)/rows - 1,
                                               (np.arange(-3, rows + 3) + 0.5)/rows - 0.5))
        for number, (px, py, vx, vy) in enumerate(zip(x, y, *flow(x, y))):
            kind = "fluid" if abs(px) < 1 and abs(py) < 0.5 else behind if abs(px) < 1 else "image"
            yield {**point(("spam", variant), scene, 1e4, rows), "seed": 1, "number": number, "kind": kind, "x": px,
                   "y": py, "vx": vx, "vy": vy}


def errors(mean):
    """Against K of the made-up fluid, for Kg against what smoothing leaves of it."""
    for row in mean:
        gas = row["method"] != "boussinesq" and math.isfinite(row["resolution"])
        here = [name for name, words in SCENES.items() if words == (row["eos"], row["transport"], row["sides"])]
        ref = k(row["ra"], here[0]) if gas else 0
        for energy, column, left in (("Kp", "ke", 1), ("Kg", "ke_field", kept_by_smoothing(row["resolution"]))):
            if ref and (energy == "Kp" or row["method"] == "spam"):
                yield {name: row[name] for name in tables.POINT} | {
                    "particles": row["particles"], "ke": row[column], "ke_err": row[f"{column}_err"], "reference": left*ref,
                    "reference_err": 0.0, "error": row[column]/(left*ref) - 1, "error_err": row[f"{column}_err"]/ref,
                    "energy": energy, "cpu_s": 1e-3*row["resolution"]**3}
        if ref:
            yield {name: row[name] for name in tables.POINT} | {
                "particles": row["particles"], "ke": 1.5, "ke_err": 0.0, "reference": 1.5, "reference_err": 0.0,
                "error": -7.5/row["resolution"]**1.5, "error_err": 0.01/row["resolution"], "energy": "Nu",
                "cpu_s": 1e-3*row["resolution"]**3}


def smoothed():
    for ra in (5000.0, 10000.0):
        for rows in (25, 35, 50):
            yield {**point(GRID, "layer", ra, 48), "weight": "Lucy", "h": 3.0, "rows": rows, "ke": k(ra),
                   "ke_smoothed": k(ra)*kept_by_smoothing(rows)}
