"""RR98's moving points, compiled: their slow twin, points that stay as their twin between plates, limits."""
from dataclasses import replace

import numpy as np
import pytest
from crowd import random_fields, rates

from continuum.fluid import ConstEta, ConstNu, IdealGas, PowerLaw, VanDerWaals
from continuum.scene import RayleighBenard
from particles.integral.dih import Pairwise
from particles.integral.drifts import DRIFTS, ConstantMassDrift, Powers
from particles.integral.edge_makers import plain
from particles.integral.edges import between_plates
from particles.integral.exchange import PRINTED
from particles.integral.interpolants import OrderingWarning
from particles.integral.layer import Layer, LayerSums
from particles.integral.points import jittered, lattice
from particles.integral.rr98_moving import Drift, scale_of
from particles.integral.rr98_moving_plain import MOTIONS
from particles.integral.transposed_stress import MENDED
from particles.integrators import RK4
from particles.limits import limit_of
from particles.run import Plan, run
from particles.smooth.spam import LessStatic
from particles.threads import Threads
from particles.walls.mirror import plates
from particles.walls.periodic import periodic
from particles.weights import WendlandC2
from studies.build.moving import DRIFT_MOTIONS, heat_of_pairs

COUNTS = COLUMNS, ROWS = 10, 8
WEIGHT = WendlandC2.of(h=2.9)
LAW = ConstEta(0.3, 0.2)
AT = jittered(COUNTS, 0.2, 3)
SCALE = scale_of(AT, WEIGHT)
#: row of the slow twin that each row of a state is
TWIN = [0, 1, 3, 4, 2, 5, 6]


def conserved(method, state):
    """Mass, momentum and energy of all points."""
    return state[[4, 2, 3, 5]]@(state[6]/method.owned(state[6]))


def drift(kind="literal", inside=False, **more):
    """Periodic both ways without gravity, or between plates under it."""
    ends = plates(ROWS, 1.5, 0.5) if inside else periodic(ROWS, 1)
    walls = (*ends, *periodic(COLUMNS)) if inside else (*periodic(COLUMNS), *ends)
    usual = {"motion": DRIFTS[kind], "walls": walls, "box": COUNTS, "weight": WEIGHT, "eos": IdealGas(),
             "law": LAW, "g": 0.02*inside, "scale": SCALE}
    return Drift(**usual | more)


def shaken(method, x=AT.x):
    """A state; volumes differ where they can change."""
    state = method.state(x, *random_fields(len(x)))
    if method.motion != DRIFTS["literal"]:
        state[6] *= np.random.default_rng(1).uniform(0.9, 1.1, len(x))
    return state


def inner(x):
    """Points that are between plates."""
    return np.stack([x[:, 0], np.clip(x[:, 1], -ROWS/2 + 0.2, ROWS/2 - 0.2)], axis=1)


def alike(found, expected):
    """Equal to round-off of 27 neighbours."""
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_allclose(one, other, rtol=0, atol=1e-13*max(1.0, np.abs(other).max()))


@pytest.mark.parametrize("mended", [False, True])
@pytest.mark.parametrize("law", [LAW, PowerLaw(0.3, 0.2, 0.5, 1.0)], ids=["const-eta", "power-law"])
@pytest.mark.parametrize(("kind", "eos", "more"), [
    *((kind, IdealGas(), {}) for kind in DRIFTS), ("constant-mass", VanDerWaals(), {}),
    *(("constant-mass", IdealGas(), {"bracket": Powers(a, b)}) for a, b in ((0, 0), (1, -1), (0.5, 1)))])
def test_compiled_sums_are_those_of_the_slow_twin(kind, eos, more, law, mended):
    motion = ConstantMassDrift(**more) if more else DRIFTS[kind]
    fast = drift(motion=motion, eos=eos, law=law, transport=MENDED if mended else PRINTED)
    slow = MOTIONS[kind](box=COUNTS, weight=WEIGHT, eos=eos, law=law, scale=SCALE,
                         transport=Pairwise(mended=mended), **more)
    state = shaken(fast)
    given = slow.state(AT.x, *random_fields(AT.n))
    given[TWIN] = state
    alike(rates(fast, state), rates(slow, given)[TWIN])
    assert fast.names == tuple(slow.names[row] for row in TWIN)
    np.testing.assert_allclose(conserved(fast, state)[[0, 3]], slow.conserved(given)[[0, 3]], rtol=1e-13)


@pytest.mark.parametrize("mended", [False, True])
@pytest.mark.parametrize(("law", "eos"), [
    (LAW, IdealGas()), (ConstNu(0.3, 0.2), IdealGas()), (PowerLaw(0.3, 0.2, 0.5, 1.0), VanDerWaals())])
def test_literal_points_between_plates_are_fixed_ones_that_are_moved(law, eos, mended):
    """Under gravity: rates are those of `Layer` on the edges that the points have at this moment."""
    x = inner(AT.x)
    edges, beyond = between_plates(plain, x, COLUMNS, ROWS, WEIGHT)
    scaled, images = (replace(q, S=SCALE*q.S, k=SCALE*q.k) for q in (edges, beyond))
    fixed = Layer(x=x, edges=scaled, beyond=images, eos=eos, law=law, T_plates=(1.5, 0.5), g=0.02,
                  transport=MENDED if mended else PRINTED, form=LayerSums)
    method = drift(inside=True, eos=eos, law=law, transport=fixed.transport)
    state = method.state(x, *random_fields(AT.n))
    found = rates(method, state)
    alike(found[[4, 2, 3, 5]], rates(fixed, state[[4, 2, 3, 5]]))
    np.testing.assert_allclose(found[:2], state[2:4]/state[4], rtol=1e-15)


@pytest.mark.parametrize("fraction", [0.0, 1.0])
def test_what_static_pressure_leaves_out_it_gives_back_in_the_continuum(fraction):
    """In a layer at rest on a lattice no force is left where pressure balances gravity."""
    at = lattice(COUNTS)
    method = drift("constant-mass", inside=True, static=LessStatic(fraction, 1.0), scale=scale_of(at, WEIGHT))
    out = rates(method, method.state(at.x, 1.0, 0*at.x, 1 - method.g*at.x[:, 1]))
    np.testing.assert_allclose(out[2:4, np.abs(at.x[:, 1]) < 1], 0, atol=1e-14)


def test_mass_between_plates_stays_in_literal_motion_and_leaks_in_convective():
    lost = {}
    for kind in ("literal", "convective", "constant-mass"):
        method = drift(kind, inside=True)
        state = shaken(method, inner(AT.x))
        done = run(method, state, Plan(dt=0.5*limit_of(method, state), steps=200))
        lost[kind] = abs(conserved(method, done.state)[0]/conserved(method, state)[0] - 1)
    assert max(lost["literal"], lost["constant-mass"]) < 1e-14 < 1e-5 < lost["convective"]


@pytest.mark.parametrize("kind", DRIFTS)
def test_steps_up_to_the_limit_are_stable_and_those_well_above_it_are_not(kind):
    """A lattice with small velocities, without friction: shear grows in short steps, too, and as much."""
    method = drift(kind, law=ConstEta(0.0, 0.0))
    x = lattice(COUNTS).x
    state = method.state(x, 1.0, np.random.default_rng(0).normal(0, 1e-6, x.shape), np.ones(len(x)))
    dt = limit_of(method, state)
    fastest = {}
    for of_limit in (0.25, 1.0, 2.5):
        sums, now = method.start(len(x), Threads(1)), state.copy()
        sums.around.relist(now, np.arange(len(x)), 0.0)
        stepper = RK4(now.shape, Threads(1))
        for _ in range(round(50/of_limit)):
            stepper.step(sums, now, of_limit*dt)
        fastest[of_limit] = np.abs(now[2:4]).max()
    assert fastest[1.0] < 1.1*fastest[0.25]
    assert not fastest[2.5] < 100*fastest[0.25]


def test_what_is_no_fluid_is_named():
    method = drift("constant-mass")
    state = shaken(method)
    sums = method.start(AT.n, Threads(1))
    state[6, 5] = -1.0
    assert "point 5 has V = -1" in sums.fault(state, np.arange(AT.n))
    with pytest.raises(ValueError, match="LiteralDrift needs the whole pressure"):
        drift(static=LessStatic(0.5, 1.0))


def test_a_weight_that_is_none_is_refused_and_a_narrow_one_told():
    with pytest.raises(ValueError, match=r"WendlandC2 of range h = 2\.9 has the integral 2 in 2 dim"):
        drift(weight=WEIGHT._replace(scale=2*WEIGHT.scale))
    method = drift(weight=WendlandC2.of(h=1.05), scale=1.0)
    with pytest.warns(OrderingWarning, match=r"below the spacing 1, the left side of Eq\. 45: gradients"):
        run(method, method.state(AT.x, *random_fields(AT.n)), Plan(dt=0.01, steps=1))


def test_heat_through_plates_is_conduction_where_temperature_is_linear():
    scene = RayleighBenard(ra=1e4, L=12.0)
    fluid, x = DRIFT_MOTIONS["moving-literal"].ready(scene).method, lattice((24, 12)).x
    sums, now = fluid.start(len(x), Threads(1)), fluid.state(x, 1.0, 0*x, scene.T(x[:, 1]))
    sums.around.relist(now, np.arange(len(x)), 0.0)
    sums.look_at(now)
    for side in (-1, 1):
        conducted = -side*scene.k*scene.dT/scene.L*scene.width
        assert heat_of_pairs(sums, now, side) == pytest.approx(conducted, rel=1e-12)
