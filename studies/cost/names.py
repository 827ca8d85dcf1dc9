"""Names of methods as tables and figures have them, and the colour of each family."""

GRID, NEWTON = "compressible grid, RK4", "compressible grid, Newton"
MAC_NEWTON, MAC_IMEX = "MAC grid, Newton", "MAC grid, IMEX"
PYPDE_GAS, PYPDE_BOUSSINESQ = "py-pde, gas", "py-pde, Boussinesq"
NEAREST, LATTICE, WIDE = "DIH lattice, h = 1.2 a", "DIH lattice, h = 2 a", "DIH lattice, h = 3 a"
TWO_STEP = "DIH lattice, h = 2 a, two-step"
LATTICE_MONAGHAN, LATTICE_WENDLAND = "DIH lattice, h = 2 a, Monaghan", "DIH lattice, h = 2 a, Wendland C2"
JITTERED, RELAXED = "DIH Delaunay, jittered", "DIH Delaunay, relaxed"
LUCY, MONAGHAN, WENDLAND = "SPAM, Lucy (as printed)", "SPAM, Monaghan", "SPAM, Wendland C2"
LESS_STATIC, LUCY_TWO_STEP = "SPAM, Lucy, less static pressure", "SPAM, Lucy, two-step"
MOVING = "moving points"

#: how a name begins -> colour
FAMILIES = {"compressible": "#000000", "MAC": "#882255", "py-pde": "#E69F00", "DIH lattice": "#0072B2",
            "DIH Delaunay": "#56B4E9", "SPAM": "#D55E00", "moving": "#009E73"}
ORDER = (GRID, NEWTON, MAC_NEWTON, MAC_IMEX, PYPDE_GAS, PYPDE_BOUSSINESQ, NEAREST, LATTICE, WIDE, TWO_STEP,
         LATTICE_MONAGHAN, LATTICE_WENDLAND, JITTERED, RELAXED, LUCY, MONAGHAN, WENDLAND, LESS_STATIC, LUCY_TWO_STEP, MOVING)


def family(name: str) -> str:
    """How a name begins."""
    return next(start for start in FAMILIES if name.startswith(start))
