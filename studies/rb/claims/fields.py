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
from studies.rb.claims.questions import ALIKE, diverged, guarded, history, mean, rolls_in, said, same_flow
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


def robust(tables: Tables) -> Measured:
    """Relative change of K between third and last quarter of the run at Ra 100 000; inf if it diverged"""
    if diverged(tables, particles(HIGHEST)).any():
        return Measured(inf)
    return per_seed(history(questions.drift, particles(HIGHEST)))(tables)


def right_at_high(tables: Tables) -> Measured:
    """|Kg/K - 1| at Ra 100 000, K of the finest grid smoothed alike

    The grid's flow oscillates there for good: it is not extrapolated, its error is what the next coarser grid
    changes.
    """
    point = besides(grid(HIGHEST), "resolution")
    cells = rows(tables, "kinetic_energy", "resolution < inf", need=2, **point).sort_values("resolution")
    coarse, fine = (cells.iloc[at] for at in (-2, -1))
    if rolls_in(tables, particles(HIGHEST)) != fine.rolls:
        raise CannotTell("particles and grid have different numbers of rolls at Ra 100 000: another flow")
    seen = {"weight": "Lucy", "h": 3.0, "rows": 50, **besides(point, "variant")}
    left = one("smoothed", "ke_smoothed/ke", err="0", **seen)(tables)
    reference = left*Measured(fine.ke, hypot(fine.ke - coarse.ke, fine.ke_err))
    return abs(mean(particles(HIGHEST), "ke_field")(tables)/reference - 1)


def losses(variant: str) -> Value:
    """Particles lost without the elastic wall, a particle and run: none where it turned none back."""
    point = particles(1e4, variant=variant)
    turns = per_seed(one("walls", f"reflections/{PARTICLES}", plate="lower", **point))

    def check(tables: Tables) -> None:
        if (number := turns(tables).value) > 0:
            raise CannotTell(f"the elastic wall turned particles back, {number:.2g} times a particle and "
                             "run; but a turn is no loss: a particle beyond the plate may come back by "
                             "itself, and no run here goes without it")
    return guarded(turns, check)


def carried(tables: Tables) -> Measured:
    """Share of the pressure on the plates that fixed rows carry, Ra 10 000, and not the elastic wall

    An impact gives 2 m |v_y|, here twice the largest speed of a particle at the end; P = rho T of the layer.
    """
    fastest = sqrt(seen("fastest", ROWS)(tables).value)
    runs = rows(tables, "kinetic_energy", **ROWS)[["seed", "t_end"]]
    walls = rows(tables, "walls", **ROWS).merge(runs, on="seed")
    impacts = 2*fastest*walls.reflections/(walls.t_end*2*WIDTH)
    by_seed = walls.assign(impacts=impacts, P=walls.rho_layer*walls.T_layer).groupby("seed")
    return stats.over_seeds(1 - by_seed.impacts.first()/by_seed.P.mean())


#: when K is near its late mean for good, particles over grid, Ra 10 000
TIMES = per_seed(history(questions.settling, STEADY))/history(questions.settling, CELLS, "ke")
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
    said("neighbours-range", "Sec. II", "20 to 30", seen("neighbours"),
         "bulk particles have 20 to 30 neighbours within 3 sigma: mean in a run at Ra 10 000",
         "the printed ends", at_least=20, at_most=30),
    said("range-spacing", "Sec. II", "about three times", RANGE/seen("spacing"),
         "the range is about three nearest-neighbour distances: over the first peak of g(r), Ra 10 000",
         '"about", one digit', **as_printed("range-spacing")),
    *(VELOCITY(id=f"khp95-velocity-field-{ra}", headline=ra == 10000, value=beside_grid("velocity", ra),
               statement=f"velocity errors of the order of 5 % at Ra {words}, place by place: rms difference "
                         "of mean fields, rolls aligned, over rms velocity")
      for ra, words in ((10000, "10 000"), (5000, "5000"))),
    said("within-percent", "Sec. VII", "a few percent", beside_grid("velocity"),
         "results are within a few percent of converged solutions: velocities place by place, Ra 10 000",
         f"a few are five at most; {FIELD}", at_most=0.05, headline=True, evidence="rb/convergence.png"),
    said("fig9-temperature", "Sec. VI, Fig. 9", "good agreement", beside_grid("T"),
         "temperatures of particles and grid agree at Ra 10 000: rms difference over the whole range",
         "no number is printed: a few percent", **AT_FIG9, at_most=0.05),
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
    *(APPROACH(id=f"khp95-approach{end}", value=questions.approach(STEADY, CELLS, energy),
               headline=not end, evidence="" if end else "rb/fig8.png",
               because=f"a few are five at most; {but}; {LAG}",
               statement="the approach to the steady state is described semiquantitatively, to a few "
                         f"percent: largest difference of K(t) over the steady K, energy of the {whose}")
      for end, energy, whose, but in (
          ("", "ke_field", "field", "smoothing lowers K at the start"),
          ("-particles", "ke", "particles", "the jitter of the lattice at the start is in K, too"))),
    said("steady-time", "Fig. 8", "same approach", same_flow(TIMES, STEADY, grid(1e4)),
         "particles need as long as the grid to be steady at Ra 10 000: ratio of times until K is within 5 "
         "%", "no number is printed: a fifth; a narrower band would time the noise", **AT_FIG8, expect=1,
         within=0.2),
    said("fluctuation-level", "Sec. VI", "about 1%", per_seed(history(questions.scatter, STEADY)),
         "fluctuations disguise errors of less than 1 %: standard deviation of K(t) over K, 5000 "
         "particles, Ra 10 000", '"about", one digit, as an upper bound: twice', expect=0.01, within=0.01),
    said("walls-leakproof", "Sec. II", "as well as a leak-proof wall", losses("printed-fixed-rows"),
         "fixed rows need a leak-proof wall besides: particles lost without it, a particle and run, Ra 10 "
         "000", "one particle that would have been lost", at_least=1/PARTICLES),
    said("images-instead", "Sec. II", "use instead", losses("printed"),
         "mirror images take the place of the leak-proof wall, too: particles lost without it, a particle "
         "and run, Ra 10 000", "none is lost", at_most=0),
    said("rows-repel", "Sec. II", "capable of repelling", of(carried),
         "fixed rows, here at the fluid's density, are capable of repelling: share of the pressure on the "
         "plates that they carry and not the elastic wall",
         '"capable" has no number: more than half; the share is a lower bound, all impacts are taken to be '
         "as fast as the fastest particle", at_least=0.5),
    PAIRS(id="khp95-monaghan-pairs", source="KHP95 Sec. VI, Fig. 10", printed="pairs", at_least=2,
          value=seen("pairing", particles(1e4, variant="printed-monaghan")),
          statement="with Monaghan's weight particles move in pairs: median of second over first neighbour "
                    "distance, Ra 10 000"),
    PAIRS(id="khp95-lucy-no-pairs", source="KHP95 Sec. VI", printed="no such pairing", at_most=1.6,
          value=seen("pairing"),
          statement="with Lucy's weight particles do not pair: median of second over first neighbour "
                    "distance, Ra 10 000"),
    said("robust", "Secs VI, VII", "continues to provide solutions", of(robust),
         "particles give steady solutions at high Ra: change of K in the second half of the run at the "
         "highest Ra",
         "finite and steady within their errors of a few percent; whether right is another claim",
         at_most=0.05),
    said("robust-right", "Secs VI, VII", "solutions", of(right_at_high),
         "what particles give at high Ra solves the equations: |Kg/K_grid - 1| at the highest Ra, the "
         "finest grid", f"10 % is the paper's error of K; {ALIKE}", at_most=0.1),
)
