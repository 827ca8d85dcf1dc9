"""Values of the claims of the study fluctuations: from its tables, or from arithmetic    [RR98 Eqs 20-25, 40-44]"""

import numpy as np
import pandas as pd
from scipy.special import stdtrit

from studies.build.read import Value, select
from studies.kit.claim import CannotTell
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.noise.fluctuations.sampling import BATCHES
from studies.ordering.derive import line

MOMENTA, ENERGIES = ("stress", "friction", "stress+friction"), ("heat", "conduction", "heat+conduction")
EXACT = (*MOMENTA, *ENERGIES)


# --- algebra ----------------------------------------------------------------------------------------------------------


def worst(column: str, noises: tuple[str, ...], **where) -> Value:
    """The largest entry of a column of `partners` among some kinds of noise, all point sets."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "partners", **where)
        rows = rows[rows["noise"].isin(noises)]
        return Measured(float(rows[column].abs().max()), 0.0)
    return value


def least(column: str, noise: str, **where) -> Value:
    """The smallest entry of a column of `partners`."""
    return lambda tables: Measured(float(select(tables, "partners", noise=noise, **where)[column].min()), 0.0)


def nulls(noise: str) -> Value:
    """Null modes of a dissipation on the square lattice with even sides."""
    return lambda tables: Measured(float(select(tables, "partners", maker="renormalised", points="lattice", d=2,
                                                noise=noise)["nulls"].iloc[0]), 0.0)


def longest(equation: str, term: str, reading: str, d: int = 1, h: float = 1.5) -> Value:
    """Noise over its due, longest wave."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "printed", equation=equation, term=term, reading=reading, d=d, h=h)
        return Measured(float(rows.sort_values("wavenumber")["ratio"].iloc[0]), 0.0)
    return value


def spread(equation: str, term: str, d: int, h: float) -> Value:
    """Largest over smallest ratio among waves: no factor mends what is not 1."""
    def value(tables: Tables) -> Measured:
        ratio = select(tables, "printed", equation=equation, term=term, reading="doubled", d=d, h=h)["ratio"]
        return Measured(float(ratio.max()/ratio.min()), 0.0)
    return value


def from_cosine(equation: str, term: str, factor: float, d: int, h: float) -> Value:
    """Largest relative distance of the ratio, doubled, from factor/cos^2(k/2)."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "printed", equation=equation, term=term, reading="doubled", d=d, h=h)
        return Measured(float(np.abs(rows["ratio"]*np.cos(rows["wavenumber"]/2)**2/factor - 1).max()), 0.0)
    return value


def from_sums(tables: Tables) -> Measured:
    """Largest relative distance of all ratios from lattice sums."""
    rows = select(tables, "printed")
    return Measured(float(np.abs(rows["ratio"]/rows["predicted"] - 1).max()), 0.0)


# --- flows ------------------------------------------------------------------------------------------------------------


def at_rest(*makers: str) -> Value:
    """Largest |C - equilibrium| of a gas at rest, all points and transports of some makers of edges."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "rest")
        rows = rows[rows["maker"].isin(makers)]
        if rows["error"].isna().any():
            raise CannotTell("a case that should be stable is not")
        return Measured(float(rows["error"].max()), 0.0)
    return value


def growth(tables: Tables) -> Measured:
    """Largest growth rate with plain quadrature on jittered points."""
    return Measured(float(select(tables, "rest", maker="plain")["growth"].max()), 0.0)


def gradient(tables: Tables, strong: bool, least: float, most: float = 0.201) -> pd.DataFrame:
    """Waves by their wave number; strong : only those enhanced by 500 contrast^2, other effects being of that order."""
    rows = select(tables, "gradient")
    rows = rows[(rows["predicted"] > 500) if strong else rows["wavenumber"].between(least, most)]
    if len(rows) < 3:
        raise CannotTell("not run yet: three waves of these lengths")
    return rows


def gradient_ratio(strong: bool) -> Value:
    """Enhancement over its closed form, farthest from 1: waves of 30 to 90 spacings, or strong ones."""
    def value(tables: Tables) -> Measured:
        rows = gradient(tables, strong, 0.069)
        ratio = rows["extra"]/rows["predicted"]
        return Measured(float(ratio.iloc[int(np.argmax(np.abs(ratio - 1)))]), 0.0)
    return value


def gradient_slope(strong: bool) -> Value:
    """Power of k of the enhancement, divided by what the period of the profile takes from it: waves of 30 to 60 spacings, or
    strong ones that are shorter than the period.
    """
    def value(tables: Tables) -> Measured:
        rows = gradient(tables, strong, 0.099)
        if strong:
            rows = rows[rows["wavenumber"] > 2*np.pi/rows["period"]]
            if len(rows) < 3:
                raise CannotTell("not run yet: three strong waves that are shorter than the period")
        k, q = rows["wavenumber"], 2*np.pi/rows["period"]
        # with nu = 2 D: k^2/(k^2 + q^2)/[k^2 (2 (k^2 + q^2) + k^2)] of K^-4
        whole = 3*k**4/((k**2 + q**2)*(3*k**2 + 2*q**2))
        return Measured(*line(np.log(k.to_numpy()), np.log((rows["extra"]/whole).to_numpy())))
    return value


def onset_power(tables: Tables) -> Measured:
    """Power of 1 - Ra/Ra_c in the enhancement of <w w>, 0.005 to 0.05, all heights."""
    found = []
    for _, rows in select(tables, "onset").groupby("rows"):
        rows = rows[rows["below"] < 0.06]
        found.append(line(np.log(rows["below"].to_numpy()), np.log(rows["velocity"].to_numpy() - 1)))
    return Measured(*max(found, key=lambda one: abs(one[0] + 1)))


def onset_nearest(tables: Tables) -> Measured:
    """The same from the two values nearest to onset; the error is what the two before them give another power."""
    found = []
    for _, rows in select(tables, "onset").groupby("rows"):
        x, y = (np.log(q.to_numpy()) for q in (rows.sort_values("below")["below"], rows.sort_values("below")["velocity"] - 1))
        nearest, before = (np.diff(y)/np.diff(x))[:2]
        found.append(Measured(float(nearest), float(abs(nearest - before))))
    return max(found, key=lambda one: abs(one.value + 1))


# --- steps ------------------------------------------------------------------------------------------------------------


def stepped(integrator: str, dt: float, column: str = "velocity", **where) -> Value:
    """A column of `steps`."""
    def value(tables: Tables) -> Measured:
        return Measured(float(select(tables, "steps", integrator=integrator, dt=dt, **where)[column].abs().max()), 0.0)
    return value


def euler_law(tables: Tables) -> Measured:
    """Largest |T (1 - c^2 dt/nu)/T0 - 1| of forward Euler, isothermal, longest wave."""
    rows = select(tables, "steps", integrator="forward-euler", fluid="isothermal", wavenumber=0.02)
    return Measured(float(np.abs(rows["velocity"]*(1 - rows["dt"]) - 1).max()), 0.0)


def by_hand(tables: Tables) -> Measured:
    """The same against the solution by hand, all waves."""
    rows = select(tables, "steps", integrator="forward-euler", fluid="isothermal")
    return Measured(float(np.abs(rows["velocity"]/rows["by_hand"] - 1).max()), 0.0)


def order(tables: Tables) -> Measured:
    """Order of three stages from steps 0.1 to 0.4, the gas, k = 0.4."""
    rows = select(tables, "steps", integrator="three-stage", fluid="gas", wavenumber=0.4)
    rows = rows[rows["dt"].between(0.09, 0.41)]
    return Measured(*line(np.log(rows["dt"].to_numpy()), np.log(rows["error"].to_numpy())))


def better(tables: Tables) -> Measured:
    """Error of the temperature with Eqs 40, 41 over that with Eq. 40 for both, largest ratio."""
    both, one = (select(tables, "steps", integrator=name).set_index(["wavenumber", "dt"])["error"]
                 for name in ("eq40-eq40", "eq40-eq41"))
    return Measured(float((one/both).max()), 0.0)


# --- samples ----------------------------------------------------------------------------------------------------------


def total(tables: Tables) -> Measured:
    """Mean variance over all degrees of freedom."""
    row = select(tables, "modes", field="all").iloc[0]
    return Measured(float(row["ratio"]), float(row["ratio_err"]))


def z(tables: Tables, name: str = "modes") -> np.ndarray:
    """Deviations of modes in standard errors."""
    rows = select(tables, name)
    rows = rows[rows["field"] != "all"]
    return ((rows["ratio"] - 1)/(rows["ratio_err"]/stdtrit(BATCHES - 1, 0.975))).to_numpy()


def rms_z(tables: Tables) -> Measured:
    """Root mean square of z; by chance it is off by 1/sqrt(2 N) for N modes, 95 % twice that."""
    found = z(tables)
    return Measured(float(np.sqrt(np.mean(found**2))), float(2/np.sqrt(2*len(found))))


def largest_z(tables: Tables) -> Measured:
    """Largest |z| over the bound that all of N modes keep in 95 % of all cases."""
    found = z(tables)
    return Measured(float(np.abs(found).max()/stdtrit(BATCHES - 1, 1 - 0.025/len(found))), 0.0)


def structure(tables: Tables) -> Measured:
    """Mean of S(k)/S(0) over density waves; errors add in squares."""
    rows = select(tables, "modes", field="rho")
    return Measured(float(rows["ratio"].mean()), float(np.sqrt((rows["ratio_err"]**2).sum())/len(rows)))


def peak(name: str) -> Value:
    """Measured over the symbol, the highest of the waves: its peak is the best known."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "peaks", peak=name).sort_values("turns").iloc[-1]
        return Measured(float(row["measured"]/row["symbol"]), float(row["measured_err"]/row["symbol"]))
    return value


def nonlinear(field: str) -> Value:
    """Variance in the full equations over equilibrium, k = 1e-3."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "nonlinear", field=field, k=1e-3).iloc[0]
        return Measured(float(row["ratio"]), float(row["ratio_err"]))
    return value


def drift(tables: Tables) -> Measured:
    """Largest change of mass, momentum and energy over the energy, all runs."""
    return Measured(float(select(tables, "nonlinear")["drift"].max()), 0.0)


def capacity(noise: str, over: str) -> Value:
    """Variance of temperature at C = 20 k over a prediction: that of the same noise, or of the corrected one."""
    def value(tables: Tables) -> Measured:
        row, other = (select(tables, "capacity", C=20.0, noise=name).iloc[0] for name in (noise, over))
        return Measured(float(row["measured"]/other["predicted"]), float(row["measured_err"]/other["predicted"]))
    return value
