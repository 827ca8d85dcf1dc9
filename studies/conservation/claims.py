"""What RR98 says of sums, of moving points, of bodies, judged    [RR98 Eqs 34-41, 46-50, Secs III, IV]"""
from functools import partial
from math import inf
from typing import Any

from studies.conservation.sums import EVERYTHING
from studies.kit.ask import Value, largest, largest_of, one, over_seeds, power
from studies.kit.claim import Claim

SUMS = ("mass", "momentum", "energy")


def kept(name: str, *claimed: str) -> Value:
    """Largest change of a sum over all runs on fixed points that claim to keep it and reached the end."""
    return largest("drift", name, "reached == steps", err="err", scheme=("layer", "dih"),
                   claimed=(*claimed, EVERYTHING))


def changed(*modes: str) -> Value:
    """Largest change of any sum in runs of moving points."""
    return largest_of(*(largest("drift", name, scheme="motions", mode=modes) for name in SUMS))


def drag_error(variant: str, fraction: float) -> Value:
    """|error| of the drag with 48 rows."""
    return abs(one("drag", "error", variant=variant, fraction=fraction, rows=48))


BY_CONSTRUCTION = "by construction, the total mass, total momentum, and total energy are conserved"
SAME: dict[str, Any] = {
    "at_most": 1e-13, "because": "1e-13: sums of some hundred numbers that 40 000 additions have rounded"}
STEPS: dict[str, Any] = {
    "at_most": 1e-13, "because": "round-off: 1e4 steps of some 1e-17 each, in a random walk"}
HALVES = "its error is what the two halves of the run differ by"
ALONE = "computed once, by sums in a fixed order: no statistics"
SMOOTHED = f"2 %: a weight of h = 3 a takes 1.5 % off the gradient of such a wave; {ALONE}"
PERCENT = "1 %, the error at which resolutions are compared in this repository"
LIMIT = "0.3 %, as for other limits of second order here"
EXTRAPOLATED = "the error is the difference of two extrapolations"
CONSTANTS = "with a and b constants"
ACRIVOS = "Sangani & Acrivos 1982, Table 1"
SLIDE = partial(Claim, source="RR98 Sec. IV", printed="can be used")
CONSERVED = partial(Claim, printed=BY_CONSTRUCTION, headline=True, **SAME)
FIXED = (
    CONSERVED(id="rr98-conservation-mass", source="RR98 Eq. 34", value=kept("mass", "mass"),
              statement="total mass is conserved: largest relative change in any run of 10 000 steps on "
                        "fixed points, every transport, weight, maker of edges and set of points, in "
                        "periodic boxes, between plates, in all dimensions"),
    CONSERVED(id="rr98-conservation-momentum", source="RR98 Eq. 35", value=kept("momentum"),
              statement="total momentum is conserved: largest change over the sum of its sizes in any run "
                        "of 10 000 steps on fixed points, in periodic boxes and along plates without "
                        "friction"),
    CONSERVED(id="rr98-conservation-energy", source="RR98 Eq. 36", value=kept("energy"),
              statement="total energy is conserved: largest relative change in any run of 10 000 steps on "
                        "fixed points, in periodic boxes and between plates without friction and "
                        "conduction"),
    Claim(id="rr98-conservation-symmetrised", source="RR98 Sec. III B", at_least=0.01, headline=True,
          value=over_seeds("losses", "lost"),
          printed="as long as ij-symmetrized forms are provided, the conservation laws are guaranteed",
          because="a per cent: the error to which flows are known",
          statement="without forms symmetric in ij momentum is lost: P_ij + P_ij for point i in place of "
                    "P_ij + P_ji, change over the sum of its sizes in 10 000 steps, or until shortly before "
                    "a run diverges, mean of 24 random starts on a line"),
    Claim(id="own-conservation-plates-gravity", source="RR98 Sec. III A", **SAME,
          value=largest("drift", "energy", err="err", mode="ideal", wall="plates, gravity"),
          statement="energy with that of height is conserved between plates without friction under gravity: "
                    "relative change until the end, of 10 000 steps at most"),
)
MOVING = (
    Claim(id="rr98-eq39-pattern", source="RR98 Secs I, III", printed="fully consistent; a bold assumption",
          headline=True,
          expect=1, within=0.02, value=one("patterns", "speed", motion="literal", wavelength=32),
          statement="points that move with v under Eqs 34-36 show the fluid: speed of a density pattern "
                    "over that of the stream that carries it, wavelength 32 a",
          because=f"2 %: what a weight of h = 3 a does to such a wave; {HALVES}"),
    Claim(id="rr98-eq39-sound", source="RR98 Eq. 39", printed="fully consistent", expect=1, within=0.02,
          headline=True,
          value=one("long_sound", "speed", motion="literal", weight="WendlandC2"),
          statement="points that move with v under Eqs 34-36: speed of long sound over c, Wendland C2, h = "
                    "4 a",
          because=f"2 %: extrapolated from wavelengths of 24 and 32 a; {EXTRAPOLATED}"),
    Claim(id="rr98-eq39-conserves", source="RR98 Eqs 34-36, 39", printed="conserved", **STEPS,
          value=changed("literal, RK4", "literal, TwoStep"),
          statement="mass, momentum and energy stay while points move literally: largest relative drift "
                    "over 1e4 steps, all weights, both integrators"),
    *(Claim(id=f"rr98-eq41-accuracy{name}", source="RR98 Eq. 41", at_most=1, printed="more accurate",
            headline=name != "-mass", value=one("accuracy", "ratio", motion=motion, flow=flow),
            because="smaller than one is more accurate; the reference is RK4",
            statement="positions with new velocities are more accurate: their error over that with old ones, "
                      f"{words}")
      for name, motion, flow, words in (
          ("", "literal", "sound", "sound in literal motion"),
          ("-mass", "constant-mass", "sound", "sound at constant mass"),
          ("-vortices", "constant-mass", "vortices", "decaying vortices at constant mass"))),
    *(Claim(id=f"rr98-eq{n}-sign", source=f"RR98 Eq. {n}", printed="-", expect=1, within=0.02,
            because=SMOOTHED, value=one("signs", "factor", equation=n, wavelength=32), headline=True,
            statement=f"what is added to the change of {name} is v.grad of it: over the exact one, lattice, "
                      "wavelength 32 a")
      for n, name in zip((46, 47, 48), SUMS, strict=True)),
    Claim(id="own-eq46-conserves", source="RR98 Eq. 46", at_most=1e-12,
          value=one("drift", "mass", mode="convective, RK4"),
          statement="mass is conserved with Eq. 46: largest relative drift in 1e4 steps, stirred gas, "
                    "jittered points",
          because="what is exchanged is not symmetric in i and j, so that more than round-off is lost; "
                  f"{ALONE}"),
    Claim(id="own-eq46-carried", source="RR98 Eqs 46-48", at_most=1e-6, value=changed("carried, RK4"),
          statement="Eqs 46-48 on volumes that grow with div v lose nothing but the error of time steps: "
                    "largest relative drift of mass, momentum, energy in 1e4 steps",
          because="RK4 at omega dt = 0.3: (omega dt)^5 times the amplitudes squared, some 100 steps long; "
                  f"{ALONE}"),
    Claim(id="rr98-eq46-sound", source="RR98 Eqs 46-48", printed="fully consistent", expect=1, within=0.02,
          headline=True,
          value=one("long_sound", "speed", motion="convective", weight="WendlandC2"),
          statement="Eqs 39, 46-48 on volumes dV that stay: speed of long sound over c, Wendland C2, h = 4 a",
          because=f"2 %: extrapolated from wavelengths of 24 and 32 a; {EXTRAPOLATED}"),
    Claim(id="rr98-eq49-identity", source="RR98 Eq. 49", printed="can be written", at_most=1e-12,
          headline=True,
          value=largest("identity", "abs(convective)"),
          statement="Eqs 34, 35, 46, 47 with p = m v are Eq. 49: largest difference of accelerations over "
                    "the largest, random fields on jittered points, all Reynolds numbers",
          because=f"round-off of some 30 terms; {ALONE}"),
    Claim(id="rr98-eq49-reynolds", source="RR98 after Eq. 48", printed="not too large Reynolds numbers",
          at_least=0.01, value=largest("identity", "abs(convective)", reynolds=inf),
          statement="Eq. 49 leaves out what Eqs 46-48 bring at large Reynolds numbers: difference of "
                    "accelerations over the largest, without viscosity",
          because=f"a per cent would limit its use; {ALONE}"),
    Claim(id="rr98-eq49-sound", source="RR98 Eq. 49", printed="a correct continuum limit", expect=1,
          within=0.01,
          value=one("long_sound", "speed", motion="constant-mass", weight="WendlandC2"),
          statement="constant mass, volumes that follow the flow: speed of long sound over c, Wendland C2, "
                    "h = 4 a",
          because=f"1 %: 0.5 % from sums over the lattice, and the next order in h/lambda; {EXTRAPOLATED}"),
    Claim(id="own-eq49-conserves", source="RR98 Eq. 49", value=changed("constant-mass, RK4"), **STEPS,
          statement="constant mass: largest relative drift of mass, momentum, energy over 1e4 steps"),
    Claim(id="rr98-eq50-sum-zero", source="RR98 Eq. 50", printed=CONSTANTS, expect=1, within=0.02,
          headline=True,
          value=one("brackets", "force", a=1, b=-1),
          statement="a = 1, b = -1, smoothed particles with their own masses: force over -grad P, wave "
                    "without entropy of 32 a",
          because=SMOOTHED),
    Claim(id="rr98-eq50-spam", source="RR98 Eq. 50", printed="SPH is formulated with forms such as",
          at_most=1e-12, value=one("beside", "start", a=1, b=-1), because=f"round-off of 30 terms; {ALONE}",
          statement="a = 1, b = -1 on volumes m/rho of the summed density are the accelerations of SPAM: rms "
                    "difference over their rms, random fields on jittered points"),
    Claim(id="rr98-eq50-any", source="RR98 Eq. 50", printed=CONSTANTS, at_most=0.02, headline=True,
          value=largest("brackets", "abs(force - 1)", "a + b != 0"),
          statement="any constants a and b make Eq. 49 the momentum equation where volumes follow the flow: "
                    "largest error of the force over -grad P for a + b other than 0", because=SMOOTHED),
)
BODIES = (
    SLIDE(id="rr98-sliding-exact", at_most=1e-9, headline=True,
          value=largest_of(*(largest("shear", f"abs({name})") for name in ("stress", "heating", "profile"))),
          statement="Lees-Edwards sides can be used: homogeneous shear between them, largest relative error "
                    "of stress (eta rate), heating (eta rate^2) and profile while the images slide two "
                    "boxes",
          because="an exact solution: round-off of 400 to 1600 steps, of an energy of which friction adds "
                  "0.4 %"),
    SLIDE(id="rr98-sliding-conserves", at_most=1e-12, because="round-off of 400 to 1600 steps",
          value=largest_of(largest("shear", "mass_drift"), largest("shear", "momentum_drift")),
          statement="Lees-Edwards sides can be used: drift of mass and momentum in homogeneous shear "
                    "between them"),
    SLIDE(id="rr98-sliding-order", expect=2, within=0.15, value=-power("wave", "error", "rows"),
          headline=True,
          statement="Lees-Edwards sides can be used: order of the error of a plane wave that the shear "
                    "turns by a right angle",
          because="0.15: at 16 rows, a seventh of a radian to the spacing, the next order is a tenth of the "
                  "error"),
    Claim(id="rr98-frozen-body", source="RR98 Sec. IV", at_most=0.01, value=drag_error("frozen", 0.1),
          printed="simulate a rigid body",
          headline=True, evidence="conservation/drag.png",
          because=PERCENT,
          statement="'freezing' a number of points simulates a rigid body: |error| of the drag of a "
                    "cylinder in a square array, solid fraction 0.1, lattice points within the circle "
                    "frozen, 17 spacings across"),
    *(Claim(id=f"sangani-acrivos-surface-{c:g}", source=ACRIVOS, printed=printed,
            value=drag_error("surface", c), at_most=0.01, because=PERCENT,
            statement="points on the surface, Delaunay edges: |error| of the drag, solid "
                      f"fraction {c:g}, {across} spacings across")
      for c, printed, across in ((0.1, "24.83", 17), (0.3, "102.90", 30))),
    *(Claim(id=f"sangani-acrivos-limit-{c:g}", source=ACRIVOS, printed=printed, expect=0, within=0.003,
            because=LIMIT, value=one("drag_limits", "error", variant="surface", fraction=c),
            statement="points on the surface: drag extrapolated to infinitely fine points against print, "
                      f"relative, solid fraction {c:g}") for c, printed in ((0.1, "24.83"), (0.3, "102.90"))),
)
PRESSURES = ("pressure, P_i + P_j", "pressure, Eq. 13")
HALVED = (PRESSURES[0], "convection, half of each end", "friction, Eq. 37")
SUMMED: dict[str, Any] = {"at_most": 1e-14, "because": "round-off of some thousand terms, summed once",
                          "after": "torques of one seed had been seen"}
TORQUES = (
    Claim(id="own-angular-central", source="RR98 Eqs 35, 49, 51", **SUMMED,
          value=largest_of(largest("torques", "torque", exchange=PRESSURES, maker=("plain", "printed")),
                           largest("torques", "torque", exchange="friction, Eq. 51, B = 0"),
                           largest("motion_torques", "torque", viscosity=0.0,
                                   motion=("carried", "constant-mass", "spam"))),
          statement="forces along edges keep angular momentum on any points: largest torque over its size, "
                    "pressures by a weight, friction with B = 0, moving points whose masses stay"),
    Claim(id="own-angular-linear", source="RR98 Eqs 35, 37", **SUMMED,
          value=largest("torques", "torque", exchange=HALVED, maker=("delaunay", "exact")),
          statement="edges exact on linear fields keep angular momentum if each end gives half of a "
                    "symmetric stress: largest torque over its size, P_i + P_j, rho v v halved, Eq. 37"),
    Claim(id="own-angular-convection", source="RR98 Eq. 35", **SUMMED,
          value=largest("torques", "torque", exchange="convection, Eq. 35"),
          statement="convection as printed, p_i v_j + p_j v_i, keeps angular momentum: largest torque over "
                    "its size, all makers of edges, lattice and jittered points"),
)
CLAIMS = (*FIXED, *MOVING, *BODIES, *TORQUES)
