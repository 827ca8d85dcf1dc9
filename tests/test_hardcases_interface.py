"""The shocked interface on the grid: markers, limits, verdicts."""
import numpy as np
import pandas as pd
import pytest

from studies.hardcases.interface.grid import CLAIMS, GRIDS, GROWTH, RIPPLES, GridInterface, derive, gentle, inviscid
from studies.hardcases.interface.runs import impulse
from studies.kit.claim import CannotTell, judged
from studies.kit.table import Tables


def grown(rate, steeps=(0.25, 0.05)) -> Tables:
    """Growth rates of all runs by a formula of eta, cells, steepness."""
    rows = [{"steep": steep, "eta": eta, "cells": cells, "kick": 1.0, "kick_err": 0.0, "growth": rate(eta, cells, steep),
             "growth_err": 0.001} for eta, cells in GRIDS for steep in steeps]
    particles = [{"scale": scale, "steep": 0.25, "growth": 0.7 - 0.5*scale**-0.5, "growth_err": 0.01} for scale in (1.0, 4.0)]
    return Tables({GROWTH.name: pd.DataFrame(rows), "ripple_growth": pd.DataFrame(particles)})


def test_the_limit_is_linear_in_the_square_root_of_viscosity():
    found = inviscid(grown(lambda eta, cells, steep: 0.9 - 0.7*eta**0.5))
    assert found.value == pytest.approx(0.9) and found.err < 1e-12
    bent = inviscid(grown(lambda eta, cells, steep: 0.9 - 0.7*eta))
    assert bent.err > 0.02
    coarse = inviscid(grown(lambda eta, cells, steep: 0.9 - 0.7*eta**0.5 + 0.1/cells**2))
    assert coarse.err > 0.1*(1/16 - 1/64)*0.99
    with pytest.raises(CannotTell, match="three"):
        inviscid(Tables({GROWTH.name: grown(lambda *_: 1.0)[GROWTH.name].query("eta > 0.06")}))


@pytest.mark.parametrize("rate, verdicts", [(lambda eta, cells, steep: 1.0, ["holds", "holds", "fails", "fails"]),
                                            (lambda eta, cells, steep: 0.45, ["fails", "holds", "holds", "fails"]),
                                            (lambda eta, cells, steep: 0.8 - steep/2, ["fails", "fails", "fails", "holds"])])
def test_claims_of_the_interface_can_fail(rate, verdicts):
    tables = grown(rate)
    assert [judged(claim, tables)["verdict"] for claim in CLAIMS] == verdicts
    assert gentle(tables).value == pytest.approx(rate(0.1, 4, 0.25)/rate(0.1, 4, 0.05))


def test_markers_go_with_the_flow():
    case, at = GridInterface(eta=0.4, cells=2), np.array([[12.3, -40.0], [-7.1, 14.9]])
    S = np.zeros((4, 2*2*100 + 2, 2*30 + 2))
    S[0, 1:-1, 1:-1] = np.arange(400)[:, None]/2 - 100      # v_x = y, v_y = 3
    S[1, 1:-1, 1:-1] = 3.0
    np.testing.assert_allclose(case.velocity(S, at), [[3.0, 3.0], [12.3, -40.0]], atol=1e-12)


def test_a_thick_interface_is_kicked_and_grows():
    """Two cells a spacing: viscosity takes half of the growth, and a tenth of the kick is what the thick shock adds."""
    theory = impulse(1.0, 0.25)
    rows = GridInterface(eta=0.4, cells=2).run(lambda done: None, None).rows[RIPPLES.name]
    [row] = derive(Tables({RIPPLES.name: pd.DataFrame(rows)}))[GROWTH.name]
    assert rows[-1]["time"] == pytest.approx(theory.back) and row["kick"] == pytest.approx(1, abs=0.1)
    assert 0.3 < row["growth"] < 0.7
    before = [one for one in rows if one["time"] < 0.6*theory.meets]
    # heat that goes from the light to the heavy gas moves both
    assert before[-1]["amplitude"] == pytest.approx(before[0]["amplitude"], rel=0.05)
