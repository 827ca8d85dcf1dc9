"""Values of the claims on samples in 3D, flows that move and velocity autocorrelations    [RR98 Eqs 20-25]"""
import numpy as np
import pandas as pd
from scipy.special import stdtrit

from studies.build.read import Value, select
from studies.kit.claim import CannotTell
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.noise.fluctuations.read import z
from studies.noise.fluctuations.sampling import BATCHES
from studies.noise.fluctuations.steps import line_symbols
from studies.ordering.derive import line


def farthest(rows: pd.DataFrame, value: str, err: str = "", centre: float = 1.0) -> Measured:
    """The entry farthest from `centre`, with its error where it has one."""
    row = rows.iloc[int(np.argmax(np.abs(rows[value].to_numpy() - centre)))]
    return Measured(float(row[value]), float(row[err]) if err else 0.0)


# --- samples ----------------------------------------------------------------------------------------------------------


def total_3d(tables: Tables) -> Measured:
    """Mean variance over all degrees of freedom, farther from 1 of both point sets."""
    return farthest(select(tables, "cubes", field="all"), "ratio", "ratio_err")


def rms(name: str) -> Value:
    """Root mean square of deviations in standard errors; 95 % of its scatter by chance."""
    def value(tables: Tables) -> Measured:
        found = z(tables, name)
        return Measured(float(np.sqrt(np.mean(found**2))), float(2/np.sqrt(2*len(found))))
    return value


def largest(name: str) -> Value:
    """Largest deviation over the bound that all modes keep in 95 % of all cases."""
    def value(tables: Tables) -> Measured:
        found = z(tables, name)
        return Measured(float(np.abs(found).max()/bound(len(found))), 0.0)
    return value


def bound(n: int) -> float:
    """Standard errors that n means over batches keep together in 95 % of all cases [Bonferroni]."""
    return float(stdtrit(BATCHES - 1, 1 - 0.025/n))


def fields_3d(tables: Tables) -> Measured:
    """Largest deviation of a mean over waves of density, velocity along and across k, temperature, over their bound."""
    rows = select(tables, "cubes")
    rows = rows[rows["field"] != "all"].assign(kind=lambda q: q["field"].str.removesuffix(" 2"))
    found = []
    for _, some in rows.groupby(["points", "kind"]):
        err = np.sqrt((some["ratio_err"]**2).sum())/len(some)/stdtrit(BATCHES - 1, 0.975)
        found.append(abs(some["ratio"].mean() - 1)/err)
    return Measured(float(max(found)/bound(len(found))), 0.0)


def seen(tables: Tables) -> Measured:
    """Sampled variance, over that at rest, of the velocity across the shear flow, longest waves along it."""
    rows = select(tables, "flows", flow="Shear", field="v", turns_x=1, turns_y=0)
    return Measured(float((rows["ratio"]*rows["exact"]).mean()),
                    float(np.sqrt(((rows["ratio_err"]*rows["exact"])**2).sum())/len(rows)))


def sampled_seen(flow: str, field: str) -> Value:
    """Sampled variance of the case that is enhanced most: the longest wave in the gradient, the layer nearest to onset."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "sampled", flow=flow, field=field).sort_values("exact").iloc[-1]
        return Measured(float(row["ratio"]*row["exact"]), float(row["ratio_err"]*row["exact"]))
    return value


def sampled_power(tables: Tables) -> Measured:
    """Power of Ra_c - Ra in the sampled variance of the slowest mode, from the ends of what is within a tenth of onset."""
    rows = select(tables, "sampled", flow="layer", field="slowest").sort_values("strength")
    rows = rows[rows["strength"] <= 0.1]
    if len(rows) < 2:
        raise CannotTell("not run yet: two samples within a tenth of onset")
    one, other = rows.iloc[0], rows.iloc[-1]
    span = np.log(one["strength"]/other["strength"])
    power = np.log(one["ratio"]*one["exact"]/(other["ratio"]*other["exact"]))/span
    return Measured(float(power), float(np.hypot(*(row["ratio_err"]/row["ratio"] for row in (one, other)))/abs(span)))


def spectrum(tables: Tables) -> Measured:
    """Mean ratio of a sampled spectrum to that of the symbols, farthest from 1 of the waves; error from the scatter of bins."""
    found = []
    for _, rows in select(tables, "spectrum").groupby("turns"):
        ratio = (rows["measured"]/rows["predicted"]).to_numpy()
        found.append({"ratio": ratio.mean(), "err": stdtrit(len(ratio) - 1, 0.975)*ratio.std(ddof=1)/np.sqrt(len(ratio))})
    return farthest(pd.DataFrame(found), "ratio", "err")


# --- a shear flow -----------------------------------------------------------------------------------------------------

WEAK = 1e-3     # of U: to second order in the shear


def weak(tables: Tables) -> pd.DataFrame:
    """Waves in the weak shear that are enhanced by 1000 U^2 and more: sound, which closed forms leave out, adds some U^2."""
    rows = select(tables, "shear")
    rows = rows[(rows["U"] < WEAK) & (rows["second"] > 1000*rows["U"]**2)]
    if len(rows) < 3:
        raise CannotTell("not run yet: three waves that a weak shear enhances by 1000 U^2")
    return rows


def sheared(over: str, strong: bool) -> Value:
    """Enhancement over a prediction, farthest from 1; strong : enhanced by 0.1 and more."""
    def value(tables: Tables) -> Measured:
        rows = weak(tables) if not strong else select(tables, "shear")
        rows = rows if not strong else rows[(rows["U"] > WEAK) & (rows["extra"] > 0.1)]
        if rows.empty:
            raise CannotTell("not run yet: waves that a strong shear enhances by 0.1")
        return farthest(rows.assign(ratio=rows["extra"]/rows[over]), "ratio")
    return value


def shear_slope(tables: Tables) -> Measured:
    """Power of k in a weak shear, what the period takes divided out, waves shorter than the period."""
    rows = weak(tables)
    rows = rows[rows["wavenumber"] > 2*np.pi/rows["period"]]
    if len(rows) < 3:
        raise CannotTell("not run yet: three waves shorter than the period")
    k, q = rows["wavenumber"], 2*np.pi/rows["period"]
    whole = 2*k**4/((2*k**2 + q**2)*(k**2 + q**2))
    return Measured(*line(np.log(k.to_numpy()), np.log((rows["extra"]/whole).to_numpy())))


def as_uniform(tables: Tables) -> Measured:
    """Enhancement over that of the local uniform shear: the shortest wave, where it is the strongest of the shears."""
    rows = select(tables, "shear")
    row = rows[rows["wavenumber"] == rows["wavenumber"].max()].sort_values("U").iloc[-1]
    return Measured(float(row["extra"]/row["uniform"]), 0.0)


# --- a uniform stream -------------------------------------------------------------------------------------------------


def in_stream(nested: bool) -> Value:
    """Largest |C - equilibrium| in a stream; nested : transport on points, or on a lattice; else along edges off it."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "stream")
        rows = rows[((rows["share"] == 0) | (rows["points"] == "lattice")) == nested]
        if rows.empty or rows["error"].isna().any():
            raise CannotTell("not run yet: a gas in a stream" if rows.empty else "a case that should be stable is not")
        return Measured(float(rows["error"].max()), 0.0)
    return value


def peak_in_stream(name: str, over: str) -> Value:
    """A peak in the stream, highest wave, over its `symbol`, or its shift over speed times k (`speed`)."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "shifted", peak=name).sort_values("turns").iloc[-1]
        due = row["symbol"] if over == "symbol" else row["speed"]*row["wavenumber"]
        return Measured(float(row["measured"]/due), float(row["measured_err"]/due))
    return value


def shift_order() -> float:
    """Power of k in what the shift of waves of 63 and 126 spacings lacks of speed times k."""
    lack = [1 - line_symbols(k)[0]/k for k in (0.05, 0.1)]
    return float(np.log2(lack[1]/lack[0]))


# --- velocity autocorrelation -----------------------------------------------------------------------------------------


def tail_of(share: float, large: bool = False) -> Value:
    """Autocorrelation over kT/(8 pi rho nu t) at nu t = 30, without what finite n adds.

    That is -1/n, the total momentum, until sound has gone round the box, as in the `large` one; -1/(2 n) when sound has died, 1/n
    with three null modes.
    """
    def value(tables: Tables) -> Measured:
        row = select(tables, "tail", share=share, nu_t=30.0).sort_values("side").iloc[-1 if large else 0]
        finite = (-1.0 if large else 1.0 if share == 0 else -0.5)/row["side"]**2
        return Measured(float((row["correlation"] - finite)*8*np.pi*row["nu_t"]), 0.0)
    return value


def floor(share: float) -> Value:
    """n times the autocorrelation at the longest time."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "tail", share=share).sort_values("nu_t").iloc[-1]
        return Measured(float(row["correlation"]*row["side"]**2), 0.0)
    return value


def sampled_floor(tables: Tables) -> Measured:
    """The same of the samples with null modes."""
    row = select(tables, "tail_sampled", share=0.0).sort_values("lag").iloc[-1]
    return Measured(float(row["measured"]*row["side"]**2), float(row["measured_err"]*row["side"]**2))


def tail_sampled(tables: Tables) -> Measured:
    """Largest deviation of a sampled autocorrelation from the exact one, over the bound for all lags."""
    rows = select(tables, "tail_sampled")
    found = np.abs(rows["measured"] - rows["exact"])/rows["measured_err"]*stdtrit(BATCHES - 1, 0.975)
    return Measured(float(found.max()/bound(len(rows))), 0.0)
