"""Patterns on a stream, and sound, on points that move    [RR98 Eqs 34-36, 39, 46-50]"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from particles.weights import Lucy
from studies.conservation.motions.scene import (
    AMPLITUDE,
    C,
    amplitude,
    by_halves,
    march,
    moving,
    rate,
    seen_slope,
    seen_stiffness,
    strip,
    transform,
)
from studies.kit.case import Case, Outcome, Report

STREAM = 0.2


@dataclass(frozen=True, kw_only=True)
class Pattern(Case):
    """Speed of a wave of density (pressure uniform) or of velocity across, over that of the stream, without viscosity.

    kind : of `motions.MOTIONS`. The error is what the halves of the run differ by.
    """
    motion: str
    kind: type
    pattern: str
    wavelength: int
    h: float = 3.0
    time: float = 20.0
    dt: float = 0.2

    @property
    def cost(self) -> float:
        return 1e-5*self.wavelength*self.time/self.dt

    @property
    def label(self) -> str:
        return f"pattern {self.pattern}, {self.motion}, wavelength {self.wavelength}, h {self.h:g}"

    def run(self, report: Report, folder: Path) -> Outcome:
        at, k = strip(self.wavelength), 2*np.pi/self.wavelength
        weight = Lucy.of(h=self.h)
        method, wave = moving(self.kind, at, weight), AMPLITUDE*np.cos(k*at.x[:, 0])
        one, v = np.ones(at.n), np.tile([STREAM, 0.0], (at.n, 1))
        rho = one + wave*(self.pattern == "density")
        v[:, 1] = wave*(self.pattern == "shear")
        row = 2 if self.pattern == "density" else 4      # rho or m, py
        seen = march(method, method.state(at.x, rho, v, 1/rho), self.dt, round(self.time/self.dt),
                     lambda state: amplitude(state[row] - state[row].mean(), state[0], k))
        phase = -np.unwrap(np.angle(seen))/(k*STREAM*self.dt)
        speed = by_halves(phase, lambda part: np.polyfit(np.arange(len(part)), part, 1)[0])
        twice = self.motion == "literal"
        return Outcome({"patterns": [{"motion": self.motion, "pattern": self.pattern, "h": self.h, "wavelength": self.wavelength,
                                      "speed": speed.value, "speed_err": speed.err,
                                      "predicted": 1 + twice*seen_slope(weight, at, k),
                                      "smoothed": transform(weight, k)}]})


#: c^2 over P/rho of sound on moving points, of f (the gradient) and g (a moved lattice under uniform pressure)
PREDICTED = {"literal": lambda f, g: 2*f*f + 2*g, "convective": lambda f, g: 2*f*f + 2*g,
             "carried": lambda f, g: 2*f*f + 2*g - 2*f*f, "constant-mass": lambda f, g: 2*f*f + 2*g - 2*f*f}


@dataclass(frozen=True, kw_only=True)
class Sound(Case):
    """Speed of standing sound without viscosity over c; bracket: of `ConstantMass`, else none. weight : class.

    The error is what the halves of the run, two periods, differ by.
    """
    motion: str
    kind: type
    wavelength: int
    bracket: Any = None
    weight: Any = Lucy
    h: float = 3.0
    dt: float = 0.2

    @property
    def cost(self) -> float:
        return 2e-6*self.wavelength**2*self.h**2/self.dt

    @property
    def label(self) -> str:
        return f"sound {self.motion} {self.name}, {self.weight.__name__} h {self.h:g}, wavelength {self.wavelength}"

    @property
    def name(self) -> str:
        """The bracket in words."""
        return "none" if self.bracket is None else type(self.bracket).__name__ + "".join(f" {p:g}" for p in self.bracket)

    def run(self, report: Report, folder: Path) -> Outcome:
        at, k = strip(self.wavelength, 2*int(self.h) + 2), 2*np.pi/self.wavelength
        weight, wave = self.weight.of(h=self.h), np.sin(k*at.x[:, 0])
        method = moving(self.kind, at, weight, **({} if self.bracket is None else {"bracket": self.bracket}))
        v, one = np.stack([AMPLITUDE*wave, 0*wave], axis=1), np.ones(at.n)
        steps = round(2*self.wavelength/C/self.dt)
        seen = march(method, method.state(at.x, one, v, one), self.dt, steps, lambda state: float(state[3]@wave))
        speed = by_halves(np.array(seen), lambda part: rate(part, self.dt).imag/(k*C))
        f, g = seen_slope(weight, at, k), seen_stiffness(weight, at, k)
        lost = sum(self.bracket) if self.bracket else 0.0      # a + b of Eq. 50 takes (a + b) P/rho off c^2
        return Outcome({"moving_sound": [{"motion": self.motion, "bracket": self.name, "weight": self.weight.__name__, "h": self.h,
                                   "wavelength": self.wavelength, "speed": speed.value, "speed_err": speed.err, "gradient": f,
                                   "stiffness": g,
                                   "predicted": np.sqrt((PREDICTED[self.motion](f, g) - lost*f*f)/2)}]})
