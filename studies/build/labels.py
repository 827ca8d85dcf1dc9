"""What figures of convection share: names of methods, of the axes, K against Ra^-1/2."""
from matplotlib.axes import Axes

from studies.kit.figure import width

ENERGY = r"kinetic energy per mass $K$  [$\varepsilon/m$]"
#: room for a number above an axis  [inches]
LABEL = 0.42
#: Rayleigh numbers to name, the rounder ones first
NAMED = (10000, 5000, 2500, 20000, 1500, 3500, 1e5, 2000, 7000, 50000)
#: name in `studies.build.METHODS` -> words in legends, tables and texts
LABELS = {
    "grid": "compressible grid, RK4", "grid-paper-form": "grid of KHP95's form",
    "grid-edge-heat": "grid, heat along edges", "grid-two-rolls": "grid, two rolls at the start",
    "grid-fig10": "grid, temperatures of Fig. 10", "spam": "SPAM, Lucy (as printed)",
    "spam-half-step": "SPAM, half of the time step", "spam-from-flow": "SPAM, from the grid's flow",
    "spam-fixed-rows": "SPAM, fixed rows behind plates", "spam-monaghan": "SPAM, Monaghan",
    "spam-wendland-c2": "SPAM, Wendland C2", "spam-wendland-c4": "SPAM, Wendland C4",
    "spam-wendland-c6": "SPAM, Wendland C6", "spam-range-4": "SPAM, Lucy, h = 4",
    "spam-range-6": "SPAM, Lucy, h = 6", "spam-walls-odd": "SPAM, images -v, 2 T_w - T",
    "spam-walls-own-pressure": "SPAM, images at rest, own pressure",
    "spam-walls-odd-own-pressure": "SPAM, images -v, own pressure",
    "spam-arithmetic-mean": "SPAM, arithmetic mean of densities",
    "spam-direct": "SPAM, friction and heat along pairs",
    "spam-more-static-400": "SPAM, five times the static pressure",
    "spam-more-static-100": "SPAM, twice the static pressure",
    "spam-less-static-50": "SPAM, Lucy, less static pressure",
    "spam-less-static-90": "SPAM, a tenth of the static pressure",
    "spam-direct-less-static-90": "SPAM, along pairs, a tenth of the static pressure",
    "fixed-lattice": "DIH lattice, h = 2 a", "fixed-lattice-h1.2": "DIH lattice, h = 1.2 a",
    "fixed-lattice-h3": "DIH lattice, h = 3 a", "fixed-lattice-monaghan": "DIH lattice, h = 2 a, Monaghan",
    "fixed-lattice-wendland-c2": "DIH lattice, h = 2 a, Wendland C2",
    "fixed-lattice-printed-heat": "DIH lattice, heating of Eq. 51 as printed",
    "fixed-lattice-nested": "DIH lattice, nested, a tenth along edges",
    "fixed-lattice-nested-only": "DIH lattice, nested", "fixed-jittered-plates": "DIH Delaunay, jittered",
    "fixed-random-plates": "DIH Delaunay, random", "relaxed-plates": "DIH Delaunay, relaxed",
    "fixed-jittered-delaunay": "DIH Delaunay, jittered, images",
    "fixed-random-delaunay": "DIH Delaunay, random, images",
    "relaxed-delaunay": "DIH Delaunay, relaxed, images", "relaxed-plain": "DIH plain edges, relaxed",
    "fixed-jittered-plain": "DIH plain edges, jittered", "fixed-jittered-exact": "DIH exact edges, jittered",
    "fixed-jittered-closed": "DIH closed edges, jittered", "moving": "moving points",
    "moving-half-step": "moving points, half of the time step",
    "moving-open-faces": "moving points, faces left open",
    "moving-closer-faces": "moving points, faces closed better",
    "moving-no-shift": "moving points, not shifted",
    "moving-no-follow": "moving points, volumes do not follow",
    "moving-no-spread": "moving points, no spread of mass",
    "moving-plain-spread": "moving points, plain spread of mass",
    "moving-whole-pressure": "moving points, whole pressure on faces",
    "moving-printed-heat": "moving points, heating of Eq. 51 as printed",
    "moving-literal": "RR98 moving, as printed",
    "moving-literal-printed-heat": "RR98 moving, as printed, its heating too",
    "moving-convective": "RR98 moving, convective [Eqs 46-48]",
    "moving-carried": "RR98 moving, convective, volumes carried",
    "moving-constant-mass": "RR98 moving, constant mass [Eq. 49]",
    "moving-constant-mass-printed-heat": "RR98 moving, constant mass, heating as printed",
    "moving-sph": "RR98 moving, Eq. 50 with a = -b = 1",
    "moving-less-static": "RR98 moving, Eq. 49 without static pressure"}

#: of `METHODS`, the family of a method in tables, and the variant that has the family's own name
FAMILIES = {"compressible": ("grid", "flux-form"), "spam": ("spam", "printed"), "dih": ("", "")}


def label(method: str, variant: str) -> str:
    """What people call the rows of a method and its variant; nothing where nobody calls them anything."""
    family, usual = FAMILIES.get(method, (method, ""))
    other = variant.removeprefix(usual).removeprefix("-")
    return LABELS.get("-".join(filter(None, (family, other))), "")


def ra_axis(axes: Axes) -> None:
    """Ra^-1/2 below, Ra above: the rounder ones first, others where there is room."""
    low, high = axes.get_xlim()
    scale = width(axes)/(high - low)
    shown: list[float] = []
    for ra in NAMED:
        inches = [scale*abs(ra**-0.5 - other**-0.5) for other in shown]
        if low < ra**-0.5 < high and all(gap > LABEL for gap in inches):
            shown.append(ra)
    top = axes.secondary_xaxis("top")
    top.set_xticks([ra**-0.5 for ra in shown], labels=[f"{ra:g}" for ra in shown])
    top.tick_params(labelsize=8)
    top.set_xlabel("Rayleigh number Ra")
    axes.set_xlabel(r"$\mathrm{Ra}^{-1/2}$")
