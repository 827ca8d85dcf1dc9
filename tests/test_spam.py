"""The rates of SPAM in every variant: its slow twin, conservation, invariance, threads, refusals."""
from dataclasses import replace
from itertools import cycle
from typing import Any, NamedTuple

import numpy as np
import plain
import pytest
from crowd import crowd, everywhere, lattice, prepare, rates

from continuum.fluid import EQUATIONS_OF_STATE, ConstEta, ConstNu, DenseFluid, IdealGas, PowerLaw, VanDerWaals
from continuum.scene import RayleighBenard
from particles.smooth.corrected import AllCorrected, Corrected, Reversed, Symmetrised
from particles.smooth.meshless import AdiabaticMfm, Crksph, Mfm
from particles.smooth.riemann import LowDissipationSums
from particles.smooth.shifting import DeltaPlus
from particles.smooth.spam import LessStatic, Spam
from particles.smooth.sums import Direct, Nested
from particles.smooth.transport import TransportVelocity
from particles.terms import ArithmeticGradients
from particles.threads import Threads
from particles.walls.fixed import fixed_plates
from particles.walls.mirror import AtWall, Odd, plates, sides
from particles.walls.periodic import periodic
from particles.weights import WEIGHTS, Lucy, Monaghan, WendlandC2, WendlandC4, WendlandC6

BOX = (9.0, 8.0)
COLUMNS, ROWS = 11, 9
MASS = BOX[0]*BOX[1]/(COLUMNS*ROWS)  # neither the mass nor the spacing is 1
HOT, COLD = 1.2, 0.8
ETA, NU, POWER = ConstEta(0.4, 0.3), ConstNu(0.4, 0.3), PowerLaw(0.4, 0.3, 0.5, 0.5)
PERIODIC = periodic(BOX[0])


def closed(rule, own_pressure=False):
    """Four mirrors."""
    return sides(BOX[0], 1.0, -0.05, rule, own_pressure) + plates(BOX[1], HOT, COLD, rule, own_pressure)


class Setup(NamedTuple):
    weight: type
    eos: Any
    law: Any
    walls: tuple
    other: dict = {}  # noqa: RUF012


FIXED = fixed_plates(BOX[1], HOT, COLD)
# every printed weight, equation of state, law, wall, rule and variant at least twice, in different company
SETUPS = {
    "printed": Setup(Lucy, IdealGas(), ETA, PERIODIC + plates(BOX[1], HOT, COLD)),
    "odd, own": Setup(Monaghan, VanDerWaals(), NU, PERIODIC + plates(BOX[1], HOT, COLD, Odd(), True)),
    "four walls": Setup(WendlandC2, DenseFluid(), ETA, closed(AtWall(), True)),
    "four odd walls": Setup(WendlandC4, IdealGas(), NU, closed(Odd()),
                            {"gradients": ArithmeticGradients()}),
    "fixed": Setup(WendlandC6, VanDerWaals(), POWER, PERIODIC + FIXED),
    "fixed between mirrors": Setup(Lucy, DenseFluid(), NU, FIXED + sides(BOX[0], 1.0, -0.05, Odd(), True)),
    "no walls": Setup(WendlandC4, VanDerWaals(), POWER, everywhere(BOX)),
    "arithmetic": Setup(Lucy, IdealGas(), ETA, everywhere(BOX), {"gradients": ArithmeticGradients()}),
    "direct": Setup(Lucy, IdealGas(), ETA, PERIODIC + plates(BOX[1], HOT, COLD), {"transport": Direct}),
    "direct, less static": Setup(Monaghan, DenseFluid(), ETA, PERIODIC + FIXED,
                                   {"transport": Direct, "static": LessStatic(0.6, 1.2, 1.1)}),
    "sumB": Setup(WendlandC2, DenseFluid(), ETA, closed(Odd()), {"transport": Corrected}),
    "reverse": Setup(WendlandC2, IdealGas(), POWER, everywhere(BOX), {"transport": Reversed}),
    "symmetric": Setup(WendlandC4, IdealGas(), ETA, PERIODIC + plates(BOX[1], HOT, COLD, Odd(), True),
                       {"transport": Symmetrised}),
    "corrected": Setup(WendlandC2, VanDerWaals(), ETA, closed(Odd()), {"transport": AllCorrected}),
    "CRKSPH": Setup(WendlandC2, VanDerWaals(), NU, closed(Odd()), {"transport": Crksph}),
    "CRKSPH, periodic": Setup(Lucy, IdealGas(), ETA, everywhere(BOX), {"transport": Crksph}),
    "MFM": Setup(WendlandC2, DenseFluid(), NU, closed(Odd()), {"transport": Mfm}),
    "MFM, less static": Setup(WendlandC4, IdealGas(), ETA, PERIODIC + plates(BOX[1], HOT, COLD, Odd()),
                              {"transport": Mfm, "static": LessStatic(0.5, 1.2, 0.9)}),
    "MFM, adiabatic": Setup(WendlandC2, DenseFluid(), NU, closed(Odd()),
                            {"transport": AdiabaticMfm}),
    "riemann": Setup(WendlandC2, DenseFluid(), ETA, closed(Odd()),
                     {"transport": LowDissipationSums}),
    "less static": Setup(WendlandC6, VanDerWaals(), NU, closed(Odd(), True),
                         {"static": LessStatic(1.0, 1.2, 1.1)}),
}


def test_every_equation_of_state_has_a_setup():
    assert {type(s.eos) for s in SETUPS.values()} == {type(eos) for eos in EQUATIONS_OF_STATE.values()}


def method(setup: Setup, h=3.0) -> Spam:
    return Spam(weight=setup.weight.of(h=h), eos=setup.eos, law=setup.law, walls=setup.walls, box=BOX, g=0.05,
                m=MASS, **setup.other)


def state_of(spam, jitter=0.25):
    """Densities and masses scatter where they are rows of the state."""
    state, rng = crowd(BOX, COLUMNS, ROWS, spam.eos, jitter), np.random.default_rng(3)
    rho, m = rng.uniform(0.9, 1.1, (2, state.shape[1]))
    full = spam.transport.complete(state, rho, MASS)
    full[6:] *= m
    return full


def close(fast, slow):
    """Largest difference, relative to the largest value."""
    return abs(fast - slow).max()/abs(slow).max()


@pytest.mark.parametrize("name", SETUPS)
def test_equals_the_slow_twin(name):
    # both add about 30 terms a pair sum in double precision: round-off is 1e-15 of the largest term, and the
    # sums cancel to a few per cent of their terms
    spam = method(SETUPS[name])
    sums, state, _ = prepare(spam, crowd(BOX, COLUMNS, ROWS, spam.eos))
    out = np.empty_like(state)
    sums.rates(state, out)
    sums.gradients()
    slow, gradient = plain.rates(spam, state), sums.slopes.reshape(-1, 2, 4)[:, :, :3]
    assert close(sums.around.rho[:sums.around.rows], slow.rho) < 1e-12
    assert close(gradient[:, :, :2], slow.grad_v) < 1e-12
    assert close(gradient[:, :, 2], slow.grad_T) < 1e-12
    for fast, exact in zip(out, slow.out):
        assert close(fast, exact) < 1e-12


def free(weight=Lucy, eos=IdealGas(), law=ETA, **other) -> Spam:  # noqa: B008
    return Spam(weight=weight.of(h=3.0), eos=eos, law=law, walls=everywhere(BOX), box=BOX, m=MASS, **other)


COMPANY = [free(weight, eos, ETA) for weight,
           eos in zip(WEIGHTS.values(), cycle(EQUATIONS_OF_STATE.values()))]
COMPANY += [free(gradients=ArithmeticGradients()), free(transport=Direct),
            free(WendlandC2, VanDerWaals(), POWER)]
COMPANY += [free(WendlandC2, law=POWER, transport=kind)
            for kind in (AllCorrected, Corrected, Reversed, Symmetrised, Crksph, Mfm, AdiabaticMfm)]
COMPANY += [free(WendlandC2, transport=LowDissipationSums), free(transport=DeltaPlus)]
PUSHED = free(transport=TransportVelocity, static=LessStatic(0.0, 1.2, 0.0))
NAMED = {"ids": lambda s: " ".join([type(s.weight).__name__, type(s.eos).__name__, type(s.law).__name__,
                                    type(s.gradients).__name__, s.transport.__name__])}


@pytest.mark.parametrize("spam", [*COMPANY, PUSHED], **NAMED)
def test_mass_momentum_and_energy_are_exchanged_only(spam):
    # what one particle gains its partner loses: the sum over 99 particles of 30 terms each is round-off,
    # 1e-16 of the terms, which are ten times larger than the rates
    state = state_of(spam)
    _, _, ax, ay, heat, *more = rates(spam, state)
    m, gain = (state[6], more[1]) if more else (MASS, 0*heat)
    v2, power = (state[2]**2 + state[3]**2)/2, state[2]*ax + state[3]*ay + heat
    for rate in (m*ax + state[2]*gain, m*ay + state[3]*gain, m*power + (state[4] + v2)*gain, *more[1:]):
        assert abs(rate.sum()) < 1e-14*30*abs(rate).sum() and abs(rate).max() > 1e-3


def change_in_a_stream(spam, jitter=0.25):
    """How much the rates change when everything moves along, relative to the largest."""
    state = state_of(spam, jitter)
    moving = state.copy()
    moving[2:4] += np.array([[7.0], [-3.0]])
    return close(rates(spam, moving)[2:], rates(spam, state)[2:])


@pytest.mark.parametrize("spam", COMPANY, **NAMED)
def test_galilean_invariance(spam):
    assert change_in_a_stream(spam) < 1e-13     # velocities of 7 lose a digit in their differences


def test_galilean_invariance_of_a_transport_velocity_on_lattices_alone():
    assert change_in_a_stream(PUSHED, 0.0) < 1e-13 < 1e-2 < change_in_a_stream(PUSHED)


@pytest.mark.parametrize("side", [-4.5, 4.5, np.nextafter(-4.5, -5), np.nextafter(4.5, 5)])
def test_a_particle_on_the_seam_has_all_its_neighbours(side):
    state = crowd(BOX, COLUMNS, ROWS)
    state[0, 7] = side
    _, _, ax, ay, _ = rates(free(), state)
    assert abs(ax.sum()) < 1e-12 and abs(ay.sum()) < 1e-12  # a missing image costs its whole force, about 0.1


# 198 to 1001 rows: a thread is used from 64 rows on; odd numbers leave remainders to vector instructions
@pytest.mark.parametrize("columns, rows", [(18, 11), (25, 25), (77, 13)])
@pytest.mark.parametrize("kind", [Nested, Direct, DeltaPlus, TransportVelocity])
def test_threads_do_not_change_a_bit(columns, rows, kind):
    box, static = (float(columns), float(rows)), LessStatic(0.0, 1.2*(kind is TransportVelocity), 0.0)
    walls = periodic(box[0]) + plates(box[1], HOT, COLD, Odd())
    spam = Spam(weight=Lucy.of(h=3.0), eos=IdealGas(), law=ETA, walls=walls, box=box, g=0.05, transport=kind,
                static=static)
    state = kind.complete(crowd(box, columns, rows), 1.0, 1.0)
    one = rates(spam, state)
    for threads in (2, 3):
        assert (rates(spam, state, threads) == one).all()


def test_errors_name_value_rule_and_way_out():
    with pytest.raises(ValueError, match=r"no particles \(n = 0\)"):
        prepare(free(), np.empty((5, 0)))
    with pytest.raises(ValueError, match="skin of the neighbour list must be positive, got 0"):
        prepare(free(skin=0.0), crowd(BOX, 3, 3))
    with pytest.raises(ValueError, match=r"lacks a part of the stress where viscosity varies.*or Nested"):
        free(law=NU, transport=Direct)


def test_a_particle_whose_neighbours_lie_in_a_line_is_named():
    row = crowd(BOX, COLUMNS, ROWS)[:, :5]
    row[0], row[1] = np.arange(5) - 2.0, 1.0
    with pytest.raises(FloatingPointError, match=r"at \(-2, 1\) lie in a line with it.*take a wider weight"):
        rates(free(WendlandC2, transport=Corrected), row)


def test_walls_at_rest_do_no_work_on_a_riemann_problem():
    """What would heat a particle beside its images is P u*, and u* is the velocity of the wall."""
    spam = Spam(weight=WendlandC2.of(h=3.0), eos=IdealGas(), law=ConstEta(0.0, 0.0), box=(7.0, 8.0),
                transport=Mfm, walls=periodic(7.0) + plates(8.0, HOT, COLD, Odd()))
    x, y = (q.ravel() for q in np.meshgrid(np.arange(7) - 3.0, np.arange(8) - 3.5))
    state = np.array([x, y, 0*x, np.where(abs(y) > 3, 0.1*np.sign(y), 0.0), 1 + 0*x])
    out = rates(spam, state)
    assert abs((state[3]*out[3] + out[4]).sum()) < 1e-13


def test_pressure_heats_a_layer_at_rest_at_its_plates_in_printed_mfm_alone():
    """Images that copy P bend it at plates: Riemann problems there have a velocity v*, which carries heat."""
    scene = RayleighBenard(ra=1e4, L=12.0, aspect=1.0)
    spam = Spam(weight=WendlandC2.of(h=3.0), eos=IdealGas(), law=ConstEta(0.1, 0.0), g=scene.g,
                box=(12.0, 12.0), walls=periodic(12.0) + plates(12.0, scene.T_hot, scene.T_cold, Odd()))
    x = np.stack(lattice((12.0, 12.0), 12, 12), axis=1)
    state = spam.state(x, 1.0, 0*x, scene.fields(x)[2])
    printed, *others = (abs(rates(replace(spam, transport=kind), state)[4]).max()
                        for kind in (Mfm, AdiabaticMfm, Crksph))
    assert max(others) < 1e-13 and printed > 0.1*scene.k*scene.dT/scene.L


def test_mfm_refuses_images_that_do_not_copy_pressure():
    spam = free(transport=Mfm)
    with pytest.raises(ValueError, match=r"mirrored as images copy it: take own_pressure = False"):
        replace(spam, walls=closed(Odd(), True)).start(9, Threads(1))
