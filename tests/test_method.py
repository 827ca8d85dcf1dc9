"""What a method of one's own inherits, and how its longest step is found."""
from typing import NamedTuple

import numpy as np
import pytest
from strangers import Cells, Dicing, Heun, Unwritten

from continuum.fluid import conductivity, viscosity
from continuum.scene import RayleighBenard
from particles.integrators import Euler
from particles.limits import limit_of, outermost
from particles.method import Method, OwnRates, Stepping, Sums
from particles.run import Plan, run
from particles.threads import Threads
from studies.build import ready
from studies.build.scenes import TaylorGreen, Tile

VORTEX = TaylorGreen(L=8)


@pytest.mark.parametrize("kind", [Cells, Heun])
def test_a_class_of_ones_own_meets_the_contract(kind):
    method, start, dt = ready(VORTEX, kind)
    assert isinstance(method, Method)
    assert isinstance(method.start(start.shape[1], Threads(1)), Sums) and dt == 0.8*limit_of(method, start)
    assert not isinstance(VORTEX, Method) and not isinstance(method.eos, Sums)


def test_a_run_of_ones_own_goes_on_from_its_checkpoint(tmp_path):
    """Another object of the class in an equal scene is the same method."""
    method, start, dt = ready(VORTEX, Cells)
    plan = Plan(dt=dt, steps=32, checkpoint=tmp_path/"run.h5")

    def stop(part):
        raise KeyboardInterrupt
    with pytest.raises(KeyboardInterrupt):
        run(method, start, plan, progress=stop)
    again, whole = run(Cells(VORTEX), start, plan), run(method, start, Plan(dt=dt, steps=32))
    assert np.array_equal(again.state, whole.state)


def test_own_steps_are_taken_from_record_to_record(monkeypatch):
    taken = []
    monkeypatch.setattr(Heun, "advance", lambda self, state, dt, steps: taken.append(steps) or state)
    method, start, dt = ready(VORTEX, Heun)
    done = run(method, start, Plan(dt=dt, steps=11, every=4, series={"n": lambda sums, state: len(taken)}))
    assert taken == [4, 4, 3] and done.step == 11 and done.series["n"] == [1, 2]


@pytest.mark.parametrize("lacking, way_out", [
    (type("NoLimit", (Stepping,), {}), r"NoLimit has no limit\(start\)"),
    (type("OtherSteps", (Cells,), {"integrator": Euler}), r"OtherSteps is not known, .* its limit\(start\)"),
    (type("NoRates", (Cells,), {"rates": OwnRates.rates}), r"NoRates has no rates\(state, out\): write"),
    (Unwritten, "rates leave row 0 of out unwritten"),
    (type("Dice", (Dicing,), {"limit": property()}), "rates of Dice differ between two calls with one")])
def test_what_a_class_lacks_for_its_step_is_told_in_a_line(lacking, way_out):
    method = lacking(VORTEX)
    with pytest.raises((TypeError, ValueError, FloatingPointError), match=way_out):
        limit_of(method, Cells(VORTEX).state(*VORTEX.fields(Cells(VORTEX).x)))


def test_an_array_that_is_no_state_is_refused(monkeypatch):
    monkeypatch.setattr(Heun, "advance", lambda self, state, dt, steps: None)
    method, start, dt = ready(VORTEX, Heun)
    with pytest.raises(ValueError, match=r"advance of Heun gave an array \(\) for a state \(4, 64\): return"):
        run(method, start, Plan(dt=dt, steps=1))


def test_outer_eigenvalues_of_a_known_matrix():
    """Of 300 on a half circle, the fastest decay and the fastest oscillation to 2 %."""
    angle = np.linspace(0, np.pi/2, 150)
    decay, omega = np.cos(angle), np.sin(angle)

    def product(wave):
        a, b = wave.reshape(2, 150)
        return np.concatenate([-decay*a - omega*b, omega*a - decay*b])
    found = outermost(product, (300,), 40)
    assert found.real.min() == pytest.approx(-1, abs=0.02)
    assert np.abs(found.imag).max() == pytest.approx(1, abs=0.02)


class Bare(NamedTuple):
    """A law without formulas."""
    eta: float
    k: float


def test_a_law_is_told_all_formulas_that_it_lacks():
    told = r"Bare has no formula for viscosity and conductivity: add @viscosity.of\(Bare\), @conductivity"
    with pytest.raises(TypeError, match=told):
        ready(Tile(width=8, L=8, law=Bare(1.0, 1.0)), "grid")
    with pytest.raises(TypeError, match=told):
        RayleighBenard(ra=1e4, transport=Bare)
    half = type("Half", (Bare,), {})
    viscosity.of(half)(lambda law, rho, T: law.eta)
    with pytest.raises(TypeError, match="Half has no formula for conductivity: add"):
        ready(Tile(width=8, L=8, law=half(1.0, 1.0)), "grid")
    assert half not in conductivity.kinds
