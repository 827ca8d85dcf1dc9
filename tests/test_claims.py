"""Claims of KHP95 that arithmetic decides: known values, sums that are those of the runs; claims on onset."""
import numpy as np
import pandas as pd
import plain
import pytest
from claim_tables import BY_ID, numbers

from continuum.fluid import ConstEta, IdealGas
from particles.smooth.spam import Spam
from particles.walls.periodic import periodic
from particles.weights import Lucy, Monaghan, value_and_slope
from studies.kit.claim import judge
from studies.kit.table import Tables
from studies.onset.claims import ONSET_CLAIMS
from studies.rb import snapshots
from studies.rb.claims import RB_CLAIMS
from studies.rb.runs import arithmetic, lattices
from studies.rb.runs import few_particles as few

ALL = (*RB_CLAIMS, *ONSET_CLAIMS)
VERDICTS = ("holds", "fails", "undecidable")


KNOWN = [  # derived on paper or summed in other code
    ("khp95-lucy-bracket", 0.010452, 1e-4, "holds"), ("khp95-spurious-shear", 0.0102, 1e-2, "holds"),
    ("khp95-spurious-shear-square", 0.077, 1e-2, "fails"),
    ("khp95-high-pressure-lattice", 1.37934/1.00297, 1e-3, "fails"),
    ("khp95-frozen-occupancy-lucy", 1, 0, "holds"), ("khp95-frozen-occupancy-monaghan", 2, 0, "holds"),
    ("khp95-vdw-stiffness", (3/7)/(10/25.5), 1e-9, "fails"), ("khp95-dense-stiffness", 10/25.5, 1e-9, "fails"),
    ("khp95-pressure-sound", 5/25.5, 1e-9, "fails"), ("khp95-prandtl-isobaric", 2, 1e-6, "fails"),
    ("khp95-dense-maxwell-energy", -1.5, 1e-12, "holds"), ("khp95-dense-maxwell-pressure", 1.25, 1e-12, "holds"),
    ("khp95-ra-fig10", 9.5**2*2500/0.64, 1e-12, "holds"),
    ("khp95-ra-fig10-expansivity", 9.5**2*2500/0.64/5.25, 1e-6, "fails"),
    ("khp95-kinetic-errors", 1 - 30/34, 1e-12, "undecidable"),
    ("khp95-initial-energy", 0.0018/0.00481, 1e-12, "fails"),
    ("khp95-line-pair", 1717.417, 1e-5, "undecidable"), ("khp95-line-read", 0.00480061, 1e-6, "undecidable"),
    ("khp95-rk4-order-small", 3, 0.05, "fails"), ("khp95-viscoelastic", 0.0071, 0.01, "holds"),
]


@pytest.mark.parametrize(("name", "value", "rel", "said"), KNOWN)
def test_what_arithmetic_decides(name, value, rel, said):
    [row] = judge([BY_ID[name]], Tables(arithmetic=numbers()), "rb")
    assert row["measured"] == pytest.approx(value, rel=rel)
    assert row["verdict"] == said


def test_rounding_of_the_printed_pair_is_its_error():
    """Zeros of the lines through 0.003405 and 0.004805, 0.003395 and 0.004815: 1705 and 1730."""
    value, err = arithmetic.zero_of_pair()
    ends = [((5000**-0.5*q - 10000**-0.5*k)/(q - k))**-2 for k, q in ((0.003405, 0.004805), (0.003395, 0.004815))]
    assert ends == pytest.approx([1705.22, 1729.57], abs=0.01)
    assert err == pytest.approx(max(abs(end - value) for end in ends), rel=1e-12)


def test_third_derivatives_of_the_weights_jump_at_the_range():
    """Why Runge-Kutta ends at order 3. By hand: 4 (1 - r/3)^3 and 2 (1 - r/3)^3, in w(0), are what is left at r = 3."""
    for weight, factor in ((lattices.LUCY, 4), (lattices.MONAGHAN, 2)):
        assert weight.jumps(3)[len(weight.pieces) - 1] == pytest.approx(factor*6/27, rel=1e-12)


def test_midpoint_steps_are_of_second_order():
    start = few.start()
    fine = few.march(start, 0.01, 60, eta=0.3)
    errors = [few.distance(few.march_midpoint(start, 0.6/n, n, eta=0.3), fine) for n in (4, 8)]
    assert np.log2(errors[0]/errors[1]) == pytest.approx(2, abs=0.15)      # the next term is dt = 0.15 times the first


def test_printed_weights_are_those_that_run():
    r = np.linspace(0, 3.2, 60)
    for weight, here in ((Lucy, lattices.LUCY), (Monaghan, lattices.MONAGHAN)):
        values = [value_and_slope(weight.of(3.0), at)[0] for at in r]
        np.testing.assert_allclose(here(r), values, rtol=0, atol=1e-14)     # normalised by quadrature good to 1e-13


def test_sums_of_the_claims_are_those_that_run():
    walls = periodic(few.SIDE) + periodic(few.SIDE, axis=1)
    method = Spam(weight=Lucy.of(3.0), eos=IdealGas(), law=ConstEta(0.3, 0.3), walls=walls, box=(few.SIDE, few.SIDE))
    state = few.start()
    # the range 3 of 36 particles: some 30 terms a sum, each good to 1e-16 times its size
    np.testing.assert_allclose(few.rates(state, eta=0.3), plain.rates(method, state).out, rtol=0, atol=1e-12)


def test_accelerations_of_a_snapshot_are_those_of_the_sums():
    """Nine copies of a periodic square on top of each other: the middle one does not know of the ends."""
    state, copies = few.start(), 9
    x = np.concatenate([state[:2].T + [0, few.SIDE*copy] for copy in range(copies)])
    v, T = (np.concatenate([part]*copies) for part in (state[2:4].T, state[4]))
    real, simple = snapshots.accelerations(x, v, T, 0.3, few.SIDE)
    middle = slice(36*(copies//2), 36*(copies//2 + 1))
    np.testing.assert_allclose(real[middle], few.rates(state, eta=0.3)[2:4].T, rtol=0, atol=1e-12)
    np.testing.assert_allclose(simple[middle], few.rates(state, few.quadratic)[2:4].T, rtol=0, atol=1e-12)


# --- onset ----------------------------------------------------------------------------------------


def critical(**values: float) -> Tables:
    layer = "ra_c periodic aspect 2"
    names = {"linear": ("linear", layer), "infinite": ("linear", "ra_c infinite layer rigid"),
             "eta": ("compressible", f"{layer} (growth rates)"),
             "nu": ("compressible", f"{layer}, const-nu (growth rates)"),
             "small": ("compressible", f"{layer}, dT 0.1 (growth rates)"),
             "line": ("compressible", f"{layer} (K line, L^-2 extrapolated)")}
    rows = [(*names[key], value, 0.02) for key, value in values.items()]
    return Tables({"critical_ra": pd.DataFrame(rows, columns=["method", "quantity", "value", "err"])})


def onset_verdicts(**values: float) -> dict[str, list[str]]:
    """Claims by verdict."""
    rows = judge(ONSET_CLAIMS, critical(**values), "onset")
    return {said: [row["id"].removeprefix("khp95-") for row in rows if row["verdict"] == said] for said in VERDICTS}


def test_verdicts_on_onset_follow_the_table():
    found = onset_verdicts(linear=1707.92, infinite=1707.762, eta=1714.0, nu=1701.0, small=1708.0, line=1714.05)
    assert found["fails"] == ["small-dt", "intermediate-capacity"]
    assert found["undecidable"] == ["ra-figures-plain", "ra-figures-square"]
    assert found["holds"] == ["chandrasekhar", "box-corresponds", "ra-bracket", "ra-close", "ra-close-const-nu",
                              "ra-deviation", "ra-figures"]
    same_side = onset_verdicts(linear=1707.92, eta=1714.0, nu=1712.0, line=1720.0)
    assert {"ra-bracket", "ra-figures"} <= set(same_side["fails"])
