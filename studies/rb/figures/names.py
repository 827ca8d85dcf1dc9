"""What figures call methods and variants, and the look that each keeps in every figure; apart from what runs them."""
from typing import Any

from studies.kit.figure import COLOURS, LINES, MARKERS, look
from studies.rb.looks import GRID, KIND

#: variants of smooth particles by what they change: name -> words
SPAM_GROUPS = {
    "as printed": {"printed": "Lucy's weight, $h = 3\\sigma$, images", "printed-half-step": "half of the time step"},
    "weight": {"printed-monaghan": "Monaghan's", "wendland-c2": "Wendland's C2", "wendland-c4": "Wendland's C4",
               "wendland-c6": "Wendland's C6", "range-4": "Lucy's, $h = 4\\sigma$", "range-6": "Lucy's, $h = 6\\sigma$"},
    "walls": {"printed-fixed-rows": "fixed rows", "walls-odd": "images $-v$, $2T_w - T$",
              "walls-own-pressure": "images at rest, own $P$", "walls-odd-own-pressure": "images $-v$, own $P$"},
    "static pressure in the sums": {"less-static-90": "a tenth of it", "less-static-50": "half of it",
                                    "more-static-100": "twice as much", "more-static-400": "five times as much"},
    "viscosity, conduction": {"direct": "along pairs, not nested", "direct-less-static-90": "the same, a tenth of the pressure",
                              "arithmetic-mean": "arithmetic mean of densities"},
}
#: schemes on points that stay, by what they are for
FIXED_GROUPS = {
    "on a lattice, weight of Lucy": {
        "fixed-lattice": "friction along edges [Eq. 51], $h = 2a$", "fixed-lattice-h3": "the same, $h = 3a$",
        "fixed-lattice-nested": "nested [Eqs 37, 38], a tenth along edges", "fixed-lattice-nested-only": "nested alone",
        "fixed-lattice-printed-heat": "heating of Eq. 51 as printed"},
    "off a lattice, edges of Delaunay triangles": {
        "relaxed-plates": "moved apart, rows of points on the plates", "relaxed-delaunay": "moved apart, images",
        "fixed-jittered-plates": "shifted by up to $0.3a$, rows on the plates",
        "fixed-jittered-delaunay": "shifted by up to $0.3a$, images",
        "fixed-random-plates": "random, rows on the plates", "fixed-random-delaunay": "random, images"},
    "off a lattice, edges of a weight": {
        "relaxed-plain": "moved apart, plain", "fixed-jittered-plain": "shifted by up to $0.3a$, plain",
        "fixed-jittered-closed": "shifted, closed", "fixed-jittered-exact": "shifted, exact"},
}
#: what the scheme on moving points does without one of its ingredients, or with more of it
INGREDIENTS = {
    "moving": "all ingredients", "moving-half-step": "half of the time step", "moving-open-faces": "faces left open",
    "moving-closer-faces": "faces closed better", "moving-no-shift": "points not shifted",
    "moving-no-follow": "volumes do not follow", "moving-no-spread": "no spread of mass",
    "moving-plain-spread": "plain spread of mass", "moving-whole-pressure": "whole pressure on faces",
    "moving-printed-heat": "heating of Eq. 51 as printed",
}
#: RR98's own motions
MOTIONS = {
    "moving-literal": "as printed [Eqs 39-41]", "moving-literal-printed-heat": "the same, heating as printed",
    "moving-convective": "convective [Eqs 46-48]", "moving-carried": "the same, volumes carried",
    "moving-constant-mass": "constant mass [Eq. 49]", "moving-constant-mass-printed-heat": "the same, heating as printed",
    "moving-sph": "Eq. 50 with $a = -b = 1$", "moving-less-static": "Eq. 49 without static pressure",
}
MOVING_GROUPS = {"the scheme and its ingredients": INGREDIENTS, "motions of RR98": MOTIONS}
WORDS = {name: words for groups in (SPAM_GROUPS, FIXED_GROUPS, MOVING_GROUPS) for group in groups.values()
         for name, words in group.items()}
#: (method, variant) -> label, look: one for each series in all figures
METHODS: dict[tuple[str, str], tuple[str, dict[str, Any]]] = {
    (GRID["method"], GRID["variant"]): ("compressible grid", KIND["grid"]),
    ("compressible", "paper-form"): ("grid of KHP95's form", {"color": "0.45", "marker": "X", "linestyle": ":"}),
    ("pypde-compressible", "staggered"): ("grid in py-pde", look(5)),
    ("dih", "fixed-lattice"): ("fixed points, lattice", {**look(2), "marker": "v", "linestyle": LINES[4]}),
    ("dih", "fixed-jittered-plates"): ("fixed points, shifted", {**look(4), "marker": "<"}),
    ("dih", "moving"): ("moving points", {**look(7), "marker": "*", "markersize": 8}),
}


def method(name: str, variant: str) -> tuple[str, dict[str, Any]]:
    """Label and look of a series; one that is not known here keeps its own name and looks like the others of its kind."""
    return METHODS.get((name, variant), (f"{name}, {variant}", {"color": "0.3", "marker": "h", "linestyle": LINES[7]}))


def grouped(names: set[str], groups: dict[str, dict[str, str]], rest: str = "others") -> dict[str, list[str]]:
    """The names that there are by group, in the order of the groups; names that no group knows come last."""
    there = {title: [name for name in group if name in names] for title, group in groups.items()}
    unknown = sorted(names - {name for group in groups.values() for name in group})
    return {title: found for title, found in (*there.items(), (rest, unknown)) if found}


def words(name: str) -> str:
    """What a variant is, with the name that tables have for it."""
    return f"{WORDS[name]}  ({name})" if name in WORDS else name


def numbered(names: list[str]) -> dict[str, dict[str, Any]]:
    """A look for each of a panel's series."""
    return {name: {"color": COLOURS[n % 8], "marker": (*MARKERS, "<", ">")[n % 10], "linestyle": LINES[n % 8]}
            for n, name in enumerate(names)}
