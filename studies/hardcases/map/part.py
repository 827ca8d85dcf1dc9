"""The map of hard cases: for every method that takes a case, what became of it, as a part of the study."""
from collections.abc import Iterator

from studies.hardcases.map import cases as map_cases
from studies.hardcases.map import claims as map_claims
from studies.hardcases.map import derive as map_derive
from studies.hardcases.map import ends as map_ends
from studies.hardcases.map import figures as map_figures
from studies.hardcases.map import shear as map_shear
from studies.hardcases.map import torus as map_torus
from studies.kit.case import Case
from studies.kit.study import Part
from studies.kit.table import Table

#: K and K of the flow (velocities averaged over 4 x 4 spacings), means of the last third; mass at the end over that of the start
#: less 1; reached: part of the time; refused: why a method does not take the case; rows: over the height
RUNS = Table("hard_runs", key=["case", "method", "rows"], columns=["case", "method", "rows", "k", "flow", "mass_drift", "k_start",
                                                                   "flow_start", "reached", "refused"])
#: the grid at high Ra: mean K, and largest less smallest K over the mean in the last quarter of the time and in the one before;
#: reached: part of the time, where it diverges; step: over the grid's own
STEADINESS = Table("steadiness", key=["ra", "rows", "step"], columns=["ra", "rows", "step", "k", "swing", "before", "rolls",
                                                                      "reached"])
#: outcome by the rules of `map_derive`; number: the name of what is predicted and measured
MAP = Table("map", key=["case", "method", "variant"], columns=["case", "method", "variant", "number", "predicted", "measured",
                                                               "measured_err", "outcome"])


def cases(size: str) -> Iterator[Case]:
    """Layers and boxes, the shear layer, boxes on the grid, and why some end."""
    yield from map_cases.cases(size)
    yield from map_shear.cases(size)
    yield from map_torus.cases(size)
    yield from map_ends.cases(size)


PART = Part(cases=cases, tables=(RUNS, STEADINESS, map_shear.SHEAR, map_ends.ENDS, MAP),
            claims=(*map_claims.CLAIMS, *map_ends.CLAIMS), derive=map_derive.derive, figures=map_figures.figures)
