"""Tables of the study. Of dissipative particles: units in which mass, rc and kT are one; `_err` of 95 %."""
from studies.kit.table import Table

PARTNERS = Table("partners", key=["maker", "points", "d", "noise"], columns=[
    "maker", "points", "d", "noise", "mismatch", "asymmetry", "sums", "uniform", "nulls", "negative"])
WAVE = ["equation", "term", "reading", "d", "h", "wavenumber"]
PRINTED = Table("printed", key=WAVE, columns=[*WAVE, "ratio", "predicted"])
REST = Table("rest", key=["maker", "points", "d", "share", "n"], columns=[
    "maker", "points", "d", "share", "n", "growth", "error", "kinetic"])
ONSET = Table("onset", key=["rows", "below"], columns=["rows", "below", "ra_c", "slowest", "velocity"])
STEPS = Table("steps", key=["integrator", "fluid", "wavenumber", "dt"], columns=[
    "integrator", "fluid", "wavenumber", "dt", "velocity", "density", "error", "by_hand"])
MODE = ["points", "share", "field", "turns_x", "turns_y", "phase"]
MODES = Table("modes", key=MODE, columns=[*MODE, "wavenumber", "ratio", "ratio_err"])
CUBE = ["points", "share", "field", "turns_x", "turns_y", "turns_z", "phase"]
CUBES = Table("cubes", key=CUBE, columns=[*CUBE, "wavenumber", "ratio", "ratio_err"])
PEAKS = Table("peaks", key=["points", "turns", "peak"], columns=[
    "points", "turns", "wavenumber", "peak", "measured", "measured_err", "symbol"])
NONLINEAR = Table("nonlinear", key=["share", "k", "field"], columns=[
    "share", "k", "field", "ratio", "ratio_err", "drift"])
CAPACITY = Table("capacity", key=["C", "noise"], columns=["C", "noise", "measured", "measured_err",
                                                          "predicted"])
#: strength : 1 - Ra/Ra_c; exact : variance by Lyapunov, 1 of a field at rest; ratio : of samples to that
GIVEN = ["flow", "strength", "rows", "wavenumber", "field"]
SAMPLED = Table("sampled", key=GIVEN, columns=[*GIVEN, "exact", "ratio", "ratio_err"])
#: what printed formulas give by arithmetic
FORMULAS = Table("formulas", key=["name"], columns=["name", "value"])

FLUID = ["integrator", "a", "side", "dt"]
KT = ["kinetic", "kinetic_err", "configurational", "configurational_err"]
#: steady states of dissipative particles: both kT, pressure, largest mean velocity
STATES = Table("states", key=FLUID, columns=[*FLUID, "n", "time", *KT, "P", "P_err", "drift"])
#: long runs at the usual step; P with rho kT as it is asked for
LONG = Table("long", key=FLUID, columns=[*FLUID, "n", "time", *KT, "P", "P_err"])
#: kT - 1 = linear dt + quadratic dt^2 + cubic dt^3 of the table states; order: d ln|kT - 1|/d ln dt, of the
#: steps (`used`) whose error is no chance
ERRORS = Table("errors", key=["integrator", "a", "temperature"], columns=[
    "integrator", "a", "temperature", "steps", "linear", "linear_err", "quadratic", "quadratic_err", "cubic",
    "cubic_err", "used", "order", "order_err"])
SHEAR = Table("shear", key=[*FLUID, "rate"], columns=[
    *FLUID, "rate", "n", "time", "viscosity", "viscosity_err", "kinetic", "kinetic_err"])
#: a stream past a cylinder; inside and outside (`fluid`): density of free particles
CYLINDER = Table("cylinder", key=FLUID, columns=[
    *FLUID, "n", "held", "time", "push", "speed", "speed_err", "force", "inside", "fluid"])
#: velocity over the mean one in squares of the cell, places in radii
FLOW = Table("flow", key=["x", "y"], columns=["x", "y", "u", "v"])
#: drag of the cylinder over eta times speed and depth; ratio: to the published one of slow flow
DRAG = Table("drag", key=["side", "dt"], columns=[
    "side", "dt", "reynolds", "drag", "drag_err", "ratio", "ratio_err"])

ALL = (PARTNERS, PRINTED, REST, ONSET, STEPS, MODES, CUBES, PEAKS, NONLINEAR, CAPACITY, SAMPLED, FORMULAS,
       STATES, LONG, ERRORS, SHEAR, CYLINDER, FLOW, DRAG)
