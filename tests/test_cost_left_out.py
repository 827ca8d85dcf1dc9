"""What terms cost: a fluid that lists its terms is the gas of the paper; what is left out is not stored."""
import numpy as np
import pytest
from crowd import rates

from particles.integral.edge_makers import renormalised
from particles.integral.points import jittered, lattice
from particles.integral.triangulation import delaunay
from particles.integrators import RK4
from particles.limits import limit_of
from particles.plan import Plan
from particles.run import Divergence, run
from particles.threads import Threads
from particles.weights import Lucy
from studies.build.scenes import TaylorGreen
from studies.cost import contestants, left_out, tables
from studies.cost.isothermal import Isothermal
from studies.cost.seconds import array_bytes


def on_lattice(size):
    points = lattice((size, size))
    return Isothermal(x=points.x, edges=renormalised(points, Lucy.of(h=2.0)), c2=2.0)


def test_rates_without_heat_are_the_brackets_of_the_paper():
    """Slowly, edge by edge: Eqs 34, 35 with P = c^2 rho, and friction eta k (v_j - v_i)."""
    points, rng = jittered((6, 5), 0.2, 1), np.random.default_rng(2)
    edges, state = delaunay(points), np.array([[1.0], [0.2], [-0.1]]) + 0.1*rng.normal(size=(3, points.n))
    rho, v = state[0], (state[1:]/state[0]).T
    wanted = np.zeros((points.n, 3))
    for i, j, S, k in zip(edges.i, edges.j, edges.S, edges.k, strict=True):
        mass = S@(rho[i]*v[j] + rho[j]*v[i])/2
        carried = (S@v[j]*rho[i]*v[i] + S@v[i]*rho[j]*v[j])/2
        momentum = carried + 2.0*S*(rho[i] + rho[j])/2 - 0.3*k*(v[j] - v[i])
        wanted[i] -= np.r_[mass, momentum]
        wanted[j] += np.r_[mass, momentum]
    method = Isothermal(x=points.x, edges=edges, c2=2.0, eta=0.3)
    np.testing.assert_allclose(rates(method, state), wanted.T/edges.V, atol=1e-13)


@pytest.mark.parametrize("share, stable", [(0.98, True), (1.05, False)])
def test_the_limit_of_the_step_is_that_of_sound(share, stable):
    """Without friction: noise stays below, and grows above."""
    method = on_lattice(12)
    state = np.array([1 + 1e-6*np.random.default_rng(1).normal(size=144), *np.zeros((2, 144))])
    sums, now = method.start(144, Threads(1)), state.copy()
    for _ in range(400):
        RK4(now.shape, Threads(1)).step(sums, now, share*limit_of(method, state))
    grown = np.abs(now[0] - 1).max()/np.abs(state[0] - 1).max()
    assert grown < 2 if stable else not grown < 10


def test_a_density_that_is_not_positive_ends_a_run():
    state = np.array([np.ones(36), *np.zeros((2, 36))])
    state[0, 3] = -1.0
    with pytest.raises(Divergence, match="point 3 has rho = -"):
        run(on_lattice(6), state, Plan(dt=1e-6, steps=1))


def test_what_is_left_out_is_not_stored():
    """Heat: state and records have three fields instead of four and thirteen. Noise: no numbers of pairs."""
    whole, cold = (make(8).problem for make in (left_out.vortex, left_out.vortex_without_heat))
    noisy, silent = (make(8).problem for make in (left_out.vortex_with_noise, left_out.vortex_without_noise))
    assert len(cold.start) == 3 and len(whole.start) == 4
    assert cold.held()[1].at.points.dtype.names == ("rho", "vx", "vy")
    assert array_bytes(cold.held()) < array_bytes(whole.held())
    assert array_bytes(silent.held()) < array_bytes(noisy.held())


def test_a_base_is_measured_whole_and_in_parts(monkeypatch):
    """Slow vortices without heat are those with it, but for 4e-4 of Mach 0.05; at 0.2 16 times as much."""
    faster = contestants.ExactFlow(TaylorGreen(L=12, mach=0.2))      # its answer takes seconds less
    monkeypatch.setattr(left_out, "FLOW", faster)
    case = left_out.LeavingOut(base=left_out.BASES[2], size=12, short=1e-5)
    whole, cold = case.run(lambda done: None, None).rows["measured"]
    assert [whole["left_out"], cold["left_out"]] == ["nothing", "heat"]
    assert set(cold) == set(tables.TERMS[0].columns)
    assert whole["changed"] == 0 < cold["changed"] < 16*4e-4
    assert {base.scene for base in left_out.BASES} == {"taylor-green", "convection"}
