"""Tables of cost, and the names of methods in them, which `studies.build.words` explains.

CPU seconds of one thread; errors relative; `_err`: half width of a 95 % interval. resolution: points to the
wavelength (taylor-green, sound) or rows to the height.
"""
from studies.kit.stats import Measured
from studies.kit.table import Table

GRID = "grid"
MAC = "mac"
PYPDE = "py-pde"
NEAREST = "fixed-lattice-h1.2"
LATTICE = "fixed-lattice"
WIDE = "fixed-lattice-h3"
JITTERED = "fixed-jittered-plates"
ON_TORUS = "fixed-jittered-delaunay"        # the same without plates
AS_MOVING = "fixed-jittered-0.2-plates"     # the same, disordered as moving points start
LUCY = "spam"
MONAGHAN = "spam-monaghan"
WENDLAND = "spam-wendland-c2"
LESS_STATIC = "spam-less-static-50"
MOVING = "moving"
METHODS = (GRID, MAC, PYPDE, NEAREST, LATTICE, WIDE, JITTERED, ON_TORUS, AS_MOVING, LUCY, MONAGHAN, WENDLAND,
           LESS_STATIC, MOVING)

RUN = ["scene", "method", "resolution", "seed"]
COUNT = {"points": ("number of points or cells", ""),
         "resolution": ("points to the wavelength (taylor-green, sound) or rows to the height", "")}
RUNS = Table("runs", key=RUN, columns=[
    *RUN, "points", "of_limit", "dt", "steps", "run_s", "run_s_err", "setup_s", "setup_s_err"], means=COUNT,
    about="The run at the method's own best step (py-pde's by formula).")
ERRORS = Table("errors", key=[*RUN, "quantity"], columns=[*RUN, "quantity", "error", "error_err", "share"],
               about="An error of that run.",
               means=COUNT | {"share": ("share of the steps that this quantity needs", "")})
STEPS = Table("steps", key=[*RUN, "quantity", "of_limit"], columns=[
    *RUN, "quantity", "of_limit", "time_error", "space_error", "accepted"], large=True, means=COUNT,
    about="A trial of a step; of steps longer than one that is accepted the errors are from the half of "
          "that one.")
SERIES = ["scene", "quantity", "method"]
POINTS = Table("points", key=[*SERIES, "resolution"], columns=[
    *SERIES, "resolution", "points", "seeds", "error", "error_err", "cpu_s", "cpu_s_err", "setup_s"],
    means=COUNT | {"cpu_s": ("CPU seconds of all steps and of setting up", "s")},
    about="Error against cost, means over seeds.")
NEEDED = Table("needed", key=[*SERIES, "level"], columns=[
    *SERIES, "level", "reached", "cpu_s", "low", "high", "points", "error"],
    about="What it costs to come below a level of error and stay there.",
    means=COUNT | {"reached": ("yes; at most: the coarsest run is below already; no", ""),
                   "error": ("the level; of those that do not reach it the least error", ""),
                   "cpu_s": ("CPU seconds of all steps and of setting up", "s")})
RIVALS = Table("rivals", key=["scene", "quantity"], columns=[
    "scene", "quantity", "rival", "error", "points", "points_err", "seconds", "seconds_err"],
    about="The printed particles where their error is least, over the grid with that error.",
    means={"points": ("number of points over that of the rival with the same error", "")})
GROWTH = Table("growth", key=["method", "points", "threads", "clock"], columns=[
    "method", "points", "threads", "clock", "step_s", "step_s_err"], means=COUNT,
    about="Seconds of a step by number of particles.")
GROWTH_LAWS = Table("growth_laws", key=["method", "what", "most"], columns=[
    "method", "what", "least", "most", "value", "value_err"],
    about="How these seconds grow.",
    means={"what": ("exponent: d ln(seconds of a step)/d ln(particles); two threads: how much faster than "
                    "one", "")})
ERRORS_OF = (RUNS, ERRORS, STEPS, POINTS, NEEDED, RIVALS, GROWTH, GROWTH_LAWS)

TERM = ["scene", "base", "left_out"]
A_STEP = {"step_s": ("CPU seconds of one point and step", "s"), "bytes": ("bytes of arrays a point", "B"),
          "error": ("relative error of the quantity; none where the run diverged", ""),
          "changed": ("what leaving out changes of the quantity at the same points, adds to its error on "
                      "others, "
                      "or makes of it on any grid", "")}
MEASURED = Table("measured", key=TERM, columns=[
    *TERM, "quantity", "points", "step_s", "step_s_err", "time_s", "time_s_err", "bytes", "error",
    "error_err", "changed"], means=COUNT | A_STEP,
    about="A method with or without something that a scene may need.")
SCENES = Table("scenes", key=TERM, columns=[
    *TERM, "quantity", "step_s", "step_s_err", "bytes", "step_ratio", "step_ratio_err", "time_ratio",
    "time_ratio_err", "bytes_ratio", "error", "changed", "needed"],
    means=A_STEP | {"needed": ("yes where it changes more than 1 %", "")},
    about="The same over the whole of the base.")
TERMS = (MEASURED, SCENES)


def with_err(**values: Measured) -> dict[str, float]:
    """Columns of measured values, and of their errors."""
    row: dict[str, float] = {}
    for name, (value, err) in values.items():
        row |= {name: value, f"{name}_err": err}
    return row
