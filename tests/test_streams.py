"""Flows in a stream: what it must not change, what is exactly known of them, what is read off the runs."""
from math import pi, sqrt

import numpy as np
import pandas as pd
import pytest

from continuum.exact import gresho, periodic
from continuum.exact.shear import growing_wave, viscous_growth
from continuum.exact.vortex import Vortex, solved, velocities
from particles.run import Plan, run
from studies.build import variant
from studies.front.solving import prepared
from studies.streams.cases import SCENES
from studies.streams.scenes import Convection
from studies.streams.tables import crossing, needed

PLACES = np.random.default_rng(1).uniform(-0.5, 0.5, (200, 2))
TORUS = [name for name, kind in SCENES.items() if kind is not Convection]


@pytest.mark.parametrize("name, method", [*((name, "moving-delaunay") for name in TORUS),
                                          ("vortex", "moving-delaunay-entropy-stable")])
def test_a_stream_changes_nothing_for_points_that_move(name, method):
    """Their own frame after some steps: round-off of places, 1e-16 L, and of momenta times the stream."""
    both = []
    for stream in (0.0, 10.0):
        scene = SCENES[name](L=12, stream=stream)
        ready = prepared(scene, variant(method))
        at = ready.method.fields(run(ready.method, ready.start, Plan(dt=ready.dt, steps=8)).by_id())
        both.append((at.rho, *(at.v - scene.wind).T, at.T))
    assert np.abs(np.subtract(*both)).max() < 1e-11


@pytest.mark.parametrize("name", ["vortex", "spot", "gresho"])
def test_the_end_is_carried_with_the_stream_and_comes_round_the_box(name):
    """Fields of the answer itself, seen where the stream has taken them, have no error."""
    scene = SCENES[name](L=16, stream=3.0)
    ready = prepared(scene, variant("fixed-lattice-h1.2"))
    first = ready.method.fields(ready.start)
    rho, v, T = scene.end(scene.own(first))
    assert max(map(abs, scene.errors(first, first._replace(rho=rho, v=v + scene.wind, T=T)).values())) < 1e-12
    assert max(scene.errors(first, first).values()) > 0.1


def test_fourier_sums_of_any_start_are_those_of_the_vortex():
    """What the filter takes from its waves on 33 points is 2e-6 of the speed."""
    flow = Vortex(0.2, 1)

    def start(place):
        rho = flow.density(place)
        return rho, flow.velocity(place), rho
    sums = periodic.solved(start, flow.eta, flow.eta, flow.time, 33)
    known = velocities(solved(0.2), PLACES)
    assert np.abs(periodic.fields(sums, PLACES)[1]/flow.speed - known).max() < 5e-6


def test_heat_spreads_at_even_pressure_by_half_of_its_conductivity():
    """C_P = 2. Besides: squares of the wave, and sound, as the gas is still at rest: 2 pi (k/2)/c."""
    def start(place):
        T = 1 + 1e-3*np.cos(2*pi*place[:, 0])
        return 1/T, np.zeros(place.shape), T
    *_, T = periodic.fields(periodic.solved(start, 0.001, 0.002, 2.0, 17), PLACES)
    known = np.exp(-0.001*4*pi**2*2)*np.cos(2*pi*PLACES[:, 0])
    assert np.abs((T - 1)/1e-3 - known).max() < 1e-3 + pi*0.002/sqrt(2)


def test_the_wave_in_shear_grows_at_rayleighs_rate_and_is_rubbed_away():
    # long waves grow at k_x U/sqrt 2, short ones, k_x >= k, do not
    assert growing_wave(0.15, 1.0, 1e-3)[0] == pytest.approx(1e-3*0.15/sqrt(2), rel=1e-3)
    assert growing_wave(0.15, 1.0, 1.01)[0] == pytest.approx(0, abs=1e-9)
    rate, _ = growing_wave(1.0, 1.0, 0.5)
    assert np.log(viscous_growth(1.0, 1.0, 0.5, 0.0, 9.0))/9 == pytest.approx(rate, rel=1e-7)
    # one that feels no layer decays by nu k_x^2
    alone = np.log(viscous_growth(1e-9, 1.0, 0.5, 0.1, 4.0))
    assert alone == pytest.approx(-0.1*0.25*4, rel=1e-6)


def test_pressure_holds_the_round_vortex_and_friction_keeps_its_angular_momentum():
    r = np.linspace(0.01, 0.45, 400)
    line, smooth = np.stack([r, 0*r], axis=1), np.minimum(abs(r - 0.2), abs(r - 0.4)) > 0.005
    slope = np.gradient(gresho.pressure(line), r, edge_order=2)
    assert np.abs(slope - gresho.velocity(line)[:, 1]**2/r)[smooth].max() < 1e-3   # of 5; steps of 1e-3
    axis = np.arange(gresho.FINE)/gresho.FINE - 0.5
    spin = [axis@v.sum(axis=1) - axis@u.sum(axis=0) for u, v in map(gresho.diffused, (0.0, 1e-4))]
    assert spin[1] == pytest.approx(spin[0], rel=1e-9)


def series(*errors: float) -> pd.DataFrame:
    rows = 16*2.0**np.arange(len(errors))
    return pd.DataFrame({"rows": rows, "error": errors, "error_err": 0.0, "cpu_s": rows**3, "cpu_s_err": 0.0})


def test_seconds_to_one_percent_lie_between_rows_or_follow_the_order():
    """Second order, seconds as the cube of the rows."""
    between = needed(series(0.16, 0.04, 0.0025))
    assert between["reached"] == "yes" and between["cpu_s"] == pytest.approx(between["rows"]**3)
    follows = needed(series(0.32, 0.08, 0.02))
    assert (follows["reached"], follows["rows"]) == ("by order", pytest.approx(64*2**0.5))
    assert needed(series(1.2, 0.9, 0.5))["reached"] == "no" and needed(series(0.009, 0.002))["low"] == 0


def test_the_crossing_is_where_seconds_are_equal():
    """Seconds of the one that stands go with the stream, those of the others are 1."""
    stand = pd.DataFrame({"cpu_s": [0.1, 0.3, 3.0, np.nan], "high": [0.1, 0.3, 3.0, np.nan],
                          "cpu_s_moving": 1.0, "high_moving": 1.0}, index=[0.0, 0.3, 3.0, 10.0])
    assert crossing(stand)["stream"] == pytest.approx(0.3*10**(np.log(1/0.3)/np.log(10)))
    assert crossing(stand.iloc[:2])["moving"] == "never" and crossing(stand.iloc[2:])["moving"] == "always"
    assert crossing(stand.iloc[[1, 3]])["low"] == 0.3
