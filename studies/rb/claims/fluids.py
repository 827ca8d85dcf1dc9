"""Claims about the three equations of state, gravity and the Prandtl number: arithmetic with `continuum.fluid`."""
import numpy as np

from continuum.fluid import (
    EQUATIONS_OF_STATE,
    DenseFluid,
    IdealGas,
    VanDerWaals,
    energy,
    expansivity,
    pressure,
    sound_speed,
    temperature,
    thermal_pressure,
)
from continuum.scene import RayleighBenard
from studies.build.read import exact
from studies.kit.claim import Claim
from studies.rb.claims.printed import as_printed, number

IDEAL, VDW, DENSE = IdealGas(), VanDerWaals(), DenseFluid()


def at_reference(eos) -> tuple[float, float]:
    """(P, rho c^2) at density and temperature 1."""
    e = energy(eos, 1.0, 1.0)
    return float(pressure(eos, 1.0, e)), float(sound_speed(eos, 1.0, e)**2)


def stiffness(eos) -> float:
    """2 P/(rho c^2) at density and temperature 1."""
    P, rho_c2 = at_reference(eos)
    return 2*P/rho_c2


def heat_capacity(eos) -> float:
    """C_P = C_V + T alpha (dP/dT)_rho/rho at density and temperature 1."""
    return eos.cv + expansivity(eos, 1.0, 1.0)*float(thermal_pressure(eos, 1.0, 1.0))


def imbalance(eos) -> float:
    """Largest |P(y) + rho g y - P(0)| over P(0) in the motionless state."""
    scene = RayleighBenard(ra=1e4, eos=eos)
    y = np.linspace(-0.5, 0.5, 101)*scene.L
    total = pressure(eos, 1.0, scene.e(y)) + scene.g*y
    return float(np.ptp(total)/total.mean())


def energy_by_volume() -> float:
    """(dE/dV)_T = -rho^2 (de/drho)_T of the dense fluid; e is quadratic, so that wide differences are exact."""
    return -float(energy(DENSE, 1.5, 1.0) - energy(DENSE, 0.5, 1.0))


def wall_mismatch() -> float:
    """Largest |T(1, u(1, T)) - T| between the plates."""
    T = np.linspace(0.5, 1.5, 11)
    return float(np.max(np.abs(temperature(DENSE, 1.0, energy(DENSE, 1.0, T)) - T)))


def critical_slopes() -> float:
    """Largest of dP/drho and d2P/drho2 along the printed critical isotherm at the printed critical density."""
    rho, T, step = number("vdw-critical-density"), number("vdw-critical-temperature"), 1e-4
    P = [pressure(VDW, r, energy(VDW, r, T)) for r in (rho - step, rho, rho + step)]
    return float(max(abs(P[2] - P[0])/(2*step), abs(P[2] - 2*P[1] + P[0])/step**2))


CLAIMS = (
    Claim(id="khp95-isentrope", source="KHP95 Sec. III", printed="P ~ rho^2",
          statement="P ~ rho^2 is the isentrope of the two-dimensional ideal gas: exponent rho c^2/P",
          value=exact(lambda: 2/stiffness(IDEAL)), expect=2, within=1e-12, because="round-off"),
    Claim(id="khp95-vdw-critical-density", source="KHP95 Sec. IV", printed="2/3",
          statement="critical density of the van der Waals fluid, 1/(3 b)", value=exact(lambda: 1/(3*VDW.b)),
          expect=2/3, within=1e-12, because="round-off"),
    Claim(id="khp95-vdw-critical-temperature", source="KHP95 Sec. IV", printed="8/27",
          statement="critical temperature of the van der Waals fluid, 8 a/(27 b)",
          value=exact(lambda: 8*VDW.a/(27*VDW.b)), expect=8/27, within=1e-12, because="round-off"),
    Claim(id="khp95-vdw-critical-point", source="KHP95 Sec. IV, Eq. 2", printed="2/3, 8/27",
          statement="slope and curvature of Eq. 2 along its isotherm vanish there", value=exact(critical_slopes),
          at_most=1e-6, because="differences over 1e-4: truncation and round-off are 1e-8"),
    Claim(id="khp95-vdw-density-reference", source="KHP95 Fig. 7", printed="half",
          statement="n sigma^2 = 1 is half the maximum density of the van der Waals fluid", value=exact(lambda: VDW.b),
          expect=0.5, within=1e-12, because="exact numbers"),
    Claim(id="khp95-vdw-temperature-reference", source="KHP95 Fig. 7", printed="27/8",
          statement="T = 1 is 27/8 of the critical temperature of the van der Waals fluid",
          value=exact(lambda: 27*VDW.b/(8*VDW.a)), expect=27/8, within=1e-12, because="round-off"),
    Claim(id="khp95-static-density", source="KHP95 Sec. IV", printed="g = kB dT/L",
          statement="the printed gravity keeps the motionless density exactly constant, for all three equations of "
                    "state; largest imbalance of forces", at_most=1e-12, because="round-off",
          value=exact(lambda: max(imbalance(eos) for eos in EQUATIONS_OF_STATE.values()))),
    Claim(id="khp95-gravity-ideal", source="KHP95 Sec. IV", printed="kB dT/L",
          statement="(dP/dT)_rho dT/(rho L) is dT/L for the ideal gas: g L/dT",
          value=exact(lambda: 50*RayleighBenard(ra=1e4).g), expect=1, within=1e-12, because="round-off"),
    Claim(id="khp95-prandtl", source="KHP95 Sec. IV", printed="unity",
          statement="equal coefficients eta = k mean Pr = 1, with C_V: ideal gas and van der Waals",
          value=exact(lambda: max(abs(eos.cv - 1) for eos in (IDEAL, VDW))), at_most=1e-12,
          because="exact: Pr = eta C_V/k = C_V"),
    Claim(id="khp95-prandtl-dense", source="KHP95 Sec. IV", printed="unity", expect=1, within=0.05,
          statement='"in every case": eta = k means Pr = 1 with C_V for the dense fluid, too',
          value=exact(lambda: DENSE.cv), because="one digit is printed, in words; C_V = 1.5 by Eq. 3"),
    Claim(id="khp95-prandtl-isobaric", source="KHP95 Sec. IV", printed="unity", expect=1, within=0.05,
          statement="eta = k means Pr = 1 for the ideal gas by the usual definition, with C_P",
          value=exact(lambda: heat_capacity(IDEAL)),
          because="one digit is printed, in words; the paper takes C_V, in which flow at constant pressure has no "
                  "part"),
    Claim(id="khp95-dense-maxwell-energy", source="KHP95 Sec. IV", printed="-1.5",
          statement="(dE/dV)_T of the dense fluid at its reference state", value=exact(energy_by_volume), expect=-1.5,
          within=1e-12, because="round-off"),
    Claim(id="khp95-dense-maxwell-pressure", source="KHP95 Sec. IV", printed="1.25",
          statement="d(beta P)/d(beta) at constant V of the dense fluid at its reference state: P - T (dP/dT)_rho",
          value=exact(lambda: at_reference(DENSE)[0] - thermal_pressure(DENSE, 1.0, 1.0)), expect=1.25, within=1e-12,
          because="round-off"),
    Claim(id="khp95-dense-inconsistent", source="KHP95 Sec. IV", printed="-1.5, 1.25",
          statement="the dense fluid violates the Maxwell relation: (dE/dV)_T over -d(beta P)/d(beta), which should "
                    "be 1",
          value=exact(lambda: energy_by_volume()/(thermal_pressure(DENSE, 1.0, 1.0) - at_reference(DENSE)[0])),
          expect=1.2, within=1e-12, because="1.5/1.25; 1 would be consistent"),
    Claim(id="khp95-dense-inverse", source="KHP95 Eq. 3", printed="0.7, 1.5",
          statement="T(n, u) and u(n, T) of the dense fluid belong together: error of temperature between the plates",
          value=exact(wall_mismatch), at_most=0.0375,
          because="0.7 is 2/3 rounded, 0.05 of its last digit times du = 0.75; a solver that keeps u has walls at "
                  "0.475 and 1.525 for 0.5 and 1.5"),
    Claim(id="khp95-dense-stiffness", source="KHP95 Sec. IV", printed="2P/n = m c^2",
          statement="the dense fluid has 2 P/n about equal to m c^2: ratio at n = T = 1",
          value=exact(lambda: stiffness(DENSE)), **as_printed("dense-pressure-ratio"),
          because='"about equal", no digit: half; the ideal gas has exactly 1'),
    Claim(id="khp95-vdw-stiffness", source="KHP95 Sec. IV", printed="considerably lower", at_most=0.8,
          statement="van der Waals has a considerably lower pressure relative to its sound speed than the dense "
                    "fluid: ratio of both 2P/(n m c^2)", value=exact(lambda: stiffness(VDW)/stiffness(DENSE)),
          because='"considerably" is a fifth at least; what differs is P itself, 1.5 against 5'),
    Claim(id="khp95-pressure-sound", source="KHP95 Sec. IV", printed="P V/N approximates m c^2", expect=1, within=0.5,
          statement="at high pressure P/n is about m c^2: ratio for the dense fluid, P = 5",
          value=exact(lambda: stiffness(DENSE)/2), because='"approximates", no digit: half'),
)
