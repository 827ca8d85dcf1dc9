"""Flows of the study ordering: Fourier sums, vortices that decay as lattices make them, what tables make of errors."""
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from particles.integral.edge_makers import MAKERS
from particles.integral.edges import Edges
from particles.integral.points import Points
from particles.weights import Lucy
from studies.kit.claim import CannotTell
from studies.kit.table import Tables
from studies.ordering import flows
from studies.ordering import flows_claims as claims
from studies.ordering.convection import PLATES, convection, on_lattice
from studies.ordering.vortices import DECAYS, TaylorGreen, fourier, incompressible, off, solved, velocities
from studies.build.disorder import DISORDERS


def vortex(maker: str, h: float, disorder: str, wavelength: int, mach: float = 0.3) -> dict:
    case = TaylorGreen(maker=maker, make=MAKERS[maker], weight=Lucy if h else None, h=h, disorder=DISORDERS[disorder],
                       wavelength=wavelength, mach=mach)
    return case.run(lambda done: None, Path()).rows["vortices"][0]


# --- Fourier sums ---------------------------------------------------------------------------------------------------------


def test_fourier_sums_are_derivatives_of_every_wave_that_fits():
    points, edges = fourier(9)
    x, y = 2*np.pi*points.x.T/9
    k = 2*np.pi/9
    f = np.sin(4*x + 0.3)*np.cos(3*y)
    grad = np.stack([4*k*np.cos(4*x + 0.3)*np.cos(3*y), -3*k*np.sin(4*x + 0.3)*np.sin(3*y)], axis=1)
    assert edges.grad(f) == pytest.approx(grad, abs=1e-13)
    assert edges.lap(f) == pytest.approx(-25*k**2*f, abs=1e-12)
    assert np.abs(edges.closure).max() < 1e-13


def test_the_gas_becomes_incompressible_as_the_square_of_the_mach_number():
    """Of the first two terms, Mach^2 and Mach^4, the second is a tenth of the first at Mach 0.3."""
    place = np.random.default_rng(1).uniform(-0.5, 0.5, (50, 2))
    slow, fast = (solved(mach, 29) for mach in (0.15, 0.3))
    assert (fast.decay - 1)/(slow.decay - 1) == pytest.approx(4, rel=0.15)
    errors = [off(np.ones(50), velocities(found, place), incompressible(place)) for found in (slow, fast)]
    assert errors[1]/errors[0] == pytest.approx(4, rel=0.15)
    assert errors[0] < 0.3*0.15**2


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
    rows = [{"maker": "renormalised", "weight": "Lucy", "h": h, "points": points, "wavelength": n, "mach": flows.MACH, "seed": 1,
             "velocity": constant*n**-order, "decay": -constant*n**-order, "reached": 1.0, "exchanges": float(n)**3}
            for n in sizes]
    return pd.DataFrame(rows)


def test_slopes_and_costs_of_power_laws_are_theirs():
    found = flows.derive(Tables({"vortices": made(4.0, 2.0)}))
    assert {row["quantity"]: row["slope"] for row in found["flow_slopes"]} == pytest.approx({"velocity": 2, "decay": 2})
    for row in found["cheapest"]:       # 4/n^2 = 0.01
        assert (row["needed"], row["exchanges"], row["bound"]) == (pytest.approx(20), pytest.approx(8000), 0)


def test_slopes_over_the_range_leave_out_nearest_neighbours():
    wider = pd.concat([made(h**1.5, 2.0, h=h) for h in (1.2, 2.0, 3.0, 4.0)])
    wider.loc[wider["h"] == 1.2, "velocity"] *= 7
    found = [row for row in flows.derive(Tables({"vortices": wider}))["flow_slopes"] if row["fixed"] == "a"]
    assert [row["slope"] for row in found] == pytest.approx([1.5]*8)


def test_costs_say_where_they_are_bounds_and_where_there_is_none():
    low, high = (flows.derive(Tables({"vortices": made(c, 2.0)}))["cheapest"][0] for c in (0.1, 400.0))
    assert (low["bound"], low["needed"]) == (1, 16)
    assert np.isnan(high["needed"]) and high["finest"] == pytest.approx(400/48**2)
    with pytest.raises(CannotTell):
        claims.cost(Tables({"cheapest": pd.DataFrame([low])}), {"flow": "taylor-green"})


def test_a_lost_seed_makes_no_slope_and_no_cost():
    runs = made(4.0, 2.0)
    runs.loc[runs["wavelength"] == 48, "velocity"] = np.nan
    found = flows.derive(Tables({"vortices": runs}))
    row = next(row for row in found["cheapest"] if row["quantity"] == "velocity")
    assert np.isnan(row["needed"])
    assert next(row for row in found["flow_slopes"] if row["quantity"] == "velocity")["number"] == 3


def test_convection_with_other_rolls_has_no_error_and_what_is_not_steady_a_larger_one():
    known = flows.reference()
    assert known[0]["ke"] == pytest.approx(0.00489, rel=0.02)      # KHP95 prints 0.00481
    row = {"maker": "renormalised", "weight": "Lucy", "h": 2.0, "points": "lattice", "rows": 16, "ke": 1.1*known[0]["ke"],
           "ke_err": 0.02*known[0]["ke"], "exchanges": 1.0, "rolls": 2}
    rows = pd.DataFrame([{**row, "seed": 1}, {**row, "seed": 2, "rolls": 4}])
    found = flows.derive(Tables({"convection": rows}))["flows"][0]
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


def test_the_share_of_ordered_vortices_counts_wide_weights_on_irregular_points_only():
    def rows(points: str, h: float, velocity: float) -> pd.DataFrame:
        return made(1.0, 0.0, (16,), h, points).assign(velocity=velocity)
    tables = Tables({"vortices": pd.concat([rows("random", 3.0, 0.05), rows("random", 4.0, np.nan), rows("random", 2.0, np.nan),
                                            rows("lattice", 3.0, 0.9)])})
    assert claims.ordered(tables).value == 0.5


def test_decays_are_told_over_one_time():
    assert DECAYS == 1.0 and np.hypot(*incompressible(np.array([[0.25, 0.0]]))[0]) == pytest.approx(np.exp(-1))
