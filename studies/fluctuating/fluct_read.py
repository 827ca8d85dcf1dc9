"""Values of the claims of the study fluctuations: from its tables, or from arithmetic    [RR98 Eqs 20-25, 40-44]"""

import numpy as np
from scipy.special import stdtrit

from particles.interpolants import Exponential, W
from particles.makers import MAKERS
from particles.methods import fluctuating
from particles.points import lattice, random
from particles.weights import Lucy
from studies.convection.claims.read import Value, select
from studies.fluctuating.fluct_sampling import BATCHES
from studies.fluctuating.fluct_steps import isothermal
from studies.integral.ordering_derive import line
from studies.integral.transport_symbol import neighbours
from studies.kit.claim import CannotTell
from studies.kit.stats import Measured
from studies.kit.table import Tables

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


def least(column: str, noise: str) -> Value:
    """The smallest entry of a column of `partners`."""
    return lambda tables: Measured(float(select(tables, "partners", noise=noise)[column].min()), 0.0)


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


def other_partner() -> float:
    """|Q - 2 kT Gamma| of the eta term of Eq. 42 on random points, Gamma a friction along edges, trace factor 2/d."""
    edges = MAKERS["delaunay"](random((8, 8), 0.5, 1), None)
    k = np.maximum(edges.k, 1e-3)       # any positive number: A and B make it up
    V, S2 = (edges.V[edges.i] + edges.V[edges.j])/2, (edges.S**2).sum(axis=1)
    pair = fluctuating.printed_stress(edges, 0.3, 0.0, 1.0, doubled=False, trace=1.0)
    A = 0.3*S2/(2*V)/k                  # 2D: S S (1 - 2/d) vanishes, B = 0
    wider = type(edges)(i=edges.i, j=edges.j, S=edges.S, k=k, apart=edges.apart, V=edges.V)
    due = 2*fluctuating.between(wider, A, 0*A, np.ones(len(A))).Gamma
    return float(abs(pair.Q - due).max()/abs(due).max())


def finer() -> float:
    """Variance of the literal noise over its due at the spacing 1/2 over that at 1, 2D: what a missing volume does."""
    found = []
    for a in (0.5, 1.0):
        edges = MAKERS["renormalised"](lattice((8, 8), a), Lucy.of(h=1.5*a))
        pair = fluctuating.printed_stress(edges, 0.3, 0.1, 1.0, doubled=True, volume=False)
        found.append(float(pair.Q.diagonal().sum()/(2*pair.Gamma.diagonal().sum())))
    return found[0]/found[1]


def half_step() -> float:
    """<u u> with increments of unit variance whatever the step, at dt/2 over that at dt: exact steady states of a decay."""
    def variance(dt: float) -> float:
        l = 0.1     # u' = (1 - l dt/2)/(1 + l dt/2) u + dt X/(1 + l dt/2), <X X> = 1
        return dt**2/((1 + l*dt/2)**2 - (1 - l*dt/2)**2)
    return variance(0.5)/variance(1.0)


def integral(d: int) -> float:
    """int W^2 r^2 dr of Eq. 31's weight from 10^-4 r0 on, over that from 10^-2 r0 on: the force's variance by Eq. 23, k small."""
    weight, found = Exponential(1.0, d), []
    for low in (1e-4, 1e-2):
        q = np.linspace(np.log(low), np.log(40.0), 40001)       # r = exp q, dr = r dq
        y = W(weight, np.exp(q))**2*np.exp(q)**(d + 2)
        found.append(float(((y[1:] + y[:-1])/2).sum()*(q[1] - q[0])))
    return found[0]/found[1]


def inner_k(k: float = 0.5) -> float:
    """Variance of the trace of Eq. 23's tensor in 3D without bulk viscosity, over that of its shear, k = 1/2: 4(1 - k)/4."""
    eta_T = 1.0
    return (2*k*(2*eta_T*2 + k*2*(-2/3)*eta_T*3))/(2*k*2*eta_T*2)


def wrong_sign() -> float:
    """Largest growth rate of sound at k = 0.4 with the sign of Eq. 21 as printed."""
    J, _ = isothermal(0.4)
    J[0] *= -1
    return float(np.linalg.eigvals(J).real.max())


def bulk(d: int) -> float:
    """Variance of the trace of X, over d^2: noise of a bulk viscosity that is not there."""
    return float(np.trace(fluctuating.shear(d, 2/3).reshape(d, d, d, d).trace(axis1=0, axis2=1)))/d**2


def smallest_of_44() -> float:
    """Smallest eigenvalue of the covariance of X, 1 to 3 dimensions."""
    return min(float(np.linalg.eigvalsh(fluctuating.shear(d, 2/3)).min()) for d in (1, 2, 3))


def tail(h: float, nu_t: float = 30.0, n: int = 96) -> float:
    """Velocity autocorrelation of a point on an n x n lattice by nested viscosity alone, over the continuum's 1/(4 pi nu t)."""
    weight = Lucy.of(h=h)
    r = neighbours(weight, 2)
    size = np.hypot(*r.T)
    w = W(weight, size)
    w *= 2/(w@size)
    k = 2*np.pi*np.stack(np.meshgrid(np.arange(n), np.arange(n)), axis=-1).reshape(-1, 2)/n
    s2 = sum((np.sin(k@r.T)@(w*r[:, a]/size))**2 for a in (0, 1))
    return float(np.exp(-nu_t*s2).mean()*4*np.pi*nu_t)


# --- flows ------------------------------------------------------------------------------------------------------------


def at_rest(tables: Tables) -> Measured:
    """Largest |C - equilibrium| of a gas at rest: lattices, Delaunay edges on jittered and random points, all transports."""
    rows = select(tables, "rest")
    rows = rows[rows["maker"].isin(["renormalised", "delaunay"])]
    if rows["error"].isna().any():
        raise CannotTell("a case that should be stable is not")
    return Measured(float(rows["error"].max()), 0.0)


def growth(tables: Tables) -> Measured:
    """Largest growth rate with plain quadrature on jittered points."""
    return Measured(float(select(tables, "rest", maker="plain")["growth"].max()), 0.0)


def gradient_ratio(tables: Tables) -> Measured:
    """Enhancement over its closed form, farthest from 1 of waves of 30 to 90 spacings."""
    rows = select(tables, "gradient")
    rows = rows[rows["wavenumber"].between(0.069, 0.201)]
    if rows.empty:
        raise CannotTell("not run yet: waves of 30 to 90 spacings")
    ratio = rows["extra"]/rows["predicted"]
    return Measured(float(ratio.iloc[int(np.argmax(np.abs(ratio - 1)))]), 0.0)


def gradient_slope(tables: Tables) -> Measured:
    """Power of k of the enhancement, divided by what the period of the profile takes from it, k 0.1 to 0.2."""
    rows = select(tables, "gradient")
    rows = rows[rows["wavenumber"].between(0.099, 0.201)]
    if len(rows) < 3:
        raise CannotTell("not run yet: three waves of 30 to 60 spacings")
    q = 2*np.pi/rows["period"]
    # with nu = 2 D: k^2/(k^2 + q^2)/[k^2 (2 (k^2 + q^2) + k^2)] of K^-4
    k = rows["wavenumber"]
    whole = 3*k**4/((k**2 + q**2)*(3*k**2 + 2*q**2))
    return Measured(*line(np.log(k.to_numpy()), np.log((rows["extra"]/whole).to_numpy())))


def onset_power(tables: Tables) -> Measured:
    """Power of 1 - Ra/Ra_c in the enhancement of <w w>, 0.005 to 0.05, all heights."""
    found = []
    for _, rows in select(tables, "onset").groupby("rows"):
        rows = rows[rows["below"] < 0.06]
        found.append(line(np.log(rows["below"].to_numpy()), np.log(rows["velocity"].to_numpy() - 1)))
    slope = max(found, key=lambda one: abs(one[0] + 1))
    return Measured(*slope)


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


def z(tables: Tables) -> np.ndarray:
    """Deviations of modes in standard errors."""
    rows = select(tables, "modes")
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
