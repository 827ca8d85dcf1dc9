"""Tables of cost, and the names of methods in them.

CPU seconds of one thread; errors relative; `_err`: half width of a 95 % interval. resolution: points to the
wavelength (taylor-green, sound) or rows to the height.
"""
from studies.build.labels import LABELS
from studies.kit.stats import Measured
from studies.kit.table import Table

GRID = LABELS["grid"]
MAC = "MAC grid, IMEX"
PYPDE = "py-pde, gas"
NEAREST = LABELS["fixed-lattice-h1.2"]
LATTICE = LABELS["fixed-lattice"]
WIDE = LABELS["fixed-lattice-h3"]
JITTERED = LABELS["fixed-jittered-plates"]
LUCY = LABELS["spam"]
MONAGHAN = LABELS["spam-monaghan"]
WENDLAND = LABELS["spam-wendland-c2"]
LESS_STATIC = LABELS["spam-less-static-50"]
MOVING = LABELS["moving"]
METHODS = (GRID, MAC, PYPDE, NEAREST, LATTICE, WIDE, JITTERED, LUCY, MONAGHAN, WENDLAND, LESS_STATIC, MOVING)

RUN = ["scene", "method", "resolution", "seed"]
#: what the run at the method's own best step takes (py-pde's by formula): points, steps of dt (`of_limit`: of
#: the stability limit), CPU seconds of the steps, of setting up
RUNS = Table("runs", key=RUN, columns=[
    *RUN, "points", "of_limit", "dt", "steps", "run_s", "run_s_err", "setup_s", "setup_s_err"])
#: share: of the steps that this quantity needs (a steady state is reached, and averaged, before the run ends)
ERRORS = Table("errors", key=[*RUN, "quantity"], columns=[*RUN, "quantity", "error", "error_err", "share"])
#: how the step was found: what halving it changes (time_error) against the error that is left then
#: (space_error); for steps longer than one that is accepted, the change and the error from the half of that
#: one
STEPS = Table("steps", key=[*RUN, "quantity", "of_limit"], columns=[
    *RUN, "quantity", "of_limit", "time_error", "space_error", "accepted"])
SERIES = ["scene", "quantity", "method"]
#: means over seeds: error against CPU seconds of steps and setting up
POINTS = Table("points", key=[*SERIES, "resolution"], columns=[
    *SERIES, "resolution", "points", "seeds", "error", "error_err", "cpu_s", "cpu_s_err", "setup_s"])
#: CPU seconds at which each method comes below a level of error and stays there; reached: yes, at most (its
#: coarsest run is below already) or no (then error is the least one); points there
NEEDED = Table("needed", key=[*SERIES, "level"], columns=[
    *SERIES, "level", "reached", "cpu_s", "low", "high", "points", "error"])
#: the printed particles of least error over the grid with that error: points and CPU seconds
RIVALS = Table("rivals", key=["scene", "quantity"], columns=[
    "scene", "quantity", "rival", "error", "points", "points_err", "seconds", "seconds_err"])
#: seconds of a step by number of particles: CPU time, or the time that passes
GROWTH = Table("growth", key=["method", "points", "threads", "clock"], columns=[
    "method", "points", "threads", "clock", "step_s", "step_s_err"])
#: d ln(seconds of a step)/d ln(particles); of two threads: how much faster than one
GROWTH_LAWS = Table("growth_laws", key=["method", "what", "most"], columns=[
    "method", "what", "least", "most", "value", "value_err"])
ERRORS_OF = (RUNS, ERRORS, STEPS, POINTS, NEEDED, RIVALS, GROWTH, GROWTH_LAWS)

TERM = ["scene", "base", "left_out"]
#: `base` without `left_out` ("nothing": all of it). step_s: CPU seconds of a point and step; time_s: of a
#: point and unit of time; bytes of arrays a point; error: of the main quantity, nan where the run diverged;
#: changed: what leaving out changes of it at the same points, adds to its error on others, or makes of it on
#: any grid
MEASURED = Table("measured", key=TERM, columns=[
    *TERM, "quantity", "points", "step_s", "step_s_err", "time_s", "time_s_err", "bytes", "error",
    "error_err", "changed"])
#: step, time, memory: of what is left over the whole of the base; needed: yes where it changes more than 1 %
SCENES = Table("scenes", key=TERM, columns=[
    *TERM, "quantity", "step_s", "step_s_err", "bytes", "step_ratio", "step_ratio_err", "time_ratio",
    "time_ratio_err", "bytes_ratio", "error", "changed", "needed"])
TERMS = (MEASURED, SCENES)


def with_err(**values: Measured) -> dict[str, float]:
    """Columns of measured values, and of their errors."""
    row: dict[str, float] = {}
    for name, (value, err) in values.items():
        row |= {name: value, f"{name}_err": err}
    return row
