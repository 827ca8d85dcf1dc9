"""Dissipative particles with internal energies: one temperature, conduction of heat    [RR98 Sec. V]

Units: rho = 3, gamma = 4.5, rc = kT = 1, unit masses. A particle's entropy is C ln e.
"""
from collections.abc import Iterator

import numpy as np

from particles.dissipative.edpd import Edpd
from particles.dissipative.observe import kinetic_temperature
from particles.dissipative.pairs3d import Uniform
from particles.run import Plan, run
from studies.kit import fits
from studies.kit.case import Case, Report
from studies.kit.stats import mean, with_errors
from studies.kit.table import Row
from studies.noise.dissipative import RHO

BOX = (12.0, 3.0, 3.0)
K = 2*np.pi/BOX[0]
MANY, FEW = 1e4, 50.0       # heat capacities of particles whose T hardly fluctuates, and whose T does


def kappa_of(diffusivity: float, C: float, rho: float = RHO) -> float:
    """kappa from diffusivity = 2 pi rho C kappa/315    [Li et al. 2014, Eq. 15, and LAMMPS's manual]"""
    return 315*diffusivity/(2*np.pi*rho*C)


class Shared(Case, table="shared", same="a dt"):
    """A closed fluid whose halves start at different temperatures; means over the second half of the run."""
    a: float
    dt: float
    time: float = 200.0
    side: float = 6.0

    @property
    def cost(self) -> float:
        return 3e-6*RHO*self.side**3*self.time/self.dt

    def measure(self, report: Report) -> Iterator[Row]:
        method = Edpd(box=(self.side,)*3, a=self.a, C=FEW, kappa=kappa_of(0.1, FEW))
        start = method.random_start(RHO)
        start[-1] *= np.where(start[0] > 0, 1.5, 0.5)
        series = {"energy": energy, "kinetic": kinetic_temperature, "internal": internal_temperature,
                  "variance": relative_variance}
        plan = Plan(dt=self.dt, steps=round(self.time/self.dt), every=max(1, round(0.2/self.dt)),
                    series=series)
        done = run(method, start, plan, report)
        total, *late = (np.array(x)[len(x)//2*(name != "energy"):] for name, x in done.series.items())
        drift = float(np.abs(total/total[0] - 1).max())
        kinetic, internal, variance = late
        means = with_errors(kinetic=mean(kinetic), internal=mean(internal), ratio=mean(kinetic/internal),
                            variance=mean(variance*(FEW + 1)))
        yield {"n": start.shape[1], "drift": drift, **means}


def energy(sums, state: np.ndarray) -> float:
    """Kinetic and internal energy of all particles."""
    return float((sums.velocity(state)**2).sum()/2 + state[-1].sum())


def internal_temperature(sums, state: np.ndarray) -> float:
    """1/<1/T_i>, which is T in equilibrium; <T_i> is T (1 + 1/C)    [Avalos & Mackie 1997]"""
    return float(1/np.mean(sums.method.C/state[-1]))


def relative_variance(sums, state: np.ndarray) -> float:
    """<e^2>/<e>^2 - 1, which is 1/(C + 1) for P(e) = e^C exp(-e/T)    [Avalos & Mackie 1997]"""
    return float(state[-1].var()/state[-1].mean()**2)


class Conduction(Case, table="conduction", same="rho a given seed"):
    """Diffusivity of temperature from the decay of a wave along x, beside the given one."""
    rho: float
    a: float
    given: float
    seed: int = 1

    @property
    def cost(self) -> float:
        return 3e-6*self.rho**2*36*self.plan.steps

    @property
    def plan(self) -> Plan:
        """Steps until the wave has decayed to a third or less; dt resolves the exchange of pairs, 21 D."""
        time, dt = (1.0, 0.002) if self.given > 5 else (6.0, 0.01)
        return Plan(dt=dt, steps=round(time/dt), every=round(0.02*time/dt), series={"wave": wave})

    def measure(self, report: Report) -> Iterator[Row]:
        method = Edpd(box=BOX, a=self.a, C=MANY, kappa=kappa_of(self.given, MANY, self.rho),
                      noise=Uniform(self.seed))
        start = method.random_start(self.rho, self.seed)
        start[-1] *= 1 + 0.1*np.sin(K*start[0])
        done = run(method, start, self.plan, report)
        t, size = np.array(done.times), np.array(done.series["wave"])
        late = (t > t[-1]/10) & (size > 0.01)
        rate = fits.line(t[late], np.log(size[late])).slope.value
        yield {"n": start.shape[1], "diffusivity": -rate/K**2}


def wave(sums, state: np.ndarray) -> float:
    """Amplitude of the wave of T, without the mean of T: particles' random places would add a part of it."""
    T, shape = state[-1]/sums.method.C, np.sin(K*state[0])
    return float(np.sum((T - T.mean())*shape)/np.sum(shape**2))
