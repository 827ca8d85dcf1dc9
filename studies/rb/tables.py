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
#: key of a point as `Table.of` takes it
AT = " ".join(POINT)
ENERGIES = "ke ke_err ke_field ke_field_err ke_mean ke_mean_err ke_fluctuation nu nu_err"
#: columns of long tables that repeat what is above
SAME = [*RUN, *STAMP]

RUNS = (f"{AT} particles seed {ENERGIES} rolls free_fall mass_drift converged dt steps t_end "
        "cpu_s compile_s threads")
KINETIC = Table("kinetic_energy", key=RUN, columns=RUNS.split())
#: means over the `seeds` that settled in the commonest number of rolls: the error is the larger of those
#: within runs and between seeds, and twice what half of the time step changes; `mixed` counts seeds that
#: ended in other rolls
MEANS = Table.of("means", AT, f"particles seeds mixed {ENERGIES} rolls")
#: approach to the steady state [KHP95, Fig. 8]; t in units of time, not L^2/eta
HISTORY = Table.of(
    "history", f"{AT} seed t", "t_viscous ke ke_field", once=SAME,
    digits={"t_viscous": ".6g", "ke": ".8g", "ke_field": ".8g"})
#: steady fields on KHP95's 30 x 60 places [Figs 9, 12]; x, y in units of L; particles: means over the second
#: half
FIELDS = Table.of(
    "fields", f"{AT} seed x y", "rho T vx vy", once=SAME,
    digits={"x": ".4f", "y": ".4f", "rho": ".5f", "T": ".5f", "vx": ".6f", "vy": ".6f"})
#: particles at the end of a run [Figs 2, 3, 7, 12]; kind: fluid, fixed or image
PARTICLES = Table.of(
    "particles", f"{AT} seed number", "kind x y vx vy T", once=[*RUN, "kind", *STAMP],
    digits={"x": ".6f", "y": ".6f", "vx": ".5f", "vy": ".5f", "T": ".4f"})
WALLS = Table.of("walls", f"{AT} seed plate", "T_wall T_layer rho_layer reflections nu_plate nu_plate_err")
#: seconds of a step, measured alone
COST = Table.of("cost", "method variant eos sides resolution", "points step_s step_s_err dt threads")
#: error against cost, derived; energy Kp: of all particles against the grid, Kg: smoothed against the grid
#: smoothed alike, Nu: the Nusselt number (then ke, reference are Nusselt numbers)
ERRORS = Table.of("errors", f"{AT} energy",
                  "particles ke ke_err reference reference_err error error_err cpu_s")
#: K of the finest grid's field, and smoothed with a weight of range h spacings, `rows` of them a height
SMOOTHED = Table.of("smoothed", f"{AT} weight h rows", "ke ke_smoothed")
#: of the particles at the end, first seed: mean number of neighbours in range, first peak of g(r), median of
#: second over first neighbour distance, particles a site, largest v^2, correlation of accelerations with
#: those of the potential 2 w
SNAPSHOTS = Table.of("snapshots", AT, "neighbours neighbours_err spacing spacing_err pairing pairing_err "
                                      "occupancy fastest newtonian newtonian_err")
#: mean fields of particles against the finest grid's, rolls aligned: rms difference over places, of velocity
#: over the rms velocity, of T and rho over the range of the grid's; rho along the plates, seen by the weight
#: and counted in a layer
FIELD_ERRORS = Table.of("field_errors", AT, "velocity velocity_err T T_err rho rho_err "
                                            "rho_plates rho_plates_err rho_layer rho_layer_err")
#: numbers that need no flow
ARITHMETIC = Table.of("arithmetic", "quantity", "value err")

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
    return {"method": "spam", "variant": variant, "resolution": float(height)} | scene(ra, **where)


def grid(ra: float, height: float = inf, variant="flux-form", **where) -> Point:
    """Of the compressible grid; extrapolated without rows."""
    return {"method": "compressible", "variant": variant, "resolution": float(height)} | scene(ra, **where)


def points(ra: float, variant: str, height: float = inf, **where) -> Point:
    """Of a scheme on RR98's points; extrapolated without rows."""
    return {"method": "dih", "variant": variant, "resolution": float(height)} | scene(ra, **where)


def besides(point: Point, *names: str) -> Point:
    """The columns of a point without these."""
    return {name: value for name, value in point.items() if name not in names}
