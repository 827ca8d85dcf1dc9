"""Published numbers: every file is complete, and what a paper prints must agree with itself."""
import csv
from dataclasses import FrozenInstanceError

import numpy as np
import pytest
from scipy.integrate import quad

from continuum import published as module
from continuum.published import names, published, table

COLUMNS = ["id", "quantity", "symbol", "value", "uncertainty", "units", "source", "reading", "note"]
READINGS = {"text", "equation", "caption", "memory", "derived"}


def number(key: str) -> float:
    return published(key).value


def khp(key: str) -> float:
    return number("khp95-" + key)


def close(a: float, b: float) -> bool:
    """Equal to the 12 figures with which fractions such as 5/(9 pi) are kept in the files."""
    return a == pytest.approx(b, rel=1e-11)


# --- files ------------------------------------------------------------------------------------------------


def test_module_is_not_hidden_by_its_folder():
    assert module.__file__.endswith("published.py") and not (module.FOLDER / "__init__.py").exists()


@pytest.mark.parametrize("name", names())
class TestFile:
    def text(self, name):
        return (module.FOLDER / f"{name}.csv").read_text().splitlines()

    def test_head_says_paper_reading_uncertainty_misprints(self, name):
        head = "\n".join(line for line in self.text(name) if line.startswith("#"))
        assert all(f"# {word}:" in head for word in ("paper", "read", "uncertainty", "misprints"))

    def test_columns(self, name):
        assert list(table(name).columns) == COLUMNS

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


# --- look-up ----------------------------------------------------------------------------------------------


def test_every_id_is_found():
    for name in names():
        for row in table(name).itertuples():
            assert (published(row.id).value, published(row.id).source) == (row.value, row.source)


def test_wrong_id_names_the_like():
    with pytest.raises(ValueError, match=r"'khp95-ke-500'.*khp95-ke-5000"):
        published("khp95-ke-500")
    with pytest.raises(ValueError, match=r"'zzz'.*khp95.*table\("):
        published("zzz")


def test_wrong_table_names_the_known():
    with pytest.raises(ValueError, match=r"'nobody'.*khp95.*rr98"):
        table("nobody")


def test_numbers_cannot_be_changed():
    with pytest.raises(FrozenInstanceError):
        published("khp95-ke-5000").value = 0.0
    mine = table("khp95")
    mine["value"] = -1.0
    assert (table("khp95")["value"] != -1.0).iloc[0]


# --- KHP95 ------------------------------------------------------------------------------------------------


def lucy(r):
    return khp("lucy-prefactor")*(1 + khp("lucy-slope")*r)*(1 - r/khp("weight-range"))**khp("lucy-exponent")


def monaghan_inner(r):
    return khp("monaghan-prefactor-inner")*(1 + khp("monaghan-quadratic")*r**2 + khp("monaghan-cubic")*r**3)


def monaghan_outer(r):
    return khp("monaghan-prefactor-outer")*(1 - r/khp("weight-range"))**khp("monaghan-exponent")


def plane(w, start, end):
    """Integral of w over a ring of the plane."""
    return quad(lambda r: 2*np.pi*r*w(r), start, end)[0]


def test_printed_weights_are_normalised():
    joint, h, one = khp("monaghan-joint"), khp("weight-range"), khp("weight-integral")
    assert close(plane(lucy, 0, h), one)
    assert close(plane(monaghan_inner, 0, joint) + plane(monaghan_outer, joint, h), one)


def test_printed_monaghan_pieces_meet_with_two_derivatives():
    r, h, inner, outer = khp("monaghan-joint"), khp("weight-range"), *(
        khp(f"monaghan-prefactor-{piece}") for piece in ("inner", "outer"))
    a, b = khp("monaghan-quadratic"), khp("monaghan-cubic")
    left = np.array([1 + a*r**2 + b*r**3, 2*a*r + 3*b*r**2, 2*a + 6*b*r])
    right = np.array([(1 - r/h)**3, -3/h*(1 - r/h)**2, 6/h**2*(1 - r/h)])
    np.testing.assert_allclose(inner*left, outer*right, rtol=1e-10)     # 12 figures, less cancellation


def test_printed_lucy_bracket():
    bracket = lucy(khp("melting-distance")) - lucy(1.0)
    assert abs(bracket - khp("lucy-bracket")) < published("khp95-lucy-bracket").uncertainty


def test_van_der_waals_critical_point_follows_from_a_and_b():
    a, b = khp("vdw-a"), khp("vdw-b")
    assert close(khp("vdw-critical-density"), 1/(3*b))
    assert close(khp("vdw-critical-temperature"), 8*a/(27*b))
    assert close(khp("fig7-temperature"), khp("temperature-mean")/khp("vdw-critical-temperature"))
    assert close(khp("fig7-density-maximum"), khp("fig7-density")*b)


def test_dense_fluid_is_inconsistent_by_the_printed_numbers():
    pressure, slope = khp("dense-pressure"), khp("dense-p-du")*khp("dense-u-dtau")      # P, (dP/dT)_V
    assert close(khp("dense-p-const"), pressure)
    assert close(khp("dense-maxwell-energy"), -khp("dense-u-dn"))                       # dV = -dn at n = 1
    assert close(khp("dense-maxwell-pressure"), pressure - slope)


def test_pressure_over_sound_speed_does_not_single_out_the_dense_fluid():
    pressure = khp("dense-pressure")
    stiffness = pressure + khp("dense-p-dn") + pressure*khp("dense-p-du")       # dP/dn + (P/n^2) dP/du
    assert close(khp("derived-ratio-dense"), 2*pressure/stiffness)
    a, b = khp("vdw-a"), khp("vdw-b")
    room = 1 - b
    assert close(khp("derived-ratio-vdw"), 2*(1/room - a)/(1/room**2 - 2*a + 1/room**2))
    assert khp("derived-ratio-dense") < khp("derived-ratio-vdw") < khp("dense-pressure-ratio")


@pytest.mark.parametrize("figure", [2, 3, 4, 7, 9, 10, 12])
def test_boxes_hold_unit_density(figure):
    height, width = khp(f"fig{figure}-height"), khp(f"fig{figure}-width")
    assert khp(f"fig{figure}-particles") == khp("density")*height*width


@pytest.mark.parametrize("figure", [2, 3, 9, 12])
def test_captions_agree_on_the_rayleigh_number(figure):
    """Ra = (dT L/eta)^2 of the ideal gas with g = dT/L, alpha = 1."""
    dT = khp("temperature-hot") - khp("temperature-cold")
    assert close((dT*khp(f"fig{figure}-height")/khp(f"fig{figure}-eta"))**2, khp(f"fig{figure}-ra"))


def test_rayleigh_number_of_figure_10_has_unit_expansivity():
    dT = khp("fig10-temperature-hot") - khp("fig10-temperature-cold")
    ra = (dT*khp("fig10-height")/khp("fig10-eta-ideal"))**2
    assert abs(ra - khp("fig10-ra")) < published("khp95-fig10-ra").uncertainty
    assert abs(ra - khp("derived-ra-fig10")) <= published("khp95-derived-ra-fig10").uncertainty


@pytest.mark.parametrize("ra", [5000, 10000])
def test_printed_errors_against_printed_energies(ra):
    ratio = khp(f"ke-{ra}-spam")/khp(f"ke-{ra}")
    for what, error in (("energy", 1 - ratio), ("velocity", 1 - np.sqrt(ratio))):
        assert error == pytest.approx(khp(f"derived-{what}-error-{ra}"), abs=5e-5)  # four decimals kept


def test_printed_energies_do_not_bear_out_ten_per_cent():
    error = published("khp95-derived-energy-error-5000")
    assert error.value - error.uncertainty > khp("energy-error")


def test_derived_line_through_the_printed_energies():
    x = np.array([khp("ra-low"), khp("ra-high")])**khp("line-exponent")
    slope, start = np.polyfit(x, [khp("ke-5000"), khp("ke-10000")], 1)
    assert (-start/slope)**-2 == pytest.approx(khp("derived-ra-critical"), abs=0.5)    # an integer is kept
    onset = number("chandrasekhar-ra-rigid")**-0.5
    line = khp("ke-5000")*(onset - x[1])/(onset - x[0])
    assert line == pytest.approx(khp("derived-ke-10000-line"), abs=5e-6)            # five decimals kept


# --- RR98 -------------------------------------------------------------------------------------------------


def test_moments_of_the_exponential_weight():
    def moment(n):
        cubed, squared = number("rr98-exponential-cubed"), number("rr98-exponential-squared")
        weight = lambda r: number("rr98-exponential-prefactor")*(cubed/r**3 + squared/r**2)*np.exp(-r)  # noqa: E731
        return quad(lambda r: 4*np.pi*r**2*r**n*weight(r), 0, np.inf)[0]
    assert moment(1) == pytest.approx(number("rr98-moment-1"), rel=1e-8)                # of the quadrature
    assert moment(3) == pytest.approx(number("rr98-derived-moment-3"), rel=1e-8)


def test_leading_gradient_error():
    """1/6 of Taylor instead of the printed 1/2, times the three pairs of the isotropic tensor."""
    assert close(number("rr98-derived-gradient-error"), 3*number("rr98-moment-3-factor")/6)


# --- other references -------------------------------------------------------------------------------------


def test_free_plates_are_analytic():
    ra, k = published("chandrasekhar-ra-free"), published("chandrasekhar-k-free")
    assert abs(ra.value - 27*np.pi**4/4) < ra.uncertainty
    assert abs(k.value - np.pi/np.sqrt(2)) < k.uncertainty


def test_half_of_the_odd_mode_is_the_layer_with_one_free_plate():
    """Its mid-plane is a free plate, in a layer of half the height: Ra/2^4 and k/2."""
    for what, factor in (("ra", 16), ("k", 2)):
        half, odd = (published(f"chandrasekhar-{what}-rigid-{which}") for which in ("free", "odd"))
        assert abs(odd.value/factor - half.value) < half.uncertainty + odd.uncertainty/factor


def test_marginal_curve_has_its_minimum_at_the_critical_point():
    curve = [number(f"chandrasekhar-ra-rigid-{k}") for k in range(1, 9)]
    assert number("chandrasekhar-ra-rigid") < min(curve) == curve[2]


@pytest.mark.parametrize("ra", ["1e3", "1e4", "1e5", "1e6"])
def test_cavity_carries_the_same_heat_everywhere(ra):
    """Insulated top and bottom: wall, mid-plane and mean Nusselt numbers are one number."""
    mean = published(f"devahldavis-nu-{ra}")
    for where in ("middle", "wall"):
        other = published(f"devahldavis-nu-{where}-{ra}")
        assert abs(mean.value - other.value) < mean.uncertainty + other.uncertainty
    assert number(f"devahldavis-nu-min-{ra}") < mean.value < number(f"devahldavis-nu-max-{ra}")
