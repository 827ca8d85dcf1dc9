"""Tables of the study, and the drag that follows. Dissipative particles have mass, rc and kT of one."""
from typing import Any

from continuum.exact.cylinder import drag_of
from studies.kit.stats import Measured
from studies.kit.table import Rows, Table, Tables
from studies.noise.dissipative import DEPTH, FRACTION, RADIUS

PARTNERS = Table("partners", key=["maker", "points", "d", "noise"], columns=[
    "maker", "points", "d", "noise", "mismatch", "sums"],
    about="A noise beside its dissipation on one set of points, coefficients random by factors of five.")
WAVE = ["equation", "term", "reading", "d", "h", "wavenumber"]
PRINTED = Table("printed", key=WAVE, columns=[*WAVE, "ratio", "predicted"],
                about="A wave of noise as a paper's equation prints it.",
                means={"ratio": ("variance over its due, 2 kT Gamma of Eq. 37 or 38", "")})
ONSET = Table("onset", key=["rows", "below"], columns=["rows", "below", "ra_c", "velocity"],
              about="A motionless layer on the way to onset, linearised.",
              means={"velocity": ("variance of vertical velocities, 1 in equilibrium", "")})
STEPS = Table("steps", key=["integrator", "fluid", "wavenumber", "dt"], columns=[
    "integrator", "fluid", "wavenumber", "dt", "velocity", "error"],
    about="What an integrator makes of a wave with noise at one step.",
    means={"dt": ("time step", "eta/(rho c^2)"), "velocity": ("variance of the velocity, 1 in equilibrium",
                                                              ""),
           "error": ("largest error of a covariance of the wave", "")})
MODE = ["points", "share", "field", "turns_x", "turns_y", "phase"]
VARIANCE = {"ratio": ("variance over its exact value", ""), "wavenumber": ("wave number; none of all "
                                                                           "waves", "1/a")}
MODES = Table("modes", key=MODE, columns=[*MODE, "wavenumber", "ratio", "ratio_err"], means=VARIANCE,
              about="A plane wave of a gas at rest in 2D, sampled.")
CUBE = ["points", "share", "field", "turns_x", "turns_y", "turns_z", "phase"]
CUBES = Table("cubes", key=CUBE, columns=[*CUBE, "wavenumber", "ratio", "ratio_err"], means=VARIANCE,
              about="The same in 3D.")
PEAKS = Table("peaks", key=["points", "turns"], columns=[
    "points", "turns", "wavenumber", "measured", "measured_err", "symbol"],
    about="The Brillouin peak of a wave on a line of points.",
    means={"points": ("number of points", ""), "measured": ("position of the peak in samples", "1/t0")})
NONLINEAR = Table("nonlinear", key=["share", "k", "field"], columns=[
    "share", "k", "field", "ratio", "ratio_err", "drift"],
    about="A field of the full equations with current amplitudes, sampled.",
    means={"k": ("Boltzmann's constant", ""), "ratio": ("variance over that of equilibrium", "")})
CAPACITY = Table("capacity", key=["C", "noise"], columns=["C", "noise", "measured", "measured_err",
                                                          "predicted"],
                 about="The variance of temperatures with current amplitudes.",
                 means={"noise": ("corrected: with Ito's correction; current: without", ""),
                        "measured": ("variance of T over T^2", "")})
GIVEN = ["flow", "strength", "rows", "wavenumber", "field"]
SAMPLED = Table("sampled", key=GIVEN, columns=[*GIVEN, "exact", "ratio", "ratio_err"],
                about="A quantity of linear fluctuations about a layer below onset.",
                means={"field": ("amplitude of the slowest mode, or velocity u along, w across the plates",
                                 ""),
                       "exact": ("variance by Lyapunov's equation, 1 of a field at rest", ""),
                       "ratio": ("variance of samples over the exact one", "")})
FORMULAS = Table("formulas", key=["name"], columns=["name", "value"],
                 about="What a printed formula gives by arithmetic.")

FLUID = ["integrator", "side", "dt"]
KT = ["kinetic", "kinetic_err", "configurational", "configurational_err"]
#: dissipative particles have units of their own
OWN = {"dt": ("time step", "rc (m/kT)^(1/2)"), "time": ("time of the run", "rc (m/kT)^(1/2)"),
       "n": ("number of particles", "")}
HOT = OWN | {"kinetic": ("kT from velocities over that asked for", ""), "P": ("pressure", "kT/rc^3"),
             "configurational": ("kT from forces over that asked for", "")}
STATES = Table("states", key=FLUID, columns=[*FLUID, "n", "time", *KT, "P", "P_err"], means=HOT,
               about="A steady state of dissipative particles at one step.")
LONG = Table("long", key=FLUID, columns=[*FLUID, "n", "time", *KT, "P", "P_err"],
             means=HOT | {"P": ("pressure, with rho kT as it is asked for", "kT/rc^3")},
             about="A long run of dissipative particles at the usual step.")
SHEAR = Table("shear", key=[*FLUID, "rate"], columns=[
    *FLUID, "rate", "n", "time", "viscosity", "viscosity_err", "kinetic", "kinetic_err"],
    means=HOT | {"viscosity": ("stress over rate", "(m kT)^(1/2)/rc^2"),
                 "rate": ("rate of shear", "(kT/m)^(1/2)/rc")},
    about="Dissipative particles between sliding sides.")
CYLINDER = Table("cylinder", key=FLUID, columns=[*FLUID, "n", "held", "time", "speed", "speed_err", "force"],
                 means=OWN | {"speed": ("mean velocity", "(kT/m)^(1/2)"),
                              "force": ("force along the stream on what is free", "kT/rc")},
                 about="A stream of dissipative particles past a cylinder of frozen ones.")
FLOW = Table("flow", key=["x", "y"], columns=["x", "y", "u", "v"],
             about="A place of the mean velocity of that stream.",
             means={"x": ("place along the stream from the axis of the cylinder", "radius"),
                    "y": ("place across", "radius"), "v": ("velocity across over the mean one", "")})
DRAG = Table("drag", key=["side", "dt"], columns=[
    "side", "dt", "reynolds", "drag", "drag_err", "ratio", "ratio_err"],
    about="The drag of that cylinder.",
    means=OWN | {"drag": ("drag over viscosity, speed and depth", ""),
                 "ratio": ("drag over the published one of slow flow", "")})

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
