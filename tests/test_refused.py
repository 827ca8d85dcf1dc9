"""What the public constructors take is a fluid, a box, points: all else is refused where it is given."""
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from continuum.fluid import IdealGas
from continuum.scene import RayleighBenard
from particles.dissipative.dpd import Dpd
from particles.integral.bodies import held
from particles.integral.points import lattice, of_positions
from particles.plan import Plan
from particles.run import run
from particles.smooth.spam import Spam
from particles.threads import Threads
from particles.walls.mirror import plates, sides
from particles.weights import Lucy
from studies.build import ready
from studies.build.spam import PRINTED, images

SCENE, PLAN = RayleighBenard(ra=5000.0, L=8.0), Plan(dt=0.1, steps=1)
METHOD, START, _ = ready(SCENE, PRINTED)
PLACES = np.random.default_rng(1).uniform(-2, 2, (8, 2))
WEIRD = st.floats(-1e100, 1e100) | st.sampled_from([
    np.nan, np.inf, "1", None, 1j, True, np.ma.masked, (), [1.0], IdealGas])
MADE = {
    "weight": lambda a, b: (w := Lucy.of(a)) and (w.h, w.scale),
    "mass": lambda a, b: vars(replace(METHOD, m=a, g=b)),
    "box": lambda a, b: vars(Spam(weight=Lucy.of(3.0), eos=IdealGas(), law=METHOD.law, walls=(), box=(a, b))),
    "held": lambda a, b: held([1], T=2.0, v=(a, 0.0), heat=b),
    "points": lambda a, b: of_positions(PLACES, (a, b)).box, "lattice": lambda a, b: lattice((4, 4), a).box,
    "dpd": lambda a, b: vars(Dpd(box=(8.0, 8.0), a=a, gamma=b)), "dpd box": lambda a, b: Dpd(box=(a, b)).box,
    "plan": lambda a, b: vars(Plan(dt=a, steps=1, checkpoint_seconds=3.0)), "threads": lambda a, b: (
        Threads(a if isinstance(a, float) else -1).number,)}


@pytest.mark.parametrize("make", MADE.values(), ids=MADE)
@settings(max_examples=40, deadline=None)
@given(a=WEIRD, b=WEIRD)
def test_what_is_made_of_any_numbers_is_refused_in_words_or_has_finite_ones(make, a, b):
    try:
        made = make(a, b)
    except (TypeError, ValueError, MemoryError) as error:
        assert len(str(error)) > 20
        return
    values = made.values() if isinstance(made, dict) else made
    numbers = [np.asarray(one) for one in values if isinstance(one, int | float | np.ndarray)]
    assert numbers and all(np.isfinite(one).all() for one in numbers)


@pytest.mark.parametrize(("make", "words"), [
    (lambda: replace(METHOD, weight=Lucy.of(1e6)), r"2 h = 2e\+06 is wider than the box 16 x 8"),
    (lambda: replace(METHOD, box=(16.0, 8.0, 8.0)), r"\(width, height\), both positive and finite"),
    (lambda: run(replace(METHOD, walls=()), START + np.full((5, 1), 1e6), PLAN), "beyond a wall of the box"),
    (lambda: replace(METHOD, walls=plates(8.0, np.nan, 1.0)), "temperature of Mirror.* must be positive"),
    (lambda: replace(METHOD, walls=sides(16.0, -1.0, 0.0)), "temperature of Mirror.* must be positive"),
    (lambda: ready(SCENE, PRINTED._replace(walls=lambda scene: images(scene)[1:])), "walls of printed are 3"),
    (lambda: ready(SCENE, PRINTED, x=START[:2, ::2].T, fields=(1.0, START[2:4, ::2].T, 1.0)),
     "64 particles of unit mass fill 64 of a box of 128"),
    (lambda: held([[0, 1]]), "named by whole numbers"), (lambda: held([0], T=np.inf), "T = inf: give"),
    (lambda: of_positions(PLACES, (np.inf, 4.0)), "box of points must be finite"),
    (lambda: of_positions(PLACES[0], (4.0, 4.0)), "need points"),
    (lambda: lattice((3.5, 4)), r"whole numbers of points along its axes, got \(3\.5, 4\)"),
    (lambda: Dpd(box=(np.inf, 4.0)), "needs two or three sides")])
def test_what_ran_without_a_word_is_refused(make, words):
    with pytest.raises(ValueError, match=words):
        make()


@pytest.mark.parametrize("kind", [complex, bool, str, np.ma.MaskedArray])
def test_places_that_are_no_plain_numbers_are_refused(kind):
    with pytest.raises(TypeError, match="give real ones, without a mask"):
        of_positions(kind(PLACES) if kind is np.ma.MaskedArray else PLACES.astype(kind), (4.0, 4.0))
