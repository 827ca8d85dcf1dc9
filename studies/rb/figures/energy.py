"""Kinetic energy against Ra^-1/2: KHP95's Figs 5, 6, and what they share with the README's figure."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.build.axes import ENERGY, ra_axis
from studies.kit.figure import below, figure
from studies.kit.table import Tables
from studies.rb.flows import STILL
from studies.rb.looks import (
    BOX,
    FROM_FLOW,
    GRID,
    KHP95_PARTICLES,
    KIND,
    LABELS,
    LAYER,
    MARKS,
    OPEN,
    PRINTED_WEIGHT,
    cross_out,
    finest,
    particles,
    reference,
    rows,
)

ENERGIES = (("kp", "ke", LABELS["kp"]), ("kg", "ke_field", LABELS["kg"]))
#: how far marks at the same Ra are moved apart, in Ra^-1/2
ASIDE = 1.5e-4
SMOOTHED_GRID = {"color": KIND["kg"]["color"], "marker": "", "linestyle": "-.", "lw": 1.5}
#: a second series of the same kind in one panel
SECOND = {"linestyle": "--", **OPEN}
VDW, CONST_NU = LAYER | {"eos": "vdw"}, LAYER | {"transport": "const-nu"}
IDEAL_PANEL = "ideal gas; particles at constant $\\nu$ moved right"
PANELS = ((IDEAL_PANEL, (("constant $\\eta$", LAYER, {}), ("constant $\\nu$", CONST_NU, SECOND))),
          ("van der Waals gas", (("constant $\\eta$", VDW, {}),)))


# --- series ---------------------------------------------------------------------------------------


def smoothed_grid(axes: Axes, tables: Tables, scene: dict[str, Any], size: float, limit: pd.DataFrame) -> None:
    """K of the grid's field, smoothed as the particles smooth theirs: what Kg is to be compared with."""
    seen = rows(tables, "smoothed", **GRID, **scene, **PRINTED_WEIGHT, rows=size).sort_values("ra")
    seen = seen[(seen["ke"] > STILL) & seen["ra"].isin(limit["ra"])]
    if len(seen):
        label = "the grid's field, smoothed like $K_g$"
        axes.plot(seen["ra"]**-0.5, seen["ke_smoothed"], label=label, **SMOOTHED_GRID)


def grid(axes: Axes, limit: pd.DataFrame, label: str, **more: Any) -> None:
    """Line and markers of an extrapolated grid; the line stops where motion dies out."""
    style, moving = KIND["grid"] | more, limit["ke"] > STILL
    if moving.any():
        flow, rest = limit[moving], limit[~moving]
        axes.errorbar(flow["ra"]**-0.5, flow["ke"], flow["ke_err"], label=label, **style)
        axes.plot(rest["ra"]**-0.5, rest["ke"], **style | MARKS)


def by_resolution(axes: Axes, spam: pd.DataFrame, kind: str, column: str, label: str) -> None:
    """An energy of the printed scheme; the finest filled and in place, coarser ones smaller, open, a little to the right."""
    for number, size in enumerate(sorted(spam["resolution"].unique(), reverse=True)):
        group = spam[spam["resolution"] == size]
        x, err = group["ra"]**-0.5 + ASIDE*number, group[f"{column}_err"]
        low = np.minimum(err, group[column])      # no energy is below zero
        style = KIND[kind] | (OPEN if number else {}) | MARKS | {"markersize": 7 - 1.2*number}
        axes.errorbar(x, group[column], [low, err], zorder=4 - number, **style,
                      label=f"{label}, {group['particles'].iloc[0]:.0f} particles")
        cross_out(axes, x, group[column], group["steady"])


def name_frozen(axes: Axes, limit: pd.DataFrame, spam: pd.DataFrame, aside: tuple[float, float] = (-14, 16)) -> None:
    """A word where the grid convects and the finest particles, which start from weak rolls, stand still on a lattice."""
    spam = finest(spam)
    grid_ke = spam["ra"].map(limit.set_index("ra")["ke"])
    line = {"arrowstyle": "-", "lw": 0.6, "shrinkB": 4}
    for ra in spam.loc[(grid_ke > STILL) & (spam["ke_field"] < 0.01*grid_ke), "ra"]:
        axes.annotate("frozen, from weak rolls", (ra**-0.5, 0), xytext=aside, textcoords="offset points", fontsize=8,
                      ha="right" if aside[0] < 0 else "left", arrowprops=line)


def from_flow(axes: Axes, tables: Tables, scene: dict[str, Any]) -> None:
    """Kg of the finest particles that start from the grid's steady flow."""
    started = finest(particles(tables, **scene, **FROM_FLOW))
    if len(started):
        x, style = started["ra"]**-0.5, {"markersize": 10, "markerfacecolor": "none", "zorder": 6}
        axes.errorbar(x, started["ke_field"], started["ke_field_err"], **KIND["from-flow"] | style,
                      label="$K_g$, started from the grid's flow")
        cross_out(axes, x, started["ke_field"], started["steady"])


def finish(axes: Axes, note: str = "") -> None:
    """Both axes and the legend below; a little room below zero, where motion has died out."""
    top = axes.get_ylim()[1]
    axes.set_ylim(-0.02*top, top)
    ra_axis(axes)
    below(axes, ncols=2, title=f"bars: 95 % intervals{note}", title_fontsize=8)


# --- figures --------------------------------------------------------------------------------------


def fig5(tables: Tables) -> Figure | None:
    """Kinetic energy K of convection against the Rayleigh number: grid and 5000 particles. Two gases, two transport laws."""
    panels = [panel for panel in PANELS if any(there(tables, scene) for _, scene, _ in panel[1])]
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


def there(tables: Tables, scene: dict[str, Any]) -> bool:
    """Whether a scene has rows."""
    return not (reference(tables, **scene).empty and particles(tables, **scene).empty)


def pair(axes: Axes, tables: Tables, scene: dict[str, Any], name: str, aside: float, **more: Any) -> None:
    """Grid of a scene and Kp, Kg of its finest particles, as many as KHP95 had or fewer."""
    spam, limit = particles(tables, **scene), reference(tables, **scene)
    spam = finest(spam[spam["particles"] <= KHP95_PARTICLES])
    grid(axes, limit, f"grid, {name}", **more)
    if not more:
        name_frozen(axes, limit, spam)
    for kind, column, label in ENERGIES if len(spam) else ():
        x, style = spam["ra"]**-0.5 + aside, KIND[kind] | more | MARKS
        axes.errorbar(x, spam[column], spam[f"{column}_err"], label=f"{label}, {name}", **style)
        cross_out(axes, x, spam[column], spam["steady"])


def fig6(tables: Tables) -> Figure | None:
    """Kinetic energy in a square box with four walls. Left all particles beside the grid, right the smoothed field."""
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
    page.suptitle("Square box with four walls, ideal gas: grid and particles    [KHP95, Fig. 6]\n"
                  "upper ends of long bars are cut", fontsize=10)
    return page
