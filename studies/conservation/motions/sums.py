"""What motions conserve, how Eqs 46-48 turn into 49, what Eq. 50 does to the force, what a density filter does."""
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from continuum.fluid import ConstEta
from particles.integral.brackets import Powers
from particles.integral.dih import Dih
from particles.integral.edge_makers import renormalised
from particles.integral.filtered import Filtered
from particles.integral.points import Points, jittered, lattice
from particles.integral.rr98_moving_plain import ConstantMass, Convective, Literal, convected
from particles.threads import Team
from particles.weights import Lucy
from studies.conservation.motions.scene import (
    ALONG,
    AMPLITUDE,
    GAS,
    STILL,
    C,
    amplitude,
    by_halves,
    march,
    moving,
    seen_slope,
    strip,
)
from studies.kit.case import Case, Outcome, Report

SIDE = 6            # spacings of the box of long runs
POINTS = {"lattice": 0.0, "jittered-0.1": 0.1}


def crowd(at: Points, seed: int = 0) -> tuple[np.ndarray, ...]:
    """Random rho, v, T on points."""
    rng = np.random.default_rng(seed)
    return rng.uniform(0.9, 1.1, at.n), rng.normal(0, 0.1, (at.n, at.d)), rng.uniform(0.9, 1.1, at.n)


def stirred(at: Points) -> tuple[np.ndarray, ...]:
    """Vortices and sound on a stream: rho, v, T."""
    X, Y = (2*np.pi*at.x/at.box).T
    v = 0.1*np.stack([0.5 + np.sin(X)*np.cos(Y), 0.3 - np.cos(X)*np.sin(Y)], axis=1)
    return 1 + 0.05*np.cos(X + Y), v, 1 + 0.05*np.sin(Y)


@dataclass(frozen=True, kw_only=True)
class Conservation(Case):
    """Largest drift of mass, momentum and energy over a run: vortices and sound on a stream, 6 x 6 points, viscous gas.

    kind, weight, integrator : classes. points : of POINTS. chi : of the density filter, none if 0.
    """
    motion: str
    kind: type
    weight: Any
    points: str
    integrator: Any
    steps: int
    dt: float
    chi: float = 0.0
    h: float = 2.7

    @property
    def cost(self) -> float:
        return 5e-4*self.steps*self.integrator.evaluations

    @property
    def label(self) -> str:
        return f"conservation {self.motion} {self.weight.__name__} {self.points} {self.integrator.__name__} {self.chi:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        at = jittered((SIDE, SIDE), POINTS[self.points], 1)
        transport = Filtered(chi=self.chi, transport=ALONG) if self.chi else ALONG
        method = moving(self.kind, at, self.weight.of(h=self.h), ConstEta(0.2, 0.2), transport=transport)
        state = method.state(at.x, *stirred(at))
        stepper, sums, d = self.integrator(state.shape, Team(1)), [method.conserved(state)], at.d
        size = np.array([sums[0][0], *(np.abs(state[d + 1:2*d + 1]).sum(axis=1)*sums[0][0]/state[d].sum()), sums[0][-1]])
        for n in range(self.steps):
            stepper.step(method, state, self.dt)
            sums.append(method.conserved(state))
            if n % 256 == 0:
                report(n/self.steps)
        drift = np.abs(np.array(sums) - sums[0]).max(axis=0)/size
        found = {"mass": drift[0], "momentum": drift[1:-1].max(), "energy": drift[-1]}
        return Outcome({"conservation": [{
            "motion": self.motion, "edges": "renormalised", "weight": self.weight.__name__, "points": self.points,
            "integrator": self.integrator.__name__, "filter": self.chi, "steps": self.steps, "dt": self.dt, "quantity": name,
            "drift": value} for name, value in found.items()]})


def rates(method: Any, state: np.ndarray) -> np.ndarray:
    """d(state)/dt."""
    out = np.empty_like(state)
    method.rates(state, out)
    return out


def acceleration(method: Any, state: np.ndarray) -> np.ndarray:
    """dv/dt, (d, n), of dp/dt - v dm/dt."""
    d, found = method.places, rates(method, state)
    return (found[d + 1:2*d + 1] - method.velocity(state)*found[d])/state[d]


@dataclass(frozen=True, kw_only=True)
class Identity(Case):
    """Accelerations of Eqs 46-48, and without what these add, against Eq. 49: random fields on jittered points, 10 x 10.

    Reynolds number: U a/nu with U = 0.1; infinite without viscosity.
    """
    name: str
    transport: Any
    reynolds: float
    size: float = 0.2

    def run(self, report: Report, folder: Path) -> Outcome:
        at, eta = jittered((10, 10), self.size, 2), 0.1/self.reynolds
        made = [moving(kind, at, Lucy.of(h=3.0), ConstEta(eta, eta), transport=self.transport)
                for kind in (ConstantMass, Convective, Literal)]
        exact, *others = (acceleration(method, method.state(at.x, *crowd(at))) for method in made)
        off = [float(np.abs(other - exact).max()/np.abs(exact).max()) for other in others]
        return Outcome({"identity": [{"transport": self.name, "reynolds": self.reynolds, "convective": off[0],
                                      "literal": off[1]}]})


@dataclass(frozen=True, kw_only=True)
class Signs(Case):
    """d/dt less the partial derivative, as Eqs 46-48 have it, over v.grad of smooth fields on a lattice, by least squares."""
    wavelength: int
    h: float = 3.0

    def run(self, report: Report, folder: Path) -> Outcome:
        at, k = strip(self.wavelength), 2*np.pi/self.wavelength
        weight = Lucy.of(h=self.h)
        dih = moving(Convective, at, weight).fluid(at.x, at.V)
        x, v = at.x[:, 0], np.tile([0.3, -0.1], (at.n, 1))
        f, rows = seen_slope(weight, at, k), []
        for equation, phase in (("46", 0.0), ("47", 0.7), ("48", 1.9)):
            exact = -0.3*k*np.sin(k*x + phase)
            [found] = convected(dih.edges, v, np.cos(k*x + phase)[None])
            rows.append({"equation": equation, "wavelength": self.wavelength, "factor": found@exact/(exact@exact),
                         "predicted": f})
        return Outcome({"signs": rows})


@dataclass(frozen=True, kw_only=True)
class Brackets(Case):
    """Acceleration by Eq. 50 in a density wave without entropy (P = rho^2), over -grad P/rho; wavelength 32, h = 3.

    unit : accelerations where masses are counted in a third of the unit, three times rho and P, over those with the whole:
    random fields on jittered points, by least squares. unit_left : the largest that this does not explain, over the largest.
    """
    a: float
    b: float

    def run(self, report: Report, folder: Path) -> Outcome:
        at, k = strip(32), 2*np.pi/32
        wave = AMPLITUDE*np.cos(k*at.x[:, 0])
        method = moving(ConstantMass, at, Lucy.of(h=3.0), bracket=Powers(self.a, self.b))
        found = amplitude(acceleration(method, method.state(at.x, 1 + wave, 0*at.x, 1 + wave))[0], at.x[:, 0], k).imag
        exact, lost = -2*k*AMPLITUDE/2, self.a + self.b      # of -grad rho^2 = 2 k A sin kx: amplitude of exp(ikx) is -i/2
        f = seen_slope(Lucy.of(h=3.0), at, k)
        unit, left = unit_of_mass(Powers(self.a, self.b))
        return Outcome({"brackets": [{"a": self.a, "b": self.b, "force": found/exact, "predicted": f*(1 - lost/2),
                                      "unit": unit, "unit_left": left, "unit_predicted": 3.0**-lost}]})


def unit_of_mass(bracket: Any) -> tuple[float, float]:
    """(unit, unit_left) of `Brackets`."""
    at = jittered((10, 10), 0.2, 2)
    method, (rho, v, T) = moving(ConstantMass, at, Lucy.of(h=3.0), bracket=bracket), crowd(at)
    whole, third = (acceleration(method, method.state(at.x, unit*rho, v, T)) for unit in (1.0, 3.0))
    ratio = float(np.sum(whole*third)/np.sum(whole**2))
    return ratio, float(np.abs(third - ratio*whole).max()/np.abs(third).max())


@dataclass(frozen=True, kw_only=True)
class FilterRun(Case):
    """Decay rate over chi, on a lattice that stands still, of a density wave under uniform pressure, or of alternating density.

    Read from eps - 2 rho, which sound does not move. Predicted: k^2 as the filter sees it; half of it for the wave, since mass
    leaves with its energy and pressure brings back half of it (1/gamma). wavelength 0 : density that alternates along both axes,
    at uniform temperature. lost : share of the wave that is gone when sound has crossed its wavelength.
    """
    h: float
    wavelength: int
    corrected: bool = False
    chi: float = 0.1*C
    time: float = 20.0
    dt: float = 0.1

    def run(self, report: Report, folder: Path) -> Outcome:
        corner = self.wavelength == 0
        at = lattice((12, 12)) if corner else strip(self.wavelength, 10)
        k = np.pi if corner else 2*np.pi/self.wavelength
        shape = np.cos(np.pi*(at.x - 0.5)).prod(axis=1) if corner else np.cos(k*at.x[:, 0])
        edges = renormalised(at, Lucy.of(h=self.h))
        transport = Filtered(chi=self.chi, transport=ALONG, corrected=self.corrected) if self.chi else ALONG
        dih, rho, one = Dih(edges=edges, eos=GAS, law=STILL, transport=transport), 1 + AMPLITUDE*shape, np.ones(at.n)
        T = one if corner else 1/rho
        seen = march(dih, dih.state(rho, 0*at.x, T), self.dt, round(self.time/self.dt),
                     lambda state: float((state[3] - 2*state[0])@shape))
        fall = by_halves(-np.log(np.abs(seen)), lambda part: np.polyfit(np.arange(len(part)), part, 1)[0]/self.dt)
        seen_by = seen_square(dih, self.corrected, shape)
        name = "none" if not self.chi else "corrected" if self.corrected else "plain"
        per = self.chi or 0.1*C
        mode = "corner" if corner else f"wave {self.wavelength}"
        return Outcome({"filter": [{"filter": name, "h": self.h, "mode": mode, "k": k,
                                    "rate": fall.value/per, "rate_err": fall.err/per,
                                    "lost": np.nan if corner else 1 - np.exp(-fall.value*self.wavelength/C),
                                    "predicted": (self.chi > 0)*seen_by*(1 if corner else 0.5)}]})


def seen_square(dih: Dih, corrected: bool, shape: np.ndarray) -> float:
    """k^2 as the filter sees it: -lap of a wave over the wave, less what a linear density explains."""
    edges = dih.edges
    filtered = replace(dih, transport=Filtered(chi=1.0, transport=ALONG, corrected=corrected))
    flow = filtered.flow(filtered.state(1 + AMPLITUDE*shape, np.zeros((edges.n, edges.d)), np.ones(edges.n)))
    left = filtered.transport.fluxes(filtered, flow).mass
    lost = np.bincount(edges.i, left, edges.n) - np.bincount(edges.j, left, edges.n)
    return float(lost/edges.V@shape/(AMPLITUDE*shape@shape))


