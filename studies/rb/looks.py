"""Rows that figures show, picked from tables that may lack any of them, and how each kind of row looks."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from continuum.published import published
from studies.kit.figure import look, width
from studies.kit.stats import combine
from studies.kit.table import Tables
from studies.rb.tables import ALL, POINT

COLUMNS = {table.name: table.columns for table in ALL}
#: KHP95's ideal gas in the layer of Fig. 5; its square box of Fig. 6
LAYER = {"eos": "ideal", "transport": "const-eta", "sides": "periodic", "pr": 1}
BOX = {**LAYER, "sides": "walls"}
GRID = {"method": "compressible", "variant": "flux-form"}
SPAM = {"method": "spam", "variant": "printed"}
FROM_FLOW = {"variant": "printed-from-flow"}     # the same, but started from the grid's steady flow
RA_C = published("chandrasekhar-ra-rigid").value
#: energies below are none: motion has died out
STILL = 1e-6

#: the same kind of row looks the same in every figure
KIND = {"grid": {**look(0), "color": "black"}, "kp": look(1), "kg": {**look(2), "color": "#0072B2"},
        "boussinesq": {**look(3), "linestyle": "none"},
        "nu": {**look(3), "linestyle": "-."}, "from-flow": {**look(4), "color": "#0072B2", "linestyle": "none"},
        "khp": {"color": "black", "linestyle": "none", "markerfacecolor": "none", "markersize": 9,
                "markeredgewidth": 1.4, "zorder": 5}}
LABELS = {"kp": "$K_p$, all particles", "kg": "$K_g$, smoothed field"}
#: of the column `energy` of `errors`, besides
NUSSELT = {"nu": "Nusselt number, particles"}
UNSETTLED: dict[str, Any] = {"color": "black", "linestyle": "none", "marker": "x", "markersize": 8, "zorder": 6}
NOT_STEADY = "not steady: halves of the mean differ"
#: room for a number above an axis  [inches]
LABEL = 0.42
TIME = r"$(m\sigma^2/\varepsilon)^{1/2}$"
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
    """The printed scheme, means over seeds, by resolution and Ra; `steady` says that every seed has settled."""
    found = rows(tables, "means", **(SPAM | scene)).sort_values(["resolution", "ra"])
    return found.assign(steady=steady(tables, found))


def errors(tables: Tables, **scene: Any) -> pd.DataFrame:
    """Relative errors by method, resolution and energy (Kp, Kg or Nu), with `steady`."""
    found = rows(tables, "errors", **scene)
    return found.assign(steady=steady(tables, found))


def of_energy(found: pd.DataFrame) -> pd.DataFrame:
    """Those of K alone."""
    return found[found["energy"].str.lower().isin(LABELS)]


def settled(runs: pd.DataFrame) -> pd.Series:
    """Column `converged` of `kinetic_energy` as truth, whether read from CSV or made."""
    return runs["converged"].astype(str).eq("True")


def steady(tables: Tables, points: pd.DataFrame) -> pd.Series:
    """For each point whether all its runs have settled; a point whose runs are not told counts as settled."""
    runs = rows(tables, "kinetic_energy")
    runs = runs[~settled(runs) & runs["ke"].notna()]
    restless = pd.MultiIndex.from_frame(runs[POINT])
    return pd.Series(~pd.MultiIndex.from_frame(points[POINT]).isin(restless), index=points.index)


def diverged(tables: Tables, **scene: Any) -> pd.DataFrame:
    """Points of a method, particles if none is named, at which runs diverged: `t` of the first, `lost` of `seeds`."""
    runs = rows(tables, "kinetic_energy", **{"method": SPAM["method"]} | scene)
    found = [{**dict(zip(POINT, point)), "t": group.loc[group["ke"].isna(), "t_end"].min(),
              "lost": int(group["ke"].isna().sum()), "seeds": len(group)} for point, group in groups(runs, POINT)]
    found = [row for row in found if row["lost"]]
    return pd.DataFrame(found, columns=[*POINT, "t", "lost", "seeds"])


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


def over_seeds(frame: pd.DataFrame, by: list[str], value: str, err: str = "") -> pd.DataFrame:
    """Mean and `err` over seeds: the scatter between them or, if that is larger, the column of errors within runs."""
    frame = frame[frame[value].notna()]
    within = frame[err] if err else pd.Series(0.0, index=frame.index)
    found = [(*key, *combine(list(zip(group[value], within[group.index])))) for key, group in groups(frame, by)]
    return pd.DataFrame(found, columns=[*by, value, "err"])


def straight_line(limit: pd.DataFrame) -> np.ndarray | None:
    """(slope, constant) of K over Ra^-1/2 from Ra_c to 4 Ra_c, None for fewer than two rows    [KHP95, Sec. V]"""
    inside = limit[(limit["ra"] > RA_C) & (limit["ra"] <= 4*RA_C) & (limit["ke"] > STILL)]
    return np.polyfit(inside["ra"]**-0.5, inside["ke"], 1) if len(inside) > 1 else None


def cross_out(axes: Axes, x: pd.Series, y: pd.Series, steady: pd.Series) -> None:
    """A cross on each mark whose runs have not settled; one entry in the legend."""
    if not steady.all():
        told = axes.get_legend_handles_labels()[1]
        axes.plot(x[~steady], y[~steady], **UNSETTLED, label="" if NOT_STEADY in told else NOT_STEADY)


def ra_axis(axes: Axes) -> None:
    """Ra^-1/2 below, Ra above: the rounder ones first, others where there is room."""
    low, high = axes.get_xlim()
    top, wide = axes.secondary_xaxis("top"), width(axes)
    shown: list[float] = []
    for ra in (10000, 5000, 2500, 20000, 1500, 3500, 1e5, 2000, 7000, 50000):
        inches = [wide*abs(ra**-0.5 - other**-0.5)/(high - low) for other in shown]
        if low < ra**-0.5 < high and all(gap > LABEL for gap in inches):
            shown.append(ra)
    top.set_xticks([ra**-0.5 for ra in shown], labels=[f"{ra:g}" for ra in shown])
    top.tick_params(labelsize=8)
    top.set_xlabel("Rayleigh number Ra")
    axes.set_xlabel(r"$\mathrm{Ra}^{-1/2}$")
