"""Claims of KHP95 that arithmetic decides: known values, sums that are those of the runs."""
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from particles.weights import Lucy, Monaghan, value_and_slope
from studies.kit.claim import judge
from studies.kit.sweep import RESULTS
from studies.kit.table import Tables, read
from studies.rb.claims import RB_CLAIMS
from studies.rb.runs import few_particles as few
from studies.rb.runs.arithmetic import SUBJECTS, WithoutFlow

KNOWN = [  # derived on paper or summed in other code
    ("lucy-bracket", 0.010452, 1e-4), ("spurious-shear", 0.0102, 1e-2),
    ("spurious-shear-square", 0.077, 1e-2), ("high-pressure-lattice", 1.37934/1.00297, 1e-3),
    ("vdw-stiffness", (3/7)/(10/25.5), 1e-9), ("dense-stiffness", 10/25.5, 1e-9),
    ("pressure-sound", 5/25.5, 1e-9), ("prandtl-isobaric", 2, 1e-6),
    ("ra-fig10-expansivity", 9.5**2*2500/0.64/5.25, 1e-6),
    ("rk4-order-small", 3, 0.05), ("viscoelastic", 0.0071, 0.01),
]


@pytest.fixture(scope="module")
def judged() -> dict[str, dict]:
    """Claims judged by the table `arithmetic` alone, computed anew."""
    outcomes = [WithoutFlow(numbers=subject).run(lambda done: None, Path()) for subject in SUBJECTS]
    numbers = pd.DataFrame([row for outcome in outcomes for row in outcome.rows["arithmetic"]])
    return {row["id"]: row for row in judge(RB_CLAIMS, Tables(arithmetic=numbers), "rb")}


def test_numbers_computed_anew_give_the_committed_verdicts(judged):
    committed = read(RESULTS/"claims.csv").set_index("id")["verdict"].to_dict()
    decided = {name: row["verdict"] for name, row in judged.items() if row["verdict"] != "undecidable"}
    assert decided.items() <= committed.items() and len(decided) > 40


@pytest.mark.parametrize(("name", "value", "rel"), KNOWN)
def test_what_arithmetic_decides(judged, name, value, rel):
    found, = (row for whole, row in judged.items() if whole.partition("-")[2] == name)
    assert found["measured"] == pytest.approx(value, rel=rel)


def test_midpoint_steps_are_of_second_order():
    errors = [few.distance(few.end(few.GAS, 1, steps, few.Midpoint), few.end(few.GAS, 1, 512))
              for steps in (64, 128)]
    # the next term is dt = 0.075 times the first
    assert np.log2(errors[0]/errors[1]) == pytest.approx(2, abs=0.1)


def test_printed_weights_are_those_that_run():
    r = np.linspace(0, 3.2, 60)
    for weight, here in ((Lucy, few.LUCY), (Monaghan, few.MONAGHAN)):
        values = [value_and_slope(weight.of(3.0), at)[0] for at in r]
        # normalised by quadrature good to 1e-13
        np.testing.assert_allclose(here(r), values, rtol=0, atol=1e-14)
