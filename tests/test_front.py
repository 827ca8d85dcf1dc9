"""One call solves any scene with any method: numbers, fields, a picture, files, errors that help."""
import warnings
from dataclasses import replace

import h5py
import meshio
import numpy as np
import pytest

from continuum.domain import Domain
from continuum.scene import RayleighBenard
from continuum.sides import Periodic, Plate, Sliding, Slip
from studies.build import SCENES, ready
from studies.build.fixed import with_term
from studies.build.spam import PRINTED
from studies.front import compare, solve
from studies.front.__main__ import main
from studies.kit.stats import Measured

RB = "rayleigh-benard"


@pytest.fixture(scope="module")
def convection():
    """Lattice points in convection, long enough to be steady."""
    return solve(RB, "fixed-lattice", rows=12, time=150)


def test_numbers_have_errors_and_agree_with_the_history(convection):
    assert convection.K.value == pytest.approx(convection.history["K"].iloc[-1], rel=1e-3)
    assert 0 < convection.K.err < 0.01*convection.K.value
    # with errors of second order: 0.5 % with 50 rows (README) are 9 % with 12; Nu of the grid is 1.80
    assert convection.K.value == pytest.approx(0.00489, rel=0.1)
    assert convection.Nu.value == pytest.approx(1.80, rel=0.1)


@pytest.mark.parametrize("method", ["grid", "py-pde", "boussinesq", "spectral-gas"])
def test_references_agree_by_the_same_call(convection, method):
    done = solve(RB, method, rows=16)
    assert done.K.value == pytest.approx(convection.K.value, rel=0.1)
    at = done.fields()
    m = at.rho*at.V
    assert (m*(at.vx**2 + at.vy**2)).sum()/2/m.sum() == pytest.approx(done.K.value, rel=0.05)


def test_references_take_a_layer_made_of_sides_and_say_what_they_cannot():
    """The gas of the scene by name, side by side."""
    layer = RayleighBenard(ra=1e4, L=12.0)
    sides = {"left": Periodic(), "right": Periodic(), "bottom": Plate(T=1.5), "top": Plate(T=0.5)}
    by_hand = Domain(L=12.0, aspect=2.0, eta=layer.nu, k=layer.k, g=layer.g, **sides)
    for name in ("boussinesq", "py-pde", "spectral-gas"):
        assert solve(by_hand, name).K.value == pytest.approx(solve(layer, name).K.value, rel=1e-9)
    assert solve(by_hand, "linear-theory").numbers == solve(layer, "linear-theory").numbers
    with pytest.raises(ValueError, match=r"boussinesq takes a layer .*, not left = Plate\(.*\): take grid"):
        solve(replace(by_hand, left=Plate(), right=Plate()), "boussinesq")
    for odd in ({"bottom": Plate(T=0.5), "top": Plate(T=1.5)}, {"g": 0.0}):
        with pytest.raises(ValueError, match=r"not T_hot = [01]\.5, T_cold = [01]\.5, g = 0"):
            solve(replace(by_hand, **odd), "py-pde")


def test_linear_theory_knows_the_onset_and_says_what_it_does_not_know():
    done = solve(RB, "linear-theory", ra=2000.0)
    assert done["Ra_c"].value == pytest.approx(1707.9, abs=0.5) and done["growth"].value > 0
    with pytest.raises(AttributeError, match="linear-theory has no K in this scene; it has Ra_c, growth"):
        _ = done.K


@pytest.mark.parametrize("scene, method, least", [
    *((scene, "fixed-lattice", least) for scene, least in (("taylor-green", 1.7), ("sound", 1.5),
                                                           ("couette", 1.5), ("conduction", 1.4))),
    ("taylor-green", "fixed-lattice-entropy-stable", 1.7), ("taylor-green", "moving-delaunay", 1.6),
    ("taylor-green", "moving-delaunay-entropy-stable", 1.6)])
def test_errors_of_points_fall_with_second_order(scene, method, least):
    few, many = (solve(scene, method, rows=rows).error.value for rows in (16, 32))
    assert least < np.log2(few/many) < 2.6


@pytest.mark.parametrize("method", ["grid", "spam", "fixed-jittered-plates"])
def test_a_sliding_plate_pulls_the_fluid_along(method):
    """At rest the error is 1."""
    assert solve("couette", method, rows=16).error.value < 0.3


def test_a_shear_wave_grows_as_rayleigh_says():
    few, many = (abs(solve("shear-layer", "grid", rows=rows)["growth"].value - 1) for rows in (16, 32))
    assert many < few < 0.05


#: rows and time that differ from the others'
LARGER = {RB: (8, 1.0), "rayleigh-benard-box": (8, 1.0), "cavity": (16, 0.01), "shock-tube": (18, None)}


@pytest.mark.parametrize("scene", SCENES)
def test_every_scene_runs_on_the_grid_and_draws(scene, tmp_path):
    """By its name or as an object, whose rows are given anew."""
    rows, time = LARGER.get(scene, (8, None))
    done = solve(SCENES[scene]() if time is None else scene, "grid", rows=rows, time=time)
    done.plot(tmp_path/"flow.png")
    assert (tmp_path/"flow.png").stat().st_size > 5000 and len(done.history) > 1 and done.rows == rows


def test_a_variant_an_object_a_class_and_a_function_are_methods():
    """A class or function of the scene at several resolutions."""
    mine = PRINTED._replace(name="mine", h=2.5)
    assert solve(RB, mine, rows=8, time=1).method == "mine"

    def made(scene):
        return ready(scene, "fixed-lattice").method

    class Made:
        def __new__(cls, scene):
            return made(scene)
    done = compare("taylor-green", ["fixed-lattice", made, Made], rows=(8, 12)).solutions
    assert [one.method for one in done[2:]] == ["made", "made", "Made", "Made"]
    assert [one.K for one in done] == [one.K for one in done[:2]]*3
    vortex = SCENES["taylor-green"](8)
    assert solve(vortex, made(vortex)).K == done[0].K


def test_files_hold_what_the_solution_has(convection, tmp_path):
    with h5py.File(convection.save(tmp_path/"run.h5")) as file:
        assert file.attrs["K"] == convection.K.value
        assert np.array_equal(file["fields/T"], convection.fields()["T"])
    mesh = meshio.read(convection.save(tmp_path/"run.vtu"))
    assert np.array_equal(mesh.point_data["velocity"][:, 1], convection.fields()["vy"])
    with pytest.raises(ValueError, match=r"run.txt ends in .txt: give a name that ends in .h5 or .vtu"):
        convection.save(tmp_path/"run.txt")
    with pytest.raises(ValueError, match=r"a.pdf ends in .pdf: .* in .png, or .*savefig\('a.pdf'\)"):
        convection.plot(tmp_path/"a.pdf")
    assert not (tmp_path/"a.pdf").exists()


def test_an_interrupted_run_goes_on_bitwise(tmp_path, monkeypatch):
    def stop(bar, steps):
        if steps > bar.total/2:
            raise KeyboardInterrupt
    whole = solve(RB, "grid", rows=12, time=5)
    with monkeypatch.context() as half, pytest.raises(KeyboardInterrupt):
        half.setattr("studies.front.solving.tqdm.update", stop)
        solve(RB, "grid", rows=12, time=5, resume=tmp_path/"run.h5")
    again = solve(RB, "grid", rows=12, time=5, resume=tmp_path/"run.h5")
    assert again.K == whole.K and again.fields().equals(whole.fields())


def other_box():
    """Points of a layer, in another one."""
    method = ready(RayleighBenard(ra=1e4, L=8.0), "fixed-lattice").method
    solve(RayleighBenard(ra=1e4, L=12.0, aspect=4/3), method)


@pytest.mark.parametrize(("call", "words"), [
    (lambda: solve("rayleigh", "grid"), "no scene is called 'rayleigh'; near to it are rayleigh-benard"),
    (lambda: solve(RB, "fixed-latice"), "no method is called 'fixed-latice'; near to it are fixed-lattice"),
    (lambda: solve(RB, "xyz"), "no name of [0-9]+ is near to it; .* are grid, spam, .*; make words"),
    (lambda: solve(RB, "mac"), r"mac is used by a single study only, incompress.*usual ones are grid, spam"),
    (lambda: solve(RB, 3), "a method is a name, a variant, .*, got 3: make words lists"),
    (lambda: solve(3, "grid"), "a scene is a name or an object such as Domain.*, got 3: make words lists"),
    (lambda: solve(RB, "grid", rows=0), "rows must be a whole number of 4 or more, got 0"),
    (lambda: solve(RB, "grid", rows="8"), "rows must be a whole number of 4 or more, got '8'"),
    (lambda: solve(RB, "grid", seed=-1), "seed must be a whole number of 0 or more, got -1"),
    (lambda: solve(Domain(L=12, eta=0.1, k=0.1, top=Sliding(0.1)), "moving-delaunay"),
     r"cannot take top = Sliding\(v=0.1.*: take grid, spam$"),
    (lambda: solve(Domain(L=12, eta=0.1, k=0.1, top=Slip()), "moving-delaunay"), r"= Slip\(.*\): take grid"),
    (lambda: compare(RB, ["grid"], rows=8, ra=1e9, time=30).plot(), "every run diverged: there is nothing"),
    (lambda: solve(RB, "grid", time=-1), "time must be positive and finite, got -1"),
    (lambda: solve(RB, "grid", rows=8, dt=9.0), "limit [0-9.]+: take at most that, or leave dt out"),
    (lambda: solve(RB, "grid", rows=8, eos="vdw"), "got .vdw.: EQUATIONS_OF_STATE .* has ideal, vdw"),
    (other_box, "points of the method reach 15 x 7, the scene is 16 x 12"),
    (lambda: solve("sound", "boussinesq"), "boussinesq solves Rayleigh-Benard convection, not Sound"),
    (lambda: solve("sound", lambda scene: with_term(ready(scene, "spam").method, 0.0)),
     "Spam takes no float: pair terms are for methods with edges and images, which are fixed-lattice"),
    (lambda: solve("sound", lambda scene: with_term(ready(scene, "fixed-lattice").method, 0.0), rows=8),
     r"a formula is missing or does not fit in rate\(float64, point, point, Edge"),
    (lambda: solve(RB, "grid", Ra=1e4), r"nothing is called 'Ra'; near to it are ra\b"),
    (lambda: solve("taylor-green", "grid", ra=1e4),
     "nothing is called 'ra'; there are rows, mach, seed, time, dt, resume, progress$"),
    (lambda: compare("couette", [], rows=8), r"got methods \[\], rows 8; give one of each"),
    (lambda: compare("couette", ["grid"], row=8), "called 'row'; near to it are rows"),
    (lambda: solve(RayleighBenard(ra=1e4, L=8.0), "grid", prr=2.0), "called 'prr'; near to it are pr")])
def test_what_cannot_be_solved_is_refused_with_a_way_out(call, words):
    with pytest.raises((ValueError, TypeError), match=words):
        call()


def test_a_comparison_has_a_row_a_method_and_resolution_and_tells_what_diverged(tmp_path):
    wild = PRINTED._replace(name="wild", step=0.9, fraction=-60.0)
    done = compare("taylor-green", ["grid", "fixed-lattice", wild], rows=(8, 12))
    assert len(done.table) + len(done.diverged) == 6
    assert list(done.table.columns[:4]) == ["method", "rows", "K", "K_err"]
    done.plot(tmp_path/"all.png")
    assert (tmp_path/"all.png").stat().st_size > 10000


@pytest.mark.parametrize("value, err, words", [(0.0049912, 0.0000123, "0.004991(12)"), (1.8, 0.0, "1.8"),
                                               (1.236, 0.096, "1.24(10)"), (1234.5, 20.0, "1234(20)"),
                                               (1.23e-8, 4e-10, "1.23(4)e-8")])
def test_numbers_are_written_with_their_error_in_the_last_digit(value, err, words):
    assert str(Measured(value, err)) == words


@pytest.mark.parametrize("top, told", [(Plate(), True), (Plate(q=-0.01), False), (Plate(T=1.0), False)])
def test_heat_that_finds_no_way_out_is_told_before_the_run(top, told):
    scene = Domain(L=8, eta=0.1, k=0.1, bottom=Plate(q=0.01), top=top)
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        at = solve(scene, "grid", rows=16, time=0.1).at
    words = [str(one.message) for one in seen if "T will change by" in str(one.message)]
    assert bool(words) == told
    if told:        # an error of second order, 2.6 % with 16 rows
        rise = float(words[0].split("change by ")[1].split()[0])
        assert (at.rho*at.V)@at.T/(at.rho@at.V) - 1 == pytest.approx(rise, rel=0.03)


def test_the_command_prints_and_draws_and_takes_numbers_of_the_scene(tmp_path, capsys):
    out = ["--rows", "8", "--time", "1", "--out", str(tmp_path), "--numbers"]
    assert main([RB, "linear-theory", *out, "ra=5000", "pr=0.7"]) == 0
    growth = solve(RB, "linear-theory", rows=8, ra=5000, pr=0.7)["growth"]
    assert f"growth = {growth}" in capsys.readouterr().out
    assert (tmp_path/f"{RB}-linear-theory.png").exists()
    assert main([RB, "grid", *out, "Ra=5000"]) == 1 and "near to it are ra" in capsys.readouterr().err
    assert main([RB, "grid", *out, "transport=1"]) == 1 and "give ConstEta" in capsys.readouterr().err
    for wrong in ("ra", "ra=much", "rows=9"):
        with pytest.raises(SystemExit):
            main([RB, "grid", *out, wrong])
        assert f"'{wrong}' is no number of a scene: write them as ra=5000" in capsys.readouterr().err


def test_the_command_tells_in_a_line_why_it_ended(tmp_path, capsys, monkeypatch):
    def run(*words, out=tmp_path):
        return main([RB, *words, "--rows", "8", "--out", str(out)]), capsys.readouterr().err

    def stop(bar, steps):
        raise KeyboardInterrupt
    code, text = run("grid", "--numbers", "ra=1e9", "--time", "30")
    assert code == 1 and "or take more rows" in text and text.count("\n") == 1
    (tmp_path/"file").touch()
    code, text = run("grid", "--time", "1", out=tmp_path/"file")
    assert code == 1 and "rayleigh-benard-grid.png cannot be written (File exists) and is as it was" in text
    with monkeypatch.context() as stopped:
        stopped.setattr("studies.front.solving.tqdm.update", stop)
        code, text = run("grid", "--time", "5")
        kept, = tmp_path.glob("*.h5")
        assert code == 130 and text == f"interrupted: the same command goes on from {kept}\n"
        code, text = run("grid", "fixed-lattice", "--time", "5")
        assert code == 130 and text == "interrupted: the same command starts anew, nothing is kept\n"
    assert run("grid", "--time", "6")[0] == 0 and kept.exists()       # another run has a file of its own
    assert run("grid", "--time", "5")[0] == 0 and not kept.exists()
