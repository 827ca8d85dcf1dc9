"""Names of methods as tables and figures have them, and the colour of each family."""
from studies.build.names import LABELS

GRID = LABELS["grid"]
NEWTON = "compressible grid, Newton"
MAC_NEWTON = "MAC grid, Newton"
MAC_IMEX = "MAC grid, IMEX"
PYPDE_GAS = "py-pde, gas"
PYPDE_BOUSSINESQ = "py-pde, Boussinesq"
NEAREST = LABELS["fixed-lattice-h1.2"]
LATTICE = LABELS["fixed-lattice"]
WIDE = LABELS["fixed-lattice-h3"]
TWO_STEP = "DIH lattice, h = 2 a, two-step"
LATTICE_MONAGHAN = LABELS["fixed-lattice-monaghan"]
LATTICE_WENDLAND = LABELS["fixed-lattice-wendland-c2"]
JITTERED = LABELS["fixed-jittered-plates"]
RELAXED = LABELS["relaxed-plates"]
LUCY = LABELS["spam"]
MONAGHAN = LABELS["spam-monaghan"]
WENDLAND = LABELS["spam-wendland-c2"]
LESS_STATIC = LABELS["spam-less-static-50"]
LUCY_TWO_STEP = "SPAM, Lucy, two-step"
MOVING = LABELS["moving"]

#: how a name begins -> colour
FAMILIES = {"compressible": "#000000", "MAC": "#882255", "py-pde": "#E69F00", "DIH lattice": "#0072B2",
            "DIH Delaunay": "#56B4E9", "SPAM": "#D55E00", "moving": "#009E73"}
ORDER = (GRID, NEWTON, MAC_NEWTON, MAC_IMEX, PYPDE_GAS, PYPDE_BOUSSINESQ, NEAREST, LATTICE, WIDE, TWO_STEP,
         LATTICE_MONAGHAN, LATTICE_WENDLAND, JITTERED, RELAXED, LUCY, MONAGHAN, WENDLAND, LESS_STATIC, LUCY_TWO_STEP, MOVING)


def family(name: str) -> str:
    """How a name begins."""
    return next(start for start in FAMILIES if name.startswith(start))
