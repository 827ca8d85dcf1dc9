"""What convection at Ra = 10 000, and 5000, from KHP95's rolls is told against, and what share of a run a quantity needs.

    K, velocity, temperature    of the steady state, against the compressible grid's by Newton's method, extrapolated
    K(t)                        over the first 30 free-fall times, against the compressible grid in time, extrapolated

A steady state is reached at the time t* after which K, averaged over a free-fall time, stays as near to its end as the quantity's
own error; from there on a flow that fluctuates is averaged until the statistical error is as small as that, too. What a quantity
costs is that share of the run.
"""
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from continuum.gas.fields import Fields, initial, interpolate
from continuum.gas.newton import steady as newton
from continuum.gas.solve import run as run_grid
from continuum.scene import RayleighBenard
from continuum.steady import Time
from studies.build.names import START_ENERGY
from studies.cost.problem import Problem, Residuals
from studies.kit.stats import settled

RA, LOWER_RA = 1e4, 5000.0
END, EARLY, LATE = 90.0, 30.0, 40.0     # free-fall times: of the run, of K(t), from which averages are taken
SETTLED = 60.0      # the same where an error of 1 % is told: K of the grid is off by 1 % until 47, by 0.2 % until 60
OFTEN = 4           # samples a free-fall time
SIZES = (32, 48, 64)                    # of the references
MIDDLE = 1/8        # of the height on either side of the middle, where the place of the rolls is read


class Reference(NamedTuple):
    """K of the steady state and its uncertainty, its fields on two grids, K(t) over free-fall times and its uncertainty."""
    ke: float
    known: float
    fields: tuple[Fields, ...]
    history: CubicSpline
    history_known: float


def scene_of(rows: float, ra: float = RA) -> RayleighBenard:
    """Unit spacing."""
    return RayleighBenard(ra=ra, L=float(rows))


def extrapolated(coarse: Any, fine: Any, sizes: Sequence[int]) -> Any:
    """Second order."""
    share = sizes[1]**2/(sizes[1]**2 - sizes[0]**2)
    return fine*share - coarse*(share - 1)


@cache
def reference(sizes: tuple[int, int, int] = SIZES, ra: float = RA) -> Reference:
    """The gas."""
    scene = RayleighBenard(ra=ra)
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


def end_of(done: Followed, late: float | None) -> tuple[float, float]:
    """K of the end and its statistical error; of a flow that fluctuates the mean from `late` on."""
    if not late:
        return float(done.ke[-1]), 0.0
    mean, _ = settled(done.ke[done.t > late*done.t[-1]/END])
    return mean


def residuals_of(done: Followed, see: Callable[[Any], Seen] | None, late: float | None, factor: float,
                 found: Reference) -> Residuals:
    """All quantities; `factor`: what smoothing alone makes of K."""
    ke, times = end_of(done, late)[0], np.arange(1, round(EARLY*OFTEN))/OFTEN
    exactly = factor*found.history(times)
    off = (CubicSpline(done.t, done.ke)(times) - exactly)/np.sqrt(np.mean(exactly**2))
    return {"K": np.array([ke/(factor*found.ke) - 1]), "K(t)": off, **(compared(see(done.state), found) if see else {})}


def shares_of(done: Followed, errors: dict[str, float], late: float | None) -> dict[str, float]:
    """Of the run, by quantity: rule at the head of this file."""
    ke, err = end_of(done, late)
    width = OFTEN if len(done.ke) > 4*OFTEN else 1
    smooth = np.convolve(done.ke/ke - 1, np.ones(width)/width, "valid")
    times, found = done.t[width - 1:], {}
    for name, error in errors.items():
        outside = np.flatnonzero(np.abs(smooth) > error)
        reached = times[min(outside[-1] + 1, len(times) - 1)] if len(outside) else times[0]
        averaged = (END - late)*min(1.0, (err/ke/error)**2) if late else 0.0
        found[name] = min(1.0, (reached + averaged)/done.t[-1])
    return found | {"K(t)": min(1.0, EARLY/done.t[-1])}


def problem_of(points: int, first: Any, limit: float, follow: Callable[[Any, float, int], Followed],
               step: Callable[[Any, float, int], Any], held: Callable[[], tuple], see: Callable[[Any], Seen] | None, *,
               unit: float, late: float | None = None, factor: float = 1.0, found: Reference | None = None,
               firm: bool = False) -> Problem:
    """What all contestants share; unit: of free-fall time; late: of a flow that fluctuates, from when it is averaged."""
    found = found or reference()

    def residuals(done: Followed) -> Residuals:
        return residuals_of(done, see, late, factor, found)

    def share(done: Followed) -> dict[str, float]:
        errors = {name: max(found.known, float(np.sqrt(np.mean(off**2)))) for name, off in residuals(done).items()}
        return shares_of(done, errors, late)

    def uncertain(done: Followed) -> dict[str, float]:
        return {"K": end_of(done, late)[1]/(factor*found.ke), "K(t)": found.history_known}
    return Problem(points, first, limit, END*unit, follow, residuals, held, found.known, bool(late), firm, step, uncertain, share)
