"""Fixed points between plates in 1D, 2D, 3D: edges to images, the compiled layer, adjointness, what plates keep, exact flows."""
from dataclasses import replace

import numpy as np
import pytest
from scipy import sparse
from scipy.linalg import expm
from test_layer import MADE, layer, shaken
from test_layer import rates as compiled

from continuum.fluid import ConstEta, ConstNu, IdealGas, PowerLaw, VanDerWaals
from particles.integral.dih import Nested, Pairwise
from particles.integral.dih_plates import DihPlates, Mixed
from particles.integral.edge_makers import MAKERS, renormalised
from particles.integral.edges import between_plates, mirror
from particles.integral.points import jittered, lattice
from particles.integral.triangulation import delaunay
from particles.weights import Lucy

COUNTS = {1: (12,), 3: (4, 5, 6)}
CUBE = {1: (12,), 3: (4, 4, 4)}           # where every column of an operator is wanted
RANGE = {1: 2.6, 3: 1.95}                 # below half of the narrowest side
CLOSE = [("renormalised", 0.0), ("closed", 0.2), ("exact", 0.2)]
SETS = [(d, maker, size) for d in COUNTS for maker, size in CLOSE]
ALL = pytest.mark.parametrize(("d", "maker", "size"), SETS)
TRANSPORT = {"pairwise": Pairwise(), "unmended": Pairwise(mended=False), "everywhere": Pairwise(everywhere=True),
             "nested": Nested(), "printed": Nested(differences=False), "mixed": Mixed(share=0.3)}


def made(d, maker, size, counts=None):
    """Points (n, d), edges among them and to their images."""
    counts = counts or COUNTS[d]
    at = jittered(counts, size, 1) if size else lattice(counts)
    x = at.x.copy()
    x[:, -1] = np.clip(x[:, -1], -counts[-1]/2 + 0.25, counts[-1]/2 - 0.25)
    return x, *between_plates(MAKERS[maker], x, counts[:-1], float(counts[-1]), Lucy.of(h=RANGE[d], d=d))


def plates(d, maker, size, transport="pairwise", counts=None, **more):
    x, edges, beyond = made(d, maker, size, counts)
    settings = {"eos": IdealGas(), "law": ConstEta(0.3, 0.4), "zeta": 0.1, "T_plates": (1.0, 1.0), **more}
    return DihPlates(x=x, edges=edges, beyond=beyond, transport=TRANSPORT[transport], **settings)


def crowd(fluid, seed=0):
    rng, (n, d) = np.random.default_rng(seed), fluid.x.shape
    return fluid.state(rng.uniform(0.9, 1.1, n), rng.normal(0, 0.2, (n, d)), rng.uniform(0.9, 1.1, n))


def rates(fluid, state):
    out = np.empty_like(state)
    fluid.rates(state, out)
    return out


def lost(fluid, state):
    """What all points gain of each conserved sum, over what it turns over."""
    found = rates(fluid, state)
    return np.abs(found@fluid.edges.V)/(np.abs(found)@fluid.edges.V)


# --- edges ----------------------------------------------------------------------------------------------------------------


def with_images(matrices, beyond, own, image):
    """Of each direction the matrix among points and S/2 times `own` at the point, `image` (d,) at the parent."""
    n = matrices[0].shape[0]
    return [M + sparse.csr_array((S/2*own, (beyond.i, beyond.i)), shape=(n, n))
            + sparse.csr_array((S/2*s, (beyond.i, beyond.parent)), shape=(n, n))
            for M, S, s in zip(matrices, beyond.S.T, image, strict=True)]


@ALL
def test_edges_close_with_those_to_images(d, maker, size):
    _, edges, beyond = made(d, maker, size)
    total = edges.closure.copy()
    np.add.at(total, beyond.i, beyond.S)
    assert np.abs(total).max() < 1e-12*np.abs(edges.S).max()       # measured 3e-15
    assert np.abs(edges.closure).max() > 0.1                        # it is the images that close them


@pytest.mark.parametrize(("d", "maker", "size"), [(d, *kind) for d in COUNTS for kind in (CLOSE[0], CLOSE[2])])
def test_edges_are_exact_on_linear_fields_that_go_on_beyond_plates(d, maker, size):
    """A field across a plate is odd about its value there: images at x_i + apart have that of the straight line."""
    x, edges, beyond = made(d, maker, size)
    total = edges.linear*edges.V[:, None, None]
    np.add.at(total, beyond.i, beyond.S[:, :, None]*beyond.apart[:, None, :]/2)
    assert np.abs(total/edges.V[:, None, None] - np.eye(d)).max() < 1e-10
    place = np.where(beyond.plate, 1, -1)*COUNTS[d][-1] - x[beyond.parent, -1]
    assert x[beyond.i, -1] + beyond.apart[:, -1] == pytest.approx(place, abs=1e-12)


@pytest.mark.parametrize("size", [0.0, 0.2])
@pytest.mark.parametrize("maker", [name for name in MAKERS if name != "delaunay"])
@pytest.mark.parametrize("d", COUNTS)
@pytest.mark.filterwarnings("ignore::particles.integral.interpolants.OrderingWarning")
def test_divergence_with_images_is_minus_the_adjoint_of_the_gradient(d, maker, size):
    """Of what is even: with m for the signs; of what is odd, as friction sees it: with -m. The other way round it is not."""
    _, edges, beyond = made(d, maker, size)
    unit = np.abs(edges.S).max()
    for sign in (1, -1):
        G = with_images(edges.G, beyond, -1, [sign]*d)
        right, wrong = (with_images(edges.D, beyond, 1, s*mirror(d)) for s in (sign, -sign))
        assert max(np.abs(D + g.T).max() for D, g in zip(right, G, strict=True)) < 1e-14*unit
        assert min(np.abs(D + g.T).max() for D, g in zip(wrong, G, strict=True)) > 0.1*unit


@pytest.mark.parametrize(("d", "width", "wanted"), [(1, 5.0, r"\(\)"), (2, (5.0, 5.0), "a positive number"),
                                                    (2, (), "a positive number"), (2, -5.0, "a positive number"),
                                                    (3, 5.0, "two positive numbers"), (3, (5.0, 0.0), "two positive numbers"),
                                                    (3, (5.0, np.nan), "two positive numbers")])
def test_a_box_of_other_dimensions_is_refused(d, width, wanted):
    with pytest.raises(ValueError, match=rf"wide, which must be {wanted} in {d}D: one for each axis along the plates"):
        between_plates(renormalised, lattice((5,)*d).x, width, 5.0, Lucy.of(h=2.0, d=d))


def test_points_without_an_axis_are_refused():
    with pytest.raises(ValueError, match=r"shape \(5,\), which must be \(n, d\).*x\[:, None\]"):
        between_plates(renormalised, np.arange(5.0), (), 5.0, Lucy.of(h=2.0, d=1))


@pytest.mark.parametrize(("d", "axis"), [(1, "x"), (3, "z")])
@pytest.mark.parametrize("at", [3.0, 2.5, -9.0, np.nan])
def test_points_that_are_not_between_plates_are_refused(d, axis, at):
    x = lattice((5,)*d).x.copy()
    x[3, -1] = at
    with pytest.raises(ValueError, match=rf"point 3 at {axis} = {at:g} is not between the plates {axis} = -\+2\.5 \(1 of {5**d}"):
        between_plates(renormalised, x, (5.0,)*(d - 1), 5.0, Lucy.of(h=2.0, d=d))


@pytest.mark.parametrize(("d", "why"), [(1, "no triangles in one dimension"), (3, "span a flat simplex")])
def test_triangles_between_plates_are_of_2d_only_and_say_why(d, why):
    x = jittered((5,)*d, 0.1, 1).x
    with pytest.raises(ValueError, match=why) as found:
        between_plates(delaunay, x, (5.0,)*(d - 1), 5.0, None)
    assert ("only a weight makes edges in 3D" in found.value.__notes__[0]) == (d == 3)
    assert f"point m + {5**d} that of point m" in found.value.__notes__[0]


# --- the compiled layer -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("transport", "settings", "law", "eos"), [
    ("pairwise", {}, ConstEta, IdealGas()), ("pairwise", {}, ConstNu, IdealGas()), ("pairwise", {}, PowerLaw, VanDerWaals()),
    ("unmended", {"mended": False}, ConstEta, VanDerWaals()), ("unmended", {"mended": False}, ConstNu, IdealGas()),
    ("nested", {"share": 0.0}, ConstEta, IdealGas()), ("nested", {"share": 0.0}, ConstEta, VanDerWaals()),
    ("mixed", {"share": 0.3}, ConstEta, IdealGas())])
@pytest.mark.parametrize(("make", "size", "h"), MADE)
def test_in_2d_it_is_the_compiled_layer(make, size, h, eos, transport, settings, law):
    """Under gravity, between plates that are not equally warm."""
    fluid, x, where = layer(make, size, h=h, eos=eos, transport=law)
    fluid = replace(fluid, **settings)
    twin = DihPlates(x=x, edges=fluid.edges, beyond=fluid.beyond, eos=eos, law=fluid.law, T_plates=fluid.T_plates, g=fluid.g,
                     transport=TRANSPORT[transport])
    state = shaken(fluid, x)
    assert where.g > 0 and fluid.T_plates[0] > fluid.T_plates[1]
    for one, other in zip(rates(twin, state), compiled(fluid, state), strict=True):
        assert np.abs(one - other).max() < 1e-12*np.abs(other).max()       # measured 4e-15


# --- what plates keep ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("transport", TRANSPORT)
@ALL
def test_plates_take_no_mass_and_at_rest_do_no_work(d, maker, size, transport):
    """With friction, of a viscosity that varies: energy stays where nothing conducts; momentum does not."""
    fluid = plates(d, maker, size, transport, law=PowerLaw(0.3, 0.0))
    mass, *momentum, energy = lost(fluid, crowd(fluid))
    assert max(mass, energy) < 1e-13                # sums of some hundred numbers that cancel
    assert max(momentum) > 1e-2


@pytest.mark.parametrize("transport", TRANSPORT)
@ALL
def test_plates_that_conduct_take_energy_unless_all_is_as_warm(d, maker, size, transport):
    """To second order in T - T_w: what is given is that of the mean temperature."""
    fluid = plates(d, maker, size, transport, law=ConstEta(0.0, 0.4), zeta=0.0)
    n = len(fluid.x)
    warm, level = (fluid.state(np.ones(n), np.zeros((n, d)), np.full(n, T)) for T in (1.1, 1.0))
    assert (rates(fluid, warm)@fluid.edges.V)[-1] < -1e-2
    assert np.abs(rates(fluid, level)).max() < 1e-13


@ALL
def test_without_friction_momentum_along_plates_and_energy_stay(d, maker, size):
    fluid = plates(d, maker, size, law=ConstEta(0.0, 0.0), zeta=0.0)
    mass, *along, across, energy = lost(fluid, crowd(fluid))
    assert max(mass, energy, *along) < 1e-13
    assert across > 1e-3


@pytest.mark.parametrize("transport", ["pairwise", "nested", "mixed"])
@pytest.mark.parametrize("d", COUNTS)
def test_the_motionless_state_stays_to_round_off(d, transport):
    """Linear T at density 1, gravity its slope: an exact solution of the discrete equations on a lattice, with images."""
    height, slope = COUNTS[d][-1], 0.05
    fluid = plates(d, "renormalised", 0.0, transport, g=slope, T_plates=(1 + slope*height/2, 1 - slope*height/2))
    state = fluid.state(np.ones(len(fluid.x)), 0*fluid.x, 1 - slope*fluid.x[:, -1])
    assert np.abs(rates(fluid, state)).max() < 1e-14       # sums of 50 pressures of 1
    assert np.abs(rates(replace(fluid, g=0.0), state)).max() > 0.9*slope


def jacobian(fluid, rest, columns, step=1e-6):
    """Of V times the rates, in some of the rows of the state, by central differences."""
    V, found = fluid.edges.V, []
    for row in columns:
        for i in range(rest.shape[1]):
            shift = np.zeros_like(rest)
            shift[row, i] = step
            found.append((V*(rates(fluid, rest + shift) - rates(fluid, rest - shift))/(2*step)).ravel())
    return np.stack(found, axis=1)


@pytest.mark.parametrize(("transport", "law"), [("pairwise", ConstEta(0.3, 0.4)), ("pairwise", PowerLaw(0.3, 0.4)),
                                                ("nested", ConstEta(0.3, 0.4)), ("mixed", ConstEta(0.3, 0.4))])
@ALL
def test_friction_and_conduction_are_symmetric_and_only_damp(d, maker, size, transport, law):
    """At rest forces are -K v, of random temperatures where viscosity varies, heating -C T: no negative eigenvalue."""
    fluid = plates(d, maker, size, transport, counts=CUBE[d], law=law)
    n, even = len(fluid.x), isinstance(law, ConstEta)
    T = np.ones(n) if even else np.random.default_rng(0).uniform(0.7, 1.3, n)
    rest = fluid.state(np.ones(n), np.zeros((n, d)), T)
    found = [jacobian(fluid, rest, range(1, d + 1))[n:(d + 1)*n]]       # convection is even in v
    if even:                             # a law of T makes conduction that of another variable
        found.append(jacobian(fluid, rest, [d + 1])[(d + 1)*n:])
    for M in found:
        assert np.abs(M - M.T).max() < 1e-8*np.abs(M).max()         # round-off over 1e-6
        values = np.linalg.eigvalsh(M + M.T)
        assert values.max() < -1e-8*values.min()


@ALL
def test_sound_between_plates_does_not_grow(d, maker, size):
    """Without friction the operator linearised about rest has no eigenvalue with a positive real part above round-off."""
    fluid = plates(d, maker, size, counts=CUBE[d], law=ConstEta(0.0, 0.0), zeta=0.0)
    n = len(fluid.x)
    rest = fluid.state(np.ones(n), np.zeros((n, d)), np.ones(n))
    found = np.linalg.eigvals(jacobian(fluid, rest, range(d + 2))/np.tile(fluid.edges.V, d + 2)[:, None])
    sound = np.sqrt(2)*fluid.fastest[0]
    assert np.abs(found.imag).max() == pytest.approx(sound, rel=1e-6)
    assert found.real.max() < 1e-4*sound       # differences over 1e-6: 1e-10; defective zeros of rest spread as its square root


# --- exact flows --------------------------------------------------------------------------------------------------------------


def warmed(rows, transport):
    """(found, exact) temperatures of a gas at 1 some time after plates 1D apart have become 1.5 and 0.5."""
    fluid = plates(1, "renormalised", 0.0, transport, counts=(rows,), T_plates=(1.5, 0.5))
    one, still = np.ones(rows), np.zeros((rows, 1))
    given = rates(fluid, fluid.state(one, still, one))[-1]
    M = np.stack([rates(fluid, fluid.state(one, still, one + unit))[-1] - given for unit in np.eye(rows)], axis=1)
    steady = one - np.linalg.solve(M, given)
    tau, s, k = 0.03, fluid.x[:, 0]/rows + 0.5, np.arange(1, 60)
    exact = 1.5 - s - np.sin(np.pi*np.outer(s, k))@((1 + (-1.0)**k)/(np.pi*k)*np.exp(-(np.pi*k)**2*tau))
    return steady + expm(M*tau*rows**2/0.4)@(one - steady), exact


@pytest.mark.parametrize("transport", ["pairwise", "mixed"])
def test_conduction_between_plates_follows_the_series_to_second_order(transport):
    errors = [np.abs(np.subtract(*warmed(rows, transport))).max() for rows in (12, 24, 48)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders == pytest.approx([2, 2], abs=0.2) and errors[-1] < 2e-3


def lattice_viscosity(fluid, at):
    """Of the flow u_x(z), by the edges of a point: 1/2 sum k (B + A e_x^2) z^2/V, which is eta if A = 0 or r^4 isotropic."""
    edges, eta, zeta = fluid.edges, 0.3, fluid.zeta
    B, A = eta*(1/2 + 1/3) - zeta/2, 5/2*(eta*(1 - 2/3) + zeta)
    met, r = (edges.i == at) | (edges.j == at), edges.apart
    return float((edges.k*(B + A*r[:, 0]**2/(r**2).sum(axis=1))*r[:, 2]**2/2)[met].sum()/edges.V[at])


def poiseuille(rows, transport, zeta):
    """(found, exact) steady velocities, layer by layer, of 4 x 4 x rows points that are pushed along the plates."""
    push, small, middle = 1e-3, 1e-3, rows//2
    fluid = plates(3, "renormalised", 0.0, transport, counts=(4, 4, rows), law=ConstEta(0.3, 0.0), zeta=zeta)
    layer_of, n = np.round(fluid.x[:, 2] + rows/2 - 0.5).astype(int), len(fluid.x)
    drag = np.empty((rows, rows))
    for column in range(rows):
        v = np.zeros((n, 3))
        v[layer_of == column, 0] = small
        found = rates(fluid, fluid.state(np.ones(n), v, np.ones(n)))[1]
        drag[:, column] = np.bincount(layer_of, found)/16/small
    along = lattice_viscosity(fluid, int(np.argmax(layer_of == middle)))
    eta = along if transport == "pairwise" else 0.3*along + 0.7*0.3
    z = np.arange(rows) + 0.5 - rows/2
    return np.linalg.solve(drag, -push*np.ones(rows)), push/(2*eta)*(rows**2/4 - z**2), eta


@pytest.mark.parametrize("zeta", [-0.1, 0.05])
@pytest.mark.parametrize("transport", ["pairwise", "mixed"])
def test_flow_that_is_pushed_along_plates_in_3d_is_the_parabola_to_second_order(transport, zeta):
    """Of the viscosity that the lattice has: eta if no force is along edges, zeta = -eta/3; else cubes are not isotropic."""
    errors = []
    for rows in (6, 12, 24):
        found, exact, eta = poiseuille(rows, transport, zeta)
        errors.append(np.abs(found - exact).max()/exact.max())
        assert (abs(eta - 0.3) < 1e-12) == (zeta == -0.1)
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders == pytest.approx([2, 2], abs=0.1) and errors[-1] < 0.007


# --- what is refused ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("change", "words"), [
    ({"x": np.zeros((12, 2))}, r"points \(12, 2\) .* do not belong to edges of \(n, d\) = \(12, 1\): take x, edges and"),
    ({"T_plates": (1.0, -1.0)}, r"two positive temperatures, of the lower and the upper plate, got \(1\.0, -1\.0\)"),
    ({"T_plates": (1.0, np.nan)}, "two positive temperatures"), ({"T_plates": 1.0}, r"two positive temperatures.*got 1\.0")])
def test_what_belongs_to_other_plates_is_refused(change, words):
    with pytest.raises(ValueError, match=words):
        replace(plates(1, "renormalised", 0.0), **change)


def test_images_of_another_dimension_are_refused():
    with pytest.raises(ValueError, match="do not belong to edges"):
        replace(plates(1, "renormalised", 0.0), beyond=made(3, "renormalised", 0.0)[2])


@pytest.mark.parametrize("share", [-0.1, 1.1, np.nan])
def test_a_share_that_is_none_is_refused(share):
    with pytest.raises(ValueError, match=rf"between 0 \(points\) and 1 \(edges\), got {share}"):
        Mixed(share=share)


def test_a_transport_without_images_is_refused():
    fluid = replace(plates(1, "renormalised", 0.0), transport=None)
    with pytest.raises(TypeError, match="no images are known for transport None: take Pairwise, Nested, Mixed"):
        rates(fluid, crowd(fluid))


def test_a_bulk_viscosity_that_edges_do_not_allow_is_refused():
    fluid = plates(3, "renormalised", 0.0, zeta=0.6)
    with pytest.raises(ValueError, match=r"bulk viscosity 0\.6 .* in 3 dimensions.*take nested"):
        rates(fluid, crowd(fluid))
