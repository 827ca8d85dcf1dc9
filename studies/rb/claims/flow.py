"""Claims about the flow of smooth particles: fields, approach to the steady state, neighbours    [KHP95]"""
from collections.abc import Callable, Hashable
from math import hypot, inf

import numpy as np

from studies.build.read import (
    ALIKE,
    Value,
    diverged,
    grid,
    largest,
    limit,
    mean,
    off,
    over_seeds,
    particles,
    ratio,
    rolls,
    same_flow,
    select,
)
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.rb.claims.histories import History, distance, histories
from studies.rb.claims.lattices import RANGE
from studies.rb.claims.printed import as_printed
from studies.rb.claims.snapshots import Fields, contour_error, edge_error, fields, snapshot, velocity_error

STEADY, ROWS = particles(1e4), particles(1e4, variant="printed-fixed-rows")
PARTICLES, WIDTH = 5000, 100


def against(measure: Callable[..., Measured], ra: float, *names: str) -> Value:
    """An error of the mean fields of 5000 particles against the grid's, of the same flow."""
    def value(tables: Tables) -> Measured:
        point = particles(ra)
        kept = int(select(tables, "fields", **point)["seed"].min())
        same_flow(tables, point, grid(ra), kept)
        return measure(tables, point, grid(ra), *names)
    return value


def seen(measure, point: dict = STEADY) -> Value:
    """What `measure` finds on the particles at the end of a run."""
    def value(tables: Tables) -> Measured:
        found = measure(snapshot(tables, point))
        return found if isinstance(found, Measured) else Measured(float(found), 0.0)
    return value


def approach(energy: str) -> Value:
    """Largest |K_particles(t) - K_grid(t)| at Ra 10 000 over the grid's steady K."""
    def value(tables: Tables) -> Measured:
        same_flow(tables, STEADY, grid(1e4))
        other = histories(tables, grid(1e4, 50), "ke")[0]
        return distance(histories(tables, STEADY, energy), other, limit(tables, 1e4).value)
    return value


def settling(tables: Tables) -> Measured:
    """Times of approach at Ra 10 000, particles over grid."""
    same_flow(tables, STEADY, grid(1e4))
    other = histories(tables, grid(1e4, 50), "ke")[0].settling
    if not other > 0:
        raise CannotTell("the grid's K(t) was near its steady value all the time: no time of approach")
    return over_seeds([run.settling/other for run in histories(tables, STEADY)])


def fluctuation(tables: Tables) -> Measured:
    """Standard deviation of K(t) over K in the steady state at Ra 10 000."""
    return over_seeds([run.scatter for run in histories(tables, STEADY)])


def high(tables: Tables) -> float:
    """The largest Ra >= 50 000 of smooth particles of 50 rows, whether they came to the end or not.

    Raises
    ------
    CannotTell
        None was run.
    """
    frame = select(tables, "kinetic_energy", **{k: v for k, v in particles(1e4).items() if k != "ra"})
    if frame["ra"].max() < 5e4:
        raise CannotTell(f"smooth particles were run up to Ra {frame['ra'].max():g} only, not 50 000 or more")
    return float(frame["ra"].max())


def robust(tables: Tables) -> Measured:
    """Relative change of K between the third and last quarter of the run at the highest Ra; no bound if it diverged."""
    point = particles(high(tables))
    if diverged(tables, point):
        return Measured(inf, 0.0)
    runs: list[History] = histories(tables, point)
    return over_seeds([run.drift for run in runs])


def right_at_high(tables: Tables) -> Measured:
    """|Kg/K - 1| at the highest Ra, K of the finest grid smoothed alike, its error what it differs from the next one.

    The grid's flow may oscillate there for good: then it is not extrapolated.
    """
    ra = high(tables)
    point = {name: value for name, value in grid(ra).items() if name != "resolution"}
    frame = select(tables, "kinetic_energy", **point)
    frame = frame[frame["resolution"] < inf].sort_values("resolution")
    if len(frame) < 2:
        raise CannotTell(f"the grid was run with one resolution at Ra {ra:g}: a reference needs two")
    fine, err = float(frame["ke"].iloc[-1]), hypot(frame["ke"].diff().iloc[-1], frame["ke_err"].iloc[-1])
    if rolls(tables, particles(ra)) != int(frame["rolls"].iloc[-1]):
        raise CannotTell(f"particles and grid have different numbers of rolls at Ra {ra:g}: another flow")
    seen = select(tables, "smoothed", weight="Lucy", h=3.0, rows=50, **{k: v for k, v in point.items() if k != "variant"})
    factor = float((seen["ke_smoothed"]/seen["ke"]).iloc[-1])
    return off(ratio(mean(tables, particles(ra), "ke_field"), Measured(factor*fine, factor*err)))


def losses(variant: str) -> Value:
    """Particles that would be lost without the elastic wall, a particle and run, Ra 10 000: none where it turned none back."""
    def value(tables: Tables) -> Measured:
        frame = select(tables, "walls", **particles(1e4, variant=variant))
        turns = over_seeds((frame.groupby("seed")["reflections"].first()/PARTICLES).tolist())
        if turns.value > 0:
            raise CannotTell(f"the elastic wall turned particles back, {turns.value:.2g} times a particle and run; but a turn is "
                             "no loss: a particle beyond the plate may come back by itself, and no run here goes without it")
        return turns
    return value


def layer_error(tables: Tables) -> Measured:
    """Largest |rho - rho_grid| within one spacing of a plate, horizontal mean, over the range of the grid's, Ra 10 000."""
    rows = select(tables, "walls", need="rho_layer", **STEADY)
    same_flow(tables, STEADY, grid(1e4))
    at = fields(tables, grid(1e4), finest=True)
    found = [over_seeds((group["rho_layer"] - beside(at, plate)).tolist()) for plate, group in rows.groupby("plate")]
    return largest([Measured(abs(one.value), one.err) for one in found], over=float(np.ptp(at["rho"])))


def beside(at: Fields, plate: Hashable) -> float:
    """The grid's mean density half a spacing of 50 rows from a plate: the line through the two places next to it."""
    mean = at["rho"].mean(axis=1)[::1 if plate == "lower" else -1]
    places = (len(mean)*0.5/50 - 0.5)       # from the first place, in distances of places
    return float(mean[0] + places*(mean[1] - mean[0]))


def carried(tables: Tables) -> Measured:
    """Share of the pressure on the plates that fixed rows carry, Ra 10 000: not the impacts on the elastic wall.

    An impact gives 2 m |v_y|, here twice the largest speed among the particles at the end; P = rho T of the layer.
    """
    at = snapshot(tables, ROWS)
    fastest = float(np.sqrt((at.v[:at.n]**2).sum(axis=1).max()))
    shares = []
    for seed, plates in select(tables, "walls", **ROWS).groupby("seed"):
        time = float(select(tables, "kinetic_energy", **ROWS, seed=seed)["t_end"].iloc[0])
        impacts = 2*fastest*plates["reflections"].iloc[0]/(time*2*WIDTH)
        shares.append(float(1 - impacts/(plates["rho_layer"]*plates["T_layer"]).mean()))
    return over_seeds(shares)


FIELD = "against the grid's field as it is, not smoothed"
PLACE_BY_PLACE = f'"of the order of", one digit: half as much again; {FIELD}'
ONE_CONTOUR = "no number is printed: one contour of ten"
SEMI = "semiquantitatively, errors of a few percent"
LAG = '"semiquantitatively" alone has no number; particles come later, the figure fig8 tells how much of it that is'
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
                    "rolls aligned, over rms velocity", value=against(velocity_error, 1e4),
          because=PLACE_BY_PLACE),
    Claim(id="khp95-velocity-field-5000", source="KHP95 Sec. VI", printed="5%", at_most=0.075,
          statement="velocity errors of the order of 5 % at Ra 5000, place by place: rms difference of mean fields, "
                    "rolls aligned, over rms velocity",
          value=against(velocity_error, 5e3),
          because=PLACE_BY_PLACE),
    Claim(id="khp95-within-percent", source="KHP95 Sec. VII", printed="a few percent", at_most=0.05,
          statement="results are within a few percent of converged solutions: velocities place by place, Ra 10 000",
          value=against(velocity_error, 1e4), because=f"a few are five at most; {FIELD}"),
    Claim(id="khp95-fig9-temperature", source="KHP95 Sec. VI, Fig. 9", printed="good agreement", at_most=0.05,
          statement="temperatures of particles and grid agree at Ra 10 000: rms difference over the whole range",
          value=against(contour_error, 1e4, "T"),
          because="no number is printed: a few percent"),
    Claim(id="khp95-fig9-density", source="KHP95 Sec. VI, Fig. 9", printed="good agreement", at_most=0.1,
          statement="densities of particles and grid agree at Ra 10 000: rms difference over the grid's range",
          value=against(contour_error, 1e4, "rho"),
          because=ONE_CONTOUR),
    Claim(id="khp95-fig9-density-plates", source="KHP95 Sec. VI, Fig. 9", printed="good agreement", at_most=0.1,
          statement="densities of particles and grid agree at the plates, too, Ra 10 000: rms difference over the places next "
                    "to a plate, the worse of both, over the grid's range", value=against(edge_error, 1e4, "rho"),
          because=ONE_CONTOUR),
    Claim(id="khp95-wall-layer-density", source="KHP95 Sec. VI, Fig. 9", printed="good agreement", at_most=0.1,
          statement="as many particles lie along the plates as the grid's density asks for, Ra 10 000: difference within one "
                    "spacing of a plate, the worse of both, over the grid's range", value=layer_error,
          because=f"{ONE_CONTOUR}; counted, not smoothed"),
    Claim(id="khp95-approach", source="KHP95 Sec. VI, Fig. 8", printed=SEMI, at_most=0.05, value=approach("ke_field"),
          statement="the approach to the steady state is described semiquantitatively, to a few percent: largest difference of "
                    "K(t) over the steady K, energy of the field",
          because=f"a few are five at most; smoothing lowers K at the start; {LAG}"),
    Claim(id="khp95-approach-particles", source="KHP95 Sec. VI, Fig. 8", printed=SEMI, at_most=0.05, value=approach("ke"),
          statement="the approach to the steady state is described semiquantitatively, to a few percent: largest difference of "
                    "K(t) over the steady K, energy of the particles",
          because=f"a few are five at most; the jitter of the lattice at the start is in K, too; {LAG}"),
    Claim(id="khp95-steady-time", source="KHP95 Fig. 8", printed="same approach", expect=1, within=0.2, value=settling,
          statement="particles need as long as the grid to be steady at Ra 10 000: ratio of times until K is within 5 "
                    "%", because="no number is printed: a fifth; a narrower band would time the noise"),
    Claim(id="khp95-fluctuation-level", source="KHP95 Sec. VI", printed="about 1%", expect=0.01, within=0.01,
          value=fluctuation,
          statement="fluctuations disguise errors of less than 1 %: standard deviation of K(t) over K, 5000 "
                    "particles, Ra 10 000", because='"about", one digit, as an upper bound: twice'),
    Claim(id="khp95-walls-leakproof", source="KHP95 Sec. II", printed="as well as a leak-proof wall",
          at_least=1/PARTICLES, value=losses("printed-fixed-rows"),
          statement="fixed rows need a leak-proof wall besides: particles lost without it, a particle and run, Ra 10 000",
          because="one particle that would have been lost"),
    Claim(id="khp95-images-instead", source="KHP95 Sec. II", printed="use instead", at_most=0, value=losses("printed"),
          statement="mirror images take the place of the leak-proof wall, too: particles lost without it, a particle and run, "
                    "Ra 10 000", because="none is lost"),
    Claim(id="khp95-rows-repel", source="KHP95 Sec. II", printed="capable of repelling", at_least=0.5, value=carried,
          statement="fixed rows, here at the fluid's density, are capable of repelling: share of the pressure on the "
                    "plates that they carry and not the elastic wall",
          because='"capable" has no number: more than half; the share is a lower bound, all impacts are taken to be as '
                  "fast as the fastest particle"),
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
          statement="what particles give at high Ra solves the equations: |Kg/K_grid - 1| at the highest Ra, the finest grid",
          because=f"10 % is the paper's error of K; {ALIKE}", value=right_at_high),
)
