"""Claims about the grid's solutions    [KHP95, Sec. V; Sec. VI, Fig. 10]"""
from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from studies.build.names import as_printed, number
from studies.kit import fits
from studies.kit.ask import Array, Value, curve, largest, largest_of, last, of, one, rows
from studies.kit.claim import Claim
from studies.kit.stats import CannotTell, Measured
from studies.kit.table import Tables
from studies.rb.claims import questions
from studies.rb.claims.questions import guarded, limit, mean, refuse_dead, rolls, said
from studies.rb.tables import STILL, besides, grid

DENSE: dict[str, Any] = {"eos": "dense"}
WILD = (5e4, 2e5)   # "higher values" of Ra
FLUCTUATES = 1e-3
DRIFTS = 1e-3       # change of K that is more than steady runs leave
LAST_DIGIT = 5e-6   # half of it, of the printed K
GRIDS = besides(grid(1e4), "resolution")        # of all resolutions, Ra 10 000
PAPER_FORM = GRIDS | {"variant": "paper-form"}
SEVERAL = "1800 <= 2*resolution**2 <= 5000"     # cells
SPECTRAL = grid(1e4, 28) | {"method": "spectral-gas", "variant": ""}
FINISHED = "ke == ke and resolution < inf"      # runs that did not diverge


def coarse_limit(tables: Tables) -> Measured:
    """K at Ra 10 000 of the limit of grids of 5000 cells at most, errors added."""
    coarse = rows(tables, "means", "2*resolution**2 <= 5000", **GRIDS)
    value, err = fits.grid_limit(coarse.resolution, coarse.ke)
    return Measured(value, err + 2*coarse.ke_err.max())


def form_of_continuity(ra: float, heights: tuple[int, ...], **where: Any) -> Value:
    """|K/K - 1| of the paper's form of continuity over the flux form, worst grid."""
    ratios = (mean(grid(ra, height, "paper-form", **where))/mean(grid(ra, height, **where))
              for height in heights)
    return largest_of(*(abs(ratio - 1) for ratio in ratios))


def refuse_diverged_grids(tables: Tables, **where: Any) -> None:
    """Refuse grids of which all runs diverged."""
    runs = rows(tables, "kinetic_energy", **where)
    if runs.ke.isna().all():
        last = runs.t_end.max()
        raise CannotTell(f"all {len(runs)} runs of the grid diverged, the last at t = {last:.0f}")


@curve
def change_after_4000(t: Array, ke: Array, err: Array) -> Measured:
    """|K(0.8)/K(end) - 1|, t in L^2/eta, which ends at 0.9."""
    return Measured(abs(np.interp(0.8, t, ke)/ke[-1] - 1))


def scattered(ra: float, height: int) -> Value:
    """Relative standard deviation of K(t) in the last half of a run of 2.1 L^2/eta."""
    return questions.history(questions.scatter, grid(ra, height), "ke")


def drift_of_dense() -> Value:
    """|K/K - 1| of the dense fluid at Ra 3000 after 20 L^2/eta, of the paper's form of continuity against the
    flux form, whose K stays; the worst grid.
    """
    change = questions.history(questions.drift, grid(3000, 24, **DENSE))

    def check(tables: Tables) -> None:
        if (most := change(tables).value) > DRIFTS:
            raise CannotTell(f"K of the flux form drifts, too, by {most:.2g}: it is no reference")
    return guarded(form_of_continuity(3000, (16, 24, 32), **DENSE), check)


def in_square(column: str, check: Callable[[pd.Series], None], **where: Any) -> Value:
    """A column of the finest grid of a variant in the square, whose row a check does not refuse."""
    where = {"method": "compressible", "sides": "walls", **where}

    def finest(tables: Tables) -> None:
        refuse_diverged_grids(tables, **where)
        runs = rows(tables, "kinetic_energy", FINISHED, **where)
        check(runs.sort_values("resolution").iloc[-1])
    return guarded(last("kinetic_energy", column, FINISHED, by="resolution", **where), finest)


def refuse_changing(row: pd.Series) -> None:
    """Refuse two rolls that still change, or died: two equal rolls are symmetric, and a grid keeps that."""
    if row.rolls == 2 and str(row.converged) != "True":
        raise CannotTell(f"the two rolls of the start are there at t = {row.t_end:.0f}, but not steady")
    refuse_dead(row)


#: drift of mass per L^2/eta = L sqrt(Ra), L = 50, with ghost density 1, on the worst grid
MASS_LOST = largest("kinetic_energy", "abs(mass_drift)/(t_end/(50*sqrt(ra)))", FINISHED, **PAPER_FORM)
LAST = "half of the last printed digit"
ALMOST = ('"almost exactly" has no number: 1 %, what Sec. VI says that the fluctuations disguise of the '
          "particles which the line is there to be compared with")
NEXT = ("the next term, L^-4, is 0.1 % of the first at 30 rows, times a factor that may be tens at thin "
        "layers")
#: end of a name: figure, sides and fluid, what is said of them
LINES: dict[str, tuple[str, dict[str, str], str]] = {
    "ke-line": ("Fig. 5", {}, "onset to four times onset, ideal gas, constant eta"),
    "ke-line-const-nu": ("Fig. 5", {"transport": "const-nu"},
                         "onset to four times onset, ideal gas, constant nu"),
    "vdw-panel": ("Fig. 5", {"eos": "vdw"}, "onset to four times onset, van der Waals"),
    "ke-line-square": ("Fig. 6", {"sides": "walls"},
                       "onset, 5012, to four times onset in the square, one roll")}
SHOWN = {"ke-line": "rb/main.png", "ke-line-square": ""}


def energies() -> Iterator[Claim]:
    """The printed K, of either transport law."""
    laws = {"": ("const-eta", "constant eta"),
            "-const-nu": ("const-nu", "read as constant nu (which one is not said)")}
    for (ra, printed), (end, (law, words)) in product((("5000", "0.003 40"), ("10 000", "0.004 81")),
                                                      laws.items()):
        name = f"ke-{ra}".replace(" ", "")
        main = name + end == "ke-5000"
        yield said(f"{name}{end}", "Sec. VI", printed, limit(float(name[3:]), transport=law),
                   f"K of the infinitely fine grid, ideal gas, Ra {ra}, {words}", LAST, **as_printed(name),
                   headline=main, evidence="rb/main.png" if main else "")


def lines() -> Iterator[Claim]:
    """K against Ra^-1/2, and what belongs to its lines against L^-2."""
    for name, (figure, where, words) in LINES.items():
        yield said(name, f"Sec. V, {figure}", "almost exactly linearly", questions.straightness(**where),
                   f"K is linear in Ra^-1/2 from {words}: largest distance over K(4 Ra_c)", ALMOST,
                   at_most=0.01, headline=name in SHOWN, evidence=SHOWN.get(name, ""))
    for name, of_line in (("slopes", questions.slope_alone), ("intercepts", questions.intercept_alone)):
        yield said(f"{name}-l2", "Sec. V", "almost exactly linearly with L^-2",
                   questions.against_cells(of_line),
                   f"{name} of the lines are linear in L^-2: largest distance over the whole change", NEXT,
                   headline=True, at_most=0.05)


CLAIMS = (
    *energies(),
    *lines(),
    Claim(id="own-ke-10000-line", source="KHP95 Secs V, VI",
          statement="0.004 81 is what the straight line in Ra^-1/2 through 1.2 to 4 times onset gives at Ra "
                    "10 000", value=questions.line(questions.reading(1e4, anew=True), low=1.2),
          **as_printed("ke-10000"), because=LAST),
    Claim(id="own-ke-line-beyond", source="KHP95 Secs V, VI",
          statement="the line may be read at Ra 10 000 = 5.9 times onset: K over the line, less 1",
          value=limit(1e4)/questions.line(questions.reading(1e4), low=1.2) - 1, expect=0,
          within=LAST_DIGIT/number("ke-10000"), because=f"{LAST} of K at Ra 10 000"),
    said("ghost-density-mass", "Sec. V", "unity",
         guarded(MASS_LOST, refuse_diverged_grids, **PAPER_FORM),
         "density 1 outside of the system is no trouble: mass lost per L^2/eta",
         "no trouble is less than the last printed digit of K, near onset after some time of 10 L^2/eta",
         at_most=1e-3),
    said("ghost-density-energy", "Sec. V", "unity", form_of_continuity(1e4, (24, 32, 48)),
         "density 1 outside of the system is no trouble: K against the conservative form on the same grid",
         "half of the last printed digit of 0.004 81", at_most=1e-3),
    said("grid-converged", "Sec. V", "several thousand cells",
         abs(last("means", "ke", SEVERAL, by="resolution", **GRIDS)/limit(1e4) - 1),
         "several thousand cells are fully converged by themselves: error of K at Ra 10 000 on the finest "
         "grid of 1800 (30 x 60) to 5000", f"{LAST} of K: fully converged, all of them are right",
         at_most=LAST_DIGIT/number("ke-10000")),
    said("grid-cells", "Secs V, VI", "several thousand cells",
         abs(of(coarse_limit) - one("means", "ke", **SPECTRAL)),
         "grids of 5000 cells at most, extrapolated in L^-2, give K at Ra 10 000 fully converged: distance "
         "between this limit and the spectral method",
         f"{LAST} of K; 50 x 100 is the largest grid that is named", at_most=LAST_DIGIT),
    said("grid-fluctuates", "Sec. VI", "begin to fluctuate", largest_of(*(scattered(ra, 50) for ra in WILD)),
         "K of centred differences on 50 rows fluctuates at Ra of 50 000 or more",
         "steady runs leave less than 1e-5", at_least=FLUCTUATES),
    said("fluctuate-physical", "Sec. VI", "more sophisticated techniques",
         scattered(max(WILD), 100)/scattered(max(WILD), 50),
         "fluctuations at Ra of 50 000 or more are of the grid, not of the flow: scatter on 100 rows over "
         "that on 50 rows", "second order; if it stays, it is the flow", at_most=0.25),
    said("transient-grid", "Fig. 8", "two rolls", rolls(grid(1e4)),
         "the printed initial rolls lead to a steady state of two rolls at Ra 10 000", "a whole number",
         **as_printed("fig8-rolls")),
    said("fig9-time", "Figs 8, 9, 12", "5000",
         change_after_4000("history", "ke", "t_viscous", **grid(1e4, 50)),
         "the flow at Ra 10 000 is steady by t = 5000: change of K from 4000 on",
         "no number is printed: 1 %, the size of the fluctuations of particles", at_most=0.01),
    said("heat-transport", "Sec. IV", "more efficiently", limit(1e4, "nu"),
         "convection carries heat better than conduction alone: Nusselt number at Ra 10 000",
         "conduction alone is 1", at_least=1),
    said("dense-divergence", "Sec. IV", "slow divergence", drift_of_dense(),
         "grid runs of the dense fluid slowly diverge at very long times, density 1 outside of the system: "
         "|K/K - 1| after 20 L^2/eta against the flux form, whose K stays",
         "steady runs leave less than 1e-5", at_least=DRIFTS,
         after="the flux form had been seen to be steady"),
    said("two-rolls-square", "Sec. VI, Fig. 10", "two rolls",
         in_square("rolls", refuse_dead, variant="fig10", eos="ideal"),
         "the ideal gas of Fig. 10 in the square convects with two rolls, on the grid", "a whole number",
         **as_printed("fig10-rolls")),
    said("fig10-dense", "Sec. VI, Fig. 10", "dense fluid",
         in_square("ke", lambda row: None, variant="fig10", eos="dense"),
         "the dense fluid flows in the square between temperatures 10 and 0.5: K of the grid at the Ra of "
         "the ideal gas", "above what is left of rest", at_least=STILL),
    said("one-roll-square", "Sec. VI, Fig. 10", "one",
         in_square("rolls", refuse_changing, variant="two-rolls", ra=7000.0),
         "two rolls in the square give way to one near onset: rolls at Ra 7000 after a start with two",
         "a whole number", expect=1, within=0),
)
