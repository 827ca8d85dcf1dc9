"""Boussinesq fluid in a square with a hot left and a cold right side, insulated above and below.

Basis functions are polynomials along both axes. Velocities vanish at all sides. T = warm - x, where `warm`
vanishes left and right; above and below insulation is the natural boundary condition. The flow is symmetric
under rotation by half a turn, so that one half of the products of two polynomials is left out.

    observed(steady(CavityLaws(1e6, 0.71), 48))["nu"]
"""
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre

from continuum.spectral.laws import BoussinesqLaws
from continuum.spectral.modes import RHO, VX, VY, T, along_y, polynomials_at
from continuum.spectral.newton import Galerkin, SpectralState, relaxed


@dataclass(frozen=True)
class CavityLaws(BoussinesqLaws):
    """Laws of the cavity in free-fall units: its height and the temperature difference of its sides are 1."""
    width: float = 1.0

    def terms(self, at: np.ndarray, x: np.ndarray) -> np.ndarray:
        """(law, term, ...) as in `BoussinesqLaws`, at positions x."""
        return self.of_T(at, at[3, 0] - x, x, (1, 0))


class Cavity(Galerkin):
    """Galerkin's equations with polynomials along both axes; those of T do not vanish above and below."""

    def __init__(self, laws: CavityLaws, n: int):
        super().__init__(laws, n)
        self.x = along_y(n)
        self.y = self.x._replace(functions=self.x.functions[:, [VX, VY, RHO, RHO]])
        self.weights = np.outer(self.x.weights, self.x.weights)
        odd = np.add.outer(np.arange(n), np.arange(n)) % 2 == 1
        self.kept = np.array([odd, odd, ~odd, odd])     # u, v and T change sign under half a turn
        self.kept[RHO, 0, 0] = False        # the mean is fixed

    def anywhere(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        along_x, upright = (polynomials_at(each, self.n)[0] for each in x.T)
        return along_x, upright[[VX, VY, RHO, RHO]]

    def terms(self, at: np.ndarray) -> np.ndarray:
        return self.laws.terms(at, self.x.points[:, None])  # type: ignore[no-any-return]


def steady(laws: CavityLaws, n: int, start: SpectralState | None = None) -> SpectralState:
    """Steady state with n polynomials along an axis, reached from `start`, by default from rest.

    Raises ValueError: n is out of range. NewtonFailed: no convergence; start from a smaller Ra.
    """
    return relaxed(Cavity(laws, n), start.on(n) if start else np.zeros((4, n, n)))


def observed(state: SpectralState) -> dict[str, float]:
    """The numbers that de Vahl Davis prints, named as in `published/devahldavis.csv`: velocities in
    kappa/L, positions in L from the lower left corner."""
    equations, kappa = state.equations, state.equations.laws.units[2]
    u, v, _, warm = series(state)
    heat = np.average(equations.terms(state.at)[T, 1], weights=equations.weights)/kappa
    hot = np.append(1.0, np.zeros(len(warm) - 1)) - 2*legendre.legval(-1, legendre.legder(warm))
    across, upright = legendre.legval(0, u)/kappa, legendre.legval(0, v.T)/kappa
    psi = abs(legendre.legval(0, legendre.legint(across, lbnd=-1)))/2
    names = ("nu-max", "nu-max-y", "u-max", "u-max-y", "v-max", "v-max-x")
    peaks = [number for line in (hot, across, upright) for number in peak(line)]
    return {"nu": float(heat), "nu-min": -peak(-hot)[0], "psi-middle": float(psi), **dict(zip(names, peaks))}


def series(state: SpectralState) -> np.ndarray:
    """Legendre coefficients (4, n + 2, n + 2) of the fields, those of P_k(2x) P_m(2y)."""
    a = np.pad(state.equations.amplitudes(state.q), ((0, 0), (0, 2), (0, 2)))
    zero_x, zero_y = [VX, VY, T], [VX, VY]
    a[zero_x, 2:] -= a[zero_x, :-2]
    a[zero_y, :, 2:] -= a[zero_y, :, :-2]
    return a


def peak(line: np.ndarray) -> tuple[float, float]:
    """Maximum of a series in P_k(2s) on -1/2 < s < 1/2, and its distance from the lower end."""
    roots = legendre.legroots(legendre.legder(line))
    inside = roots.real[(abs(roots.imag) < 1e-9) & (abs(roots.real) < 1)]
    z = np.array([-1.0, *inside, 1.0])
    values = legendre.legval(z, line)
    at = int(np.argmax(values))
    return float(values[at]), float((z[at] + 1)/2)
