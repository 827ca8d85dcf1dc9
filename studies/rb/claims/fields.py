"""Claims about the flow of smooth particles: fields, approach to the steady state, neighbours, walls"""
from functools import partial
from math import hypot, inf, sqrt
from typing import Any

from studies.build.measure import RANGE
from studies.build.names import as_printed
from studies.kit import stats
from studies.kit.ask import Value, of, one, per_seed, rows
from studies.kit.claim import Claim
from studies.kit.stats import CannotTell, Measured
from studies.kit.table import Tables
from studies.rb.claims import questions
from studies.rb.claims.questions import ALIKE, diverged, history, mean, rolls_in, same_flow
from studies.rb.tables import Point, besides, grid, particles

STEADY, ROWS = particles(1e4), particles(1e4, variant="printed-fixed-rows")
CELLS = grid(1e4, 50)       # of which K(t) is kept
PARTICLES, WIDTH = 5000, 100
HIGHEST = 1e5               # of smooth particles


def beside_grid(column: str, ra: float = 1e4) -> Value:
    """An error of the mean fields of 5000 particles against the grid's, of the same flow."""
    return same_flow(one("field_errors", column, **particles(ra)), particles(ra), grid(ra))


def seen(column: str, point: Point = STEADY) -> Value:
    """What is counted on the particles at the end of a run."""
    return one("snapshots", column, **point)


def time_of_approach() -> Value:
    """When K is near its late mean for good, particles over grid, Ra 10 000."""
    ratio = per_seed(history(questions.settling, STEADY))/history(questions.settling, CELLS, "ke")
    return same_flow(ratio, STEADY, grid(1e4))


def robust(tables: Tables) -> Measured:
    """Relative change of K between third and last quarter of the run at Ra 100 000; inf if it diverged"""
    point = particles(HIGHEST)
    if diverged(tables, point).any():
        return Measured(inf, 0.0)
    return per_seed(history(questions.drift, point))(tables)


def right_at_high(tables: Tables) -> Measured:
    """|Kg/K - 1| at Ra 100 000, K of the finest grid smoothed alike

    The grid's flow oscillates there for good: it is not extrapolated, its error is what the next coarser grid
    changes.
    """
    point = besides(grid(HIGHEST), "resolution")
    cells = rows(tables, "kinetic_energy", "resolution < inf", need=2, **point).sort_values("resolution")
    coarse, fine = cells.iloc[-2], cells.iloc[-1]
    if rolls_in(tables, particles(HIGHEST)) != int(fine["rolls"]):
        raise CannotTell("particles and grid have different numbers of rolls at Ra 100 000: another flow")
    seen = {"weight": "Lucy", "h": 3.0, "rows": 50, **besides(point, "variant")}
    left = one("smoothed", "ke_smoothed/ke", err="0", **seen)(tables)
    reference = left*Measured(fine["ke"], hypot(fine["ke"] - coarse["ke"], fine["ke_err"]))
    return abs(mean(particles(HIGHEST), "ke_field")(tables)/reference - 1)


def losses(variant: str) -> Value:
    """Particles lost without the elastic wall, a particle and run: none where it turned none back."""
    point = particles(1e4, variant=variant)
    turns = per_seed(one("walls", f"reflections/{PARTICLES}", plate="lower", **point))

    def answer(tables: Tables) -> Measured:
        number = turns(tables)
        if number.value > 0:
            turned = f"turned particles back, {number.value:.2g} times a particle and run"
            raise CannotTell(f"the elastic wall {turned}; but a turn is no loss: a particle beyond the plate "
                             "may come back by itself, and no run here goes without it")
        return number
    return Value(answer, str(turns), turns.asks)


def carried(tables: Tables) -> Measured:
    """Share of the pressure on the plates that fixed rows carry, Ra 10 000, and not the elastic wall

    An impact gives 2 m |v_y|, here twice the largest speed of a particle at the end; P = rho T of the layer.
    """
    fastest = sqrt(seen("fastest", ROWS)(tables).value)
    runs = rows(tables, "kinetic_energy", **ROWS)[["seed", "t_end"]]
    walls = rows(tables, "walls", **ROWS).merge(runs, on="seed")
    impacts = 2*fastest*walls["reflections"]/(walls["t_end"]*2*WIDTH)
    both = (walls["rho_layer"]*walls["T_layer"]).groupby(walls["seed"]).mean()
    return stats.over_seeds(1 - impacts.groupby(walls["seed"]).first()/both)


FIELD = "against the grid's field as it is, not smoothed"
PLACE_BY_PLACE = f'"of the order of", one digit: half as much again; {FIELD}'
ONE_CONTOUR = "no number is printed: one contour of ten"
SEMI = "semiquantitatively, errors of a few percent"
LAG = '"semiquantitatively" alone has no number; particles come later'
AT_FIG9: dict[str, Any] = {"headline": True, "evidence": "rb/fig9.png"}
AT_FIG8: dict[str, Any] = {"headline": True, "evidence": "rb/fig8.png"}
VELOCITY = partial(Claim, source="KHP95 Sec. VI", printed="5%", at_most=0.075, because=PLACE_BY_PLACE)
DENSITY = partial(Claim, source="KHP95 Sec. VI, Fig. 9", printed="good agreement", at_most=0.1)
APPROACH = partial(Claim, source="KHP95 Sec. VI, Fig. 8", printed=SEMI, at_most=0.05)
PAIRS = partial(Claim, because="Lucy's single particles have 1.3, pairs 2 or more")
CLAIMS = (
    Claim(id="khp95-neighbours-range", source="KHP95 Sec. II", printed="20 to 30", at_least=20, at_most=30,
          statement="bulk particles have 20 to 30 neighbours within 3 sigma: mean in a run at Ra 10 000",
          value=seen("neighbours"), because="the printed ends"),
    Claim(id="khp95-range-spacing", source="KHP95 Sec. II", printed="about three times",
          **as_printed("range-spacing"),
          statement="the range is about three nearest-neighbour distances: over the first peak of g(r), Ra "
                    "10 000", value=RANGE/seen("spacing"), because='"about", one digit'),
    VELOCITY(id="khp95-velocity-field-10000", headline=True, value=beside_grid("velocity"),
             statement="velocity errors of the order of 5 % at Ra 10 000, place by place: rms difference of "
                       "mean fields, rolls aligned, over rms velocity"),
    VELOCITY(id="khp95-velocity-field-5000", value=beside_grid("velocity", 5e3),
             statement="velocity errors of the order of 5 % at Ra 5000, place by place: rms difference of "
                       "mean fields, rolls aligned, over rms velocity"),
    Claim(id="khp95-within-percent", source="KHP95 Sec. VII", printed="a few percent", at_most=0.05,
          headline=True, evidence="rb/convergence.png",
          statement="results are within a few percent of converged solutions: velocities place by place, Ra "
                    "10 000", value=beside_grid("velocity"), because=f"a few are five at most; {FIELD}"),
    Claim(id="khp95-fig9-temperature", source="KHP95 Sec. VI, Fig. 9", printed="good agreement", at_most=0.05,
          value=beside_grid("T"), because="no number is printed: a few percent", **AT_FIG9,
          statement="temperatures of particles and grid agree at Ra 10 000: rms difference over the whole "
                    "range"),
    DENSITY(id="khp95-fig9-density", value=beside_grid("rho"), because=ONE_CONTOUR, **AT_FIG9,
            statement="densities of particles and grid agree at Ra 10 000: rms difference over the grid's "
                      "range"),
    DENSITY(id="khp95-fig9-density-plates", value=beside_grid("rho_plates"), because=ONE_CONTOUR, **AT_FIG9,
            statement="densities of particles and grid agree at the plates, too, Ra 10 000: rms difference "
                      "over the places next to a plate, the worse of both, over the grid's range"),
    DENSITY(id="khp95-wall-layer-density", value=beside_grid("rho_layer"),
            because=f"{ONE_CONTOUR}; counted, not smoothed",
            statement="as many particles lie along the plates as the grid's density asks for, Ra 10 000: "
                      "difference within one spacing of a plate, the worse of both, over the grid's range"),
    APPROACH(id="khp95-approach", value=questions.approach(STEADY, CELLS, "ke_field"), **AT_FIG8,
             because=f"a few are five at most; smoothing lowers K at the start; {LAG}",
             statement="the approach to the steady state is described semiquantitatively, to a few percent: "
                       "largest difference of K(t) over the steady K, energy of the field"),
    APPROACH(id="khp95-approach-particles", value=questions.approach(STEADY, CELLS, "ke"),
             because=f"a few are five at most; the jitter of the lattice at the start is in K, too; {LAG}",
             statement="the approach to the steady state is described semiquantitatively, to a few percent: "
                       "largest difference of K(t) over the steady K, energy of the particles"),
    Claim(id="khp95-steady-time", source="KHP95 Fig. 8", printed="same approach", expect=1, within=0.2,
          value=time_of_approach(), **AT_FIG8,
          statement="particles need as long as the grid to be steady at Ra 10 000: ratio of times until K "
                    "is within 5 %",
          because="no number is printed: a fifth; a narrower band would time the noise"),
    Claim(id="khp95-fluctuation-level", source="KHP95 Sec. VI", printed="about 1%", expect=0.01, within=0.01,
          value=per_seed(history(questions.scatter, STEADY)),
          statement="fluctuations disguise errors of less than 1 %: standard deviation of K(t) over K, 5000 "
                    "particles, Ra 10 000", because='"about", one digit, as an upper bound: twice'),
    Claim(id="khp95-walls-leakproof", source="KHP95 Sec. II", printed="as well as a leak-proof wall",
          at_least=1/PARTICLES, value=losses("printed-fixed-rows"),
          statement="fixed rows need a leak-proof wall besides: particles lost without it, a particle and "
                    "run, Ra 10 000", because="one particle that would have been lost"),
    Claim(id="khp95-images-instead", source="KHP95 Sec. II", printed="use instead", at_most=0,
          value=losses("printed"),
          statement="mirror images take the place of the leak-proof wall, too: particles lost without it, a "
                    "particle and run, Ra 10 000", because="none is lost"),
    Claim(id="khp95-rows-repel", source="KHP95 Sec. II", printed="capable of repelling", at_least=0.5,
          value=of(carried),
          statement="fixed rows, here at the fluid's density, are capable of repelling: share of the "
                    "pressure on the plates that they carry and not the elastic wall",
          because='"capable" has no number: more than half; the share is a lower bound, all impacts are '
                  "taken to be as fast as the fastest particle"),
    PAIRS(id="khp95-monaghan-pairs", source="KHP95 Sec. VI, Fig. 10", printed="pairs", at_least=2,
          value=seen("pairing", particles(1e4, variant="printed-monaghan")),
          statement="with Monaghan's weight particles move in pairs: median of second over first neighbour "
                    "distance, Ra 10 000"),
    PAIRS(id="khp95-lucy-no-pairs", source="KHP95 Sec. VI", printed="no such pairing", at_most=1.6,
          value=seen("pairing"),
          statement="with Lucy's weight particles do not pair: median of second over first neighbour "
                    "distance, Ra 10 000"),
    Claim(id="khp95-robust", source="KHP95 Secs VI, VII", printed="continues to provide solutions",
          at_most=0.05, value=of(robust),
          statement="particles give steady solutions at high Ra: change of K in the second half of the run "
                    "at the highest Ra",
          because="finite and steady within their errors of a few percent; whether right is another claim"),
    Claim(id="khp95-robust-right", source="KHP95 Secs VI, VII", printed="solutions", at_most=0.1,
          statement="what particles give at high Ra solves the equations: |Kg/K_grid - 1| at the highest "
                    "Ra, the finest grid", because=f"10 % is the paper's error of K; {ALIKE}",
          value=of(right_at_high)),
)
