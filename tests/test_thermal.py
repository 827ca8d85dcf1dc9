"""Noise in time on fixed points: what it conserves, its covariance, what is refused."""
from dataclasses import replace

import numpy as np
import pytest

from continuum.fluid import ConstEta, IdealGas
from particles.integral import fluctuating
from particles.integral.dih import Mixed
from particles.integral.edge_makers import MAKERS
from particles.integral.edges import between_plates
from particles.integral.layer import Layer
from particles.integral.points import jittered, lattice
from particles.integral.thermal import STAGED, Thermal, ThreeStage
from particles.limits import jacobian, limit_of
from particles.run import Plan, run
from particles.threads import Threads
from particles.weights import Lucy
from studies.noise.covariance import Step, layer_noise, noise, steady, steady_of_steps, waves


def gas(share: float = 0.1, k: float = 1e-3, **more) -> Thermal:
    edges = MAKERS["delaunay"](jittered((5, 5), 0.2, 1), None)
    return Thermal(**{"edges": edges, "eos": IdealGas(), "law": ConstEta(0.3, 0.4), "zeta": 0.1, "k": k,
                      "seed": 7, "share": share, **more})


def rest(method: Thermal) -> np.ndarray:
    n = method.edges.n
    return method.state(np.ones(n), np.zeros((n, 2)), np.ones(n))


@pytest.mark.parametrize("share", [0.0, 0.3, 1.0])
def test_noise_conserves_and_moves(share):
    method = gas(share)
    start = rest(method)
    end = run(method, start, Plan(dt=0.5*limit_of(method, start), steps=50)).state
    # 50 steps of three stages, sums of 25 points of order 1, each good to 1e-16
    assert end@method.edges.V == pytest.approx(start@method.edges.V, abs=1e-13*25)
    assert np.abs(end[1:3]).max() > 1e-3


def test_small_heat_capacity_is_warned_of_with_its_bias():
    method = gas(k=0.05)
    least = method.edges.V.min()/0.05
    with pytest.warns(UserWarning,
                      match=rf"heat capacity {least:.3g} k: .* up to k/C = {1/least:.2g} too much, 0.54 k/C"):
        limit_of(method, rest(method))


def test_three_stages_with_amplitudes_of_their_own_drift_nearly_as_stratonovich_has_it():
    """dx = sqrt(2 x) dW, B B' = 1: the mean over a step's normal numbers, by Gauss and Hermite's points."""
    class Root:
        def rates(self, y, out):
            out[:] = 0

        def kicks(self, y, beta, dt, out):
            out[:] = np.sqrt(2*y*dt)*(self.A + beta*self.B)

    points, weights = np.polynomial.hermite_e.hermegauss(12)
    sums, dt, mean = Root(), 1e-4, 0.0
    for A, of_A in zip(points, weights/weights.sum(), strict=True):
        for B, of_B in zip(points, weights/weights.sum(), strict=True):
            sums.A, sums.B, y = A, B, np.ones(1)
            ThreeStage((1,), Threads(1)).step(sums, y, dt)
            mean += of_A*of_B*(y[0] - 1)
    assert mean/dt == pytest.approx(STAGED, abs=10*dt)       # next order
    assert 0.45 < STAGED < 0.5


def test_bad_input_of_noise_in_time():
    with pytest.raises(ValueError, match=r"k must not be negative, got -1"):
        gas(k=-1)
    with pytest.raises(ValueError, match="seed must be a whole number"):
        gas(seed=-3)
    with pytest.raises(ValueError, match="share of transport"):
        Mixed(share=1.5)
    method = gas()
    with pytest.raises(ValueError, match="above the stability limit"):
        run(method, rest(method), Plan(dt=1.01*limit_of(method, rest(method)), steps=1))
    tight = MAKERS["delaunay"](lattice((3, 3)), None)
    doubled = replace(tight, i=np.append(tight.i, tight.i[:1]), j=np.append(tight.j, tight.j[:1]),
                      S=np.append(tight.S, tight.S[:1], axis=0), k=np.append(tight.k, tight.k[:1]),
                      apart=np.append(tight.apart, -tight.apart[:1], axis=0))
    with pytest.raises(ValueError, match="two edges join the same points"):
        gas(edges=doubled).start(9, None)
    with pytest.raises(ValueError, match=r"bulk viscosity .* outside"):
        method = gas(1.0, zeta=0.9)
        run(method, rest(method), Plan(dt=0.01, steps=1))


@pytest.mark.parametrize("share", [0.0, 0.3, 1.0])
def test_kicks_have_the_covariance_of_the_matrices(share):
    """One random number at a time is a column of B; with both sets of noise, B B^T (1 + beta^2) dt."""
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
    B = np.stack([column.ravel() for column in columns], axis=1)
    edges = method.edges
    of_p = fluctuating.mixed(fluctuating.stress(edges, 0.3, 0.1, 1.0),
                             fluctuating.friction(edges, 0.3, 0.1, 1.0), share)
    of_e = fluctuating.mixed(fluctuating.heat(edges, 0.4, 1.0),
                             fluctuating.conduction(edges, 0.4, 1.0), share)
    expected = 1e-3*(1 + beta**2)*dt*noise(edges.V, of_p.Q, of_e.Q).toarray()
    assert B@B.T == pytest.approx(expected, abs=1e-13*expected.max())


def test_a_random_stress_heats_its_own_point_by_its_work():
    """d(rho e) = s:grad v there and nothing elsewhere, s what changes the momentum by D s."""
    method = gas(0.0)
    sums, edges, out = method.start(25, None), method.edges, np.empty((4, 25))
    v = np.random.default_rng(2).normal(size=(25, 2))
    sums.of_points[:] = 0
    sums.of_points[11, :5] = (0.3, -0.2, 0.8, 0.4, 0.5)       # R, r
    sums.kicks(method.state(np.ones(25), v, np.ones(25)), 0.0, 0.01, out)
    R = sums.of_points[11, :4].reshape(2, 2)
    shear = np.sqrt(2*method.k*0.3/edges.V[11])*((R + R.T)/np.sqrt(2) - np.eye(2)*np.trace(R)/np.sqrt(2))
    s = 0.1*(shear + np.sqrt(2*method.k*0.1/edges.V[11])*0.5*np.eye(2))
    heating = out[3] - (v.T*out[1:3]).sum(axis=0)
    expected = np.zeros(25)
    expected[11] = np.sum(s*[edges.grad(v[:, 0])[11], edges.grad(v[:, 1])[11]])
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
    """A layer at rest between plates of its own temperature, waves along it: equilibrium up to the last
    row."""
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
