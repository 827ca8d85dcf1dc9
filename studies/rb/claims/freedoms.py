"""Do particles need fewer numbers than an equally accurate grid?    [KHP95, Sec. VII]"""
from contextlib import suppress
from math import hypot
from typing import Any

from studies.build.read import ALIKE, STILL, grid, limit, particles, same_flow, select
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.rb.claims.lines import finite_grids

COARSEST = 8        # rows of the coarsest grid that the solver takes


def freedoms(tables: Tables) -> Measured:
    """Numbers of particles (5 each) over those of a grid with the same error (4 a cell): at least so many in the best case.

    The error is that of Kg against the grid smoothed alike. Cases in which it is not told from zero, or is half of K, tell
    nothing; where the grid would need fewer rows than the solver takes the ratio is a lower bound.

    Raises
    ------
    CannotTell
        A lower bound below 1 decides nothing.
    """
    frame = select(tables, "errors", energy="Kg", method="spam", variant="printed", transport="const-eta", eos="ideal")
    found = []
    for _, runs in frame.sort_values("particles").groupby(["ra", "sides"]):
        with suppress(CannotTell):
            found += freedom(tables, runs.to_dict("records"))
    if not found:
        raise CannotTell("no smooth particles that flow have grids of the same scene beside them")
    least = min(found, key=lambda one: one.value - one.err)
    if least.value - least.err <= 1:
        raise CannotTell(f"{least.value - least.err:.2g} numbers at least: as a lower bound that does not tell")
    return least


def freedom(tables: Tables, runs: list[dict[Any, Any]]) -> list[Measured]:
    """The same of the rows of `errors` of one scene, particle numbers ascending.

    The error of so many particles is the largest of these and of more: K that passes the right value as the number
    grows is not accurate where it does.
    """
    sides = runs[0]["sides"]
    most, least = per_row(tables, runs[0]["ra"], sides)
    runs = [row for row in runs if of_grid(tables, row)]
    errors = [Measured(abs(row["error"]), row["error_err"]) for row in runs]
    found = []
    for n, row in enumerate(runs):
        mine = max(errors[n:])
        if mine.err < mine.value < 0.5:
            low, middle = (5*row["particles"]/(4*max(COARSEST**2, C/size)*(2 if sides == "periodic" else 1))
                           for C, size in ((most, mine.value - mine.err), (least, mine.value)))
            found.append(Measured(middle, middle - low))
    return found


def per_row(tables: Tables, ra: float, sides: str) -> tuple[float, float]:
    """C of the grid's relative error C/rows^2 of K: the most and the least that one of its grids and their errors allow."""
    end, grids = limit(tables, ra, sides=sides), finite_grids(tables, ra, sides=sides)
    if end.value < STILL or grids.empty:
        raise CannotTell(f"nothing flows at Ra {ra:g}, or no grid is beside its limit")
    C = (grids["ke"]/end.value - 1).abs()*grids["resolution"]**2
    unsure = hypot(end.err, float(grids["ke_err"].max()))/end.value*grids["resolution"]**2
    return float((C + unsure).max()), float(C.min())


def of_grid(tables: Tables, row: dict[Any, Any]) -> bool:
    """Whether the particles of a row of `errors` settled in the grid's flow."""
    point = particles(row["ra"], row["resolution"], sides=row["sides"])
    try:
        same_flow(tables, point, grid(row["ra"], sides=row["sides"]))
    except CannotTell:
        return False
    return True


CLAIMS = (
    Claim(id="khp95-fewer-freedoms", source="KHP95 Sec. VII", at_most=1, value=freedoms,
          statement="in one of these convecting gases, at least, particles need fewer numbers than an equally accurate grid: at "
                    "least so many for one of the grid in the case that suits them best, of those whose error of K is told "
                    "from zero",
          because=f"fewer is below 1; errors of K {ALIKE}; a lower bound, because 8 rows are the least that the grid's solver "
                  "takes; what 8 rows give is extrapolated, second order; \"in some cases\" may be others than convection"),
)
