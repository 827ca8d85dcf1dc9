"""LAMMPS on our scenes: its input, where particles are, what is read of them. Without LAMMPS."""
import re
from contextlib import nullcontext
from importlib.metadata import PackageNotFoundError

import numpy as np
import pytest

from bench import lammps_scenes, lammps_sph
from bench.lammps_flows import STYLES, Flow, placed, script
from bench.lammps_scenes import gradient, heat, keep, measured

LAYER = Flow(16, 32, 0.16, 4.0, 90.0, hot=1.5, cold=0.5, g=0.0625)


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("flow", [LAYER, LAYER._replace(hot=0.0, cold=0.0)])
def test_the_input_is_complete_and_has_the_numbers_of_the_flow(style, flow):
    before, after = script(flow, style)
    assert not re.search(r"[{}]", before + after)
    assert ("rheo/pressure" in after) == (style != "sph") == ("rheo/thermal" in before)
    assert ("addforce" in after) == bool(flow.hot)
    assert ("artificial" in after) == style.endswith("damped")
    viscosity = "1.0 4.0 0.16 3.0" if style == "sph" else "constant 0.16"
    assert viscosity in after and f"timestep {STYLES[style].step/4}" in after
    assert f"-16.0 16.0 {-11.0 if flow.hot else -8.0} " in before
    finer, step = script(flow._replace(a=0.5), style)
    assert "mass * 0.25" in finer and f"timestep {STYLES[style].step/16}" in step       # half the spacing


def test_particles_fill_the_box_and_frozen_rows_lie_behind_plates():
    x, kinds = placed(LAYER)
    assert np.bincount(kinds).tolist() == [0, 16*32, 3*32, 3*32]
    assert np.all(np.diff(kinds) >= 0)
    assert np.abs(x[kinds == 1, 1]).max() < 8
    for kind, side in ((2, -1), (3, 1)):
        rows, count = np.unique(x[kinds == kind, 1], return_counts=True)
        assert sorted(side*rows) == [8.5, 9.5, 10.5] and set(count) == {32}
    assert len(placed(LAYER._replace(hot=0.0))[0]) == 16*32


def test_heat_that_passes_is_exact_for_conduction_and_counts_what_flows():
    x, kinds = placed(LAYER)
    x = np.round(x[kinds == 1] - 0.5) + 0.5
    T = 1 - x[:, 1]/16
    rest = np.zeros_like(x)
    assert heat(x, rest, T, LAYER) == pytest.approx(1)
    rising = rest + [0, 0.1]*np.sign(T - 1)[:, None]
    assert heat(x, rising, T, LAYER) == pytest.approx(1 + 0.1*np.abs(T - 1).mean()*16/0.16)
    assert -gradient(x[:, 1], T, 16.0) == pytest.approx(1)


@pytest.mark.parametrize("message, kept", [("ERROR: Lost atoms: 4", True), ("ERROR: no pair", False)])
def test_lost_particles_are_a_row_and_other_errors_are_told(monkeypatch, message, kept):
    def broken(style, rows):
        raise Exception(message)        # as LAMMPS does
    monkeypatch.setitem(lammps_scenes.SCENES, "waves", broken)
    with nullcontext() if kept else pytest.raises(Exception, match="no pair"):
        row, = measured("waves", "sph", 16)
        assert row["quantity"] == "diverged" and np.isnan(row["value"])


def test_a_case_takes_the_place_of_its_older_rows(tmp_path, monkeypatch):
    monkeypatch.setattr(lammps_scenes, "FILE", tmp_path/"lammps.csv")
    case = {"scene": "waves", "style": "sph", "rows": 16, "value": 1.0, "err": 0.0, "expected": 1.0}
    keep([case | {"quantity": "diverged"}, case | {"rows": 25, "quantity": "viscosity"}])
    keep([case | {"quantity": "viscosity"}])
    table = lammps_scenes.read(tmp_path/"lammps.csv")
    assert list(zip(table.rows, table.quantity)) == [(16, "viscosity"), (25, "viscosity")]


@pytest.mark.parametrize("module, name, given, check, words", [
    (lammps_sph, "files", "missing", lammps_sph.find_mpi, r"`make bench` installs both"),
    (lammps_scenes, "version", "2026.1.1", lammps_scenes.check_version,
     r"2026\.1\.1 is installed, the table is of 2025.*: `make bench`")], ids=["missing", "other version"])
def test_a_missing_library_or_another_version_is_told_with_the_way_out(module, name, given, check, words,
                                                                       monkeypatch):
    def asked(package):
        if given == "missing":
            raise PackageNotFoundError(package)
        return given
    monkeypatch.setattr(module, name, asked)
    with pytest.raises(ImportError, match=words):
        check()
