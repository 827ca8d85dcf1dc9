"""Delta-plus-SPH: density by continuity with diffusion, and particles that are shifted.

Particles move with v + d. The shifting velocity d and the diffusion of densities are, with 2h the range,

    d = -U 2h sum_j (1 + R (W/W(a))^4) V_j grad W, |d| <= U/2        [Sun et al. 2017, 2019]
    delta h c sum_j V_j psi.grad W, x = x_i - x_j
    psi = 2 (rho_i - rho_j - (grad rho_i + grad rho_j).x/2) x/x^2    [Antuono et al. 2010]

U is the largest speed relative to the mean velocity; in the papers it is the largest expected speed. As Ma c0
= U, CFL cancels in Sun 2017's shift over dt. The force of a pair is V_i V_j (P_i + P_j) grad W; friction and
heat are those of `Direct`.

Differences from the papers: P(rho, T) and its c replace c0^2 (rho - rho0) and c0, and states have a row e.
In Sun 2019 d carries density and momentum while masses are constant, which neither conserves momentum nor is
Galilean invariant. Here d carries mass, as in Antuono et al. 2021 but without diffusion of mass, and energy:
with g = V_i V_j grad W particle i gains (rho_i q_i d_i + rho_j q_j d_j).g of q = 1, v, e + v^2/2. Each pair
conserves all three; the potential energy of mass that d lifts is not counted. The continuity equation is that
of Sun 2019, whose volumes need not fill the box.
"""
from typing import Any, ClassVar

import numpy as np

from continuum.fluid import energy, sound_speed
from continuum.jit import jit
from particles.pairs import pair_term, sweep
from particles.smooth.corrected import FLAT
from particles.smooth.sums import Direct, Led
from particles.threads import Threads
from particles.walls import fixed_points
from particles.weights import value_and_slope

R, POWER, FASTEST, DIFFUSION = 0.2, 4, 0.5, 0.1


@pair_term(7, "weight")
def Uneven(term, a, b, ab):
    """sum V (1 + R (W/W(a))^4) grad w, sum V (x_j - x_i) grad w, sum V (rho_j - rho_i) grad w."""
    x, y, wx, wy, rho = b.x - a.x, b.y - a.y, b.V*ab.wx, b.V*ab.wy, b.rho - a.rho
    f = 1 + R*(value_and_slope(term.weight, np.sqrt(x*x + y*y))[0]*a.per_w)**POWER
    return f*wx, f*wy, x*wx, x*wy, y*wy, rho*wx, rho*wy


@pair_term(8)
def Slopes(term, a, b, ab):
    """sum V_b {v_b - v_a, T_b - T_a} grad w, in the columns of `Gradients`."""
    u, v, T, wx, wy = b.vx - a.vx, b.vy - a.vy, b.T - a.T, b.V*ab.wx, b.V*ab.wy
    return u*wx, v*wx, T*wx, 0.0, u*wy, v*wy, T*wy, 0.0


@pair_term(6, "half")
def Shifting(term, a, b, ab):
    """Acceleration, heating, d rho/dt, zero, d ln m/dt; half : h of the papers, half of the range."""
    x, y, u, v, wx, wy = a.x - b.x, a.y - b.y, a.vx - b.vx, a.vy - b.vy, b.V*ab.wx, b.V*ab.wy
    # two particles in one place exert no force on each other
    F, p = (x*wx + y*wy)/max(x*x + y*y, 1e-300), (a.P + b.P)*a.irho
    drag, heat = (a.eta + b.eta)*F*a.irho, (a.k + b.k)*F*a.irho*(a.T - b.T)
    closing, own, other = u*wx + v*wy, a.dx*wx + a.dy*wy, b.dx*wx + b.dy*wy
    carried, energy = b.rho*other*a.irho, b.e - a.e + 0.5*(u*u + v*v)
    steep = 0.5*((a.gx + b.gx)*x + (a.gy + b.gy)*y)
    mixed = DIFFUSION*term.half*(a.c + b.c)*(a.rho - b.rho - steep)*F
    return ((drag - carried)*u - p*wx, (drag - carried)*v - p*wy,
            a.P*a.irho*closing - 0.5*drag*(u*u + v*v) + heat + carried*energy,
            a.rho*(closing + 2*own) + (b.rho - a.rho)*other + mixed, 0.0, own + carried)


class DeltaPlus(Led):
    """Sums of delta-plus-SPH; V_i = m_i/rho_i."""
    of_state: ClassVar[tuple[str, ...]] = (*Led.of_state, "rho", "m")
    numbers = f"{Direct.numbers} V rho P e c per_w"
    turns: ClassVar[dict[str, str]] = {"dx": "x", "dy": "y", "gx": "x", "gy": "y"}

    def __init__(self, method: Any, n: int, threads: Threads):
        super().__init__(method, n, threads)
        if held := [wall for wall in method.walls if type(wall) in fixed_points.kinds]:
            raise ValueError(f"{type(held[0]).__name__} holds particles whose density no continuity gives: "
                             "take images behind the plates")
        self.pull, self.uneven, self.U = np.zeros((n, 6)), np.empty((n, 7)), 0.0

    @classmethod
    def complete(cls, state: np.ndarray, rho: Any, m: float) -> np.ndarray:
        return np.vstack([state, rho*np.ones(state.shape[1]), np.full(state.shape[1], m)])

    def shares(self, state: np.ndarray) -> np.ndarray:
        return state[6]/self.method.m

    def fault(self, state: np.ndarray, ids: np.ndarray) -> str:
        if not (state[6] > 0).all():
            i = int(np.argmin(state[6]))
            return f"particle {ids[i]} has the mass {state[6, i]:.4g}: shifting has emptied it"
        return super().fault(state, ids)

    def place(self, state: np.ndarray) -> None:
        super().place(state)
        around, v = self.around, state[2:4]
        around.rho[:self.n] = state[5]
        for _, parent, first, last in around.blocks:
            around.rho[first:last] = around.rho[parent]
        self.U = float(np.sqrt(((v - v.mean(axis=1, keepdims=True))**2).sum(axis=0).max()))
        self.V = state[6]/state[5]/self.method.m

    def exchange(self, less: np.ndarray) -> tuple[Any, np.ndarray]:
        around, method, (_, records) = self.around, self.method, super().exchange(less)
        records["V"][:self.n] = self.V
        for _, parent, first, last in around.blocks:
            records["V"][first:last] = records["V"][parent]
        # one thread: in compiled code the first row of a range differs from others in its last digit
        _more(0, len(around.x), method.weight, method.eos, method.m, around.rho, around.T, less, records)
        self.threads(sweep, self.n, Uneven(method.weight), records, around.pairs, self.uneven)
        self.threads(_shift, self.n, self.U, method.weight.h, self.uneven, records)
        self.mirror()
        return Shifting(method.weight.h/2), records

    def gradients(self) -> None:
        self.threads(sweep, self.n, Slopes(), self.exchange(self.less)[1], self.around.pairs, self.slopes)

    def rates(self, state: np.ndarray, out: np.ndarray) -> None:
        """d(x, y, vx, vy, e, rho, m)/dt."""
        super().rates(state, out)
        out[5], out[6] = self.pull[:, 3], self.method.m*self.V*state[5]*self.pull[:, 5]


@jit
def _more(first, last, weight, eos, m, rho, T, less, records):
    for i in range(first, last):
        a = records[i]
        a.rho, a.P, a.e = rho[i], less[i], energy(eos, rho[i], T[i])
        a.c, a.per_w = sound_speed(eos, rho[i], a.e), 1/value_and_slope(weight, np.sqrt(m*a.V))[0]


@jit
def _shift(first, last, U, width, sums, records):
    """d, and gradients of rho, exact on linear fields, but zero where neighbours lie in a line."""
    for i in range(first, last):
        a, (sx, sy, xx, xy, yy, rx, ry) = records[i], sums[i]
        f = U*width*min(1.0, FASTEST/max(width*np.sqrt(sx*sx + sy*sy), 1e-300))
        a.dx, a.dy, det = -f*sx, -f*sy, xx*yy - xy*xy
        per = 1/det if det > FLAT*(xx + yy)**2 else 0.0
        a.gx, a.gy = per*(yy*rx - xy*ry), per*(xx*ry - xy*rx)
