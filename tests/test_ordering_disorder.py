"""Convection over disorder in the study ordering: rows of runs that end early, what claims read, density that creeps."""
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy import sparse
from scipy.sparse.linalg import spsolve

from particles.integral.edge_makers import closed, renormalised
from particles.integral.edges import Edges
from particles.integral.points import Points, lattice
from particles.weights import Lucy, WendlandC2
from studies.kit.claim import CannotTell
from studies.kit.table import Tables
from studies.ordering import convection_claims as claims
from studies.ordering import creep, flows
from studies.ordering.convection import between_images, convection
from studies.ordering.flows_figures import over_disorder
from studies.build.disorder import DISORDERS


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
    found = flows.convection(Tables({"convection": runs}), [{"flow": "convection", "ke": 0.005, "ke_err": 0.0}])
    assert found["exchanges"].tolist()[0] == 1e6 and np.isnan(found["exchanges"].tolist()[1])


# --- claims -----------------------------------------------------------------------------------------------------------------


def test_shares_count_the_runs_that_a_claim_is_about():
    runs = pd.DataFrame([row("plain", 3.0), row("plain", 3.0, ke=0.008), row("renormalised", 3.0, rolls=0, ke=np.nan),
                         row("plain", 2.0), row("closed", 3.0), row("plain", 3.0, "lattice")])
    tables = Tables({"convection": runs, "reference": pd.DataFrame([{"flow": "convection", "ke": 0.005}])})
    assert claims.ordered(tables).value == pytest.approx(1/3)       # h = 2 a has its r0 below the spacing
    assert claims.survived("plain")(tables).value == 1
    assert claims.survived("renormalised", ("random",))(tables).value == 0
    with pytest.raises(CannotTell):
        claims.survived("plain", ("relaxed",))(tables)


def test_closed_edges_take_from_gradients_what_disorder_takes_from_diffusion():
    """Their areas are k_ij times differences of coordinates that were made harmonic: gamma is the conductivity in the mean."""
    kind = DISORDERS["jittered-0.3"]
    edges = closed(kind.make((16, 16), kind.size, 1), Lucy.of(h=2.0))
    pull = np.zeros((edges.n, 2))
    np.add.at(pull, edges.i, edges.k[:, None]*edges.apart)
    np.add.at(pull, edges.j, -edges.k[:, None]*edges.apart)
    L = edges.laplacian.tolil()
    L[0] = 0
    L[0, 0] = 1
    pull[0] = 0
    shift = np.stack([spsolve(sparse.csc_array(L), -q) for q in pull.T], axis=1)
    conducts = float((edges.k[:, None]*(edges.apart + shift[edges.j] - shift[edges.i])**2).sum()/2/edges.V.sum())
    gamma = float(np.einsum("i,iaa->", edges.V, edges.linear)/edges.V.sum()/2)
    assert gamma == pytest.approx(conducts, abs=1e-9) and 0.9 < gamma < 0.97
    assert claims.share("lattice", 2.0).value == pytest.approx(0, abs=1e-12)


def test_the_cheapest_edges_are_held_against_triangles_of_the_same_points():
    series = {"flow": "convection", "quantity": "K", "needed": 20.0, "needed_err": 0.0, "bound": 0, "finest": 0.005}
    triangles = {**series, **row("delaunay", 0.0, "relaxed"), "exchanges": 4e6}
    other = {**series, **row("delaunay", 0.0), "exchanges": 1e6}
    dear, cheap = ({**series, **row("closed", h, "relaxed"), "exchanges": cost} for h, cost in ((2.0, 9e6), (3.0, 8e6)))
    found = claims.cheapest_triangles(Tables({"cheapest": pd.DataFrame([triangles, other, dear, cheap])}))
    assert found.value == pytest.approx(2)
    with pytest.raises(CannotTell, match="not reached"):
        claims.cheapest_triangles(Tables({"cheapest": pd.DataFrame([triangles, {**cheap, "exchanges": np.nan}])}))


def test_an_order_that_cannot_be_told_says_what_there_is():
    rows = [{"flow": "convection", "quantity": "K", "maker": "exact", "weight": "Lucy", "points": "random", "h": 3.0, "seeds": 3,
             "resolution": n, "lost": lost, "error": error, "error_err": 0.2}
            for n, lost, error in ((16, 1, 0.5), (24, 3, np.nan))]
    slopes = pd.DataFrame(columns=["flow", "quantity", "maker", "weight", "points", "fixed", "at", "slope", "slope_err"])
    with pytest.raises(CannotTell, match=r"16 rows: 2 of 3 runs end, 0.50 \+- 0.20 off; 24 rows: 0 of 3 runs end\)"):
        claims.order("exact", "random")(Tables({"flows": pd.DataFrame(rows), "flow_slopes": slopes}))


def test_what_is_lost_is_said_in_the_figure():
    means = pd.DataFrame([{"flow": "convection", "quantity": "K", "maker": "plain", "weight": "Lucy", "h": 3.0, "points": kind,
                           "resolution": n, "seeds": 3, "lost": lost, "error": error, "error_err": 0.0}
                          for kind in claims.IRREGULAR for n, lost, error in ((16, 1, np.nan), (24, 0, 0.1))])
    labels = over_disorder(means).axes[0].get_legend_handles_labels()[1]
    assert "plain, 3 $a$ (lost: 1 of 2)" in labels


# --- what creeps ------------------------------------------------------------------------------------------------------------


def test_growth_and_wavelength_of_what_changes_are_those_that_were_put_in():
    """Nearest neighbours see 2 (1 - cos k) for k^2."""
    points = lattice((16, 8))
    edges, k, rate = renormalised(points, Lucy.of(h=1.2)), np.pi/2, 0.01
    grown = np.exp(rate*creep.PIECE*np.arange(creep.PIECES + 1))
    states = [np.stack([1 + 1e-3*size*np.cos(k*points.x[:, 0]), 0.1*np.ones(128), np.zeros(128), np.ones(128)])
              for size in grown]
    found = creep.told(edges, states)
    assert found["rate"] == pytest.approx(rate, rel=1e-6) and found["rate_err"] < 1e-6
    assert found["wavelength"] == pytest.approx(2*np.pi/np.sqrt(2*(1 - np.cos(k))), rel=1e-6)
    assert found["change"] == pytest.approx(1e-3*(grown[-1] - grown[-2])/np.sqrt(2), rel=1e-6)


def test_creeping_runs_share_their_points_and_claims_read_their_means():
    rows = [case.run(lambda done: None, Path()).rows["creep"][0] for case in creep.creeps(8, (1,), (8e-3,))]
    assert [(one["maker"], one["ra"]) for one in rows] == [("plain", 1e4), ("exact", 1e4), ("delaunay", 1e4), ("exact", 1e3)]
    assert rows[3]["ke"] < 1e-3*rows[1]["ke"]       # at rest
    means = pd.DataFrame(creep.derive(Tables({"creep": pd.DataFrame(rows)}))["creep_means"])
    tables = Tables({"creep_means": means})
    assert creep.mean("rate", "exact", 8e-3)(tables).value == rows[1]["rate"]
    assert creep.over(creep.mean("change", "plain", 8e-3), creep.mean("change", "exact", 8e-3))(tables).value == pytest.approx(
        rows[0]["change"]/rows[1]["change"])


def test_a_laplacian_over_three_spacings_reads_a_zigzag_as_a_longer_wave():
    """What `Creep` says of 3.7 a."""
    points = lattice((12, 8))
    edges, zigzag = renormalised(points, WendlandC2.of(h=3.0)), np.cos(np.pi*points.x[:, 0] - np.pi/2)
    assert 2*np.pi/np.sqrt(-(zigzag@(edges.laplacian@zigzag))/(edges.V@zigzag**2)) == pytest.approx(3.75, abs=0.05)


def test_triangles_are_held_against_plain_edges_set_by_set():
    rows = [{"maker": maker, "until": creep.RESIDUALS[-1], "ra": creep.RA, "seed": seed, "ke_change": change}
            for maker, seed, change in (("plain", 2, 1e-3), ("delaunay", 2, 1e-5), ("plain", 3, 2e-3), ("delaunay", 3, 1e-4),
                                        ("plain", 4, np.nan), ("delaunay", 4, 1e-4))]
    assert creep.largest(Tables({"creep": pd.DataFrame(rows)})).value == pytest.approx(0.05)
