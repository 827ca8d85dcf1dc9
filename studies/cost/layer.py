"""Convection at Ra = 10 000, and 5000, from KHP95's rolls: references, what a run is held against, what share of it is needed.

    K, velocity, temperature    of the steady state, against the compressible grid's by Newton's method, extrapolated
    K(t)                        over the first 30 free-fall times, against the compressible grid in time, extrapolated

A steady state is reached at the time t* after which K, averaged over a free-fall time, stays as near to its end as the
quantity's own error; from there on a flow that fluctuates is averaged until the statistical error is as small as that,
too. What a quantity costs is that share of the run.
"""
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from continuum.boussinesq import HALF_LAYER, LAYER, Case, khp95, steady, transient
from continuum.boussinesq.projection import CFL_LIMIT
from continuum.gas.fields import NodeFields, initial, interpolate
from continuum.gas.newton import steady as newton
from continuum.gas.solve import run as run_grid
from continuum.scene import RayleighBenard
from continuum.steady import Time
from studies.build.names import START_ENERGY
from studies.cost.problem import Problem, Residuals, relative, rms
from studies.kit.stats import settled

RA, LOWER_RA = 1e4, 5000.0
PR = 2.0            # of the Boussinesq fluid that is nearest to the gas
END, EARLY, LATE = 90.0, 30.0, 40.0     # free-fall times: of the run, of K(t), from which averages are taken
SETTLED = 60.0      # the same where an error of 1 % counts: K of the grid is off by 1 % until 47, by 0.2 % until 60
OFTEN = 4           # samples a free-fall time
MIDDLE = 1/8        # of the height on either side of the middle, where the place of the rolls is read


class Sizes(NamedTuple):
    """Rows of three references, and of those of K(t) of the Boussinesq fluid."""
    steady: tuple[int, int, int] = (32, 48, 64)
    falls: tuple[int, int, int] = (24, 32, 48)


USUAL = Sizes()


class Reference(NamedTuple):
    """K of the steady state and its uncertainty, its fields on two grids, K(t) and its uncertainty."""
    ke: float
    known: float
    fields: tuple[NodeFields, ...]
    history: CubicSpline
    history_known: float


def scene_of(rows: float, ra: float = RA) -> RayleighBenard:
    """Unit spacing."""
    return RayleighBenard(ra=ra, L=float(rows))


def extrapolated(coarse: Any, fine: Any, sizes: Sequence[int]) -> Any:
    """Second order."""
    share = sizes[1]**2/(sizes[1]**2 - sizes[0]**2)
    return fine*share - coarse*(share - 1)


def twice(values: Sequence[Any], sizes: Sequence[int]) -> tuple[Any, Any]:
    """Limits by the two coarser and by the two finer of three grids."""
    coarse, middle, fine = values
    return extrapolated(coarse, middle, sizes[:2]), extrapolated(middle, fine, sizes[1:])


def referred(ke: Sequence, sizes: Sequence[int], curves: Sequence, falls: Sequence[int], fields: tuple) -> Reference:
    """Limits of three grids; what the coarsest grid changes of them is their uncertainty."""
    (before, last), (early, curve) = twice(ke, sizes), twice(curves, falls)
    off = float(np.sqrt(np.mean((curve - early)**2)/np.mean(curve**2)))
    times = np.linspace(0, EARLY, len(curve))
    return Reference(last, abs(last - before)/last, fields, CubicSpline(times, curve), off)


@cache
def reference(sizes: Sizes = USUAL, ra: float = RA) -> Reference:
    """The gas."""
    scene, rows = RayleighBenard(ra=ra), sizes.steady
    states = [newton(scene, n) for n in rows]
    until = Time(EARLY*scene.L/scene.free_fall, round(EARLY*OFTEN))
    runs = [run_grid(scene, n, until=until, start=initial(scene, n, START_ENERGY)) for n in rows]
    fields = tuple(state.fields for state in states[1:])
    return referred([state.ke for state in states], rows, [one.series.ke for one in runs], rows, fields)


@cache
def boussinesq_reference(sizes: Sizes = USUAL) -> Reference:
    """The Boussinesq fluid's own limits; without fields."""
    ke = [steady(Case(ra=RA, pr=PR, box=HALF_LAYER, rows=n)).K for n in sizes.steady]
    return referred(ke, sizes.steady, [fall(n) for n in sizes.falls], sizes.falls, ())


def fall(rows: int) -> np.ndarray:
    """K(t) of the Boussinesq fluid."""
    case = Case(ra=RA, pr=PR, box=LAYER, rows=rows)
    done = transient(case, khp95(case, START_ENERGY), until=EARLY, dt=CFL_LIMIT/2/rows, within=0.0)
    return np.asarray(CubicSpline(done.t, done.K)(np.arange(round(EARLY*OFTEN) + 1)/OFTEN))


# --- a run ------------------------------------------------------------------------------------------------------


class Followed(NamedTuple):
    """A run: free-fall times, K then, the state at the end."""
    t: np.ndarray
    ke: np.ndarray
    state: Any


class Rules(NamedTuple):
    """How runs are judged. late : of a flow that fluctuates, from when it is averaged. factor : smoothing's own on K."""
    against: Reference
    late: float = 0.0
    factor: float = 1.0

    def end(self, done: Followed) -> tuple[float, float]:
        """K of the end and its statistical error; of a flow that fluctuates the mean."""
        if not self.late:
            return float(done.ke[-1]), 0.0
        mean, _ = settled(done.ke[done.t > self.late*done.t[-1]/END])
        return mean

    def residuals(self, done: Followed, at: Any = None) -> Residuals:
        """All quantities; those of fields `at` the end, in heights, if there are some."""
        times = np.arange(1, round(EARLY*OFTEN))/OFTEN
        exact = self.factor*self.against.history(times)
        off = (CubicSpline(done.t, done.ke)(times) - exact)/np.sqrt(np.mean(exact**2))
        K = self.end(done)[0]/(self.factor*self.against.ke) - 1
        return {"K": np.array([K]), "K(t)": off, **(compared(at, self.against) if at else {})}

    def share(self, done: Followed, residuals: Residuals) -> dict[str, float]:
        """Of the run, by quantity: rule at the head of this file."""
        errors = {name: max(self.against.known, rms(off)) for name, off in residuals.items()}
        whole = {name: self.needed(done, error)/done.t[-1] for name, error in errors.items()}
        return {name: min(1.0, share) for name, share in {**whole, "K(t)": EARLY/done.t[-1]}.items()}

    def needed(self, done: Followed, error: float) -> float:
        """Free-fall times until a quantity of the steady state is as good as its error."""
        ke, err = self.end(done)
        width = OFTEN if len(done.ke) > 4*OFTEN else 1
        smooth, times = np.convolve(done.ke/ke - 1, np.ones(width)/width, "valid"), done.t[width - 1:]
        outside = np.flatnonzero(np.abs(smooth) > error)
        reached = times[min(outside[-1] + 1, len(times) - 1)] if len(outside) else times[0]
        averaged = (END - self.late)*min(1.0, (err/ke/error)**2) if self.late else 0.0
        return float(reached + averaged)

    def uncertain(self, done: Followed) -> dict[str, float]:
        """Of averages over time, and of the reference's K(t)."""
        return {"K": self.end(done)[1]/(self.factor*self.against.ke), "K(t)": self.against.history_known}

    def judged(self, problem: Problem, see: Callable[[Any], Any] = lambda state: None) -> Problem:
        """A problem whose runs are `Followed`, with these rules; see : fields of a state, in heights."""
        def residuals(done: Followed) -> Residuals:
            return self.residuals(done, see(done.state))
        return problem._replace(residuals=residuals, share=lambda done: self.share(done, residuals(done)),
                                uncertain=self.uncertain, known=self.against.known, chaotic=bool(self.late))


def compared(at: Any, reference: Reference) -> Residuals:
    """Velocity and temperature, weighted by volume; the temperature relative to the rms of what differs from 1."""
    v, T = exact_fields(reference, aligned(at))
    w = np.sqrt(len(at.V)*at.V/at.V.sum())
    size = np.sqrt(np.mean(w**2*(v**2).sum(axis=1))/2)
    return {"velocity": ((at.v - v)*w[:, None]/size).ravel(), "temperature": relative(at.V, at.T - T, T - 1)}


def exact_fields(reference: Reference, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Velocities (n, 2) and temperatures at places in heights."""
    L = reference.fields[0].scene.L
    coarse, fine = (interpolate(fields, *(L*x.T)) for fields in reference.fields)
    sizes = [len(fields.y) - 1 for fields in reference.fields]
    vx, vy, T = (extrapolated(getattr(coarse, name), getattr(fine, name), sizes) for name in ("vx", "vy", "T"))
    return np.stack([vx, vy], axis=1), T


def aligned(at: Any) -> np.ndarray:
    """Places shifted along x so that the rolls lie as at the start, rising in the middle; in the box |x| <= 1."""
    near = np.abs(at.x[:, 1]) < MIDDLE
    phase = np.angle(np.sum(at.V[near]*at.v[near, 1]*np.exp(-1j*np.pi*at.x[near, 0])))
    x = at.x[:, 0] + phase/np.pi
    return np.stack([(x + 1) % 2 - 1, at.x[:, 1]], axis=1)
