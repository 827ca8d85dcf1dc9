"""Tables of cost. CPU seconds of one thread; errors relative; `_err`: half width of a 95 % interval.

resolution: points to the wavelength (taylor-green, sound) or rows to the height (between plates).
"""
from studies.kit.table import Table

RUN = ["scene", "method", "resolution", "seed"]
#: what the run at the method's own best step takes (py-pde's by formula): points, steps of dt (`of_limit`: of the
#: stability limit), CPU seconds of the steps, of setting up, of compiling (from the second process on: of loading what
#: is compiled), bytes of arrays
RUNS = Table("runs", key=RUN, columns=[
    *RUN, "points", "of_limit", "dt", "steps", "run_s", "run_s_err", "setup_s", "setup_s_err", "compile_s", "bytes",
    "threads"])
#: share: of the steps that this quantity needs (a steady state is reached, and averaged, before the run ends)
ERRORS = Table("errors", key=[*RUN, "quantity"], columns=[*RUN, "quantity", "error", "error_err", "share"])
#: how the step was found: what halving it changes (time_error) against the error that is left then (space_error); for
#: steps longer than one that is accepted, the change and the error from the half of that one
STEPS = Table("steps", key=[*RUN, "quantity", "of_limit"], columns=[
    *RUN, "quantity", "of_limit", "time_error", "space_error", "accepted"])
SERIES = ["scene", "quantity", "method"]
#: means over seeds: error against CPU seconds of steps and setting up
POINTS = Table("points", key=[*SERIES, "resolution"], columns=[
    *SERIES, "resolution", "points", "seeds", "error", "error_err", "cpu_s", "cpu_s_err", "setup_s", "bytes"])
#: d ln(CPU seconds)/d ln(1/error) over all resolutions of a method
EXPONENTS = Table("exponents", key=SERIES, columns=[*SERIES, "number", "exponent", "exponent_err"])
#: CPU seconds at which each method comes below a level of error and stays there; reached: yes, at most (its coarsest
#: run is below already) or no (then error is the least one); points there
NEEDED = Table("needed", key=[*SERIES, "level"], columns=[
    *SERIES, "level", "reached", "cpu_s", "low", "high", "points", "error"])
LEVEL = ["scene", "quantity", "level"]
#: the cheapest of them, with the interval [low, high] of its seconds
CHEAPEST = Table("cheapest", key=LEVEL, columns=[*LEVEL, "method", "reached", "cpu_s", "low", "high", "points"])
#: the printed particles of least error over the grid (or lattice) with that error: points and CPU seconds
RIVALS = Table("rivals", key=["scene", "quantity"], columns=[
    "scene", "quantity", "rival", "error", "points", "points_err", "seconds", "seconds_err"])
#: seconds of a step by number of particles: CPU time, or the time that passes; bytes of arrays while it runs, and what
#: the process takes beyond what it had, setting up included (of CPU time only: one and two threads take turns)
GROWTH = Table("growth", key=["method", "points", "threads", "clock"], columns=[
    "method", "points", "threads", "clock", "step_s", "step_s_err", "bytes", "peak_bytes"])
#: d ln(seconds of a step)/d ln(particles); of two threads: how much faster than one
GROWTH_LAWS = Table("growth_laws", key=["method", "what", "most"], columns=[
    "method", "what", "least", "most", "value", "value_err"])
#: bytes of arrays while the finest run goes on, and of each point
MEMORY = Table("memory", key=["scene", "method"], columns=[
    "scene", "method", "resolution", "points", "bytes", "bytes_a_point"])
ERRORS_OF = (RUNS, ERRORS, STEPS, POINTS, EXPONENTS, NEEDED, CHEAPEST, RIVALS, GROWTH, GROWTH_LAWS, MEMORY)

TERM = ["scene", "base", "left_out"]
#: `base` without `left_out` ("nothing": all of it). step_s: CPU seconds of a point and step; time_s: of a point and unit
#: of time; bytes of arrays a point; loops: compiled loops that an evaluation calls, by name; error: of the main quantity
#: against the exact answer, nan where the run diverged; changed: what leaving out changes of it at the same points, adds
#: to its error on others, or makes of it whatever the grid (another fluid)
MEASURED = Table("measured", key=TERM, columns=[
    *TERM, "quantity", "points", "step_s", "step_s_err", "time_s", "time_s_err", "bytes", "loops", "names", "error",
    "error_err", "changed"])
#: step, time, memory: of what is left over the whole of the base; needed: yes where what it changes is above 1 %
SCENES = Table("scenes", key=TERM, columns=[
    *TERM, "quantity", "step_s", "step_s_err", "bytes", "step_ratio", "step_ratio_err", "time_ratio", "time_ratio_err",
    "bytes_ratio", "loops", "error", "changed", "needed"])
TERMS = (MEASURED, SCENES)
