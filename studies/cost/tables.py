"""Tables of cost, and the names of methods in them, which `studies.build.names` explains.

CPU seconds of one thread; errors relative; `_err`: half width of a 95 % interval. resolution: points to the
wavelength (taylor-green, sound) or rows to the height.
"""
from studies.kit.stats import Measured
from studies.kit.table import Table

GRID = "grid"
MAC = "mac"
PYPDE = "py-pde"
SPECTRAL = "spectral-gas"
NEAREST = "fixed-lattice-h1.2"
LATTICE = "fixed-lattice"
WIDE = "fixed-lattice-h3"
JITTERED = "fixed-jittered-plates"
LUCY = "spam"
MOVING = "moving"
CARRIED = "moving-delaunay"
#: scene of another fluid, which `bench` runs; LAMMPS' styles there -> their names here
BOUSSINESQ, LAMMPS = "boussinesq", {"sph": "LAMMPS sph", "rheo": "LAMMPS RHEO"}
METHODS = (GRID, MAC, PYPDE, SPECTRAL, NEAREST, LATTICE, WIDE, JITTERED, "fixed-jittered-delaunay",
           "fixed-jittered-0.2-plates", LUCY, "spam-monaghan", "spam-wendland-c2", "spam-less-static-50",
           "spam-corrected", "spam-sumB", CARRIED, MOVING, *LAMMPS.values())

RUN = "scene method resolution seed"
SERIES = "scene quantity method"
COUNT = {"points": ("number of points, of cells or of functions", ""),
         "resolution": ("points to the wavelength (taylor-green, sound) or rows to the height, of "
                        "spectral-gas functions along an axis", "")}
SECONDS = {"cpu_s": ("CPU seconds of all steps and of setting up; of LAMMPS 90 free-fall times", "s")}
POINTS = Table.of(
    "points", f"{SERIES} resolution", "points seeds error error_err cpu_s cpu_s_err setup_s",
    means=COUNT | SECONDS, about="Error against cost, means over seeds; boussinesq is from bench.")
TABLES = (
    Table.of("runs", RUN, "points of_limit dt steps run_s run_s_err setup_s setup_s_err", means=COUNT,
             about="The run at the method's own best step (py-pde's by formula)."),
    Table.of("errors", f"{RUN} quantity", "error error_err share", about="An error of that run.",
             means=COUNT | {"share": ("share of the steps that this quantity needs", "")}),
    Table.of("steps", f"{RUN} quantity of_limit", "time_error space_error accepted", large=True, means=COUNT,
             about="A trial of a step; of steps longer than one that is accepted the errors are from the "
                   "half of that one."),
    POINTS,
    Table.of("needed", f"{SERIES} level", "reached cpu_s low high points error",
             about="What it costs to come below a level of error and stay there.",
             means=COUNT | SECONDS | {
                 "reached": ("yes; at most: the coarsest run is below already; no", ""),
                 "error": ("the level; of those that do not reach it the least error", "")}),
    Table.of("rivals", "scene quantity", "rival error points points_err seconds seconds_err",
             about="The printed particles where their error is least, over the grid with that error.",
             means={"points": ("number of points over that of the rival with the same error", "")}),
    Table.of("growth", "method points threads clock", "step_s step_s_err", means=COUNT,
             about="Seconds of a step by number of particles."),
    Table.of("memory", "method points", "before resident peak", means=COUNT | {
        "before": ("bytes of the process before any point is made", "B"),
        "resident": ("the same in its steps", "B"), "peak": ("at most, setting up included", "B")},
             about="Resident memory of a process by number of particles."),
    Table.of("growth_laws", "method what least", "most value value_err", about="How these seconds grow.",
             means={"what": ("exponent: d ln(seconds of a step)/d ln(particles); two threads: how much "
                             "faster than one", "")}),
)


def with_err(**values: Measured) -> dict[str, float]:
    """Columns of measured values, and of their errors."""
    row: dict[str, float] = {}
    for name, (value, err) in values.items():
        row |= {name: value, f"{name}_err": err}
    return row
