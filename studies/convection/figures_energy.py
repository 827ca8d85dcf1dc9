"""Kinetic energy against Ra^-1/2: the README's figure and KHP95's Figs 5, 6."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from continuum.published import published
from studies.convection.pick import (
    BOX,
    ENERGY,
    FROM_FLOW,
    KIND,
    LABELS,
    LAYER,
    RA_C,
    STILL,
    cross_out,
    finest,
    particles,
    ra_axis,
    reference,
    rows,
    straight_line,
)
from studies.kit.figure import below, figure
from studies.kit.table import Tables

ENERGIES = (("kp", "ke", LABELS["kp"]), ("kg", "ke_field", LABELS["kg"]))
KHP95_PARTICLES = 5000
#: how far marks at the same Ra are moved apart, in Ra^-1/2
ASIDE = 2.5e-4


def main(tables: Tables) -> Figure | None:
    """Grid, straight line, Boussinesq, particles and the printed numbers in one picture."""
    limit, spam = reference(tables, **LAYER), particles(tables, **LAYER)
    spam = spam[spam["particles"] <= KHP95_PARTICLES]
    if limit.empty and spam.empty:
        return None
    page, axes = figure(width=7, height=5.4)
    grid(axes, limit, "compressible grid, extrapolated")
    fitted_line(axes, limit)
    boussinesq(axes, tables)
    by_resolution(axes, spam)
    name_frozen(axes, limit, spam)
    from_flow(axes, tables, LAYER)
    printed_numbers(axes)
    axes.set(title="Convection of an ideal gas: are smooth particles on the grid's line?", ylabel=ENERGY)
    finish(axes, told(spam))
    return page


def grid(axes: Axes, limit: pd.DataFrame, label: str, **more: Any) -> None:
    """Line and markers of an extrapolated grid; the line stops where motion dies out."""
    moving, still = limit[limit["ke"] > STILL], limit[limit["ke"] <= STILL]
    if len(moving):
        axes.errorbar(moving["ra"]**-0.5, moving["ke"], moving["ke_err"], label=label, **KIND["grid"] | more)
        axes.plot(still["ra"]**-0.5, still["ke"], **KIND["grid"] | more | {"linestyle": "none"})


def fitted_line(axes: Axes, limit: pd.DataFrame) -> None:
    """The straight line between Ra_c and 4 Ra_c, dotted beyond."""
    found = straight_line(limit)
    if found is None:
        return
    x = np.array([(4*RA_C)**-0.5, -found[1]/found[0]])
    axes.axvline(RA_C**-0.5, ymax=0.6, color="0.4", lw=0.8, marker="", ls="--", zorder=0)
    axes.annotate(f"onset, linear theory: {RA_C:.0f}", (RA_C**-0.5, 0.3), xycoords=("data", "axes fraction"),
                  xytext=(3, 0), textcoords="offset points", rotation=90, ha="left", va="center", fontsize=8)
    axes.plot(x, np.polyval(found, x), color="0.55", lw=5, alpha=0.5, marker="", ls="-", zorder=0,
              label=r"line fitted from Ra$_c$ to 4 Ra$_c$, dotted beyond")
    beyond = np.array([limit["ra"].max()**-0.5, x[0]])
    axes.plot(beyond, np.polyval(found, beyond), color="0.4", lw=1.5, marker="", ls=":", zorder=0)


def boussinesq(axes: Axes, tables: Tables) -> None:
    """K_ff(Ra, Pr = 2)/2: at gamma = 2 half of the gradient is adiabatic and heat travels isobarically."""
    there = rows(tables, "means", method="boussinesq", sides="periodic", pr=2, resolution=np.inf)
    if len(there):
        axes.errorbar(there["ra"]**-0.5, there["ke"]/2, there["ke_err"]/2, label="Boussinesq, Pr = 2, halved",
                      **KIND["boussinesq"] | {"markerfacecolor": "none", "markersize": 8})


def by_resolution(axes: Axes, spam: pd.DataFrame) -> None:
    """Kp and Kg of the printed scheme; coarser ones smaller, paler and a little to the right."""
    sizes = sorted(spam["resolution"].unique(), reverse=True)
    for kind, column, label in ENERGIES:
        for number, size in enumerate(sizes):
            group = spam[spam["resolution"] == size]
            style = {"linestyle": "none", "markersize": max(2.5, 7 - 1.5*number), "alpha": max(0.35, 1 - 0.3*number)}
            x = group["ra"]**-0.5 + ASIDE*number
            axes.errorbar(x, group[column], group[f"{column}_err"], zorder=4 - number,
                          label=label if number == 0 else "", **KIND[kind] | style)
            cross_out(axes, x, group[column], group["steady"])


def name_frozen(axes: Axes, limit: pd.DataFrame, spam: pd.DataFrame) -> None:
    """A word where the grid convects and the finest particles, which start from weak rolls, stand still on a lattice."""
    grid_ke = finest(spam)["ra"].map(limit.set_index("ra")["ke"])
    for ra in finest(spam).loc[(grid_ke > STILL) & (finest(spam)["ke_field"] < 0.01*grid_ke), "ra"]:
        axes.annotate("frozen, from weak rolls", (ra**-0.5, 0), xytext=(-6, 1), textcoords="offset points", ha="right",
                      fontsize=8)


def from_flow(axes: Axes, tables: Tables, scene: dict[str, Any]) -> None:
    """Kg of particles that start from the grid's steady flow; coarser ones smaller and a little to the right."""
    spam = particles(tables, **scene, **FROM_FLOW)
    for number, size in enumerate(sorted(spam["resolution"].unique(), reverse=True)):
        group = spam[spam["resolution"] == size]
        x, more = group["ra"]**-0.5 + ASIDE*number, {"markersize": max(3, 7 - 1.5*number), "markerfacecolor": "white"}
        axes.errorbar(x, group["ke_field"], group["ke_field_err"], zorder=6 - number,
                      label="$K_g$, started from the grid's flow" if number == 0 else "", **KIND["from-flow"] | more)
        cross_out(axes, x, group["ke_field"], group["steady"])


def told(spam: pd.DataFrame) -> str:
    """Numbers of particles by size, the same at every Ra."""
    counts = [f"{number:.0f}" for number in sorted(spam["particles"].unique(), reverse=True)]
    smaller = f"; smaller and moved right: {', '.join(counts[1:])}" if counts[1:] else ""
    return f"; {counts[0]} particles{smaller}" if counts else ""


def printed_numbers(axes: Axes) -> None:
    """KHP95's four numbers, a little aside of ours."""
    for end, marker, label in (("", "o", "KHP95, grid"), ("-spam", "D", "KHP95, 5000 particles")):
        found = [published(f"khp95-ke-{ra}{end}") for ra in (5000, 10000)]
        axes.errorbar([5000**-0.5 - ASIDE, 10000**-0.5 - ASIDE], [f.value for f in found], [f.uncertainty for f in found],
                      marker=marker, label=f"{label}, printed (moved left)", capsize=0, **KIND["khp"])


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
    """The square box with four walls."""
    if not there(tables, BOX):
        return None
    page, axes = figure(width=6.4, height=4.8)
    grid(axes, reference(tables, **BOX), "compressible grid, extrapolated")
    spam = particles(tables, **BOX)
    by_resolution(axes, spam)
    name_frozen(axes, reference(tables, **BOX), spam)
    from_flow(axes, tables, BOX)
    axes.set(title="Square box with four walls, ideal gas: grid and particles    [KHP95, Fig. 6]", ylabel=ENERGY)
    finish(axes, told(spam))
    return page
