"""Published numbers: every file is complete, and what a paper prints must agree with itself."""
import csv
from dataclasses import FrozenInstanceError

import numpy as np
import pytest
from scipy.integrate import quad

from continuum import published as module
from continuum.published import names, published, table

COLUMNS = ["id", "quantity", "symbol", "value", "uncertainty", "units", "source", "reading", "note"]
READINGS = {"text", "equation", "caption", "memory", "derived"}


def number(key: str) -> float:
    return published(key).value


def khp(key: str) -> float:
    return number("khp95-" + key)


def close(a: float, b: float) -> bool:
    """Equal to the 12 figures with which fractions such as 5/(9 pi) are kept in the files."""
    return a == pytest.approx(b, rel=1e-11)


# --- files ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", names())
class TestFile:
    def text(self, name):
        return (module.FOLDER / f"{name}.csv").read_text().splitlines()

    def test_head_says_paper_reading_uncertainty_misprints(self, name):
        head = "\n".join(line for line in self.text(name) if line.startswith("#"))
        assert all(f"# {word}:" in head for word in ("paper", "read", "uncertainty", "misprints"))

    def test_columns(self, name):
        assert [column for column in table(name).columns if column in COLUMNS] == COLUMNS

    def test_every_row_is_complete(self, name):
        rows = table(name)
        assert np.isfinite(rows["value"]).all() and (rows["uncertainty"] >= 0).all()
        assert (rows[["quantity", "units", "source"]] != "").all(axis=None)
        assert set(rows["reading"]) <= READINGS
        assert (rows.loc[rows["reading"] == "derived", "note"] != "").all()     # a derivation is told

    def test_ids_begin_with_the_file_and_occur_once(self, name):
        ids = table(name)["id"]
        assert ids.is_unique and ids.str.startswith(f"{name}-").all()

    def test_uncertainty_covers_the_rounding(self, name):
        for row in csv.DictReader(line for line in self.text(name) if not line.startswith("#")):
            digits = len(row["value"].partition(".")[2])
            kept = float(row["uncertainty"])
            # 0 marks a choice; 0.99 because the uncertainties are themselves rounded to two figures
            assert kept == 0 or kept >= 0.99*0.5*10**-digits, row["id"]


# --- look-up ----------------------------------------------------------------------------------------------


def test_every_id_is_found():
    for name in names():
        for row in table(name).itertuples():
            assert (published(row.id).value, published(row.id).source) == (row.value, row.source)


def test_wrong_id_names_the_like():
    with pytest.raises(ValueError, match=r"'khp95-ke-500'.*khp95-ke-5000"):
        published("khp95-ke-500")
    with pytest.raises(ValueError, match=r"'zzz'.*khp95.*table\("):
        published("zzz")
    with pytest.raises(ValueError, match=r"'nobody'.*khp95.*rr98"):
        table("nobody")


def test_numbers_cannot_be_changed():
    with pytest.raises(FrozenInstanceError):
        published("khp95-ke-5000").value = 0.0
    mine = table("khp95")
    mine["value"] = -1.0
    assert (table("khp95")["value"] != -1.0).iloc[0]


# --- KHP95 ------------------------------------------------------------------------------------------------


def lucy(r):
    return khp("lucy-prefactor")*(1 + khp("lucy-slope")*r)*(1 - r/khp("weight-range"))**khp("lucy-exponent")


def monaghan_inner(r):
    return khp("monaghan-prefactor-inner")*(1 + khp("monaghan-quadratic")*r**2 + khp("monaghan-cubic")*r**3)


def monaghan_outer(r):
    return khp("monaghan-prefactor-outer")*(1 - r/khp("weight-range"))**khp("monaghan-exponent")


def plane(w, start, end):
    """Integral of w over a ring of the plane."""
    return quad(lambda r: 2*np.pi*r*w(r), start, end)[0]


def test_printed_weights_are_normalised():
    joint, h, one = khp("monaghan-joint"), khp("weight-range"), khp("weight-integral")
    assert close(plane(lucy, 0, h), one)
    assert close(plane(monaghan_inner, 0, joint) + plane(monaghan_outer, joint, h), one)


def test_van_der_waals_critical_point_follows_from_a_and_b():
    a, b = khp("vdw-a"), khp("vdw-b")
    assert close(khp("vdw-critical-density"), 1/(3*b))
    assert close(khp("vdw-critical-temperature"), 8*a/(27*b))
    assert close(khp("fig7-temperature"), khp("temperature-mean")/khp("vdw-critical-temperature"))
    assert close(khp("fig7-density-maximum"), khp("fig7-density")*b)


def test_dense_fluid_is_inconsistent_by_the_printed_numbers():
    pressure, slope = khp("dense-pressure"), khp("dense-p-du")*khp("dense-u-dtau")      # P, (dP/dT)_V
    assert close(khp("dense-p-const"), pressure)
    assert close(khp("dense-maxwell-energy"), -khp("dense-u-dn"))                       # dV = -dn at n = 1
    assert close(khp("dense-maxwell-pressure"), pressure - slope)


@pytest.mark.parametrize("figure", [2, 3, 4, 7, 9, 10, 12])
def test_boxes_hold_unit_density(figure):
    height, width = khp(f"fig{figure}-height"), khp(f"fig{figure}-width")
    assert khp(f"fig{figure}-particles") == khp("density")*height*width


@pytest.mark.parametrize("figure", [2, 3, 9, 12])
def test_captions_agree_on_the_rayleigh_number(figure):
    """Ra = (dT L/eta)^2 of the ideal gas with g = dT/L, alpha = 1."""
    dT = khp("temperature-hot") - khp("temperature-cold")
    assert close((dT*khp(f"fig{figure}-height")/khp(f"fig{figure}-eta"))**2, khp(f"fig{figure}-ra"))


@pytest.mark.parametrize("ra", [5000, 10000])
def test_printed_errors_against_printed_energies(ra):
    ratio = khp(f"ke-{ra}-spam")/khp(f"ke-{ra}")
    for what, error in (("energy", 1 - ratio), ("velocity", 1 - np.sqrt(ratio))):
        assert error == pytest.approx(khp(f"derived-{what}-error-{ra}"), abs=5e-5)  # four decimals kept


# --- RR98 -------------------------------------------------------------------------------------------------


# --- other references -------------------------------------------------------------------------------------


def test_free_plates_are_analytic():
    ra, k = published("chandrasekhar-ra-free"), published("chandrasekhar-k-free")
    assert abs(ra.value - 27*np.pi**4/4) < ra.uncertainty
    assert abs(k.value - np.pi/np.sqrt(2)) < k.uncertainty


@pytest.mark.parametrize("ra", ["1e3", "1e4", "1e5", "1e6"])
def test_cavity_carries_the_same_heat_everywhere(ra):
    """Insulated top and bottom: wall, mid-plane and mean Nusselt numbers are one number."""
    mean = published(f"devahldavis-nu-{ra}")
    for where in ("middle", "wall"):
        other = published(f"devahldavis-nu-{where}-{ra}")
        assert abs(mean.value - other.value) < mean.uncertainty + other.uncertainty
    assert number(f"devahldavis-nu-min-{ra}") < mean.value < number(f"devahldavis-nu-max-{ra}")
