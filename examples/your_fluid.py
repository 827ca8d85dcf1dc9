"""Your own equation of state, a class and six formulas: a stiffer gas convects beside the ideal gas."""
from typing import NamedTuple

from continuum.fluid import energy, pressure, pressure_slopes, temperature, thermal_pressure, valid
from examples import picture, sized
from studies.front import solve


class Stiffened(NamedTuple):
    """P = rho T + B (rho - 1), e = cv T"""
    B: float = 1.0
    cv: float = 1.0


pressure.of(Stiffened)(lambda eos, rho, e: rho*e/eos.cv + eos.B*(rho - 1))
temperature.of(Stiffened)(lambda eos, rho, e: e/eos.cv)
energy.of(Stiffened)(lambda eos, rho, T: eos.cv*T)
pressure_slopes.of(Stiffened)(lambda eos, rho, e: (e/eos.cv + eos.B, rho/eos.cv))     # over rho, over e
thermal_pressure.of(Stiffened)(lambda eos, rho, T: rho)                               # dP/dT at this rho
valid.of(Stiffened)(lambda eos, rho, e: (rho > 0) & (e > 0))

for eos in (Stiffened(B=0.0), Stiffened(B=2.0)):        # the first is the ideal gas
    done = solve("rayleigh-benard", "fixed-lattice", rows=sized(16, 8), time=sized(60, 5), eos=eos)
    print(eos, done)
done.plot(picture("your_fluid"))
