"""Tables of the study, and the drag that follows. Dissipative particles have mass, rc and kT of one."""
from typing import Any

from continuum.exact.cylinder import drag_of
from studies.kit.stats import Measured
from studies.kit.table import Rows, Table, Tables
from studies.noise.dissipative import DEPTH, FRACTION, RADIUS

PARTNERS = Table("partners", key=["maker", "points", "d", "noise"], columns=[
    "maker", "points", "d", "noise", "mismatch", "sums"])
WAVE = ["equation", "term", "reading", "d", "h", "wavenumber"]
PRINTED = Table("printed", key=WAVE, columns=[*WAVE, "ratio", "predicted"])
ONSET = Table("onset", key=["rows", "below"], columns=["rows", "below", "ra_c", "velocity"])
STEPS = Table("steps", key=["integrator", "fluid", "wavenumber", "dt"], columns=[
    "integrator", "fluid", "wavenumber", "dt", "velocity", "error"])
MODE = ["points", "share", "field", "turns_x", "turns_y", "phase"]
MODES = Table("modes", key=MODE, columns=[*MODE, "wavenumber", "ratio", "ratio_err"])
CUBE = ["points", "share", "field", "turns_x", "turns_y", "turns_z", "phase"]
CUBES = Table("cubes", key=CUBE, columns=[*CUBE, "wavenumber", "ratio", "ratio_err"])
PEAKS = Table("peaks", key=["points", "turns"], columns=[
    "points", "turns", "wavenumber", "measured", "measured_err", "symbol"])
NONLINEAR = Table("nonlinear", key=["share", "k", "field"], columns=[
    "share", "k", "field", "ratio", "ratio_err", "drift"])
CAPACITY = Table("capacity", key=["C", "noise"], columns=["C", "noise", "measured", "measured_err",
                                                          "predicted"])
#: strength : 1 - Ra/Ra_c; exact : variance by Lyapunov, 1 of a field at rest; ratio : of samples to that
GIVEN = ["flow", "strength", "rows", "wavenumber", "field"]
SAMPLED = Table("sampled", key=GIVEN, columns=[*GIVEN, "exact", "ratio", "ratio_err"])
#: what printed formulas give by arithmetic
FORMULAS = Table("formulas", key=["name"], columns=["name", "value"])

FLUID = ["integrator", "side", "dt"]
KT = ["kinetic", "kinetic_err", "configurational", "configurational_err"]
#: steady states of dissipative particles
STATES = Table("states", key=FLUID, columns=[*FLUID, "n", "time", *KT, "P", "P_err"])
#: long runs at the usual step; P with rho kT as it is asked for
LONG = Table("long", key=FLUID, columns=[*FLUID, "n", "time", *KT, "P", "P_err"])
SHEAR = Table("shear", key=[*FLUID, "rate"], columns=[
    *FLUID, "rate", "n", "time", "viscosity", "viscosity_err", "kinetic", "kinetic_err"])
#: a stream past a cylinder
CYLINDER = Table("cylinder", key=FLUID, columns=[*FLUID, "n", "held", "time", "speed", "speed_err", "force"])
#: velocity over the mean one in squares of the cell, places in radii
FLOW = Table("flow", key=["x", "y"], columns=["x", "y", "u", "v"])
#: drag of the cylinder over eta times speed and depth; ratio: to the published one of slow flow
DRAG = Table("drag", key=["side", "dt"], columns=[
    "side", "dt", "reynolds", "drag", "drag_err", "ratio", "ratio_err"])

ALL = (PARTNERS, PRINTED, ONSET, STEPS, MODES, CUBES, PEAKS, NONLINEAR, CAPACITY, SAMPLED, FORMULAS, STATES,
       LONG, SHEAR, CYLINDER, FLOW, DRAG)


def derive(tables: Tables) -> Rows:
    """The drag, where the stream and the viscosity at its step are known."""
    if not {"cylinder", "shear"} <= set(tables):
        return {}
    pairs = zip(tables["cylinder"].itertuples(), tables["shear"].itertuples())
    return {"drag": [drag(stream, shear) for stream, shear in pairs]}


def drag(stream: Any, shear: Any) -> dict[str, float]:
    """Drag over eta U and depth: force on what is free, with the mean pressure gradient's on the body."""
    U = Measured(stream.speed, stream.speed_err)
    eta = Measured(shear.viscosity, shear.viscosity_err)
    force = stream.force*stream.n/(stream.n - stream.held)
    drag = force/DEPTH/(eta*U)
    ratio = drag/drag_of(FRACTION).value
    density = stream.n/(stream.side**2*DEPTH)
    reynolds = 2*RADIUS*density*U.value/eta.value
    return {"side": stream.side, "dt": stream.dt, "reynolds": reynolds, "drag": drag.value,
            "drag_err": drag.err, "ratio": ratio.value, "ratio_err": ratio.err}
