"""Published numbers: every file is complete, and what a paper prints must agree with itself."""
import csv
from dataclasses import FrozenInstanceError

import numpy as np
import pytest

from continuum import published as module
from continuum.published import names, published, table
from particles.weights import Lucy, Monaghan, value_and_slope

READINGS = {"text", "equation", "caption", "memory", "derived"}


def number(key: str) -> float:
    return published(key).value


def khp(key: str) -> float:
    return number("khp95-" + key)


@pytest.mark.parametrize("name", names())
class TestFile:
    def text(self, name):
        return (module.FOLDER / f"{name}.csv").read_text().splitlines()

    def test_head_says_paper_reading_uncertainty_misprints(self, name):
        head = "\n".join(line for line in self.text(name) if line.startswith("#"))
        assert all(f"# {word}:" in head for word in ("paper", "read", "uncertainty", "misprints"))

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


def test_every_id_is_found():
    for name in names():
        for row in table(name).itertuples():
            assert (published(row.id).value, published(row.id).source) == (row.value, row.source)


def test_wrong_id_names_the_like():
    with pytest.raises(ValueError, match=r"'khp95-ke-500'.*khp95-ke-5000"):
        published("khp95-ke-500")
    with pytest.raises(ValueError, match=r"'zzz'.*khp95"):
        published("zzz")
    with pytest.raises(ValueError, match=r"'nobody'.*khp95.*rr98"):
        table("nobody")


def test_numbers_cannot_be_changed():
    with pytest.raises(FrozenInstanceError):
        published("khp95-ke-5000").value = 0.0
    mine = table("khp95")
    mine["value"] = -1.0
    assert (table("khp95")["value"] != -1.0).iloc[0]


def test_printed_weights_are_those_that_run():
    r, h = np.linspace(0, 3, 7), khp("weight-range")
    lucy = khp("lucy-prefactor")*(1 + khp("lucy-slope")*r)*(1 - r/h)**khp("lucy-exponent")
    inner = khp("monaghan-prefactor-inner")*(1 + khp("monaghan-quadratic")*r**2 + khp("monaghan-cubic")*r**3)
    outer = khp("monaghan-prefactor-outer")*(1 - r/h)**khp("monaghan-exponent")
    spline = np.where(r < khp("monaghan-joint"), inner, outer)
    for kind, printed in ((Lucy, lucy), (Monaghan, spline)):
        assert [value_and_slope(kind.of(h), at)[0] for at in r] == pytest.approx(printed, abs=1e-11)


def test_what_a_paper_prints_agrees_with_itself():
    a, b = khp("vdw-a"), khp("vdw-b")
    pressure, slope = khp("dense-pressure"), khp("dense-p-du")*khp("dense-u-dtau")      # P, (dP/dT)_V
    derived = {
        "vdw-critical-density": 1/(3*b), "vdw-critical-temperature": 8*a/(27*b),
        "fig7-temperature": khp("temperature-mean")/khp("vdw-critical-temperature"),
        "fig7-density-maximum": khp("fig7-density")*b, "dense-p-const": pressure,
        "dense-maxwell-energy": -khp("dense-u-dn"),     # dV = -dn at n = 1
        "dense-maxwell-pressure": pressure - slope}
    # fractions such as 8/27 are kept with 12 figures
    assert {name: khp(name) for name in derived} == pytest.approx(derived, rel=1e-11)


@pytest.mark.parametrize("ra", [5000, 10000])
def test_printed_errors_against_printed_energies(ra):
    ratio = khp(f"ke-{ra}-spam")/khp(f"ke-{ra}")
    for what, error in (("energy", 1 - ratio), ("velocity", 1 - np.sqrt(ratio))):
        assert error == pytest.approx(khp(f"derived-{what}-error-{ra}"), abs=5e-5)  # four decimals kept


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
