"""Tables of the study `rb`: fixed columns, in which all solvers meet.

Energies are per mass in KHP95's units, m = kB = sigma = epsilon = 1 with dT = 1 (free-fall units for the
ideal gas, where `free_fall`, the unit of velocity sqrt(g alpha dT L), is 1; Boussinesq rows are in free-fall
units). `ke` is of all particles, `ke_field` of the smoothed field, `ke_mean` of velocities averaged over
time. Lengths in heights L, times in L^2/eta where not said otherwise. Every `_err` is the half width of a 95
% interval.
"""
from math import inf
from typing import Any

import pandas as pd

from studies.kit.table import Table, Tables

Point = dict[str, Any]
SCENE = ["eos", "transport", "sides", "ra", "pr"]
POINT = ["method", "variant", *SCENE, "resolution"]
RUN = [*POINT, "seed"]
#: key of a point as `Table.of` takes it
AT = " ".join(POINT)
ENERGIES = "ke ke_err ke_field ke_field_err ke_mean ke_mean_err ke_fluctuation nu nu_err"

RUNS = (f"{AT} particles seed {ENERGIES} rolls free_fall mass_drift converged dt steps t_end "
        "cpu_s compile_s threads")
KINETIC = Table("kinetic_energy", key=RUN, columns=RUNS.split(),
                about="A run of one solver: means over its late part. Boussinesq rows are in free-fall "
                      "units.")
MAKERS = Table("makers", key=RUN, columns=RUNS.split(),
               about="A run of smooth particles with areas as CRKSPH and MFM make them, with a limited "
                     "Riemann problem, or with places that are shifted.")
MEANS = Table.of("means", AT, f"particles seeds mixed {ENERGIES} rolls",
                 about="Means over the seeds that settled in the commonest number of rolls. An error is the "
                       "larger of those within runs and between seeds, and twice what half of the step "
                       "changes.",
                 means={"seeds": ("number of seeds that settled in that number of rolls", "")})
HISTORY = Table.of(
    "history", f"{AT} seed t", "t_viscous ke ke_field", large=True,
    digits={"t_viscous": ".6g", "ke": ".8g", "ke_field": ".8g"},
    about="An instant of a run on its way to the steady state [KHP95, Fig. 8].")
FIELDS = Table.of(
    "fields", f"{AT} seed x y", "rho T vx vy", large=True,
    digits={"x": ".4f", "y": ".4f", "rho": ".5f", "T": ".5f", "vx": ".6f", "vy": ".6f"},
    about="A place of a steady field, at most KHP95's 30 x 60 places [Figs 9, 12]; of particles means over "
          "the second half.")
PARTICLES = Table.of(
    "particles", f"{AT} seed number", "kind x y vx vy T", large=True,
    digits={"x": ".6f", "y": ".6f", "vx": ".5f", "vy": ".5f", "T": ".4f"},
    about="A particle at the end of a run [KHP95, Figs 2, 3, 7, 12].",
    means={"number": ("number of the particle", ""), "kind": ("fluid, fixed or image", "")})
WALLS = Table.of("walls", f"{AT} seed plate", "T_wall T_layer rho_layer reflections nu_plate nu_plate_err",
                 about="A plate in a run: the layer beside it and the heat through it.")
NU = "of energy Nu the Nusselt number"
ERRORS = Table.of("errors", f"{AT} energy",
                  "particles ke ke_err reference reference_err error error_err cpu_s",
                  about="The relative error of K or Nu of a method against the grid, and what its run cost.",
                  means={"ke": (f"K; {NU}", "epsilon/m"), "reference": (f"K of the grid; {NU}", "epsilon/m"),
                         "error": ("ke/reference - 1", "")})
SMOOTHED = Table.of("smoothed", f"{AT} weight h rows", "ke ke_smoothed",
                    about="The field of the finest grid, smoothed with a weight as particles are.",
                    means={"ke": ("K of the field", "epsilon/m"), "rows": ("spacings over the height", "")})
SNAPSHOTS = Table.of("snapshots", AT, "neighbours neighbours_err spacing spacing_err pairing pairing_err "
                                      "occupancy fastest newtonian newtonian_err",
                     about="The particles at the end of a run of the first seed.")
OF_RANGE = ("rms difference of the mean field from the grid's over the grid's range", "")
FIELD_ERRORS = Table.of("field_errors", AT, "velocity velocity_err T T_err rho rho_err "
                                            "rho_plates rho_plates_err rho_layer rho_layer_err",
                        about="Mean fields of particles against those of the finest grid, rolls aligned.",
                        means={"velocity": ("rms difference of velocities over the grid's rms velocity", ""),
                               "T": OF_RANGE, "rho": OF_RANGE,
                               "rho_layer": ("the same of particles counted in the layer", "")})
ARITHMETIC = Table.of("arithmetic", "quantity", "value err",
                      about="A number that needs no flow: of the paper, equations of state, weights, 36 "
                            "particles.")

SPACE = Table.of("three_dimensions", "method variant start ra resolution",
                 "particles ke ke_err nu nu_err across converged mass_drift dt t_end",
                 about="A run in a box of 2:2:1; that of points from rolls is a slice.",
                 means={
                     "start": ("rolls; crossed: others across, half as strong; squares: as strong", ""),
                     "across": ("weaker over stronger of the longest waves of vy along x and along z", "")})

ALL = (KINETIC, MAKERS, MEANS, HISTORY, FIELDS, PARTICLES, WALLS, SMOOTHED, ERRORS, SNAPSHOTS,
       FIELD_ERRORS, ARITHMETIC, SPACE)
COLUMNS = {table.name: list(table.columns) for table in ALL}

STILL = 1e-6        # K of a grid whose onset lies a little higher: nothing flows, and rolls are of round-off
#: Prandtl number nu/kappa, kappa = k/(rho C_V), that KHP95's eta = k means
PRANDTL = {"ideal": 1.0, "vdw": 1.0, "dense": 1.5}


def rows(tables: Tables, name: str, **wanted: Any) -> pd.DataFrame:
    """Rows of a table where each column has the wanted value; none if there is no such table."""
    frame = tables.get(name, pd.DataFrame(columns=COLUMNS[name]))
    for column, value in wanted.items():
        frame = frame[frame[column] == value]
    return frame


def scene(ra: float, eos="ideal", transport="const-eta", sides="periodic") -> Point:
    """Columns of a scene with KHP95's eta = k."""
    return {"eos": eos, "transport": transport, "sides": sides, "ra": float(ra), "pr": PRANDTL[eos]}


def particles(ra: float, height: float = 50, variant="printed", **where) -> Point:
    """Columns of a point of smooth particles in `height` rows: KHP95's 5000 are 50 rows of 100."""
    return {"method": "spam", "variant": variant, "resolution": float(height)} | scene(ra, **where)


def grid(ra: float, height: float = inf, variant="flux-form", **where) -> Point:
    """Columns of a point of the compressible grid; the limit if no rows are given."""
    return {"method": "compressible", "variant": variant, "resolution": float(height)} | scene(ra, **where)


def points(ra: float, variant: str, height: float = inf, **where) -> Point:
    """Columns of a point of a scheme on RR98's points; the limit if no rows are given."""
    return {"method": "dih", "variant": variant, "resolution": float(height)} | scene(ra, **where)


def besides(point: Point, *names: str) -> Point:
    """The columns of a point without these."""
    return {name: value for name, value in point.items() if name not in names}
