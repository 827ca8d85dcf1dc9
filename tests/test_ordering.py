"""The study ordering: waves on lattices, vortices and layers as cases, points without edges."""
import numpy as np
import pytest

from particles.integral.edge_makers import delaunay, plain, renormalised
from particles.integral.interpolants import W
from particles.integral.points import lattice, of_positions, wrapped
from particles.weights import WEIGHTS, Lucy
from studies.build.setting import DISORDERS
from studies.ordering.runs import (
    FORMS,
    OperatorErrors,
    VortexDecay,
    between_images,
    convection,
    form_error,
    form_errors,
)


def row_of(case, folder=None):
    """The row of a case."""
    (row,), = case.run(lambda done: None, folder).rows.values()
    return row


def refused(points, weight):
    raise ArithmeticError("no such edges")


@pytest.mark.parametrize("weight", WEIGHTS.values())
def test_the_error_of_a_lattice_is_its_symbol_and_of_second_order(weight):
    """grad sin kx = (sum over the lattice) cos kx: the error is that of the wave number that edges see."""
    errors = []
    for size in (32, 64):
        at, k = lattice((size, 16)), 2*np.pi/size
        edges, wave = renormalised(at, weight.of(h=3.0)), np.exp(1j*k*at.x[:, 0])
        symbol = float((edges.areas[0]@wave/wave/2).imag.mean()/edges.V[0])
        gradient = form_error(edges, edges.G, at.x[:, 0], k)
        assert gradient == pytest.approx(abs(symbol/k - 1), rel=1e-8)
        errors.append(gradient)
    assert np.log2(errors[0]/errors[1]) == pytest.approx(2, abs=0.05)       # (k h)^4 takes 0.01 to 0.02


def test_forms_of_the_gradient_differ_by_what_they_make_of_a_constant():
    """On a lattice, where the sum over e_ij is zero, all are one; by hand for points on a line."""
    at, k = lattice((32, 16)), 2*np.pi/32
    edges = plain(at, Lucy.of(h=3.0))
    error = form_error(edges, edges.G, at.x[:, 0], k)
    assert form_errors(edges, at.x[:, 0], k) == pytest.approx([error]*3)

    shift = np.where(np.arange(16) % 2, 0.2, 0.0)        # neighbours on a line at 1.2 and 0.8
    uneven = of_positions(wrapped(lattice((16,)).x + shift[:, None], np.array([16.0])), (16.0,))
    near, x, k = Lucy.of(h=1.5, d=1), uneven.x[:, 0], np.pi/8
    right, left = np.where(shift > 0, 0.8, 1.2), np.where(shift > 0, 1.2, 0.8)
    errors = dict(zip(FORMS, form_errors(plain(uneven, near), x, k)))
    for form, own in (("single", 0), ("sum", 1), ("difference", -1)):
        squares = []
        for phase in (0.0, np.pi/2):
            here, after, before = (np.sin(k*y + phase) for y in (x, x + right, x - left))
            slope = W(near, right)*(after + own*here) - W(near, left)*(before + own*here)
            squares.append(np.mean((slope/k - np.cos(k*x + phase))**2))
        assert errors[form] == pytest.approx(np.sqrt(sum(squares)), rel=1e-9)
    assert errors["sum"] > 2*errors["difference"]


def test_triangles_stay_where_the_bracket_of_weights_diverges():
    lost, kept = (row_of(VortexDecay(maker=maker, h=h, points=DISORDERS["random"], wavelength=16, mach=0.3))
                  for maker, h in ((plain, 3.0), (delaunay, 0.0)))
    assert np.isnan([lost["velocity"], lost["exchanges"]]).all()
    assert kept["velocity"] < 0.15 and kept["exchanges"] > 0


@pytest.mark.parametrize(("case", "columns"), [
    *((kind(maker=refused, h=3.0, points=DISORDERS["random"], wavelength=8), [column])
      for kind, column in ((OperatorErrors, "gradient"), (VortexDecay, "velocity"))),
    (convection("jittered-0.3", between_images("jittered-0.3", "exact", 2.0)._replace(make=refused), 8),
     ["ke", "exchanges"])])
def test_points_without_such_edges_leave_a_row_without_numbers(case, columns, tmp_path):
    assert np.isnan([row_of(case, tmp_path)[column] for column in columns]).all()
