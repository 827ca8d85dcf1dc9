"""Published numbers: every file is complete, and what a paper prints must agree with itself."""
import csv

import numpy as np
import pytest

from continuum import published as module
from continuum.published import names, published, table

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


def test_wrong_id_names_the_like():
    with pytest.raises(ValueError, match=r"'khp95-ke-500'.*khp95-ke-5000"):
        published("khp95-ke-500")
    with pytest.raises(ValueError, match=r"'zzz'.*khp95"):
        published("zzz")
    with pytest.raises(ValueError, match=r"'nobody'.*khp95.*rr98"):
        table("nobody")


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


@pytest.mark.parametrize("key, reference", [
    ("nu-1e3", 1.118), ("nu-1e4", 2.243), ("nu-1e6", 8.806), ("before-1e3", 1.117), ("before-1e5", 4.504),
    ("before-1e6", 8.767)])
def test_printed_errors_of_ethersph_are_those_from_a_printed_reference(key, reference):
    error = 100*abs(number(f"ethersph-{key}")/reference - 1)
    assert error == pytest.approx(number(f"ethersph-error-{key}"), abs=5e-4)    # of three decimals
