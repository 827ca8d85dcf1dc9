"""Claims about the flow of smooth particles: fields, approach to the steady state, neighbours    [KHP95]"""
import numpy as np

from studies.convection.claims.histories import History, distance, histories, over_seeds
from studies.convection.claims.lattices import RANGE
from studies.convection.claims.printed import as_printed
from studies.convection.claims.read import Value, grid, limit, particles, ratio, select
from studies.convection.claims.snapshots import Snapshot, contour_error, snapshot, velocity_error
from studies.convection.claims.spam import error
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables

STEADY = particles(1e4)


def seen(measure, point: dict = STEADY) -> Value:
    """What `measure` finds on the particles at the end of a run."""
    def value(tables: Tables) -> Measured:
        found = measure(snapshot(tables, point))
        return found if isinstance(found, Measured) else Measured(float(found), 0.0)
    return value


def outside(at: Snapshot) -> int:
    """Fluid particles beyond a plate."""
    return int((np.abs(at.x[:at.n, 1]) > at.height/2).sum())


def views(at: Snapshot) -> float:
    """Rms of v - <v> at the particles over rms v."""
    return float(np.sqrt(np.mean(at.noise**2)/np.mean(at.v[:at.n]**2)))


def kurtosis(at: Snapshot) -> Measured:
    """Of both components of v - <v> in the bulk; 3 for a normal distribution."""
    noise = at.noise[at.bulk].ravel()
    return Measured(float(np.mean(noise**4)/np.mean(noise**2)**2), float(1.96*np.sqrt(24/len(noise))))


def approach(energy: str) -> Value:
    """Largest |K_particles(t) - K_grid(t)| at Ra 10 000 over the grid's steady K."""
    def value(tables: Tables) -> Measured:
        other = histories(tables, grid(1e4, 50), "ke")[0]
        return distance(histories(tables, STEADY, energy), other, limit(tables, 1e4).value)
    return value


def settling(tables: Tables) -> Measured:
    """Times of approach at Ra 10 000, particles over grid."""
    other = histories(tables, grid(1e4, 50), "ke")[0].settling
    if not other > 0:
        raise CannotTell("the grid's K(t) was near its steady value all the time: no time of approach")
    return over_seeds([run.settling/other for run in histories(tables, STEADY)])


def fluctuation(tables: Tables) -> Measured:
    """Standard deviation of K(t) over K in the steady state at Ra 10 000."""
    return over_seeds([run.scatter for run in histories(tables, STEADY)])


def high(tables: Tables) -> float:
    """The largest Ra >= 50 000 of smooth particles of 50 rows or more.

    Raises
    ------
    CannotTell
        None was run.
    """
    frame = select(tables, "means", **{k: v for k, v in particles(1e4).items() if k != "ra"})
    if frame["ra"].max() < 5e4:
        raise CannotTell(f"smooth particles were run up to Ra {frame['ra'].max():g} only, not 50 000 or more")
    return float(frame["ra"].max())


def robust(tables: Tables) -> Measured:
    """Relative change of K between the third and last quarter of the run at the highest Ra."""
    runs: list[History] = histories(tables, particles(high(tables)))
    return over_seeds([run.drift for run in runs])


def layer(tables: Tables) -> Measured:
    """Density within one spacing of the plates over the mean density, fixed rows, Ra 10 000, both plates."""
    frame = select(tables, "walls", **particles(1e4, variant="printed-fixed-rows"))
    return over_seeds(frame.groupby("seed")["rho_layer"].mean().tolist())


def bounces(tables: Tables) -> Measured:
    """Reflections at the wall behind fixed rows, a particle and run."""
    frame = select(tables, "walls", **particles(1e4, variant="printed-fixed-rows"))
    return over_seeds((frame.groupby("seed")["reflections"].first()/5000).tolist())


NO_SINGLE = "Lucy's single particles have 1.3, pairs 2 or more"
CLAIMS = (
    Claim(id="khp95-neighbours-range", source="KHP95 Sec. II", printed="20 to 30", at_least=20, at_most=30,
          statement="bulk particles have 20 to 30 neighbours within 3 sigma: mean in a run at Ra 10 000",
          value=seen(lambda at: at.neighbours), because="the printed ends"),
    Claim(id="khp95-range-spacing", source="KHP95 Sec. II", printed="about three times", **as_printed("range-spacing"),
          statement="the range is about three nearest-neighbour distances: over the first peak of g(r), Ra 10 000",
          value=lambda tables: ratio(Measured(RANGE, 0.0), snapshot(tables, STEADY).spacing),
          because='"about", one digit'),
    Claim(id="khp95-velocity-field-10000", source="KHP95 Sec. VI", printed="5%", at_most=0.075,
          statement="velocity errors of the order of 5 % at Ra 10 000, place by place: rms difference of mean fields, "
                    "rolls aligned, over rms velocity", value=lambda tables: velocity_error(tables, STEADY, grid(1e4)),
          because='"of the order of", one digit: half as much again'),
    Claim(id="khp95-velocity-field-5000", source="KHP95 Sec. VI", printed="5%", at_most=0.075,
          statement="velocity errors of the order of 5 % at Ra 5000, place by place: rms difference of mean fields, "
                    "rolls aligned, over rms velocity",
          value=lambda tables: velocity_error(tables, particles(5e3), grid(5e3)),
          because='"of the order of", one digit: half as much again'),
    Claim(id="khp95-within-percent", source="KHP95 Sec. VII", printed="a few percent", at_most=0.05,
          statement="results are within a few percent of converged solutions: velocities place by place, Ra 10 000",
          value=lambda tables: velocity_error(tables, STEADY, grid(1e4)), because="a few are five at most"),
    Claim(id="khp95-fig9-temperature", source="KHP95 Sec. VI, Fig. 9", printed="good agreement", at_most=0.05,
          statement="temperatures of particles and grid agree at Ra 10 000: rms difference over the whole range",
          value=lambda tables: contour_error(tables, STEADY, grid(1e4), "T"),
          because="no number is printed: a few percent"),
    Claim(id="khp95-fig9-density", source="KHP95 Sec. VI, Fig. 9", printed="good agreement", at_most=0.1,
          statement="densities of particles and grid agree at Ra 10 000: rms difference over the grid's range",
          value=lambda tables: contour_error(tables, STEADY, grid(1e4), "rho"),
          because="no number is printed: one contour of ten"),
    Claim(id="khp95-approach", source="KHP95 Sec. VI, Fig. 8", printed="a few percent", at_most=0.05,
          value=approach("ke_field"),
          statement="the approach to the steady state agrees to a few percent: largest difference of K(t) over the "
                    "steady K, energy of the field", because="a few are five at most; smoothing lowers K at the start"),
    Claim(id="khp95-approach-particles", source="KHP95 Sec. VI, Fig. 8", printed="a few percent", at_most=0.05,
          value=approach("ke"),
          statement="the approach to the steady state agrees to a few percent: largest difference of K(t) over the "
                    "steady K, energy of the particles", because="a few are five at most"),
    Claim(id="khp95-steady-time", source="KHP95 Fig. 8", printed="same approach", expect=1, within=0.2, value=settling,
          statement="particles need as long as the grid to be steady at Ra 10 000: ratio of times until K is within 5 "
                    "%", because="no number is printed: a fifth; a narrower band would time the noise"),
    Claim(id="khp95-fluctuation-level", source="KHP95 Sec. VI", printed="about 1%", expect=0.01, within=0.01,
          value=fluctuation,
          statement="fluctuations disguise errors of less than 1 %: standard deviation of K(t) over K, 5000 "
                    "particles, Ra 10 000", because='"about", one digit, as an upper bound: twice'),
    Claim(id="khp95-fluctuation-definition", source="KHP95 Sec. VI", printed="analog of kinetic temperature", expect=3,
          within=0.3,
          statement="velocities about the field are like those of molecules: kurtosis of v - <v>, 3 for a normal "
                    "distribution", value=seen(kurtosis), because="no number is printed: 10 %"),
    Claim(id="khp95-fig12-views", source="KHP95 Fig. 12", printed="two equivalent views", at_most=0.1,
          value=seen(views),
          statement="particle velocities and averaged velocities are equivalent: rms difference over rms velocity, Ra "
                    "10 000", because="no number is printed: what an arrow's length shows"),
    Claim(id="khp95-walls-leakproof", source="KHP95 Sec. II", printed="leak-proof", expect=0, within=0,
          statement="fixed rows with an elastic wall behind them lose no particle: number outside at the end",
          value=seen(outside, particles(1e4, variant="printed-fixed-rows")), because="a whole number"),
    Claim(id="khp95-rows-repel", source="KHP95 Sec. II", printed="capable of repelling", at_most=0, value=bounces,
          statement="fixed rows repel approaching particles by themselves: reflections at the wall, a particle and run",
          because="none would need the wall"),
    Claim(id="khp95-rows-high-density", source="KHP95 Sec. II", printed="high-density", at_least=1, value=layer,
          statement="fixed rows are a region of high density: density of the fluid within one spacing of them over "
                    "the mean", because="higher than the mean"),
    Claim(id="khp95-monaghan-pairs", source="KHP95 Sec. VI, Fig. 10", printed="pairs", at_least=2, because=NO_SINGLE,
          statement="with Monaghan's weight particles move in pairs: median of second over first neighbour distance, "
                    "Ra 10 000", value=seen(lambda at: at.pairing, particles(1e4, variant="printed-monaghan"))),
    Claim(id="khp95-lucy-no-pairs", source="KHP95 Sec. VI", printed="no such pairing", at_most=1.6, because=NO_SINGLE,
          statement="with Lucy's weight particles do not pair: median of second over first neighbour distance, Ra 10 "
                    "000", value=seen(lambda at: at.pairing)),
    Claim(id="khp95-robust", source="KHP95 Secs VI, VII", printed="continues to provide solutions", at_most=0.05,
          value=robust,
          statement="particles give steady solutions at high Ra: change of K in the second half of the run at the "
                    "highest Ra",
          because="finite and steady within their errors of a few percent; whether right is another claim"),
    Claim(id="khp95-robust-right", source="KHP95 Secs VI, VII", printed="solutions", at_most=0.1,
          statement="what particles give at high Ra solves the equations: |K_particles/K_grid - 1| at the highest Ra",
          because="10 % is the paper's error of K", value=lambda tables: error(tables, high(tables))),
)
