"""The study ordering: waves on lattices, vortices and layers as cases, what tables make of their errors."""
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from particles.integral.edge_makers import MAKERS, closed, plain, renormalised
from particles.integral.edges import Edges
from particles.integral.interpolants import W
from particles.integral.points import Points, lattice, of_positions, wrapped
from particles.weights import Lucy
from studies.build.disorder import DISORDERS
from studies.kit.claim import CannotTell
from studies.kit.sweep import RESULTS
from studies.kit.table import Tables, read
from studies.ordering import claims, tables
from studies.ordering.cases import IRREGULAR
from studies.ordering.convection import PLATES, between_images, convection, on_lattice
from studies.ordering.derive import MACH, of_flows, reference
from studies.ordering.derive import convection as layers
from studies.ordering.figures import over_disorder
from studies.ordering.gradients import form_errors, wave_errors
from studies.ordering.vortices import TaylorGreen

# --- waves ------------------------------------------------------------------------------------------------------------


def test_the_error_of_a_lattice_is_its_symbol():
    """grad sin kx = (sum over the lattice) cos kx: the measured error is that of the wave number that edges see."""
    at, weight, k = lattice((32, 16)), Lucy.of(h=3.0), 2*np.pi/32
    edges = renormalised(at, weight)
    symbol = float((edges.areas[0]@np.exp(1j*k*at.x[:, 0])/np.exp(1j*k*at.x[:, 0])/2).imag.mean()/edges.V[0])
    gradient, _ = wave_errors(edges, at.x[:, 0], k)
    assert gradient == pytest.approx(abs(symbol/k - 1), rel=1e-9)


@pytest.mark.skipif(not (RESULTS/"ordering"/"slopes.csv").exists(), reason="no tables are committed yet")
def test_compact_weights_are_of_second_order_on_a_lattice():
    """Slope 2.0 +- 0.05 at a range of 3 spacings: the next order, (h/lambda)^4, takes 0.01 to 0.02 at these wavelengths."""
    slopes = pd.DataFrame(read(RESULTS/"ordering"/"slopes.csv", tables.SLOPES.columns))
    some = slopes[(slopes["maker"] == "renormalised") & (slopes["points"] == "lattice") & (slopes["fixed"] == "h/a")
                  & (slopes["at"] == 3.0) & (slopes["operator"] == "gradient")]
    assert set(some["weight"]) == {"Lucy", "Monaghan", "WendlandC2", "WendlandC4", "WendlandC6"}
    assert np.all(np.abs(some["slope"] - 2) < 0.05)


def test_forms_of_the_gradient_differ_by_what_they_make_of_a_constant():
    """On a lattice, where the sum over e_ij is zero, all three are one; by hand for points of which each has two neighbours."""
    at, weight, k = lattice((32, 16)), Lucy.of(h=3.0), 2*np.pi/32
    found = form_errors(plain(at, weight), at.x[:, 0], k)
    assert found["single"] == pytest.approx(wave_errors(plain(at, weight), at.x[:, 0], k)[0], rel=1e-9)
    assert found["sum"] == pytest.approx(found["single"], rel=1e-9) == pytest.approx(found["difference"], rel=1e-9)

    shift = np.where(np.arange(16) % 2, 0.2, 0.0)        # every second point of a line moved: neighbours at 1.2 and 0.8
    uneven = of_positions(wrapped(lattice((16,)).x + shift[:, None], np.array([16.0])), (16.0,))
    near, x = Lucy.of(h=1.5, d=1), uneven.x[:, 0]
    right, left = np.where(shift > 0, 0.8, 1.2), np.where(shift > 0, 1.2, 0.8)
    W_right, W_left = (W(near, r) for r in (right, left))
    missed = dict.fromkeys(("single", "sum", "difference"), 0.0)
    for phase in (0.0, np.pi/2):
        def f(y, phase=phase):
            return np.sin(np.pi/8*y + phase)
        for form, own in (("single", 0), ("sum", 1), ("difference", -1)):
            slope = W_right*(f(x + right) + own*f(x)) - W_left*(f(x - left) + own*f(x))
            missed[form] += np.mean((slope - np.pi/8*np.cos(np.pi/8*x + phase))**2)
    found = form_errors(plain(uneven, near), x, np.pi/8)
    assert found == pytest.approx({form: np.sqrt(total)*8/np.pi for form, total in missed.items()}, rel=1e-9)
    assert found["sum"] > 2*found["difference"]


def vortex(maker: str, h: float, disorder: str, wavelength: int, mach: float = 0.3) -> dict:
    case = TaylorGreen(maker=maker, make=MAKERS[maker], weight=Lucy if h else None, h=h, disorder=DISORDERS[disorder],
                       wavelength=wavelength, mach=mach)
    return case.run(lambda done: None, Path()).rows["vortices"][0]


# --- vortices -------------------------------------------------------------------------------------------------------------


def test_a_vortex_on_a_lattice_decays_as_the_symbol_of_its_nearest_neighbours_says():
    """Friction with nearest neighbours takes 2 (1 - cos k) for k^2; 3 %: errors of what Mach 0.1 compresses are 2 % of that."""
    for wavelength in (12, 16):
        k, row = 2*np.pi/wavelength, vortex("renormalised", 1.2, "lattice", wavelength, 0.1)
        assert row["decay"] == pytest.approx(2*(1 - np.cos(k))/k**2 - 1, rel=0.03)


def test_errors_of_all_makers_agree_on_a_lattice_but_for_plain_quadrature():
    found = {maker: vortex(maker, 3.0, "lattice", 12)["velocity"] for maker in ("renormalised", "closed", "exact", "plain")}
    assert found["closed"] == pytest.approx(found["renormalised"], rel=1e-6)
    assert found["exact"] == pytest.approx(found["renormalised"], rel=1e-6)
    assert abs(found["plain"]/found["renormalised"] - 1) > 1e-3


def test_triangles_stay_where_the_bracket_of_weights_diverges():
    lost, kept = vortex("plain", 3.0, "random", 16), vortex("delaunay", 0.0, "random", 16)
    assert 0 < lost["reached"] < 1 and np.isnan([lost["velocity"], lost["decay"], lost["exchanges"]]).all()
    assert kept["reached"] == 1 and kept["velocity"] < 0.15 and kept["exchanges"] > 0


def refused(points: Points, weight: type) -> Edges:
    raise ArithmeticError("no such edges")


def test_points_without_such_edges_leave_a_row():
    case = TaylorGreen(maker="exact", make=refused, weight=Lucy, h=3.0, disorder=DISORDERS["random"], wavelength=8)
    row = case.run(lambda done: None, Path()).rows["vortices"][0]
    assert row["reached"] == 0 and np.isnan(row["velocity"])


# --- tables -----------------------------------------------------------------------------------------------------------------


def made(constant: float, order: float, sizes=(16, 24, 32, 48), h=2.0, points="lattice") -> pd.DataFrame:
    """Vortices with errors constant/size^order and size^3 exchanges."""
    rows = [{"maker": "renormalised", "weight": "Lucy", "h": h, "points": points, "wavelength": n, "mach": MACH, "seed": 1,
             "velocity": constant*n**-order, "decay": -constant*n**-order, "reached": 1.0, "exchanges": float(n)**3}
            for n in sizes]
    return pd.DataFrame(rows)


def test_slopes_and_costs_of_power_laws_are_theirs():
    found = of_flows(Tables({"vortices": made(4.0, 2.0)}))
    assert {row["quantity"]: row["slope"] for row in found["flow_slopes"]} == pytest.approx({"velocity": 2, "decay": 2})
    for row in found["cheapest"]:       # 4/n^2 = 0.01
        assert (row["needed"], row["exchanges"], row["bound"]) == (pytest.approx(20), pytest.approx(8000), 0)


def test_slopes_over_the_range_leave_out_nearest_neighbours():
    wider = pd.concat([made(h**1.5, 2.0, h=h) for h in (1.2, 2.0, 3.0, 4.0)])
    wider.loc[wider["h"] == 1.2, "velocity"] *= 7
    found = [row for row in of_flows(Tables({"vortices": wider}))["flow_slopes"] if row["fixed"] == "a"]
    assert [row["slope"] for row in found] == pytest.approx([1.5]*8)


def test_costs_say_where_they_are_bounds_and_where_there_is_none():
    low, high = (of_flows(Tables({"vortices": made(c, 2.0)}))["cheapest"][0] for c in (0.1, 400.0))
    assert (low["bound"], low["needed"]) == (1, 16)
    assert np.isnan(high["needed"]) and high["finest"] == pytest.approx(400/48**2)
    with pytest.raises(CannotTell):
        claims.cost({"flow": "taylor-green"})(Tables({"cheapest": pd.DataFrame([low])}))


def test_a_lost_seed_makes_no_slope_and_no_cost():
    runs = made(4.0, 2.0)
    runs.loc[runs["wavelength"] == 48, "velocity"] = np.nan
    found = of_flows(Tables({"vortices": runs}))
    row = next(row for row in found["cheapest"] if row["quantity"] == "velocity")
    assert np.isnan(row["needed"])
    assert next(row for row in found["flow_slopes"] if row["quantity"] == "velocity")["number"] == 3


def test_convection_with_other_rolls_has_no_error_and_what_is_not_steady_a_larger_one():
    known = reference()
    assert known[0]["ke"] == pytest.approx(0.00489, rel=0.02)      # KHP95 prints 0.00481
    row = {"maker": "renormalised", "weight": "Lucy", "h": 2.0, "points": "lattice", "rows": 16, "ke": 1.1*known[0]["ke"],
           "ke_err": 0.02*known[0]["ke"], "exchanges": 1.0, "rolls": 2}
    rows = pd.DataFrame([{**row, "seed": 1}, {**row, "seed": 2, "rolls": 4}])
    found = of_flows(Tables({"convection": rows}))["flows"][0]
    assert (found["seeds"], found["lost"]) == (2, 1)
    assert (found["error"], found["error_err"]) == (pytest.approx(0.1), pytest.approx(0.02))


def test_cases_of_convection_name_their_points_and_weights(tmp_path):
    """A few free-fall times tell nothing of K, but a row has its key, and counts exchanges."""
    short = {"t_end": 1.0}
    for case in (convection("lattice", on_lattice(1.5), 8), convection("random", PLATES["random"], 8)):
        case = type(case)(**{**vars(case), **short})
        row = case.run(lambda done: None, tmp_path).rows["convection"][0]
        assert (row["points"], row["rows"]) == (case.kind, 8)
        assert (row["maker"], row["weight"], row["h"]) == (("renormalised", "Lucy", 1.5) if case.kind == "lattice"
                                                           else ("delaunay", "none", 0.0))
        assert row["exchanges"] > 4*16*8


# --- layers -----------------------------------------------------------------------------------------------------------


def row(maker: str, h: float, points: str = "random", rows: int = 16, **more) -> dict:
    return {"maker": maker, "weight": "Lucy" if h else "none", "h": h, "points": points, "rows": rows, "seed": 1, "ke": 0.005,
            "ke_err": 1e-6, "rolls": 2, "exchanges": 1e6, **more}


# --- rows -------------------------------------------------------------------------------------------------------------------


def exact(points: Points, weight: type) -> Edges:
    raise ArithmeticError("no such edges")


def short(maker: str, **more):
    case = convection("jittered-0.3", between_images("jittered-0.3", maker, 2.0), 8)
    return type(case)(**{**vars(case), "t_end": 1.0, **more})


def test_a_run_between_images_has_the_key_of_its_edges(tmp_path):
    found = short("closed").run(lambda done: None, tmp_path).rows["convection"][0]
    assert [found[name] for name in ("maker", "weight", "h", "points", "rows")] == ["closed", "Lucy", 2.0, "jittered-0.3", 8]
    assert found["ke"] > 0 and found["exchanges"] > 4*16*8


def test_points_without_exact_edges_leave_a_row_and_others_must_exist(tmp_path, monkeypatch):
    monkeypatch.setattr("studies.ordering.convection.exact", exact)
    scheme = between_images("jittered-0.3", "exact", 2.0)._replace(make=exact)
    found = short("exact", scheme=scheme).run(lambda done: None, tmp_path).rows["convection"][0]
    assert np.isnan(found["ke"]) and (found["rolls"], found["exchanges"]) == (0, 0)
    monkeypatch.setattr("studies.ordering.convection.exact", closed)
    with pytest.raises(ArithmeticError, match="no such edges"):
        short("exact", scheme=scheme).run(lambda done: None, tmp_path)


def test_runs_without_an_end_cost_nothing_that_could_be_told():
    runs = pd.DataFrame([row("exact", 3.0), {**row("exact", 3.0), "seed": 2, "ke": np.nan, "rolls": 0, "exchanges": 0.0}])
    found = layers(Tables({"convection": runs}), [{"flow": "convection", "ke": 0.005, "ke_err": 0.0}])
    assert found["exchanges"].tolist()[0] == 1e6 and np.isnan(found["exchanges"].tolist()[1])


def test_claims_count_the_runs_that_they_are_about():
    runs = pd.DataFrame([row("plain", 3.0), row("plain", 3.0, ke=0.008), row("renormalised", 3.0, rolls=0, ke=np.nan),
                         row("plain", 2.0), row("closed", 3.0), row("plain", 3.0, "lattice")])
    tables = Tables({"convection": runs, "reference": pd.DataFrame([{"flow": "convection", "ke": 0.005, "ke_err": 0.0}])})
    assert claims.near_grid(tables).value == pytest.approx(1/3)       # h = 2 a has its r0 below the spacing


def test_the_share_of_ordered_vortices_counts_wide_weights_on_irregular_points_only():
    def rows(points: str, h: float, velocity: float) -> pd.DataFrame:
        return made(1.0, 0.0, (16,), h, points).assign(velocity=velocity)
    tables = Tables({"vortices": pd.concat([rows("random", 3.0, 0.05), rows("random", 4.0, np.nan),
                                            rows("random", 2.0, np.nan), rows("lattice", 3.0, 0.9)])})
    value, = (claim.value for claim in claims.CLAIMS if claim.id == "rr98-eq45-vortex-irregular")
    assert value(tables).value == 0.5


def test_missing_sets_of_points_are_in_the_figure():
    means = pd.DataFrame([{"flow": "convection", "quantity": "K", "maker": "plain", "weight": "Lucy", "h": 3.0, "points": kind,
                           "resolution": n, "seeds": 3, "lost": lost, "error": error, "error_err": 0.0}
                          for kind in IRREGULAR for n, lost, error in ((16, 1, np.nan), (24, 0, 0.1))])
    labels = over_disorder(means).axes[0].get_legend_handles_labels()[1]
    assert "plain, 3 $a$ (lost: 1 of 2)" in labels
