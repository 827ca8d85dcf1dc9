"""Growth of small disturbances of the motionless layer: the derivative is one, and eigenvalues tell what time steps show."""
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from continuum.scene import RayleighBenard
from particles.limits import limit_of
from particles.run import Plan, run
from particles.threads import Team
from studies.build.fixed import SCHEMES, layer
from studies.kit.claim import judge
from studies.kit.sweep import RESULTS, load
from studies.kit.table import Tables, read
from studies.operators.nested import cases as nested
from studies.operators.nested import images as mixed_images


def growth(**more):
    case = nested.Growth(**{"h": 2.0, "rows": 8, "ra": 1500.0, "share": 1.0, **more})
    return case.run(lambda done: None, Path()).rows["nested_growth"][0]


def test_what_eigenvalues_say_time_steps_show():
    """h = 2 a, nested only: a disturbance grows at the rate of the fastest mode once it is alone."""
    scene = RayleighBenard(ra=1500.0, L=8.0, aspect=1.0)
    fluid = layer(scene, SCHEMES["fixed-lattice"]._replace(share=0.0), 1)
    rng, n = np.random.default_rng(0), len(fluid.x)
    state = fluid.state(1.0, 1e-7*rng.normal(size=(n, 2)), scene.T(fluid.x[:, 1]))
    expected = growth(share=0.0)["growth"]*np.sqrt(2)
    energies = {"ke": lambda sums, state: float((state[1:3]**2).sum())}
    dt = 0.5*limit_of(fluid, state)
    steps = round(12/expected/dt)
    done = run(fluid, state, Plan(dt=dt, steps=steps, series=energies, every=steps//40))
    late = slice(-10, None)
    rate = np.polyfit(np.array(done.times)[late], np.log(done.series["ke"])[late], 1)[0]/2
    assert rate == pytest.approx(expected, rel=0.05)       # other modes are left after 12 growth times


def test_transport_along_edges_keeps_a_lattice_at_rest():
    assert growth()["growth"] < nested.ROUND_OFF < 1e-3 < growth(share=0.0)["growth"]


def test_the_derivative_is_one():
    scene = RayleighBenard(ra=1500.0, L=8.0, aspect=1.0)
    fluid = layer(scene, SCHEMES["fixed-lattice"], 1)
    state = fluid.state(1.0, np.zeros((len(fluid.x), 2)), scene.T(fluid.x[:, 1]))
    sums, change = fluid.start(state.shape[1], Team(1)), np.random.default_rng(1).normal(size=state.shape)*1e-4
    up, down = np.empty_like(state), np.empty_like(state)
    sums.rates(state + change, up)
    sums.rates(state - change, down)
    linear = (nested.jacobian(sums, state)@change.ravel()).reshape(state.shape)
    assert np.abs((up - down)/2 - linear).max() < 1e-6*np.abs(linear).max()     # third order of 1e-4


def test_adjoint_images_are_those_of_the_layer_and_others_lose_mass():
    scene = RayleighBenard(ra=1500.0, L=6.0)
    fluid = layer(scene, SCHEMES["fixed-lattice"], 1)
    rng, n = np.random.default_rng(0), len(fluid.x)
    state = fluid.state(rng.uniform(0.9, 1.1, n), rng.normal(size=(n, 2))*0.1, scene.T(fluid.x[:, 1]))
    rates = {}      # of random states: along a lattice what two images lose cancels where the density is uniform
    for name in mixed_images.IMAGES:
        rates[name] = np.empty_like(state)
        mixed_images.mixed(fluid, name).start(state.shape[1], Team(1)).rates(state, rates[name])
    plain = np.empty_like(state)
    fluid.start(state.shape[1], Team(1)).rates(state, plain)
    assert np.abs(rates["adjoint"] - plain).max() < 1e-13
    lost = {name: abs(found[0].sum()) for name, found in rates.items()}
    assert max(lost["adjoint"], lost["temperature of conduction"]) < 1e-13 < 1e-3 < min(lost["velocity reversed"], lost["both"])


def test_zigzags_are_told_from_long_waves():
    wave = np.cos(2*np.pi*np.arange(8)/8)
    fields = np.zeros((4, 8, 8))
    fields[0] = wave[None]
    assert nested.zigzag(fields.ravel(), 8) == pytest.approx(0, abs=1e-12)
    fields[0] = (-1.0)**np.arange(8)
    assert nested.zigzag(fields.ravel(), 8) == pytest.approx(1)


def test_the_smallest_share_is_the_one_from_which_on_nothing_grows():
    rows = [{"h": 2.0, "share": share, "growth": 1e-3 if share < 0.1 else 1e-15} for share in nested.SHARES]
    assert nested.smallest_share(Tables({"nested_growth": pd.DataFrame(rows)})) == pytest.approx((0.1, 0.03))


def test_committed_verdicts_are_those_of_the_committed_table():
    found = judge(nested.STUDY.claims, load(nested.STUDY.tables, "nested"), "nested")
    committed = read(RESULTS/"claims.csv").set_index("id")
    for row in found:
        assert committed.loc[row["id"], "verdict"] == row["verdict"], row["id"]
