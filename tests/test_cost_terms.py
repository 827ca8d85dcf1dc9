"""What terms cost: what is not listed is neither called nor stored, what is listed is the gas; ratios, verdicts, the figure."""
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from continuum.scene import RayleighBenard
from particles.integral.dih import Dih
from particles.integral.edge_makers import renormalised
from particles.integral.exchange import PRINTED
from particles.integral.isothermal import Carried, ConstantFriction, Isothermal
from particles.integral.points import jittered, lattice
from particles.integral.triangulation import delaunay
from particles.integrators import RK4
from particles.limits import limit_of
from particles.plan import Plan
from particles.run import Divergence, run
from particles.threads import Team
from particles.weights import Lucy
from studies.build import ready
from studies.cost import claims, derive, figures, flows, tables, terms
from studies.kit.claim import judge
from studies.kit.table import Tables


def rates(method, state):
    out = np.empty_like(state)
    method.start(state.shape[1], Team(1)).rates(state, out)
    return out


@pytest.fixture(scope="module")
def off_lattice():
    """Irregular points with triangles, and a state (3, n) on them."""
    points, rng = jittered((6, 5), 0.2, 1), np.random.default_rng(2)
    return points, delaunay(points), np.array([1.0, 0.2, -0.1])[:, None] + 0.1*rng.normal(size=(3, points.n))


def test_listed_terms_are_the_brackets_of_the_paper(off_lattice):
    """Slowly, edge by edge: Eqs 34, 35 with P = c^2 rho, and friction eta k (v_j - v_i)."""
    points, edges, state = off_lattice
    rho, v = state[0], (state[1:]/state[0]).T
    wanted = np.zeros((points.n, 3))
    for i, j, S, k in zip(edges.i, edges.j, edges.S, edges.k, strict=True):
        mass = S@(rho[i]*v[j] + rho[j]*v[i])/2
        momentum = (S@v[j]*rho[i]*v[i] + S@v[i]*rho[j]*v[j])/2 + 2.0*S*(rho[i] + rho[j])/2 - 0.3*k*(v[j] - v[i])
        wanted[i] -= np.r_[mass, momentum]
        wanted[j] += np.r_[mass, momentum]
    found = rates(Isothermal(x=points.x, edges=edges, terms=(Carried(2.0), ConstantFriction(0.3))), state)
    np.testing.assert_allclose(found, wanted.T/edges.V, atol=1e-13)


def test_terms_add_up_and_their_order_does_not_matter(off_lattice):
    points, edges, state = off_lattice
    a, b = Carried(2.0), ConstantFriction(0.3)
    one, other, both, turned = (rates(Isothermal(x=points.x, edges=edges, terms=terms), state)
                                for terms in ((a,), (b,), (a, b), (b, a)))
    np.testing.assert_allclose(both, one + other, atol=1e-13)
    np.testing.assert_allclose(both, turned, atol=1e-13)
    assert not other[0].any() and other[1:].any()


def test_mass_and_momentum_are_kept(off_lattice):
    points, edges, state = off_lattice
    method = Isothermal(x=points.x, edges=edges, terms=(Carried(2.0), ConstantFriction(0.3)))
    end = run(method, state, Plan(dt=0.5*limit_of(method, state), steps=50)).state
    np.testing.assert_allclose(end@edges.V, state@edges.V, rtol=0, atol=50*4*points.n*1e-16)


def test_the_limit_of_the_step_is_that_of_sound():
    """Without friction: stable below, not above."""
    points = lattice((12, 12))
    method = Isothermal(x=points.x, edges=renormalised(points, Lucy.of(h=2.0)), terms=(Carried(2.0),))
    state = np.array([1 + 1e-6*np.random.default_rng(1).normal(size=points.n), *np.zeros((2, points.n))])
    limit, sums = limit_of(method, state), method.start(points.n, Team(1))
    grown = []
    for share in (0.98, 1.05):
        now = state.copy()
        for _ in range(400):
            RK4(now.shape, Team(1)).step(sums, now, share*limit)
        grown.append(np.abs(now[0] - 1).max()/np.abs(state[0] - 1).max())
    assert grown[0] < 2 and not grown[1] < 10


def test_a_density_that_is_not_positive_ends_a_run():
    points = lattice((6, 6))
    method = Isothermal(x=points.x, edges=renormalised(points, Lucy.of(h=2.0)), terms=(Carried(2.0),))
    state = np.array([np.ones(36), *np.zeros((2, 36))])
    state[0, 3] = -1.0
    with pytest.raises(Divergence, match="point 3 has rho = -"):
        run(method, state, Plan(dt=1e-6, steps=1))


def test_what_is_not_listed_is_neither_called_nor_stored():
    """Loops by name; state and records have three fields instead of four and thirteen."""
    with_heat, cold, bare = terms.GAS(8), terms.COLD(8), terms.listed(8, (Carried,))
    assert "sweep Listing(Carried+ConstantFriction)" in cold.called and "sweep Listing(Carried)" in bare.called
    assert not any("Friction" in name for name in bare.called)
    assert len(cold.problem.first) == 3 and len(with_heat.problem.first) == 4
    assert cold.problem.held()[1].at.points.dtype.names == ("rho", "vx", "vy")
    assert set(cold.called).isdisjoint(with_heat.called)


def test_plain_heating_calls_fewer_loops_and_gravity_none():
    whole, start, _ = ready(RayleighBenard(ra=1e4, L=8.0), "fixed-lattice")
    called = [terms.loops(method, start) for method in (whole, replace(whole, transport=PRINTED), replace(whole, g=0.0))]
    assert called[2] == called[0]        # a number
    assert not any("Differences" in name or "lacking" in name for name in called[1])


def test_no_noise_has_no_random_numbers():
    noisy, silent = terms.noisy(8), terms.silent(8)
    assert any(name.startswith("fill") for name in noisy.called) and silent.called == ()
    assert isinstance(silent.problem.held()[1], Dih)
    assert terms.array_bytes(silent.problem.held()) < terms.array_bytes(noisy.problem.held())


def test_slow_vortices_without_heat_are_those_with_it():
    """What Mach 0.05 leaves: 4e-4 (study ordering), 16 spacings a wavelength for both."""
    ends = []
    for made in (terms.GAS(16), terms.COLD(16)):
        problem = made.problem
        steps = 200
        state = problem.go(problem.first, problem.time/steps, steps)
        ends.append(state[1:3]/state[0])
    assert np.abs(ends[1] - ends[0]).max() < 4e-3*np.abs(ends[0]).max()


def table(**without) -> Tables:
    """`measured` of one base; (step_s, time_s, bytes, error) of what is left."""
    rows = [{"scene": "taylor-green", "base": "fixed points", "left_out": name, "quantity": "velocity", "points": 9,
             "step_s": step, "step_s_err": 0.01*step, "time_s": time, "time_s_err": 0.01*time, "bytes": size, "loops": 2,
             "names": "a; b", "error": error, "error_err": 1e-6,
             "changed": abs(error - 0.02)} for name, (step, time, size, error) in without.items()]
    found = Tables({"measured": pd.DataFrame(rows)})
    return Tables(found | {name: pd.DataFrame(rows) for name, rows in derive.terms(found).items()})


SOME = {"nothing": (2.0, 4.0, 100.0, 0.02), "heat": (1.0, 3.0, 60.0, 0.021), "gravity": (2.0, 4.0, 100.0, 0.9),
        "viscosity": (1.9, 4.0, 100.0, np.nan)}


def test_ratios_are_to_the_whole_and_what_matters_is_needed():
    rows = table(**SOME)["scenes"].set_index("left_out")
    assert rows.loc["heat", ["step_ratio", "time_ratio", "bytes_ratio"]].tolist() == pytest.approx([0.5, 0.75, 0.6])
    assert rows.loc["heat", "step_ratio_err"] == pytest.approx(0.5*0.01*2**0.5)
    assert rows["needed"].to_dict() == {"nothing": "no", "heat": "no", "gravity": "yes", "viscosity": "yes"}
    assert derive.terms(Tables()) == {}


def test_times_that_scatter_as_much_as_they_last_have_no_ratio_and_decide_nothing():
    busy = table(**SOME)["measured"].assign(step_s_err=3.0)
    rows = pd.DataFrame(derive.terms(Tables({"measured": busy}))["scenes"])
    assert rows["step_ratio"].isna().all() and rows["time_ratio"].notna().sum() == 3
    said = {row["id"]: row for row in judge(claims.TERMS, Tables({"measured": busy, "scenes": rows}), "cost")}
    assert said["own-scenes-motion"]["verdict"] == "undecidable"


def test_verdicts_follow_the_table():
    for changed, verdict in ((0.021, "holds"), (0.2, "fails")):
        rows = table(**(SOME | {"heat": (1.0, 3.0, 60.0, changed)}))
        said = {row["id"]: row["verdict"] for row in judge(claims.TERMS, rows, "cost")}
        assert said["own-scenes-heat-error"] == verdict


def test_the_figure_names_what_is_needed():
    axes, = figures.TERMS(table(**SOME))["scenes"].axes
    words = "\n".join(tick.get_text() for tick in axes.get_yticklabels())
    assert "without heat: off by 0.1 %, not needed" in words and "without viscosity: diverges, needed" in words
    assert figures.TERMS(Tables()) == {}


def test_every_base_has_a_whole():
    assert all("nothing" in made for made in terms.BASES.values())
    left_out = {name for made in terms.BASES.values() for name in made}
    assert {"heat", "gravity", "viscosity", "noise", "motion", "compressibility"} <= left_out


def test_a_base_is_measured_whole_and_in_parts(monkeypatch):
    monkeypatch.setattr(terms, "FLOW", flows.Vortex(0.2))     # whose answer takes seconds less
    case = terms.Compared(scene="taylor-green", base="fixed points without heat", size=8, short=1e-5)
    rows = case.run(lambda done: None, None).rows["measured"]
    assert [row["left_out"] for row in rows] == ["nothing", "viscosity"]
    assert all(set(row) == set(tables.MEASURED.columns) for row in rows)
    assert rows[1]["error"] > 0.5 > rows[0]["error"]        # without friction the vortex keeps e times its velocity
