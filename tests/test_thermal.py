"""Steps in time, and noise on fixed points: orders, covariance, what is conserved, refusals."""
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from continuum.fluid import ConstEta, IdealGas
from particles.integral import fluctuating
from particles.integral.dih import Mixed
from particles.integral.edge_makers import MAKERS
from particles.integral.edges import Edges, between_plates
from particles.integral.layer import Layer
from particles.integral.points import jittered, lattice
from particles.integral.thermal import Thermal, ThreeStage
from particles.integrators import RK4, Euler
from particles.limits import limit_of
from particles.run import Plan, run
from particles.threads import Threads
from particles.weights import Lucy
from studies.build.setting import jacobian
from studies.noise.covariance import Step, layer_noise, noise, steady, steady_of_steps, waves


def gas(share: float = 0.1, k: float = 1e-3, **more) -> Thermal:
    edges = MAKERS["delaunay"](jittered((5, 5), 0.2, 1), None)
    return Thermal(**{"edges": edges, "eos": IdealGas(), "law": ConstEta(0.3, 0.4), "zeta": 0.1, "k": k,
                      "seed": 7, "share": share, **more})


def rest(method: Thermal) -> np.ndarray:
    n = method.edges.n
    return method.state(np.ones(n), np.zeros((n, 2)), np.ones(n))


def test_small_heat_capacity_is_warned_of_with_its_bias():
    method = gas(k=0.05)
    least = method.edges.V.min()/0.05
    with pytest.warns(UserWarning,
                      match=rf"heat capacity {least:.3g} k: .* up to k/C = {1/least:.2g} too much"):
        limit_of(method, rest(method))


@pytest.mark.parametrize(("kind", "order"), [(RK4, 4), (Euler, 1)])
def test_steps_have_the_order_of_their_integrator(kind, order):
    """Of a pendulum that swings wide, once to and fro."""
    def rates(y, out):
        out[:] = y[1], -np.sin(y[0])

    def end(steps):
        y = np.array([2.0, 0.0])
        for _ in range(steps):
            kind(y.shape, Threads(1)).step(SimpleNamespace(rates=rates), y, 8/steps)
        return y
    first, second = np.abs(np.diff([end(steps) for steps in (400, 800, 1600)], axis=0)).max(axis=1)
    assert np.log2(first/second) == pytest.approx(order, abs=0.1)


def with_an_edge_twice(edges: Edges) -> Edges:
    again = {name: np.concatenate([getattr(edges, name), getattr(edges, name)[:1]]) for name in "ijSk"}
    return replace(edges, **again, apart=np.concatenate([edges.apart, -edges.apart[:1]]))


def started(**more):
    method = gas(**more)
    return run(method, rest(method), Plan(dt=0.01, steps=1))


@pytest.mark.parametrize("make, words", [
    (lambda: gas(k=-1), "k must not be negative, got -1"),
    (lambda: gas(seed=-3), "seed must be a whole number"),
    (lambda: Mixed(share=1.5), "share of transport"),
    (lambda: gas(edges=with_an_edge_twice(gas().edges)).start(25, None), "two edges join the same points"),
    (lambda: started(share=1.0, zeta=0.9), "bulk viscosity .* outside")])
def test_bad_input_of_noise_in_time(make, words):
    with pytest.raises(ValueError, match=words):
        make()


@pytest.mark.parametrize("share", [0.0, 0.3, 1.0])
def test_kicks_have_the_covariance_of_the_matrices(share):
    """Each random number gives a column of B, which conserves; two sets of them B B^T (1 + beta^2) dt."""
    method = gas(share)
    sums, start, beta, dt = method.start(25, None), rest(method), 0.7, 0.01
    drawn = [normals for normals in (sums.of_points, sums.of_edges) if normals is not None]
    columns = []
    for normals in drawn:
        for other in drawn:
            other[:] = 0
        for number in range(normals.size):
            normals.ravel()[number] = 1
            columns.append(np.empty_like(start))
            sums.kicks(start, beta, dt, columns[-1])
            normals.ravel()[number] = 0
    assert np.abs(columns@method.edges.V).max() < 1e-13*25
    B = np.stack([column.ravel() for column in columns], axis=1)
    edges = method.edges
    of_p = fluctuating.mixed(fluctuating.stress(edges, 0.3, 0.1, 1.0),
                             fluctuating.friction(edges, 0.3, 0.1, 1.0), share)
    of_e = fluctuating.mixed(fluctuating.heat(edges, 0.4, 1.0),
                             fluctuating.conduction(edges, 0.4, 1.0), share)
    expected = 1e-3*(1 + beta**2)*dt*noise(edges.V, of_p.Q, of_e.Q).toarray()
    assert B@B.T == pytest.approx(expected, abs=1e-13*expected.max())


def test_a_random_stress_heats_its_own_point_by_its_work():
    """d(rho e) = s:grad v at that point and 0 elsewhere, where D s is the change of momentum."""
    method = gas(0.0)
    sums, edges, out = method.start(25, None), method.edges, np.empty((4, 25))
    v = np.random.default_rng(2).normal(size=(25, 2))
    sums.of_points[:] = 0
    sums.of_points[11, 0, :5] = (0.3, -0.2, 0.8, 0.4, 0.5)       # R, r
    sums.kicks(method.state(np.ones(25), v, np.ones(25)), 0.0, 0.01, out)
    R = sums.of_points[11, 0, :4].reshape(2, 2)
    shear = np.sqrt(2*method.k*0.3/edges.V[11])*((R + R.T)/np.sqrt(2) - np.eye(2)*np.trace(R)/np.sqrt(2))
    s = 0.1*(shear + np.sqrt(2*method.k*0.1/edges.V[11])*0.5*np.eye(2))
    heating = out[3] - (v.T*out[1:3]).sum(axis=0)
    expected = np.zeros(25)
    expected[11] = np.sum(s*[[(G@f)[11]/edges.V[11] for G in edges.G] for f in v.T])
    assert heating == pytest.approx(expected, abs=1e-13*abs(expected[11]))


def test_covariances_of_three_stages_err_by_third_order():
    """Of sound, from what a step makes of one unit of state, of W_A, of W_B."""
    J, B = np.array([[0.0, 0.4], [-0.4, -0.1]]), np.array([[0.0, 0.0], [0.0, np.sqrt(0.2)]])

    class Sums:
        halves = np.zeros((2, 2))       # W_A, W_B

        def rates(self, y, out):
            out[:] = (J@y.ravel()).reshape(y.shape)

        def kicks(self, y, beta, dt, out):
            out[:] = (B@(self.halves[0] + beta*self.halves[1])*np.sqrt(dt)).reshape(out.shape)

    def stepped(start, halves, dt):
        sums, y = Sums(), start.reshape(2, 1).copy()
        sums.halves = halves
        ThreeStage((2, 1), None).step(sums, y, dt)
        return y.ravel()

    errors = []
    for dt in (0.1, 0.05):
        A = np.stack([stepped(x, np.zeros((2, 2)), dt) for x in np.eye(2)], axis=1)
        noises = np.stack([stepped(np.zeros(2), one, dt) for one in np.eye(4).reshape(4, 2, 2)], axis=1)
        errors.append(np.abs(steady_of_steps(Step(A, noises@noises.T)) - np.eye(2)).max())
    assert np.log2(errors[0]/errors[1]) == pytest.approx(3, abs=0.05)


def test_plates_have_the_noise_of_their_friction_and_heat():
    """A layer at rest between plates of its own temperature is in equilibrium up to its last row."""
    rows, T = 5, 0.7
    x = lattice((5, rows)).x
    edges, beyond = between_plates(MAKERS["renormalised"], x, 5, rows, Lucy.of(h=2.0))
    fluid = Layer(x=x, edges=edges, beyond=beyond, eos=IdealGas(), law=ConstEta(0.3, 0.4), T_plates=(T, T),
                  g=0.0)
    first, at_T = np.arange(rows), np.full(5*rows, T)
    J = jacobian(fluid.start(5*rows, Threads(1)).rates, fluid.state(1.0, 0*x, at_T), first)
    Q = layer_noise(fluid, at_T)[:, (5*rows*np.arange(4)[:, None] + first).ravel()].toarray()
    C = steady(*(waves(M, (5, rows), 0.4) for M in (J, Q)))
    # <rho rho> = 1, <p p> = T, eps = T rho + dT, <dT dT> = T^2
    one, none = np.eye(rows), np.zeros((rows, rows))
    exactly = np.block([[one, none, none, T*one], [none, T*one, none, none], [none, none, T*one, none],
                        [T*one, none, none, 2*T*T*one]])
    assert np.abs(C - exactly).max() < 1e-9
