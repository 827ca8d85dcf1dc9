"""Studies of which some cases alone were run say what cannot be told yet."""
import numpy as np
import pandas as pd
import pytest

import studies.noise as noise
import studies.operators as operators
from studies.kit.claim import judge
from studies.kit.table import Tables
from studies.onset import STUDY


def test_no_critical_number_follows_from_one_growth_rate():
    columns = next(table for table in STUDY.tables if table.name == "growth_rates").columns
    one = pd.DataFrame([{**dict.fromkeys(columns, 0.0), "method": "linear", "variant": "", "eos": "", "transport": "",
                         "sides": "periodic", "way": "eigenvalue", "resolution": np.inf}])
    assert not any(STUDY.derive(Tables({"growth_rates": one})).values()), "the rate of linear theory is no run"
    assert not any(STUDY.derive(Tables()).values())


@pytest.mark.parametrize(("study", "rows", "names"), [
    (operators, {"lattice": [{"weight": "Exponential", "d": d, "how": how, "n": n, "r0": 1.0, "value": 0.5, "predicted": 0.5}
                             for d in (1, 3) for how in ("plain", "line") for n in (0, 1, 2, 3, 4)]},
     ("rr98-eq32-zeroth", "rr98-eq32-moments")),
    (noise, {"onset": [{"rows": 8, "below": below, "velocity": 2.0} for below in (0.5, 0.02)],
                    "sampled": [{"flow": "layer", "field": "slowest", "strength": 0.02, "exact": 2.0, "ratio": 1.0,
                                 "ratio_err": 0.1}]},
     ("rr98-fluct-eq25-onset", "rr98-fluct-eq25-onset-sampled"))])
def test_few_rows_decide_nothing(study, rows, names):
    tables = Tables({name: pd.DataFrame(some) for name, some in rows.items()})
    said = {row["id"]: row for row in judge([claim for claim in study.STUDY.claims if claim.id in names], tables, "toy")}
    assert set(said) == set(names)
    assert all(row["verdict"] == "undecidable" and "not run yet" in row["reason"] for row in said.values()), said
