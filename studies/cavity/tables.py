"""The table of the cavity, and limits of grids in it."""
import numpy as np

from studies.kit.fits import four_grids
from studies.kit.table import Rows, Table, Tables, groups

CAVITY = Table.of(
    "cavity", "method ra resolution quantity", "value err",
    about="A number of the square cavity of de Vahl Davis, Boussinesq fluid, Pr 0.71; velocities in kappa/L, "
          "places in L from the lower left corner.",
    means={"quantity": ("as in continuum/published/devahldavis.csv: nu of the mean, nu-max of the hot side, "
                        "u-max on the upright, v-max on the level middle line, psi-middle", ""),
           "value": ("the number", ""),
           "err": ("of the spectral method what more functions change, the most of those before; of limits "
                   "half of the 95 % interval", "")})
TABLES = (CAVITY,)


def limits(tables: Tables) -> Rows:
    """Of grids, at resolution inf."""
    if "cavity" not in tables:
        return {}
    rows = []
    table = tables["cavity"]
    grids = table[np.isfinite(table.resolution) & (table.method == "boussinesq")]
    for key, group in groups(grids, ["method", "ra", "quantity"]):
        if len(group) > 2:
            limit = four_grids(group.resolution, group.value)
            rows.append(dict(zip(("method", "ra", "quantity"), key))
                        | {"resolution": np.inf, "value": limit.value, "err": limit.err})
    return {"cavity": rows}
