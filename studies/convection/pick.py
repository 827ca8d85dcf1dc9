"""Rows that figures show, picked from tables that may lack any of them, and how each kind of row looks."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from continuum.published import published
from studies.convection.tables import ALL
from studies.kit.figure import look
from studies.kit.stats import combine
from studies.kit.table import Tables

COLUMNS = {table.name: table.columns for table in ALL}
#: KHP95's ideal gas in the layer of Fig. 5; its square box of Fig. 6
LAYER = {"eos": "ideal", "transport": "const-eta", "sides": "periodic", "pr": 1}
BOX = {**LAYER, "sides": "walls"}
GRID = {"method": "compressible", "variant": "flux-form"}
SPAM = {"method": "spam", "variant": "printed"}
RA_C = published("chandrasekhar-ra-rigid").value
#: energies below are none: motion has died out
STILL = 1e-6

#: the same kind of row looks the same in every figure
KIND = {"grid": {**look(0), "color": "black"}, "kp": look(1), "kg": {**look(2), "color": "#0072B2"},
        "boussinesq": {**look(3), "linestyle": "none"}, "pypde": look(4),
        "khp": {"color": "black", "linestyle": "none", "markerfacecolor": "none", "markersize": 9,
                "markeredgewidth": 1.4, "zorder": 5}}
LABELS = {"kp": "$K_p$, all particles", "kg": "$K_g$, smoothed field"}
ENERGY = r"kinetic energy per mass $K$  [$\varepsilon/m$]"


def rows(tables: Tables, name: str, **wanted: Any) -> pd.DataFrame:
    """Rows of a table where each column has the wanted value; none if there is no such table."""
    frame = tables.get(name)
    if frame is None:
        return pd.DataFrame(columns=list(COLUMNS[name]))
    for column, value in wanted.items():
        frame = frame[frame[column] == value]
    return frame


def reference(tables: Tables, **scene: Any) -> pd.DataFrame:
    """The compressible grid, extrapolated, by Ra."""
    return rows(tables, "means", **GRID, **scene, resolution=np.inf).sort_values("ra")


def particles(tables: Tables, **scene: Any) -> pd.DataFrame:
    """The printed scheme, means over seeds, by resolution and Ra."""
    return rows(tables, "means", **(SPAM | scene)).sort_values(["resolution", "ra"])


def groups(frame: pd.DataFrame, by: str | list[str]) -> list[tuple[Any, pd.DataFrame]]:
    """(value, its rows), values ascending."""
    return list(frame.groupby(by))


def finest(frame: pd.DataFrame) -> pd.DataFrame:
    """The rows of the highest resolution."""
    return frame[frame["resolution"] == frame["resolution"].max()]


def nearest(frame: pd.DataFrame, ra: float = 1e4) -> pd.DataFrame:
    """The rows of the Ra that is nearest to the one wanted (of two, the lower)."""
    there = np.sort(frame["ra"].unique().astype(float))
    return frame[frame["ra"] == there[np.argmin(np.abs(there - ra))]] if len(there) else frame


def over_seeds(frame: pd.DataFrame, by: list[str], value: str) -> pd.DataFrame:
    """Mean and `err` over seeds of a column that has no error of its own: the scatter between seeds."""
    found = [(*key, *combine([(x, 0.0) for x in group[value]])) for key, group in groups(frame, by)]
    return pd.DataFrame(found, columns=[*by, value, "err"])


def errors_of_k(tables: Tables, **scene: Any) -> pd.DataFrame:
    """Columns `kp`, `kp_err`, `kg`, `kg_err`: relative errors of all gas rows against the extrapolated grid.

    Rows of all methods and resolutions that are not extrapolated, where the grid convects and the reference exists.
    """
    limit = reference(tables, **scene).set_index("ra")
    gas = rows(tables, "means", **scene)
    gas = gas[np.isfinite(gas["resolution"].astype(float)) & gas["ra"].isin(limit.index[limit["ke"] > STILL])]
    ref = limit.loc[gas["ra"]]
    columns = {}
    for new, old in (("kp", "ke"), ("kg", "ke_field")):
        columns[new] = gas[old].to_numpy()/ref["ke"].to_numpy() - 1
        columns[f"{new}_err"] = np.hypot(gas[f"{old}_err"].to_numpy(), ref["ke_err"].to_numpy())/ref["ke"].to_numpy()
    return gas.assign(**columns)


def straight_line(limit: pd.DataFrame) -> np.ndarray | None:
    """(slope, constant) of K over Ra^-1/2 from Ra_c to 4 Ra_c, None for fewer than two rows    [KHP95, Sec. V]"""
    inside = limit[(limit["ra"] > RA_C) & (limit["ra"] <= 4*RA_C) & (limit["ke"] > STILL)]
    return np.polyfit(inside["ra"]**-0.5, inside["ke"], 1) if len(inside) > 1 else None


def ra_axis(axes: Axes) -> None:
    """Ra^-1/2 below, Ra above."""
    low, high = axes.get_xlim()
    ticks = [ra for ra in (1500, 2000, 2500, 3500, 5000, 7000, 10000, 20000, 50000, 1e5) if low < ra**-0.5 < high]
    top = axes.secondary_xaxis("top")
    top.set_xticks([ra**-0.5 for ra in ticks], labels=[f"{ra:g}" for ra in ticks])
    top.tick_params(labelsize=8)
    top.set_xlabel("Rayleigh number Ra")
    axes.set_xlabel(r"$\mathrm{Ra}^{-1/2}$")
