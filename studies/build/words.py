"""One table of words: names of methods, scenes, quantities in code, tables, figures, texts, explained.

KHP95 is Kum, Hoover & Posch 1995 (smooth-particle applied mechanics, SPAM); RR98 is Romero-Rochin & Rubi 1998
(discretized integral hydrodynamics, DIH: fields on points that exchange over edges).
"""
import sys
from typing import NamedTuple


class Word(NamedTuple):
    """What a name stands for, in a sentence, and where it comes from."""
    name: str
    about: str
    source: str = ""


def table(text: str) -> dict[str, Word]:
    """Words from lines `name | sentence | source`."""
    rows = [[part.strip() for part in line.split("|")] for line in text.strip().splitlines()]
    return {row[0]: Word(*row) for row in rows}


METHODS = table("""
grid | compressible Navier-Stokes-Fourier on square cells, second order in space, RK4 in time | KHP95 Sec. V
grid-paper-form | the same with density in convective form, which loses mass | KHP95 Sec. V
grid-edge-heat | the same heated by eta abs(grad v)^2, as forces along edges heat | RR98 Eq. 51
grid-two-rolls | the same from two rolls and a little of one | KHP95 Fig. 10
grid-fig10 | the same at the temperatures of Fig. 10 | KHP95 Fig. 10
py-pde | the same equations on a staggered grid, by the library py-pde |
boussinesq | the Boussinesq fluid a gas is nearest to, staggered grid, Newton's method |
linear-theory | where convection begins in the Boussinesq layer, and how fast it grows | Chandrasekhar 1961
spam | smooth particles as printed: Lucy's weight, range of 3 spacings, images at rest | KHP95 Sec. II
spam-half-step | the same with half of the time step | KHP95 Sec. II
spam-from-flow | the same from the grid's steady flow | KHP95 Sec. II
spam-fixed-rows | the same with six rows of fixed particles behind each plate | KHP95 Fig. 2
spam-monaghan | the same with the cubic spline | KHP95 Sec. II
spam-wendland-c2 | the same with Wendland's C2 weight | Wendland 1995
spam-wendland-c4 | the same with Wendland's C4 weight | Wendland 1995
spam-wendland-c6 | the same with Wendland's C6 weight | Wendland 1995
spam-range-4 | the same with a range of 4 spacings | KHP95 Sec. II
spam-range-6 | the same with a range of 6 spacings | KHP95 Sec. II
spam-walls-odd | the same with images of reversed velocity and of temperature 2 T_w - T | KHP95 Fig. 3
spam-walls-own-pressure | the same with images whose pressure follows from their own state | KHP95 Fig. 3
spam-walls-odd-own-pressure | both of the two before | KHP95 Fig. 3
spam-arithmetic-mean | the same with arithmetic means of densities in gradients | KHP95 Sec. II
spam-direct | the same with friction and heat along pairs | RR98 Eq. 51
spam-more-static-400 | the same with five times the static pressure | KHP95 Sec. II
spam-more-static-100 | the same with twice the static pressure | KHP95 Sec. II
spam-less-static-50 | the same with half of the static pressure left out of the forces | KHP95 Sec. II
spam-less-static-90 | the same with nine tenths of the static pressure left out | KHP95 Sec. II
spam-direct-less-static-90 | the same, friction and heat along pairs besides | RR98 Eq. 51
fixed-lattice | points on a square lattice, edges of Lucy's weight, range of 2 spacings | RR98 Eqs 34-36, 51
fixed-lattice-h1.2 | the same with a range of 1.2 spacings: nearest neighbours only | RR98 Eqs 34-36, 51
fixed-lattice-h3 | the same with a range of 3 spacings | RR98 Eqs 34-36, 51
fixed-lattice-monaghan | the same with the cubic spline | RR98 Eqs 34-36, 51
fixed-lattice-wendland-c2 | the same with Wendland's C2 weight | RR98 Eqs 34-36, 51
fixed-lattice-printed-heat | the same with the heating as printed, of forces along edges alone | RR98 Eq. 51
fixed-lattice-nested | the same, stress and heat current in two steps, a tenth along edges | RR98 Eqs 37, 38
fixed-lattice-nested-only | the same, stress and heat current in two steps | RR98 Eqs 37, 38
fixed-jittered-plates | a jittered lattice, Delaunay edges, rows of points on the plates | RR98 Sec. III
fixed-random-plates | random points, Delaunay edges, rows of points on the plates | RR98 Sec. III
relaxed-plates | random points moved apart, Delaunay edges, rows of points on the plates | RR98 Sec. III
fixed-jittered-delaunay | a jittered lattice, Delaunay edges, images behind the plates | RR98 Sec. III
fixed-random-delaunay | random points, Delaunay edges, images behind the plates | RR98 Sec. III
relaxed-delaunay | random points moved apart, Delaunay edges, images behind plates | RR98 Sec. III
relaxed-plain | random points moved apart, edges of a weight as printed | RR98 Eq. 30
fixed-jittered-plain | a jittered lattice, edges of a weight as printed | RR98 Eq. 30
fixed-jittered-exact | a jittered lattice, edges made exact on linear fields | RR98 Eq. 5
fixed-jittered-closed | a jittered lattice, edges made to close | RR98 Sec. III
moving | points that move and shift to even spacing, over closed faces | RR98 Eqs 46-51, repaired
moving-half-step | the same with half of the time step |
moving-open-faces | the same with faces left open |
moving-closer-faces | the same with faces closed better |
moving-no-shift | the same without the shift |
moving-no-follow | the same with volumes that do not follow the flow |
moving-no-spread | the same without spread of mass |
moving-plain-spread | the same with a plain spread of mass |
moving-whole-pressure | the same with the whole pressure on faces |
moving-printed-heat | the same with the heating as printed | RR98 Eq. 51
moving-literal | points that move as printed | RR98 Eqs 39, 46-48
moving-literal-printed-heat | the same with the heating as printed | RR98 Eqs 39, 46-48, 51
moving-convective | points that move, rates in their own frame | RR98 Eqs 46-48
moving-carried | the same with volumes carried along | RR98 Eqs 46-48
moving-constant-mass | points of constant mass | RR98 Eq. 49
moving-constant-mass-printed-heat | the same with the heating as printed | RR98 Eqs 49, 51
moving-sph | points of constant mass, densities as powers that make it SPH | RR98 Eq. 50, a = -b = 1
moving-less-static | points of constant mass without the static pressure | RR98 Eq. 49
""")

SCENES = table("""
rayleigh-benard | a gas between a hot plate below and a cold one above, periodic sides | KHP95 Fig. 5
rayleigh-benard-box | the same in a square box whose side walls have the conduction profile | KHP95 Fig. 6
taylor-green | a vortex of Reynolds number 100 that decays by a factor e | Taylor & Green 1937
sound | a standing wave of sound for two periods |
shock-tube | Sod's tube and its mirror image, rows to half of one; the answer has no viscosity | Sod 1978
shear-layer | a sinusoidal shear flow without friction, and its fastest wave | Rayleigh 1880
couette | shear that settles between plates, the upper one sliding |
conduction | heat that spreads between plates of equal temperature |
""")

QUANTITIES = table("""
K | kinetic energy per mass; of smooth particles that of the smoothed velocity field | KHP95 Sec. VI
K_particles | kinetic energy per mass of smooth particles themselves, with their noise | KHP95 Sec. VI
Nu | Nusselt number: heat that passes over what conduction alone would carry |
Ra | Rayleigh number g alpha L^3 dT/(nu kappa), kappa = k/(rho C_V) | KHP95 Sec. IV
Pr | Prandtl number nu/kappa |
Ra_c | Rayleigh number at which convection begins |
growth | growth rate of the fastest disturbance, in free-fall units |
error | root of the mean square difference from the exact answer, relative |
rows | points or cells over the height |
cpu_s | seconds of CPU, without compiling |
converged | halves of the averaging time agree |
""")

#: of tables: the family of a method, and the variant that has the family's own name
FAMILIES = {"compressible": ("grid", "flux-form"), "spam": ("spam", "printed"), "dih": ("", "")}


def name_of(method: str, variant: str) -> str:
    """The name of what tables call by a family and a variant; nothing where it has none."""
    family, usual = FAMILIES.get(method, (method, ""))
    name = "-".join(filter(None, (family, variant.removeprefix(usual).removeprefix("-"))))
    return name if name in METHODS else ""


def explained(text: str = "") -> str:
    """Lines of all words with a text in their name or sentence, below what they are."""
    lines = []
    for title, words in (("methods", METHODS), ("scenes", SCENES), ("quantities", QUANTITIES)):
        rows = [word for word in words.values() if text.casefold() in " ".join(word).casefold()]
        lines += [f"{title}:", *(f"  {word.name:34s}{word.about}{f'  [{word.source}]'*bool(word.source)}"
                                 for word in rows)]*bool(rows)
    return "\n".join(lines) or f"no name and no sentence has {text!r}: leave it out to see all"


if __name__ == "__main__":
    print(explained(" ".join(sys.argv[1:])))
