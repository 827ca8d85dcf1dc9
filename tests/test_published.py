"""Published numbers: every file is complete, and what a paper prints must agree with itself."""
import csv

import numpy as np
import pytest

from continuum import published as module
from continuum.published import names, published, table

READINGS = {"text", "equation", "caption", "memory", "derived"}


def khp(key: str) -> float:
    return published("khp95-" + key).value


def text(name: str) -> list[str]:
    return (module.FOLDER / f"{name}.csv").read_text().splitlines()


@pytest.mark.parametrize("name", names())
class TestFile:
    def test_head_says_paper_reading_uncertainty_misprints(self, name):
        head = "\n".join(line for line in text(name) if line.startswith("#"))
        assert all(f"# {word}:" in head for word in ("paper", "read", "uncertainty", "misprints"))

    def test_every_row_is_complete(self, name):
        rows = table(name)
        assert rows["id"].is_unique and rows["id"].str.startswith(f"{name}-").all()
        assert np.isfinite(rows["value"]).all() and (rows["uncertainty"] >= 0).all()
        assert (rows[["quantity", "units", "source"]] != "").all(axis=None)
        assert set(rows["reading"]) <= READINGS
        assert (rows.loc[rows["reading"] == "derived", "note"] != "").all()     # a derivation is told

    def test_uncertainty_covers_the_rounding(self, name):
        for row in csv.DictReader(line for line in text(name) if not line.startswith("#")):
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
    for ra in (5000, 10000):
        ratio = khp(f"ke-{ra}-spam")/khp(f"ke-{ra}")
        errors = khp(f"derived-energy-error-{ra}"), khp(f"derived-velocity-error-{ra}")
        assert errors == pytest.approx((1 - ratio, 1 - np.sqrt(ratio)), abs=5e-5)       # of four decimals
    # fractions such as 8/27 are kept with 12 figures
    assert {name: khp(name) for name in derived} == pytest.approx(derived, rel=1e-11)
