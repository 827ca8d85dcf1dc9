"""What a rung of the ladder measures: (scene, method) -> numbers by name. Errors of the method go up."""
from typing import Any

import numpy as np

from continuum.fluid import Fields, energy
from particles.fields import kinetic, kinetic_energy
from particles.run import Divergence, Plan, run
from studies.build.answers import answer, duration
from studies.build.scenes import SOUND, TaylorGreen
from studies.build.unguarded import Unguarded, bisected
from studies.front.solution import Solution
from studies.front.solving import named, prepared, solve
from studies.judge.scenes import Carried
from studies.kit import csvfile
from studies.kit.store import RESULTS

Numbers = dict[str, float]
FEW = 50            # steps that two runs of one seed are compared after
TRIED = 300         # steps of a run at a step that may be too long
FED = 1.1           # of the first kinetic energy of a vortex, which can only decay: it is fed by the method
SAMPLES = 20        # of what is conserved, in a run


def error(scene: Any, method: Any) -> Numbers:
    """Difference from the exact answer, relative."""
    done = solve(scene, method)
    return {"error": done.error.value, "cpu_s": done.cpu_s}


def rest(scene: Any, method: Any) -> Numbers:
    """Of a fluid that was at rest at T = 1: rms speed over that of sound, and how much hotter it is."""
    at = solve(scene, method).places
    m = at.rho*at.V
    v2, T = (float((m*q).sum()/m.sum()) for q in (at.vx**2 + at.vy**2, at["T"]))
    return {"speed": v2**0.5/SOUND, "heating": T - 1}


def convection(scene: Any, method: Any) -> Numbers:
    """K and Nu with their errors; the error of K, relative to the grid's limit."""
    done = solve(scene, method)
    K = known_energy()
    return {"K": done.K.value, "K_err": done.K.err, "Nu": done.Nu.value, "error": done.K.value/K - 1,
            "error_err": done.K.err/K, "cpu_s": done.cpu_s}


def known_energy() -> float:
    """K at Ra 10 000, Pr 1, by the compressible grid in the limit of many cells."""
    rows = csvfile.read(RESULTS/"rb"/"kinetic_energy.csv")
    return float(rows.query("method == 'compressible' and variant == 'flux-form' and eos == 'ideal' and "
                            "transport == 'const-eta' and sides == 'periodic' and ra == 1e4 and pr == 1 and "
                            "resolution == inf")["ke"].iloc[0])


def frames(scene: Carried, method: Any) -> Numbers:
    """Errors of velocities over the vortex's speed, of the vortex at rest and carried by a wind."""
    still, carried = (velocity_error(solve(one, method)) for one in
                      (TaylorGreen(L=scene.L, mach=scene.mach), scene))
    return {"at_rest": still, "carried": carried, "ratio": carried/still}


def velocity_error(done: Solution) -> float:
    """Root of the mean square over the volume."""
    at = done.places
    exact = answer(done.scene, at[["x", "y"]].to_numpy())
    wrong = sum((at[name] - value)**2 for name, value in exact.items())
    return float(np.sqrt((at.V*wrong).sum()/at.V.sum())/done.scene.speed)


def kept(scene: TaylorGreen, method: Any) -> Numbers:
    """The largest drift of mass, momentum and energy, over the first mass, that times speed, the energy."""
    ready = prepared(scene, named(method))
    steps = int(np.ceil(duration(scene)[0]*duration(scene)[1]/ready.dt))
    totals: list[np.ndarray] = [total(scene, ready.method.fields(ready.start))]

    def look(sums: Any, state: np.ndarray) -> float:
        totals.append(total(scene, sums.method.fields(state)))
        return 0.0
    run(ready.method, ready.start, Plan(dt=ready.dt, steps=steps, every=max(1, steps//SAMPLES),
                                        series={"total": look}))
    mass, *_, heat = totals[0]
    drift = np.abs(np.array(totals) - totals[0]).max(axis=0)
    mass, px, py, heat = drift/[mass, mass*scene.speed, mass*scene.speed, heat]
    return {"mass": float(mass), "momentum": float(max(px, py)), "energy": float(heat)}


def total(scene: Any, at: Fields) -> np.ndarray:
    """Mass, momentum along both axes, energy."""
    m = at.rho*at.V
    e = energy(scene.eos, at.rho, at.T) + (at.v**2).sum(axis=1)/2
    return np.array([m.sum(), *(m@at.v), m@e])


def repeated(scene: Any, method: Any) -> Numbers:
    """The largest difference between two runs of one seed."""
    ends = []
    for _ in range(2):
        ready = prepared(scene, named(method))
        ends.append(run(ready.method, ready.start, Plan(dt=ready.dt, steps=FEW)).by_id())
    return {"difference": float(np.abs(ends[0] - ends[1]).max())}


def longest(scene: TaylorGreen, method: Any) -> Numbers:
    """The longest step at which a vortex does not gain energy, over the one that is claimed; nan: none is."""
    ready = prepared(scene, named(method))
    free = Unguarded(ready.method)

    def grows(dt: float) -> bool:
        plan = Plan(dt=dt, steps=TRIED, every=TRIED//10, series={"K": kinetic})
        try:
            K = run(free, ready.start, plan).series["K"]
        except (Divergence, ArithmeticError):
            return True
        return not max(K) < FED*kinetic_energy(ready.method.fields(ready.start))
    share = bisected(grows, ready.limit).value/ready.limit
    return {"claimed": ready.limit, "share": share, "grows": float(grows(ready.limit))}
