"""Conservative scheme on moving points, which exchange volume, mass, momentum and energy over faces, in 2D.

Faces S_ij = -S_ji close and are exact on linear fields, see `faces`. Points move with the fluid, and shift
slightly towards even spacing. The volume that they pass to each other carries mass, momentum and energy,
which RR98's moving points (Eqs 46-48) lose. Images behind plates are those of `layer`.
"""
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from continuum.fluid import check_state, diffusivity, energy, sound_speed
from particles.fields import Fields, from_densities
from particles.integral import face_terms
from particles.integral.exchange import At, Exchange, Listing, stages
from particles.integral.faces import POTENTIALS, FaceMaker, inner
from particles.integral.interpolants import check_ordering
from particles.integral.transposed_stress import MENDED
from particles.limits import limit_of
from particles.lists import Listed, PairLists, unphysical
from particles.pairs import sweep
from particles.starts import check_apart, check_reach, check_volumes, moments
from particles.threads import Threads
from particles.walls import confine
from particles.weights import check_unit

#: rows of a state: position, velocity of points, momentum, mass, volume, total energy, solution of `faces`
ROWS = ("x", "y", "wx", "wy", "px", "py", "m", "V", "E", *POTENTIALS)
EXCHANGED, SOLVED = slice(4, 9), slice(9, 15)


class Ingredients(NamedTuple):
    """Ingredients of the scheme; each can be switched off.

    iterations : largest number for the faces, starting from the last solution; 0 leaves faces open, 12 change
    K by less than 1e-3. within : relative residual at which iterations end. shift : coefficient of the shift
    towards even spacing, in spacings^2 per time. follow : rate at which volumes follow the density of points.
    spread : diffusivity of mass against pressure waves of the spacing, over a c/2; smooth : share of a linear
    pressure that causes none. static : share of the hydrostatic and mean pressure left out of the faces.
    transport : listed terms of friction and heat along faces.
    """
    iterations: int = 1
    within: float = 1e-3
    shift: float = 1.0
    follow: float = 1.0
    spread: float = 0.1
    smooth: float = 1.0
    static: float = 1.0
    transport: tuple = MENDED


class DriftKickDrift:
    """Points move for half a step, exchange over fixed faces in three stages, move for the other half."""

    def __init__(self, shape: tuple[int, ...], threads: Threads):
        self.rates, self.first = np.zeros(shape), np.zeros(shape)

    def step(self, sums: "FaceSums", y: np.ndarray, dt: float) -> None:
        """Advance y in place by dt    [third-order strong-stability-preserving Runge-Kutta in between]"""
        sums.drift(y, dt/2)
        sums.make_faces(y)
        now, k, first = y[EXCHANGED], self.rates[EXCHANGED], self.first[EXCHANGED]
        first[:] = now
        for new in (1.0, 1/4, 2/3):
            sums.rates(y, self.rates)
            # rounds less than (1 - new) first + new (now + dt k)
            now[:] = first + new*(now - first + dt*k)
        # velocity of points: that of the fluid, and the shift
        y[2:4] = y[4:6]/y[6] + sums.shift.T
        sums.drift(y, dt/2)


class FaceSums(Listed):
    """The compiled sums of moving points, with the interface of the time loop."""

    def __init__(self, method: "Moving", n: int, threads: Threads):
        self.method, self.threads, self.n = method, threads, n
        self.around = PairLists(method.weight, method.walls, n, method.box, skin=0.5, threads=threads)
        self.maker = FaceMaker(self.around, method.ingredients.iterations, method.ingredients.within)
        self.slopes, self.P0, chosen = np.zeros((n, 6)), 0.0, method.ingredients
        term = face_terms.FaceExchange(chosen.follow, chosen.spread, chosen.smooth,
                                       Listing(chosen.transport))
        self.exchange = Exchange(term, stages(chosen.transport, method.law, n, threads), n, threads)
        self.shift, self._lists = np.zeros((n, 2)), -1

    def make_faces(self, state: np.ndarray) -> None:
        """Make pairs, faces and shift for the present positions; the solution is stored in the state."""
        self.maker.make(state, state[7], state[SOLVED])
        if self._lists != self.maker.lists_made:
            self._lists, self.points = self.maker.lists_made, np.zeros(len(self.around.x), face_terms.Point)
        shift = -self.method.ingredients.shift*self.maker.pull
        # no point shifts faster than 0.3 of the fastest flow
        most = 0.3*float(np.sqrt(((state[4]**2 + state[5]**2)/state[6]**2).max()))
        self.shift = shift*np.minimum(1.0, most/np.maximum(np.hypot(*shift.T), 1e-300))[:, None]

    def look_over(self, state: np.ndarray, ids: np.ndarray) -> None:
        """ValueError: points coincide or have no neighbours. Warns where the weight is too narrow."""
        V, weight = state[7], self.method.weight
        a = float(np.sqrt(V.mean()))
        self.around.place(state, 1.0)
        check_apart(self.around, ids, a)
        check_reach(weight, moments(self.around, V), ids)
        off = V*self.around.rho[:self.n] - 1
        check_ordering(weight, 2, a, float(np.sqrt((off**2).mean())),
                       wrong="volumes, which follow the density of points, are")

    def look_at(self, state: np.ndarray) -> At:
        """Compute fields of points and images with the present faces, and prepare the stages."""
        method, around, ghosts, points, n = self.method, self.around, self.maker.ghosts, self.points, self.n
        static, g = method.ingredients.static, method.g
        self.threads(face_terms.read, n, state, method.eos, method.law, static*g, self.shift,
                     around.rho, points)
        self.P0 = static*inner(state[7], points["P"][:n])/float(state[7].sum())
        points["P"][:n] -= self.P0
        face_terms.read_images(n, *ghosts, points)
        # pressure that is not left out of the faces continues hydrostatically behind plates
        points["P"][n:] += (1 - static)*g*(around.y[ghosts.origin] - around.y[n:])
        self.threads(sweep, n, face_terms.FaceDifferences(), points, self.maker.faces, self.slopes)
        self.threads(face_terms.pressure_slopes, n, self.slopes, state[7], points)
        ghosts.fill(points, ("gx",), ("gy",))
        at = At(points, self.maker.faces, ghosts, state[7])
        for stage in self.exchange.stages:
            stage.use(self.slopes, at)
        return at

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d/dt of the rows that faces exchange, written to `out[4:9]`."""
        method, total = self.method, self.exchange.sum(self.look_at(state))
        self.threads(face_terms.per_time, self.n, total, state, self.points, method.g,
                     method.ingredients.static, self.P0, out)

    def drift(self, state: np.ndarray, dt: float) -> None:
        """Move the points; plates reflect those that have crossed them, with their momentum."""
        state[:2] += dt*state[2:4]
        self.confine(state)

    def evaluate(self, state: np.ndarray) -> None:
        self.make_faces(state)
        self.rates(state, np.empty_like(state))

    def confine(self, state: np.ndarray) -> int:
        count = 0
        for wall in self.method.walls:
            before = state[2:4].copy()
            count += confine(wall, state)
            state[4:6] *= np.where(before*state[2:4] < 0, -1.0, 1.0)
        return count

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        px, py, m, V, E = state[EXCHANGED]
        return unphysical(self.method.eos, V, m/V, (E - (px**2 + py**2)/(2*m))/m,
                          ids) or self.outran(state)


@dataclass(frozen=True, kw_only=True)
class Moving:
    """A fluid on moving points, about one per unit area.

    weight : of `particles.weights`. walls : tuple of mirror plates and periodic sides. box : (width, height).
    g : gravity, downwards; `static` of the hydrostatic pressure -g y of mean density 1 is left out of faces.
    """
    weight: Any
    eos: Any
    law: Any
    walls: tuple
    box: tuple[float, float]
    g: float = 0.0
    ingredients: Ingredients = Ingredients()  # noqa: RUF009 (immutable)

    names = ROWS
    integrator = DriftKickDrift

    def __post_init__(self):
        check_unit(self.weight)

    def state(self, x: np.ndarray, rho: Any, v: np.ndarray, T: np.ndarray) -> np.ndarray:
        """(15, n) from positions (n, 2), densities, velocities (n, 2), temperatures (n,); equal volumes."""
        V = np.full(len(x), self.box[0]*self.box[1]/len(x))
        m, e = rho*V, energy(self.eos, rho, T)
        exchanged = [*(m[:, None]*v).T, m, V, m*(e + (v**2).sum(axis=1)/2)]
        return np.stack([*x.T, *v.T, *exchanged, *np.zeros((6, len(x)))])

    def fields(self, state: np.ndarray) -> Fields:
        px, py, m, V, E = state[EXCHANGED]
        return from_densities(self.eos, state[:2].T.copy(), V.copy(), m/V, np.stack([px, py])/V, E/V)

    def start(self, n: int, threads: Threads) -> FaceSums:
        return FaceSums(self, n, threads)


@limit_of.register
def _(method: Moving, start: np.ndarray) -> float:
    """Stability limit of three-stage Runge-Kutta, 1.73 and 2.5 on the axes, for rates 1.4 times a lattice's.

    On a lattice: sound slower than c, diffusion than 4 chi, volumes following at 2.9 `follow` (Wendland C2).
    """
    px, py, m, V, E = start[EXCHANGED]
    check_volumes(V)
    rho, e = m/V, E/m - (px**2 + py**2)/(2*m**2)
    check_state(method.eos, rho, e)
    chi = np.max(diffusivity(method.eos, method.law, rho, e))
    fast = np.max(sound_speed(method.eos, rho, e) + np.hypot(px, py)/m)
    return float(1/1.4/max(fast/1.73 + 4*chi/2.5, 2.9*method.ingredients.follow/2.5))
