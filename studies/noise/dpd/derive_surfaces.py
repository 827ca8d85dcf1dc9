"""Viscosity over density; drag of cylinders against what slip along a flat wall foretells; candidates for what is missing."""
from collections.abc import Iterator
from math import hypot, log, nan, pi, sqrt
from typing import Any

import numpy as np
import pandas as pd
from scipy.optimize import brentq

from continuum.exact.cylinder import drag_of
from studies.kit.table import Table, Tables
from studies.noise.dpd.derive import GAMMA, RHO, weighted
from studies.noise.dpd.slip import drag as smooth
from studies.noise.dpd.slip import slip_of
from studies.noise.dpd.surfaces import ARRAY

FRACTION, A, ALPHA = 0.2, 25.0, 0.101       # solid fraction of the arrays; P = rho kT + alpha a rho^2
#: viscosity = eta (rho/3)^power in shear, at one step and rate
VISCOSITY = Table("viscosity", key=["dt", "rate"], columns=["dt", "rate", "densities", "eta", "eta_err", "power", "power_err"])
#: drag over eta U with density and viscosity of the fluid far from the cylinder, inertia taken out; ratio: to that of Sangani &
#: Acrivos; predicted: the ratio with the slip length of the flat wall of the same surface; moved: without slip, but on a smaller
#: cylinder by as much as the profile at the flat wall vanishes behind it; over: ratio over predicted; slip: that has this drag
SURFACES = Table("surfaces", key=ARRAY, columns=[
    *ARRAY, "reynolds", "viscosity", "viscosity_err", "inertia", "drag", "drag_err", "published", "ratio", "ratio_err",
    "wall_slip", "wall_slip_err", "predicted", "predicted_err", "moved", "over", "over_err", "slip", "slip_err"])
#: numbers foretold and measured, one a candidate
CAUSES = Table("causes", key=["cause"], columns=["cause", "predicted", "predicted_err", "measured", "measured_err"])
ALL = (VISCOSITY, SURFACES, CAUSES)


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows, as far as the tables allow."""
    shear, arrays, slabs, inertia, drag = (tables.get(name, pd.DataFrame()) for name in (
        "dpd_shear", "arrays", "slabs", "inertia", "drag"))
    rows: dict[str, list[dict[str, Any]]] = {"viscosity": list(viscosities(shear)) if len(shear) else []}
    law = pd.DataFrame(rows["viscosity"])
    if len(law) and len(arrays) and len(slabs) and len(inertia):
        rows["surfaces"] = list(surfaces(arrays, slabs, inertia, law))
        rows["causes"] = list(causes(arrays, slabs, law, pd.DataFrame(rows["surfaces"]), drag))
    return {name: found for name, found in rows.items() if found}


def viscosities(shear: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """ln eta over ln rho by least squares, where there are two densities and more."""
    some = shear[(shear["a"] == A) & (shear["integrator"] == "VelocityVerlet")]
    for (dt, rate), group in some.groupby(["dt", "rate"]):
        if group["rho"].nunique() > 1:
            x, eta = np.log(group["rho"].to_numpy()/RHO), group["viscosity"].to_numpy()
            level, power = weighted(np.stack([np.ones_like(x), x], axis=1), np.log(eta), group["viscosity_err"].to_numpy()/eta)
            at = float(np.exp(level.value))
            yield {"dt": dt, "rate": rate, "densities": group["rho"].nunique(), "eta": at, "eta_err": at*level.err,
                   "power": power.value, "power_err": power.err}


def at_density(law: pd.DataFrame, dt: float, rho: float) -> tuple[float, float]:
    """Viscosity and its error at a density."""
    row = law[law["dt"] == dt].iloc[0]
    eta = row["eta"]*(rho/RHO)**row["power"]
    return float(eta), float(eta*hypot(row["eta_err"]/row["eta"], row["power_err"]*log(rho/RHO)))


def surfaces(arrays: pd.DataFrame, slabs: pd.DataFrame, inertia: pd.DataFrame, law: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Drag against prediction."""
    fixed, known = inertia[inertia["fraction"] == FRACTION], drag_of(FRACTION)[0]
    for _, row in arrays.iterrows():
        eta, eta_err = at_density(law, row["dt"], row["far"])
        P, volume = row["momentum"], row["side"]**2*row["depth"]
        reynolds = 2*row["radius"]*P/volume/eta
        # it grows as Re^2: from the Reynolds number that is nearest
        near = fixed.iloc[(fixed["reynolds"] - reynolds).abs().argmin()]
        adds = 1 + (near["ratio"] - 1)*(reynolds/near["reynolds"])**2
        drag = row["push"]*row["far"]**2*volume**2/(eta*P*row["depth"])/adds
        relative, ratio = hypot(eta_err/eta, row["momentum_err"]/P, row["balance_err"]), drag/known
        found = {"reynolds": reynolds, "viscosity": eta, "viscosity_err": eta_err, "inertia": adds, "drag": drag,
                 "drag_err": drag*relative, "published": known, "ratio": ratio, "ratio_err": ratio*relative}
        slips = [row["radius"]*slip_of(ratio*by, FRACTION) for by in (1 + relative, 1, 1 - relative)]
        yield {**{name: row[name] for name in ARRAY}, **found, "slip": slips[1], "slip_err": (slips[2] - slips[0])/2,
               **foretold(row, slabs[slabs["surface"] == row["surface"]], ratio, relative)}


def resisting(fraction: float, slip: float = 0.0) -> float:
    """Drag with slip over that without; nan where a short run's wall holds the fluid so far off that cylinders would touch."""
    try:
        return smooth(fraction, slip)/smooth(FRACTION)
    except ValueError:
        return nan


def foretold(row: pd.Series, slab: pd.DataFrame, ratio: float, relative: float) -> dict[str, float]:
    """What the slip along the flat wall makes of the drag."""
    if slab.empty:
        return dict.fromkeys(("wall_slip", "wall_slip_err", "predicted", "predicted_err", "moved", "over", "over_err"), nan)
    wall, radius = slab.iloc[0], row["radius"]
    low, at, high = (resisting(FRACTION, (wall["slip"] + sign*wall["slip_err"])/radius) for sign in (1, 0, -1))
    half = wall["height"]/2
    behind = sqrt(half**2 + 2*half*wall["slip"]) - half        # of the wall, where the parabola vanishes
    over = ratio/at
    return {"wall_slip": wall["slip"], "wall_slip_err": wall["slip_err"], "predicted": at, "predicted_err": (high - low)/2,
            "moved": resisting(FRACTION*(1 - behind/radius)**2), "over": over,
            "over_err": over*hypot(relative, (high - low)/2/at)}


def inside_density(far: float, frozen: float) -> float:
    """Of fluid in equilibrium with fluid `far` away, among `frozen` particles a volume: kT ln rho + 2 alpha a rho_all is one."""
    return float(brentq(lambda rho: log(rho/far) + 2*ALPHA*A*(frozen + rho - far), 1e-12, far))


def darcy_share(row: pd.Series) -> float:
    """Momentum in the cylinder over all, its fluid driven by the push and by as steep a pressure as all of the force could make,
    and held by friction alone, (rho gamma/3) int w^2 dV a particle.
    """
    body = pi*row["radius"]**2*row["depth"]
    pull = row["push"] + row["push"]*(row["n"] - row["held"])/(row["far"]*body)
    return float(row["inside"]*body*pull/(row["frozen"]*GAMMA/3*4*pi/30)/row["momentum"])


def rubbing_slip(eta: float, far: float, frozen: float) -> float:
    """Slip length of a flat wall that only rubs: eta over pi gamma rho rho_wall rc^5/240, fluid up to it as dense as far away."""
    return eta/(pi*GAMMA*far*frozen/240)


def causes(arrays: pd.DataFrame, slabs: pd.DataFrame, law: pd.DataFrame, found: pd.DataFrame,
           drag: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """One row a candidate."""
    both = arrays.merge(found, on=ARRAY).sort_values(["radius", "asked"])
    frozen = both[both["surface"] == "frozen"]
    if frozen.empty:
        return
    usual = frozen.iloc[0]
    yield cause("fluid in the cylinder, density", inside_density(usual["far"], usual["frozen"]), usual["inside"])
    yield cause("fluid in the cylinder, share of the stream", darcy_share(usual), usual["carried"], usual["carried_err"])
    for _, row in both[both["surface"] == "dense"].iterrows():
        yield cause("fluid in the cylinder: drag of the dense one, in which there is none", 1.0, row["ratio"], row["ratio_err"])
    for _, wall in slabs.iterrows():
        eta, eta_err = at_density(law, wall["dt"], wall["far"])
        name = f"flat wall, {wall['surface']}"
        yield cause(f"{name}: viscosity of the profile", eta, wall["viscosity"], wall["viscosity_err"], eta_err)
        yield cause(f"{name}: slip length if it only rubs", rubbing_slip(eta, wall["far"], wall["frozen"]), wall["slip"],
                    wall["slip_err"])
    for _, row in both.iterrows():
        yield cause(f"slip: drag, {row['surface']}, radius {row['radius']:g}, Re {row['asked']:g}", row["predicted"],
                    row["ratio"], row["ratio_err"], row["predicted_err"])
    fast = frozen[(frozen["radius"] == usual["radius"]) & (frozen["asked"] > usual["asked"])]
    if len(fast):
        yield cause("inertia, shear thinning, compression: drag at the greater force over that at the smaller", 1.0,
                    *over(fast.iloc[-1], usual))
    first = drag[(drag["variant"] == "frozen") & (drag["radius"] == usual["radius"])] if len(drag) else drag
    if len(first):
        yield cause("another freezing, read with density and viscosity far away, over the first one as it was read", 1.0,
                    *over(usual, first.iloc[0]))


def cause(name: str, predicted: float, measured: float, measured_err: float = nan, predicted_err: float = nan) -> dict[str, Any]:
    """A row."""
    return {"cause": name, "predicted": predicted, "predicted_err": predicted_err, "measured": measured,
            "measured_err": measured_err}


def over(one: pd.Series, other: pd.Series) -> tuple[float, float]:
    """Ratio of two drags with its error; that of the viscosity is the same in both and counted twice."""
    value = one["ratio"]/other["ratio"]
    return value, value*hypot(one["ratio_err"]/one["ratio"], other["ratio_err"]/other["ratio"])
