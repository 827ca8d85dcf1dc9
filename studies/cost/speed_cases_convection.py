"""Who takes part in Rayleigh-Benard convection at Ra = 10 000, from KHP95's rolls: scene of the study `rb`.

    K, velocity, temperature    of the steady state, against the compressible grid's by Newton's method, extrapolated
    K(t)                        over the first 30 free-fall times, against the compressible grid in time, extrapolated

A steady state is reached at the time t* after which K, averaged over a free-fall time, stays as near to its end as the quantity's
own error; from there on a flow that fluctuates is averaged until the statistical error is as small as that, too. What a quantity
costs is that share of the run. Of smooth particles K is that of the smoothed field, told against the grid's field smoothed alike.
Boussinesq grids have another fluid: they are told against their own limit.
"""
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from continuum.compressible import March, limits
from continuum.compressible import run as run_grid
from continuum.compressible_fields import Fields, block, initial, interpolate, kinetic_energy, node_densities, nodes
from continuum.compressible_loop import VX, VY, E, FluxForm
from continuum.compressible_newton import steady as newton
from continuum.fluid import temperature
from continuum.scene import RayleighBenard
from continuum.steady import Time
from particles.limits import limit_of
from particles.methods.moving import EXCHANGED
from particles.observe import field_kinetic, fields_at
from particles.run import Plan, run
from particles.team import Team
from studies.convection import dih, moving, spam
from studies.convection.names import START_ENERGY
from studies.convection.smoothing import Smoothing, smoothed_energy
from studies.cost import speed_names as names
from studies.cost.speed_problem import Problem, Residuals, holding, plain
from studies.kit.stats import settled

RA = 1e4
END, EARLY, LATE = 90.0, 30.0, 40.0     # free-fall times: of the run, of K(t), from which averages are taken
OFTEN = 4           # samples a free-fall time
SIZES = (32, 48, 64)                    # of the references
MIDDLE = 1/8        # of the height on either side of the middle, where the place of the rolls is read
#: by rows^3, seconds of the whole case, for the order of the cases only
SECONDS = 1e-4


class Reference(NamedTuple):
    """K of the steady state and its uncertainty, its fields on two grids, K(t) over free-fall times and its uncertainty."""
    ke: float
    known: float
    fields: tuple[Fields, ...]
    history: CubicSpline
    history_known: float


def scene_of(rows: float) -> RayleighBenard:
    """Unit spacing."""
    return RayleighBenard(ra=RA, L=float(rows))


def extrapolated(coarse: Any, fine: Any, sizes: Sequence[int]) -> Any:
    """Second order."""
    share = sizes[1]**2/(sizes[1]**2 - sizes[0]**2)
    return fine*share - coarse*(share - 1)


@cache
def reference(sizes: tuple[int, int, int] = SIZES) -> Reference:
    """The gas."""
    scene = RayleighBenard(ra=RA)
    found = [newton(scene, rows) for rows in sizes]
    unit = scene.L/scene.free_fall
    curves = [run_grid(scene, rows, until=Time(EARLY*unit, round(EARLY*OFTEN)),
                       start=initial(scene, rows, START_ENERGY)).series.ke for rows in sizes]
    (before, ke), (early, curve) = ([extrapolated(q[n], q[n + 1], sizes[n:n + 2]) for n in (0, 1)]
                                    for q in ([state.ke for state in found], curves))
    off = float(np.sqrt(np.mean((curve - early)**2)/np.mean(curve**2)))
    return Reference(ke, abs(ke - before)/ke, (found[1].fields, found[2].fields),
                     CubicSpline(np.linspace(0, EARLY, len(curve)), curve), off)


class Followed(NamedTuple):
    """A run: free-fall times, K then, the state at the end."""
    t: np.ndarray
    ke: np.ndarray
    state: Any


class Seen(NamedTuple):
    """Fields at the end: places in heights (n, 2), velocity (n, 2), temperature, share of the volume."""
    x: np.ndarray
    v: np.ndarray
    T: np.ndarray
    V: np.ndarray


def exact_fields(found: Reference, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Velocities (n, 2) and temperatures at places in heights."""
    L = found.fields[0].scene.L
    coarse, fine = (interpolate(fields, *(L*x.T)) for fields in found.fields)
    sizes = (len(found.fields[0].y) - 1, len(found.fields[1].y) - 1)
    vx, vy, T = (extrapolated(getattr(coarse, name), getattr(fine, name), sizes) for name in ("vx", "vy", "T"))
    return np.stack([vx, vy], axis=1), T


def aligned(seen: Seen) -> np.ndarray:
    """Places shifted along x so that the rolls lie as at the start, rising in the middle; in the box |x| <= 1."""
    near = np.abs(seen.x[:, 1]) < MIDDLE
    phase = np.angle(np.sum(seen.V[near]*seen.v[near, 1]*np.exp(-1j*np.pi*seen.x[near, 0])))
    x = seen.x[:, 0] + phase/np.pi
    return np.stack([(x + 1) % 2 - 1, seen.x[:, 1]], axis=1)


def compared(seen: Seen, found: Reference) -> Residuals:
    """Velocity and temperature, weighted by volume; the temperature relative to the rms of what differs from 1."""
    v, T = exact_fields(found, aligned(seen))
    w = np.sqrt(len(seen.V)*seen.V/seen.V.sum())
    size_v, size_T = np.sqrt(np.mean(w**2*(v**2).sum(axis=1))/2), np.sqrt(np.mean(w**2*(T - 1)**2))
    return {"velocity": ((seen.v - v)*w[:, None]/size_v).ravel(), "temperature": (seen.T - T)*w/size_T}


def end_of(done: Followed, noisy: bool) -> tuple[float, float]:
    """K of the end and its statistical error."""
    if not noisy:
        return float(done.ke[-1]), 0.0
    late, _ = settled(done.ke[done.t > LATE*done.t[-1]/END])
    return late


def residuals_of(done: Followed, see: Callable[[Any], Seen] | None, noisy: bool, factor: float, found: Reference) -> Residuals:
    """All quantities; `factor`: what smoothing alone makes of K."""
    ke, times = end_of(done, noisy)[0], np.arange(1, round(EARLY*OFTEN))/OFTEN
    exactly = factor*found.history(times)
    off = (CubicSpline(done.t, done.ke)(times) - exactly)/np.sqrt(np.mean(exactly**2))
    return {"K": np.array([ke/(factor*found.ke) - 1]), "K(t)": off, **(compared(see(done.state), found) if see else {})}


def shares_of(done: Followed, errors: dict[str, float], noisy: bool) -> dict[str, float]:
    """Of the run, by quantity: rule at the head of this file."""
    ke, err = end_of(done, noisy)
    width = OFTEN if len(done.ke) > 4*OFTEN else 1
    smooth = np.convolve(done.ke/ke - 1, np.ones(width)/width, "valid")
    times, found = done.t[width - 1:], {}
    for name, error in errors.items():
        outside = np.flatnonzero(np.abs(smooth) > error)
        reached = times[min(outside[-1] + 1, len(times) - 1)] if len(outside) else times[0]
        averaged = (END - LATE)*min(1.0, (err/ke/error)**2) if noisy else 0.0
        found[name] = min(1.0, (reached + averaged)/done.t[-1])
    return found | {"K(t)": min(1.0, EARLY/done.t[-1])}


def problem_of(points: int, first: Any, limit: float, follow: Callable[[Any, float, int], Followed],
               step: Callable[[Any, float, int], Any], held: Callable[[], tuple], see: Callable[[Any], Seen] | None, *,
               unit: float, noisy: bool = False, factor: float = 1.0, found: Reference | None = None) -> Problem:
    """What all contestants share; unit: of free-fall time."""
    found = found or reference()

    def residuals(done: Followed) -> Residuals:
        return residuals_of(done, see, noisy, factor, found)

    def share(done: Followed) -> dict[str, float]:
        errors = {name: max(found.known, float(np.sqrt(np.mean(off**2)))) for name, off in residuals(done).items()}
        return shares_of(done, errors, noisy)

    def uncertain(done: Followed) -> dict[str, float]:
        return {"K": end_of(done, noisy)[1]/(factor*found.ke), "K(t)": found.history_known}
    return Problem(points, first, limit, END*unit, follow, residuals, held, found.known, noisy, step, uncertain, share)


def sampled(method: Any, quantity: Callable, unit: float) -> Callable[[np.ndarray, float, int], Followed]:
    """`go` of a method of the particles' time loop, with K on the way."""
    def follow(first: np.ndarray, dt: float, steps: int) -> Followed:
        every = max(1, round(unit/OFTEN/dt))
        done = run(method, first, Plan(dt=dt, steps=steps, series={"ke": quantity}, every=every))
        # the rolls of the start
        return Followed(np.array([0.0, *done.times])/unit, np.array([START_ENERGY, *done.series["ke"]]), done.by_id())
    return follow


class OnFixed(NamedTuple):
    """Fixed points."""
    name: str
    scheme: dih.Scheme
    first: float = 0.9
    sizes: tuple[int, int, int] = SIZES

    def seconds(self, rows: int) -> float:
        return 3*SECONDS*rows**3

    def problem(self, rows: int, seed: int) -> Problem:
        scene = scene_of(rows)
        method = dih.fluid(scene, self.scheme, seed)
        first, unit = dih.start(scene, method), scene.L/scene.free_fall

        def see(state: np.ndarray) -> Seen:
            v = (state[1:3]/state[0]).T
            T = temperature(scene.eos, state[0], state[3]/state[0] - (v**2).sum(axis=1)/2)
            return Seen(method.x/scene.L, v, T, method.edges.V)
        return problem_of(first.shape[1], first, limit_of(method, first), sampled(method, dih.kinetic, unit), plain(method),
                          holding(method, first), see, unit=unit, found=reference(self.sizes))


class OnMoving(NamedTuple):
    """Moving points."""
    name: str
    first: float = 1.0
    sizes: tuple[int, int, int] = SIZES

    def seconds(self, rows: int) -> float:
        return 20*SECONDS*rows**3

    def problem(self, rows: int, seed: int) -> Problem:
        scene = scene_of(rows)
        method = moving.method(scene, moving.MOTIONS["moving"])
        first, unit = moving.start(scene, method, seed), scene.L/scene.free_fall

        def see(state: np.ndarray) -> Seen:
            px, py, m, V, total = state[EXCHANGED]
            v = np.stack([px, py], axis=1)/m[:, None]
            return Seen(state[:2].T/scene.L, v, temperature(scene.eos, m/V, total/m - (v**2).sum(axis=1)/2), V)
        return problem_of(first.shape[1], first, limit_of(method, first), sampled(method, moving.kinetic, unit), plain(method),
                          holding(method, first), see, unit=unit, noisy=True, found=reference(self.sizes))


class OnSpam(NamedTuple):
    """Smooth particles; K of the smoothed field."""
    name: str
    variant: spam.Variant
    first: float = 2*spam.OF_LIMIT
    sizes: tuple[int, int, int] = SIZES

    def seconds(self, rows: int) -> float:
        return 12*SECONDS*rows**3

    def problem(self, rows: int, seed: int) -> Problem:
        scene, found = scene_of(rows), reference(self.sizes)
        method, first, unit = spam.method(scene, self.variant), spam.start(scene, seed), scene.L/scene.free_fall
        plainly, smooth = smoothed_energy(found.fields[1], Smoothing(self.variant.weight, self.variant.h, rows))

        def see(state: np.ndarray) -> Seen:
            n = state.shape[1]
            sums, copy = method.start(n, Team(1)), state.copy()
            sums.around.relist(copy, np.arange(n), 0.0)
            sums.densities(copy)
            at = fields_at(sums, copy, *state[:2])
            return Seen(state[:2].T/scene.L, np.stack([at.vx, at.vy], axis=1), at.T, np.full(n, 1.0/n))
        return problem_of(first.shape[1], first, limit_of(method, first), sampled(method, field_kinetic, unit), plain(method),
                          holding(method, first), see, unit=unit, noisy=True, factor=smooth/plainly, found=found)


class OnGrid(NamedTuple):
    """The compressible grid in time."""
    name: str
    first: float = 0.9
    sizes: tuple[int, int, int] = SIZES

    def seconds(self, rows: int) -> float:
        return SECONDS*rows**3

    def problem(self, rows: int, seed: int) -> Problem:
        scene = scene_of(rows)
        first, unit = block(initial(scene, rows, START_ENERGY)), scene.L/scene.free_fall

        def follow(S: np.ndarray, dt: float, steps: int) -> Followed:
            march, every = March(scene, S.copy(), FluxForm(), dt), max(1, round(unit/OFTEN/dt))
            t, ke = [0.0], [START_ENERGY]
            while march.steps < steps:
                march.go(min(every, steps - march.steps))
                t.append(march.t/unit)
                ke.append(kinetic_energy(march.S))
            return Followed(np.array(t), np.array(ke), march.S)

        def see(S: np.ndarray) -> Seen:
            """All nodes but those on the right side, which are those on the left."""
            x, y = nodes(scene, rows)
            X, Y = (q[:, :-1].ravel()/scene.L for q in np.meshgrid(x, y))
            rho, (vx, vy, e) = node_densities(S)[:, :-1], (S[f, 1:, 1:-1] for f in (VX, VY, E))
            V = np.ones_like(rho)
            V[[0, -1]] = 0.5
            return Seen(np.stack([X, Y], axis=1), np.stack([vx.ravel(), vy.ravel()], axis=1),
                        temperature(scene.eos, rho, e).ravel(), V.ravel())
        march = March(scene, first.copy(), FluxForm(), 1.0)
        return problem_of(rows*round(scene.aspect*rows), first, limits(scene, filled(scene, first)).both, follow,
                          lambda S, dt, steps: March(scene, S.copy(), FluxForm(), dt).go(steps),
                          lambda: (march.S, march.scratch), see, unit=unit, found=reference(self.sizes))


def filled(scene: RayleighBenard, S: np.ndarray) -> np.ndarray:
    """A block with its ghosts."""
    march = March(scene, S.copy(), FluxForm(), 1.0)
    return march.S


GRID = OnGrid(names.GRID)
LATTICES = (OnFixed(names.NEAREST, dih.Scheme("fixed-lattice-h1.2", h=1.2)), OnFixed(names.LATTICE, dih.SCHEMES["fixed-lattice"]),
            OnFixed(names.WIDE, dih.SCHEMES["fixed-lattice-h3"]))
JITTERED = OnFixed(names.JITTERED, dih.SCHEMES["fixed-jittered-plates"])
RELAXED = OnFixed(names.RELAXED, dih.SCHEMES["relaxed-plates"])
PRINTED = OnSpam(names.LUCY, spam.PRINTED)
PARTICLES = (OnSpam(names.MONAGHAN, spam.VARIANTS["printed-monaghan"]), OnSpam(names.WENDLAND, spam.VARIANTS["wendland-c2"]),
             OnSpam(names.LESS_STATIC, spam.VARIANTS["less-static-50"]))
MOVING = OnMoving(names.MOVING)
