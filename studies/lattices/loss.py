"""The convection lost to the stress of the pressure sum: a law, K predicted by it, and K measured.

Stirred particles bear, beside friction eta gamma, the stress

    tau = C P^(1 - q) (eta gamma)^q,        gamma^2 = 2 e:e

C and q are fitted to flows that a force holds. P is the pressure in the sums, the part 1 - fraction of that
of the gas. Three steps lead to K, none of which uses particles in convection:

1. With tau a roll dissipates as in a fluid x times as viscous, x = 1 + <tau gamma>/<eta gamma^2>, with means
   over the field of the grid at (Ra/x, Pr x), which is the same gas with x times the viscosity.
2. Plates with resting images act as if they were farther away by the slip length b, which is measured in the
   flow between plates. Linear theory with v_x = b dv_x/dn gives Ra_c(b) and the dissipation D(b) of a roll
   per kinetic energy.
3. K D ~ Nu - 1 ~ 1 - Ra_c/Ra: K = K_grid(Ra/x, x) [1 - Ra_c(b) x/Ra]/[1 - Ra_c(0) x/Ra] D(0)/D(b).

Step 3 was chosen after a look: with K ~ 1 - (Ra_c/Ra)^(1/2) in its place the gain by slip is half as large.

For today's smooth particles, MAKERS, tau is the excess over friction. Where that of some run does not differ
from zero it is a viscosity, tau = C eta gamma. Odd images, which all of them have, do not slip.
"""
from collections.abc import Iterator
from functools import cache
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.polynomial import Chebyshev
from scipy.interpolate import PchipInterpolator
from scipy.linalg import block_diag, eigh
from scipy.special import gamma

from continuum.gas.solve import steady_on
from continuum.linear import DEGREE, FREE, forms
from continuum.scene import RayleighBenard
from studies.build.spam import TODAY, VARIANTS, Variant
from studies.kit.case import Case, Report
from studies.kit.csvfile import read
from studies.kit.fits import power_law
from studies.kit.stats import Measured, with_errors
from studies.kit.store import RESULTS
from studies.kit.table import Row, Rows, Tables, groups
from studies.lattices.stirred import MAKERS

GRIDS = (16, 24)                    # rows: K to 1.5 %
THICK = (1.0, 1.1, 1.2, 1.4, 1.7, 2.0, 2.5, 3.2)
POWERS = tuple(np.round(np.arange(0, 1.01, 0.2), 1))
FLOWS = 1800.0          # Ra above which the grid is run: it convects there
ROLL = np.pi            # wave number of two rolls in a layer twice as wide as high
LEAST = 25              # rows from which on K is predicted: the law is one of many particles
USUAL = 0.02            # J of convection at Ra 10 000, where the error of the law is read
FAR = ("printed-from-flow", "printed-half-step")
#: all that are stirred
KINDS = VARIANTS | {name: TODAY[name] for name in MAKERS}


class Thickened(Case, table="thickened", same="ra"):
    """The grid's steady layer at an Ra, and in gases more viscous by THICK."""
    ra: float

    cost = 12.0

    def measure(self, report: Report) -> Iterator[Row]:
        for thick in (x for x in THICK if self.ra/x > FLOWS):
            fields = steady_on(RayleighBenard(ra=self.ra/thick, pr=thick), GRIDS)[-1].fields
            rate, P, eta, weight, ke = strained(fields, thick)
            for q in POWERS:
                share = (weight*P**(1 - q)*(eta*rate)**q*rate).sum()/(weight*eta*rate**2).sum()
                yield {"thick": thick, "q": q, "ke": ke, "share": share}


def strained(fields: Any, thick: float) -> tuple[np.ndarray, np.ndarray, float, np.ndarray, float]:
    """Rate of strain gamma and P at nodes, eta of the layer without excess, weights of nodes, K."""
    at, h = fields.at, fields.h
    vx, vy, rho, T = (q[:, :-1] for q in (at.vx, at.vy, at.rho, at.T))     # the last column repeats the first

    def along(q: np.ndarray) -> np.ndarray:
        return (np.roll(q, -1, axis=1) - np.roll(q, 1, axis=1))/(2*h)

    def up(q: np.ndarray) -> np.ndarray:
        return np.gradient(q, h, axis=0, edge_order=2)
    rate = np.hypot(along(vx) - up(vy), along(vy) + up(vx))
    weight = np.ones_like(vx)
    weight[[0, -1]] = 0.5
    ke = 0.5*(weight*rho*(vx**2 + vy**2)).sum()/(weight*rho).sum()
    return rate, rho*T, fields.scene.nu/thick, weight, float(ke)


# --- the law --------------------------------------------------------------------------------------


def projected(q: float) -> float:
    """Amplitude along cos kx cos ky of the stress |cos kx cos ky|^q: 4 <|cos cos|^(1 + q)>."""
    return float(4*(gamma(1 + q/2)/(np.sqrt(np.pi)*gamma(1.5 + q/2)))**2)


def family(name: str) -> str:
    """Name of the first variant with the same law: it may differ in static pressure, walls and step."""
    kind = lawful(KINDS[name])
    return next(other.name for other in KINDS.values() if lawful(other) == kind)


def lawful(kind: Variant) -> tuple:
    """The fields of a variant on which its law depends."""
    return kind.weight, kind.h, kind.gradients, kind.transport


def fitted(driven: pd.DataFrame) -> pd.DataFrame:
    """Stirred runs that laws are fitted to, with name of the law, J = eta gamma/P and tau, stress over P."""
    usual = driven.query("mode == 'stirred' and flow > 0.1")
    known = usual[usual.h == [KINDS[name].h for name in usual.variant]]
    stress = known.stress.where(~known.variant.isin(MAKERS), known.excess)
    return known.assign(law=known.variant.map(family), J=known.friction/known.P, tau=stress/known.P)


class Law(NamedTuple):
    """Law of the stress tau of a family. spread : relative error of tau at the J of convection."""
    C: float
    q: float
    spread: float


def laws(driven: pd.DataFrame) -> Iterator[Row]:
    """Laws of all families with three runs or more; those of MAKERS are taken without an error."""
    for name, runs in groups(fitted(driven), "law"):
        if len(runs) < 3:
            continue
        if name in MAKERS and (runs.excess <= runs.excess_err).any():
            ratio = runs.tau/runs.J
            C, q, scatter, spread = Measured(ratio.mean()), Measured(1.0), ratio.std(), 0.0
        else:
            fit = power_law(runs.J, runs.tau)
            q, scatter, spread = fit.slope, np.sqrt(np.mean(fit.residuals**2)), fit.at(np.log(USUAL)).err
            C = Measured(1.0, fit.intercept.err)*(np.exp(fit.intercept.value)/projected(q.value))
        if name in MAKERS:
            C, spread = Measured(C.value), 0.0
        yield {"variant": name, "scatter": scatter, "runs": len(runs), "spread": spread,
               **with_errors(C=C, q=q)}


# --- plates ---------------------------------------------------------------------------------------


@cache
def roll(b: float) -> tuple[float, float]:
    """(Ra_c, dissipation over eta and kinetic energy) of rolls between plates with slip length b, in heights.

    Trial functions are those of free plates; slip adds w'^2/b of both plates to the friction.
    """
    i = forms(ROLL, FREE, DEGREE)
    edge = Chebyshev([1, 1])*Chebyshev([1, -1])
    slopes = [2*(edge*Chebyshev.basis(n)).deriv() for n in range(DEGREE)]
    ends = np.array([[slope(z) for slope in slopes] for z in (-1.0, 1.0)])
    friction, none = i.friction + ends.T@ends/max(b, 1e-9), np.zeros_like(i.lift)
    lift = np.block([[none, i.lift], [i.lift.T, none]])
    work, waves = eigh(lift, block_diag(friction/ROLL**2, i.conduction))
    w = waves[:DEGREE, -1]
    return float(work[-1]**-2), float((w@friction@w)/(w@i.inertia@w))


def gain(b: float, ra: float) -> float:
    """K between plates with slip length b, in heights, over K between plates without slip."""
    (least, loss), (usual, whole) = roll(b), roll(0.0)
    return (1 - least/ra)/(1 - usual/ra)*whole/loss


def slips(driven: pd.DataFrame) -> pd.Series:
    """Slip lengths in spacings, by what is behind the plates."""
    plates = driven.query("mode == 'plates' and h == 3")
    return plates.groupby("walls").slip.mean()


def length(slip: pd.Series, kind: Variant) -> float:
    """Slip length of a variant, whatever the pressure of its images; nan where it was not measured."""
    walls = kind.walls.__name__.removesuffix("_own")
    return 0.0 if kind.name in MAKERS else slip.get(walls, np.nan)


# --- K --------------------------------------------------------------------------------------------


def thickness(layer: pd.DataFrame, law: Law, left: float) -> tuple[float, float]:
    """(x, K_grid(Ra/x, x)/K_grid(Ra, 1)) of a layer at one Ra; (nan, 0) if it rests. left : part of P left.

    Of several solutions x the least, which a flow that is strong at first approaches.
    """
    if law.q == 1:
        return 1 + law.C, thicker(layer, 1 + law.C)
    by = layer.pivot(index="thick", columns="q", values="share")
    share = np.exp([PchipInterpolator(by.columns, row)(law.q) for row in np.log(by.to_numpy())])
    x = np.linspace(1, by.index[-1], 2001)
    asked = 1 + law.C*left**(1 - law.q)*PchipInterpolator(by.index, share)(x)
    settled = np.flatnonzero(x >= asked)
    if not len(settled):
        return np.nan, 0.0
    found = float(x[settled[0]])
    return found, thicker(layer, found)


def thicker(layer: pd.DataFrame, x: float) -> float:
    """K of the layer with x times the viscosity, over its own."""
    ke = np.log(layer.groupby("thick").ke.first())
    return float(np.exp(PchipInterpolator(ke.index, ke - ke.iloc[0])(x)))


def foretold(tables: Tables, known: dict[str, Law]) -> Iterator[Row]:
    """Predicted and measured K of runs in `results/rb`, where law, slip and the layer of the Ra are known."""
    layers, slip = dict(groups(tables["thickened"], "ra")), slips(tables["driven"])
    usual = read(RESULTS/"rb"/"errors.csv").query(
        "method == 'spam' and energy == 'Kg' and eos == 'ideal' and transport == 'const-eta' and pr == 1 "
        "and sides == 'periodic' and resolution >= @LEAST and variant not in @FAR")
    for _, one in usual[usual.variant.isin(KINDS) & usual.ra.isin(layers)].iterrows():
        name, kind, law = one.variant, KINDS[one.variant], known.get(family(one.variant))
        b = length(slip, kind)
        if not law or np.isnan(b):
            continue
        x, bulk, K, err = with_slip(layers[one.ra], law, 1 - kind.fraction, b/one.resolution, one.ra)
        yield {"variant": name, "ra": one.ra, "rows": one.resolution, "x": x, "slip": b, "bulk": bulk,
               **with_errors(predicted=Measured(K, err), measured=Measured(1 + one.error, one.error_err))}


def with_slip(layer: pd.DataFrame, law: Law, left: float, b: float,
              ra: float) -> tuple[float, float, float, float]:
    """(x, K without slip, K with slip, its error from that of the law)."""
    tried = [thickness(layer, law._replace(C=law.C*(1 + s*law.spread)), left) for s in (0, -1, 1)]
    middle, more, less = (bulk*gain(b, ra/x) if bulk else 0.0 for x, bulk in tried)
    return *tried[0], middle, (more - less)/2


def derive(tables: Tables) -> Rows:
    """Rows of laws, and of K that they predict."""
    if not {"driven", "thickened"} <= tables.keys():
        return {}
    found = list(laws(tables["driven"]))
    known = {row["variant"]: Law(row["C"], row["q"], row.pop("spread")) for row in found}
    return {"laws": found, "foretold": list(foretold(tables, known))}
