"""Tables of the study `rb`: fixed columns, in which all solvers meet.

Energies are per mass in KHP95's units, m = kB = sigma = epsilon = 1 with dT = 1 (free-fall units for the
ideal gas, where `free_fall`, the unit of velocity sqrt(g alpha dT L), is 1; Boussinesq rows are in free-fall
units). `ke` is of all particles, `ke_field` of the smoothed field, `ke_mean` of velocities averaged over
time. Lengths in heights L, times in L^2/eta where not said otherwise. Every `_err` is the half width of a 95
% interval.
"""
from math import inf

from studies.kit.table import STAMP, Table

Point = dict
SCENE = ["eos", "transport", "sides", "ra", "pr"]
POINT = ["method", "variant", *SCENE, "resolution"]
RUN = [*POINT, "seed"]
STEP = ["method", "variant", "eos", "sides", "resolution"]


def with_err(*names: str) -> list[str]:
    """Columns, each with its error."""
    return [column for name in names for column in (name, f"{name}_err")]


KINETIC = Table("kinetic_energy", key=RUN, columns=[
    *POINT, "particles", "seed", *with_err("ke", "ke_field", "ke_mean"), "ke_fluctuation", *with_err("nu"),
    "rolls", "free_fall", "mass_drift", "converged", "dt", "steps", "t_end", "cpu_s", "compile_s", "threads"])
#: means over the `seeds` that settled in the commonest number of rolls: the error is the larger of those
#: within runs and between seeds, and twice what half of the time step changes; `mixed` counts seeds that
#: ended in other rolls
MEANS = Table("means", key=POINT, columns=[
    *POINT, "particles", "seeds", "mixed", *with_err("ke", "ke_field", "ke_mean"), "ke_fluctuation",
    *with_err("nu"), "rolls"])
#: approach to the steady state [KHP95, Fig. 8]; t in units of time, not L^2/eta
HISTORY = Table("history", key=[*RUN, "t"], columns=[*RUN, "t", "t_viscous", "ke", "ke_field"],
                digits={"t_viscous": ".6g", "ke": ".8g", "ke_field": ".8g"}, once=[*RUN, *STAMP])
#: steady fields on KHP95's 30 x 60 places [Figs 9, 12]; x, y in units of L; particles: means over the second
#: half
FIELDS = Table("fields", key=[*RUN, "x", "y"], columns=[*RUN, "x", "y", "rho", "T", "vx", "vy"],
               digits={"x": ".4f", "y": ".4f", "rho": ".5f", "T": ".5f", "vx": ".6f", "vy": ".6f"},
               once=[*RUN, *STAMP])
#: particles at the end of a run [Figs 2, 3, 7, 12]; kind: fluid, fixed or image
PARTICLES = Table("particles", key=[*RUN, "number"],
                  columns=[*RUN, "number", "kind", "x", "y", "vx", "vy", "T"],
                  digits={"x": ".6f", "y": ".6f", "vx": ".5f", "vy": ".5f", "T": ".4f"},
                  once=[*RUN, "kind", *STAMP])
WALLS = Table("walls", key=[*RUN, "plate"], columns=[
    *RUN, "plate", "T_wall", "T_layer", "rho_layer", "reflections", *with_err("nu_plate")])
#: seconds of a step, measured alone
COST = Table("cost", key=STEP, columns=[*STEP, "points", *with_err("step_s"), "dt", "threads"])
#: error against cost, derived; energy Kp: of all particles against the grid, Kg: smoothed against the grid
#: smoothed alike, Nu: the Nusselt number (then ke, reference are Nusselt numbers)
ERRORS = Table("errors", key=[*POINT, "energy"], columns=[
    *POINT, "energy", "particles", *with_err("ke", "reference", "error"), "cpu_s"])
#: K of the finest grid's field, and smoothed with a weight of range h spacings, `rows` of them a height
SMOOTHED = Table("smoothed", key=[*POINT, "weight", "h", "rows"],
                 columns=[*POINT, "weight", "h", "rows", "ke", "ke_smoothed"])
#: of the particles at the end, first seed: mean number of neighbours in range, first peak of g(r), median of
#: second over first neighbour distance, particles a site, largest v^2, correlation of accelerations with
#: those of the potential 2 w
SNAPSHOTS = Table("snapshots", key=POINT, columns=[
    *POINT, *with_err("neighbours", "spacing", "pairing"), "occupancy", "fastest", *with_err("newtonian")])
#: mean fields of particles against the finest grid's, rolls aligned: rms difference over places, of velocity
#: over the rms velocity, of T and rho over the range of the grid's; rho along the plates, seen by the weight
#: and counted in a layer
FIELD_ERRORS = Table("field_errors", key=POINT, columns=[
    *POINT, *with_err("velocity", "T", "rho", "rho_plates", "rho_layer")])
#: numbers that need no flow
ARITHMETIC = Table("arithmetic", key=["quantity"], columns=["quantity", "value", "err"])

ALL = (KINETIC, MEANS, HISTORY, FIELDS, PARTICLES, WALLS, COST, SMOOTHED, ERRORS, SNAPSHOTS, FIELD_ERRORS,
       ARITHMETIC)

STILL = 1e-6        # K of a grid whose onset lies a little higher: nothing flows, and rolls are of round-off
#: Prandtl number nu/kappa, kappa = k/(rho C_V), that KHP95's eta = k means
PRANDTL = {"ideal": 1.0, "vdw": 1.0, "dense": 1.5}


def scene(ra: float, eos="ideal", transport="const-eta", sides="periodic") -> Point:
    """Columns of a scene with KHP95's eta = k."""
    return {"eos": eos, "transport": transport, "sides": sides, "ra": float(ra), "pr": PRANDTL[eos]}


def particles(ra: float, height: int = 50, variant="printed", **where) -> Point:
    """Of smooth particles, `height` rows of them: KHP95's 5000 are 50 rows of 100."""
    return {"method": "spam", "variant": variant, "resolution": float(height), **scene(ra, **where)}


def grid(ra: float, height: float = inf, variant="flux-form", **where) -> Point:
    """Of the compressible grid; extrapolated without rows."""
    return {"method": "compressible", "variant": variant, "resolution": float(height), **scene(ra, **where)}


def points(ra: float, variant: str, height: float = inf, **where) -> Point:
    """Of a scheme on RR98's points; extrapolated without rows."""
    return {"method": "dih", "variant": variant, "resolution": float(height), **scene(ra, **where)}


def besides(point: Point, *names: str) -> Point:
    """The columns of a point without these."""
    return {name: value for name, value in point.items() if name not in names}
