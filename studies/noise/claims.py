"""What RR98 says of fluctuations about a given flow, judged    [RR98 Eqs 20-25]"""
from typing import Any

import numpy as np
from scipy.special import stdtrit

from studies.kit.ask import (
    Value,
    farthest,
    farthest_per,
    first,
    largest,
    last,
    log,
    nearest_power,
    of,
    one,
    power,
    rows,
)
from studies.kit.claim import Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.noise.partners import ENERGIES
from studies.noise.sampling import BATCHES

MOMENTA = ("stress", "friction", "stress+friction")
EXACT = (*MOMENTA, *ENERGIES)
ROUND_OFF = "round-off of sums of some ten terms, solves with condition 1e3 in some makers"
REACH = "3 %: what the samples reach; next orders are k/C = 1e-3"
HALF_PER_CENT = "half a per cent: the size that an experiment resolves"
RIGHT: dict[str, Any] = {"expect": 1, "within": 0.05,
                         "because": "5 %: waves of 32 spacings on a line are 1/cos^2(0.1) = 1.01"}
#: samples of the slowest mode within a tenth of onset, by 1 - Ra/Ra_c
SLOWEST: dict[str, Any] = {"such": "strength <= 0.1", "by": "strength", "need": 2,
                           "flow": "layer", "field": "slowest"}


def longest(equation: str, term: str, reading: str, d: int = 1, h: float = 1.5) -> Value:
    """Variance of printed noise over its due, longest wave."""
    return first("printed", "ratio", by="wavenumber", equation=equation, term=term, reading=reading, d=d, h=h)


def peak(name: str) -> Value:
    """Measured over the symbol, the highest of the waves: its peak is the best known."""
    return last("peaks", "measured/symbol", by="turns", err="measured_err/symbol", peak=name)


def sampled_power() -> Value:
    """Power of 1 - Ra/Ra_c in the variance of the slowest mode, first and last sample within a tenth."""
    variance: dict[str, Any] = {"value": "ratio*exact", "err": "ratio_err*exact", **SLOWEST}
    nearest, other = first("sampled", **variance), last("sampled", **variance)
    span = log(first("sampled", "strength", **SLOWEST)/last("sampled", "strength", **SLOWEST))
    return log(nearest/other)/span


def z(tables: Tables, table: str) -> np.ndarray:
    """(ratio - 1) of each mode in standard errors."""
    modes = rows(tables, table, "field != 'all'")
    error = modes["ratio_err"]/stdtrit(BATCHES - 1, 0.975)
    return ((modes["ratio"] - 1)/error).to_numpy()


def bound(n: int) -> float:
    """Standard errors that n means over batches keep together in 95 % of all cases [Bonferroni]."""
    return float(stdtrit(BATCHES - 1, 1 - 0.025/n))


def largest_deviation(table: str) -> Value:
    """The largest |z| of a table of modes over the bound for as many."""
    def deviation(tables: Tables) -> Measured:
        modes = z(tables, table)
        return Measured(float(np.abs(modes).max()/bound(len(modes))))
    words = "largest |ratio - 1| in standard errors, over the bound for as many modes, in"
    deviation.__doc__ = f"{words} {table}"
    return of(deviation)


CLAIMS = (
    Claim(id="rr98-fluct-eq20-rest", source="RR98 Eqs 20-25", at_most=1e-10,
          value=largest("rest", "error", maker=("renormalised", "delaunay")),
          because="Lyapunov's equation, solved twice, with differences good to 1e-12",
          statement="fluctuations linear about a gas at rest are those of equilibrium when each point has "
                    "its own stress and heat current: largest |C - C_eq|, lattices, jittered and random "
                    "points with Delaunay edges"),
    Claim(id="rr98-fluct-eq20-small", source="RR98 Eq. 20", printed="small fluctuations",
          expect=1, within=0.03,
          value=one("nonlinear", "ratio", field="rho", k=1e-3), because=REACH,
          statement="in the full equations, current amplitudes, densities fluctuate as linearised: variance "
                    "over kT rho/(c_T^2 V), C = 1000 k a point"),
    Claim(id="rr98-fluct-eq20-small-v", source="RR98 Eqs 20, 22", expect=1, within=0.03,
          value=one("nonlinear", "ratio", field="v", k=1e-3), because=REACH,
          statement="in the full equations velocities fluctuate as in equilibrium: variance over kT/(rho "
                    "V), C = 1000 k a point"),
    Claim(id="rr98-fluct-eq20-small-T", source="RR98 Eqs 20, 24", expect=1, within=0.03,
          value=one("nonlinear", "ratio", field="T", k=1e-3), because=REACH,
          statement="in the full equations temperatures fluctuate as in equilibrium: variance over "
                    "kT^2/(rho C_V V), C = 1000 k"),
    Claim(id="rr98-fluct-eq21-growth", source="RR98 Eq. 21", at_most=1e-9,
          value=one("formulas", "value", name="growth of Eq. 21"),
          because="a gas at rest is stable: no wave grows, to round-off",
          statement="fluctuations that obey Eq. 21 as printed stay small: growth rate of a wave of 16 "
                    "spacings in c/a; its sign is wrong, and all sound grows"),
    Claim(id="rr98-fluct-eq22-momentum", source="RR98 Eq. 22", printed="symmetric", at_most=1e-12,
          because=ROUND_OFF,
          value=largest("partners", "abs(sums)", noise=MOMENTA),
          statement="random stresses change no total momentum: largest sum over points, all makers and "
                    "point sets, 1 to 3 dimensions"),
    Claim(id="own-fluct-partners", source="RR98 Eqs 22-25", at_most=1e-12, because=ROUND_OFF,
          value=largest("partners", "abs(mismatch)", noise=EXACT),
          statement="one random stress and heat current a point, or noise along edges, or a mixture: "
                    "largest |Q - 2 kT Gamma|, all makers, points and dimensions, coefficients that vary by "
                    "factors of five"),
    Claim(id="own-fluct-partners-moving", source="RR98 Eqs 22-25, 45-48", at_most=1e-12, because=ROUND_OFF,
          value=largest("partners", "abs(mismatch)", noise=EXACT, maker="moving"),
          statement="these are partners on the faces between moving points, too, at any moment: largest |Q "
                    "- 2 kT Gamma|, coefficients that vary by factors of five, before and after 20 steps"),
    Claim(id="rr98-fluct-eq23-single", source="RR98 Eq. 23", **RIGHT,
          printed="usual fluctuation-dissipation",
          value=longest("23", "zeta", "single"),
          statement="Eq. 23, added once (Eq. 22), with the volume it lacks, gives long waves the right "
                    "temperature: variance over its due, zeta term, a line of nearest neighbours"),
    Claim(id="rr98-fluct-eq23-doubled", source="RR98 Eq. 23", **RIGHT,
          printed="usual fluctuation-dissipation",
          value=longest("23", "zeta", "doubled"),
          statement="Eq. 23, added as pi_ij + pi_ji, with the volume it lacks, gives long waves the right "
                    "temperature: variance over its due, zeta term, a line of nearest neighbours"),
    Claim(id="rr98-fluct-eq23-neighbours", source="RR98 Eq. 23", **RIGHT,
          printed="usual fluctuation-dissipation",
          value=longest("23", "zeta", "doubled", 2, 3.0),
          statement="Eq. 23 does so whatever the reach of the weight, added as pi_ij + pi_ji: variance over "
                    "its due, 2D, h = 3 a"),
    Claim(id="rr98-fluct-eq23-inner-k", source="RR98 Eq. 23", expect=0, within=1e-9, because="arithmetic",
          value=one("formulas", "value", name="trace of Eq. 23"),
          statement="without bulk viscosity Eq. 23's tensor has no trace: variance of the trace over that "
                    "of a shear stress in units where k = 1/2, 3D; an inner k is left over"),
    Claim(id="rr98-fluct-eq24-energy", source="RR98 Eq. 24", printed="symmetric", at_most=1e-12,
          because=ROUND_OFF,
          value=largest("partners", "abs(sums)", noise=ENERGIES),
          statement="random heat currents change no total energy: largest sum over points, all makers and "
                    "point sets"),
    Claim(id="rr98-fluct-eq25-doubled", source="RR98 Eq. 25", **RIGHT,
          value=longest("25", "kappa", "doubled"),
          statement="Eq. 25, added as J_ij + J_ji, with the volume it lacks, gives long waves the right "
                    "fluctuation of energy: variance over its due, a line of nearest neighbours"),
    Claim(id="rr98-fluct-eq25-onset", source="RR98 Eqs 20-25", printed="the flow is stable",
          expect=-1, within=0.02,
          value=farthest_per("rows", power("onset", "velocity - 1", "below", "below < 0.06"), centre=-1),
          because="0.02: other modes add a constant, of 1 % at 0.05 below onset",
          statement="fluctuations of a layer heated from below grow as 1/(Ra_c - Ra) on the way to onset, "
                    "Ra_c by eigenvalues: power of 1 - Ra/Ra_c in <w w> less equilibrium, 0.005 to 0.05"),
    Claim(id="own-fluct-onset-nearest", source="RR98 Eqs 20-25", expect=-1, within=0.02,
          value=farthest_per("rows", nearest_power("onset", "velocity - 1", "below"), centre=-1),
          because="0.02, as for all; chosen after these: the next term of the slow mode's rate is worth 1 % "
                  "at 0.01 below",
          statement="the same from the two values nearest to onset"),
    Claim(id="rr98-fluct-eq25-onset-seen", source="RR98 Eqs 20-25", at_least=5,
          value=last("sampled", "ratio*exact", by="exact", err="ratio_err*exact", flow="layer", field="w"),
          because="equilibrium is 1, rows of the Lyapunov solve add up to 10",
          statement="and what is about to convect: sampled variance of the velocity across a layer of 8 "
                    "rows, 2 % below onset, over that at rest"),
    Claim(id="rr98-fluct-eq25-onset-sampled", source="RR98 Eqs 20-25", printed="the flow is stable",
          expect=-1, within=0.15,
          value=sampled_power(), because="0.15: samples reach 0.05, the next power of the distance from "
                                         "onset adds 0.04",
          statement="sampled fluctuations of the slowest mode grow as 1/(Ra_c - Ra) on the way to onset: "
                    "power, from 10 % to 2 % below"),
    Claim(id="rr98-fluct-equipartition", source="RR98 Eqs 22, 24", expect=1, within=0.005,
          value=one("modes", "ratio", field="all"), because=HALF_PER_CENT,
          statement="sampled, all degrees of freedom of a gas at rest together have their variance: mean "
                    "ratio, jittered points"),
    Claim(id="rr98-fluct-equipartition-worst", source="RR98 Eqs 22, 24", at_most=1,
          value=largest_deviation("modes"),
          because="Bonferroni: all modes keep the bound in 95 % of all cases",
          statement="no single mode is off: largest deviation over the bound for that many modes"),
    Claim(id="rr98-fluct-equipartition-3d", source="RR98 Eqs 22, 24", expect=1, within=0.005,
          value=farthest("cubes", "ratio", field="all"), because=HALF_PER_CENT,
          statement="sampled in 3D, all degrees of freedom of a gas at rest together have their variance: "
                    "mean ratio, farther from 1 of a lattice and jittered points"),
    Claim(id="rr98-fluct-brillouin-position", source="RR98 Eqs 20-25", expect=1, within=0.005,
          value=peak("position"),
          because=HALF_PER_CENT,
          statement="the Brillouin peak of sampled density waves lies where the lattice symbol has sound: "
                    "ratio, waves of 8 spacings"),
    Claim(id="rr98-fluct-brillouin-width", source="RR98 Eqs 20-25", expect=1, within=0.03,
          value=peak("half width"),
          because="3 %: the size that an experiment resolves",
          statement="its half width is the symbol's damping of sound: ratio, waves of 8 spacings"),
)
