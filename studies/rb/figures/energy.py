"""Kinetic energy against Ra^-1/2: KHP95's Figs 5, 6, and what they share with the README's figure."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.kit.figure import below, figure
from studies.kit.table import Tables
from studies.rb.figures.errors import PRINTED_WEIGHT
from studies.rb.looks import (
    BOX,
    ENERGY,
    FROM_FLOW,
    GRID,
    KIND,
    LABELS,
    LAYER,
    STILL,
    cross_out,
    finest,
    particles,
    ra_axis,
    reference,
    rows,
)

ENERGIES = (("kp", "ke", LABELS["kp"]), ("kg", "ke_field", LABELS["kg"]))
KHP95_PARTICLES = 5000
#: how far marks at the same Ra are moved apart, in Ra^-1/2
ASIDE = 1.5e-4
SMOOTHED_GRID = {"color": KIND["kg"]["color"], "marker": "", "linestyle": "-.", "lw": 1.5}


def smoothed_grid(axes: Axes, tables: Tables, scene: dict[str, Any], size: float, limit: pd.DataFrame) -> None:
    """K of the grid's field, smoothed as the particles smooth theirs: what Kg is to be compared with."""
    found = rows(tables, "smoothed", **GRID, **scene, **PRINTED_WEIGHT, rows=size).sort_values("ra")
    found = found[(found["ke"] > STILL) & found["ra"].isin(limit["ra"])]
    if len(found):
        axes.plot(found["ra"]**-0.5, found["ke_smoothed"], label="the grid's field, smoothed like $K_g$", **SMOOTHED_GRID)


def grid(axes: Axes, limit: pd.DataFrame, label: str, **more: Any) -> None:
    """Line and markers of an extrapolated grid; the line stops where motion dies out."""
    moving, still = limit[limit["ke"] > STILL], limit[limit["ke"] <= STILL]
    if len(moving):
        axes.errorbar(moving["ra"]**-0.5, moving["ke"], moving["ke_err"], label=label, **KIND["grid"] | more)
        axes.plot(still["ra"]**-0.5, still["ke"], **KIND["grid"] | more | {"linestyle": "none"})


def by_resolution(axes: Axes, spam: pd.DataFrame, kind: str, column: str, label: str) -> None:
    """An energy of the printed scheme; the finest filled and in place, coarser ones smaller, open and a little to the right."""
    for number, size in enumerate(sorted(spam["resolution"].unique(), reverse=True)):
        group = spam[spam["resolution"] == size]
        open_ = {"markerfacecolor": "white"} if number else {}
        low = np.minimum(group[f"{column}_err"], group[column])      # no energy is below zero
        axes.errorbar(group["ra"]**-0.5 + ASIDE*number, group[column], [low, group[f"{column}_err"]], zorder=4 - number,
                      label=f"{label}, {group['particles'].iloc[0]:.0f} particles",
                      **KIND[kind] | open_ | {"linestyle": "none", "markersize": 7 - 1.2*number})
        cross_out(axes, group["ra"]**-0.5 + ASIDE*number, group[column], group["steady"])


def name_frozen(axes: Axes, limit: pd.DataFrame, spam: pd.DataFrame, aside: tuple[float, float] = (-14, 16)) -> None:
    """A word where the grid convects and the finest particles, which start from weak rolls, stand still on a lattice."""
    grid_ke = finest(spam)["ra"].map(limit.set_index("ra")["ke"])
    for ra in finest(spam).loc[(grid_ke > STILL) & (finest(spam)["ke_field"] < 0.01*grid_ke), "ra"]:
        axes.annotate("frozen, from weak rolls", (ra**-0.5, 0), xytext=aside, textcoords="offset points", fontsize=8,
                      ha="right" if aside[0] < 0 else "left", arrowprops={"arrowstyle": "-", "lw": 0.6, "shrinkB": 4})


def from_flow(axes: Axes, tables: Tables, scene: dict[str, Any]) -> None:
    """Kg of the finest particles that start from the grid's steady flow."""
    found = finest(particles(tables, **scene, **FROM_FLOW))
    if len(found):
        axes.errorbar(found["ra"]**-0.5, found["ke_field"], found["ke_field_err"], zorder=6,
                      label="$K_g$, started from the grid's flow",
                      **KIND["from-flow"] | {"markersize": 10, "markerfacecolor": "none"})
        cross_out(axes, found["ra"]**-0.5, found["ke_field"], found["steady"])


def fig5(tables: Tables) -> Figure | None:
    """Ideal gas with both transports, van der Waals gas; grid and the most particles."""
    vdw, const_nu = LAYER | {"eos": "vdw"}, LAYER | {"transport": "const-nu"}
    panels = [("ideal gas; particles at constant $\\nu$ moved right",
               (("constant $\\eta$", LAYER, {}), ("constant $\\nu$", const_nu, OPEN))),
              ("van der Waals gas", (("constant $\\eta$", vdw, {}),))]
    panels = [(title, series) for title, series in panels if any(there(tables, scene) for _, scene, _ in series)]
    if not panels:
        return None
    page, all_axes = figure(1, len(panels), width=5, height=4.6, sharex=True, sharey=True, squeeze=False)
    for axes, (title, series) in zip(all_axes[0], panels):
        for number, (name, scene, more) in enumerate(series):
            pair(axes, tables, scene, name, ASIDE*number, **more)
        axes.set_title(title)
    for axes in all_axes[0]:
        finish(axes)
    all_axes[0, 0].set_ylabel(ENERGY)
    page.suptitle("Layer of aspect 2: grid and particles    [KHP95, Fig. 5]", fontsize=10)
    return page


OPEN = {"linestyle": "--", "markerfacecolor": "white"}


def there(tables: Tables, scene: dict[str, Any]) -> bool:
    return not (reference(tables, **scene).empty and particles(tables, **scene).empty)


def pair(axes: Axes, tables: Tables, scene: dict[str, Any], name: str, aside: float, **more: Any) -> None:
    """Grid of a scene and Kp, Kg of its finest particles, as many as KHP95 had or fewer."""
    spam = particles(tables, **scene)
    spam = finest(spam[spam["particles"] <= KHP95_PARTICLES])
    grid(axes, reference(tables, **scene), f"grid, {name}", **more)
    if not more:
        name_frozen(axes, reference(tables, **scene), spam)
    for kind, column, label in ENERGIES if len(spam) else ():
        axes.errorbar(spam["ra"]**-0.5 + aside, spam[column], spam[f"{column}_err"], label=f"{label}, {name}",
                      **KIND[kind] | more | {"linestyle": "none"})
        cross_out(axes, spam["ra"]**-0.5 + aside, spam[column], spam["steady"])


def finish(axes: Axes, note: str = "") -> None:
    """Both axes and the legend below; a little room below zero, where motion has died out."""
    top = axes.get_ylim()[1]
    axes.set_ylim(-0.02*top, top)
    ra_axis(axes)
    below(axes, ncols=2, title=f"bars: 95 % intervals{note}", title_fontsize=8)


def fig6(tables: Tables) -> Figure | None:
    """The square box with four walls: all particles beside the grid, the smoothed field beside the grid's, smoothed."""
    limit, spam = reference(tables, **BOX), particles(tables, **BOX)
    if limit.empty and spam.empty:
        return None
    page, both = figure(1, 2, width=5, height=5, sharex=True, sharey=True)
    for axes, (kind, column, label) in zip(both, ENERGIES):
        grid(axes, limit, "compressible grid, extrapolated")
        by_resolution(axes, spam, kind, column, label)
    if len(spam):
        smoothed_grid(both[1], tables, BOX, spam["resolution"].max(), limit)
    name_frozen(both[1], limit, spam, aside=(36, 44))
    from_flow(both[1], tables, BOX)
    both[0].set(ylabel=ENERGY, ylim=(0, 1.1*max([*limit["ke"], *spam["ke"]])))
    for axes in both:
        finish(axes, "; smaller marks: moved right")
    page.suptitle("Square box with four walls, ideal gas: grid and particles    [KHP95, Fig. 6]\nupper ends of long bars are cut",
                  fontsize=10)
    return page
