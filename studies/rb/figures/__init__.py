"""All figures of `rb`; here the README's: K beside the grid, errors over rows, energies near onset."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from continuum.published import published
from studies.build.labels import ENERGY
from studies.kit import fits
from studies.kit.figure import Drawings, Overview, below, plain_ticks
from studies.kit.table import Tables, groups
from studies.rb.figures.energy import (
    ASIDE,
    SMOOTHED_GRID,
    energies,
    fig5,
    fig6,
    fig8,
    finish,
    grid,
    moving_points,
    name_frozen,
    smoothed_grid,
    variants,
)
from studies.rb.figures.errors import ROWS, convergence, fixed_points
from studies.rb.figures.flow import fig2_3, fig7, fig9, fig12
from studies.rb.looks import (
    ENERGIES,
    FROM_FLOW,
    KHP95_PARTICLES,
    KIND,
    LAYER,
    OPEN,
    RA_SHOWN,
    cross_out,
    errors,
    finest,
    particles,
    reference,
    rows,
    seen,
)
from studies.rb.tables import STILL

RA_C = published("chandrasekhar-ra-rigid").value
#: an Ra little above onset, where particles come to rest
NEAR_ONSET = 2500
#: (what starts so, look, column, line, label) near onset
STARTS: tuple[Any, ...] = (
    ({}, "kp", "ke", "--", "$K_p$ from weak rolls"),
    ({}, "kg", "ke_field", "-", "$K_g$ from weak rolls"),
    (FROM_FLOW, "from-flow", "ke_field", "-.", "$K_g$, started from the grid's flow"))


def main(tables: Tables) -> Figure | None:
    """Convection of an ideal gas: kinetic energy K of smooth particles beside a converged grid. Below, their
    errors with more rows of particles, and what is left of the flow near onset.
    """
    limit, spam = reference(tables, **LAYER), particles(tables, **LAYER)
    if limit.empty and spam.empty:
        return None
    page = Figure(figsize=(7.4, 8.8), layout="constrained")
    parts: Any = page.subfigures(2, 1, height_ratios=(3, 2))
    upper, lower = parts
    whole(upper.subplots(), tables, limit, finest(spam[spam["particles"] <= KHP95_PARTICLES]))
    left, right = lower.subplots(1, 2)
    over_rows(left, errors(tables, method="spam", variant="printed", **LAYER))
    near_onset(right, tables)
    page.suptitle("Convection of an ideal gas: are smooth particles on the grid's line?", fontsize=11)
    return page


def whole(axes: Axes, tables: Tables, limit: pd.DataFrame, spam: pd.DataFrame) -> None:
    """K against Ra^-1/2: grid, its line, Boussinesq, particles, and the printed numbers."""
    grid(axes, limit, "compressible grid, extrapolated")
    smoothed_grid(axes, seen(tables, **LAYER, rows=spam["resolution"].max()), limit)
    fitted_line(axes, limit)
    boussinesq(axes, rows(tables, "means", method="boussinesq", sides="periodic", pr=2, resolution=np.inf))
    for kind, (column, words) in ENERGIES.items():
        style = KIND[kind] | {"markersize": 6, "zorder": 4}
        energies(axes, spam, column, f"{words}, {spam['resolution'].max():.0f} rows", style)
    name_frozen(axes, limit, spam)
    printed_numbers(axes)
    axes.set(ylabel=ENERGY)
    finish(axes)


def straight_line(limit: pd.DataFrame) -> fits.Fit | None:
    """K over Ra^-1/2 from Ra_c to 4 Ra_c, None for fewer than three rows    [KHP95, Sec. V]"""
    inside = limit[(limit["ra"] > RA_C) & (limit["ra"] <= 4*RA_C) & (limit["ke"] > STILL)]
    return fits.line(inside["ra"].to_numpy()**-0.5, inside["ke"].to_numpy()) if len(inside) > 2 else None


def fitted_line(axes: Axes, limit: pd.DataFrame) -> None:
    """The straight line between Ra_c and 4 Ra_c, dotted beyond."""
    line = straight_line(limit)
    if line is None:
        return
    onset, last = RA_C**-0.5, (4*RA_C)**-0.5
    axes.axvline(onset, ymax=0.6, color="0.4", lw=0.8, marker="", ls="--", zorder=0)
    axes.annotate(f"onset, linear theory: {RA_C:.0f}", (onset, 0.3), xycoords=("data", "axes fraction"),
                  xytext=(3, 0), textcoords="offset points", rotation=90, ha="left", va="center", fontsize=8)
    zero = -line.coefficients[0]/line.coefficients[1]
    style: Any = {"color": "0.55", "lw": 5, "alpha": 0.5, "marker": "", "ls": "-", "zorder": 0,
                  "label": r"line fitted from Ra$_c$ to 4 Ra$_c$, dotted beyond"}
    axes.plot([last, zero], [line.at(last).value, 0], **style)
    end = limit["ra"].max()**-0.5
    beyond = [line.at(end).value, line.at(last).value]
    axes.plot([end, last], beyond, color="0.4", lw=1.5, marker="", ls=":", zorder=0)


def boussinesq(axes: Axes, limit: pd.DataFrame) -> None:
    """K_ff(Ra, Pr = 2)/2: at gamma = 2 half of the gradient is adiabatic and heat travels isobarically."""
    if len(limit):
        style = KIND["boussinesq"] | {"markerfacecolor": "none", "markersize": 8}
        half, err, words = limit["ke"]/2, limit["ke_err"]/2, "Boussinesq, Pr = 2, halved"
        axes.errorbar(limit["ra"]**-0.5, half, err, label=words, **style)


def printed_numbers(axes: Axes) -> None:
    """KHP95's four numbers, a little aside of ours."""
    x = [ra**-0.5 - ASIDE for ra in RA_SHOWN]
    for end, marker, words in (("", "o", "KHP95, grid"), ("-spam", "D", "KHP95, 5000 particles")):
        printed = [published(f"khp95-ke-{ra}{end}") for ra in RA_SHOWN]
        axes.errorbar(x, [one.value for one in printed], [one.uncertainty for one in printed], marker=marker,
                      label=f"{words}, printed (moved left)", capsize=0, **KIND["khp"])


def over_rows(axes: Axes, chosen: pd.DataFrame) -> None:
    """Errors of Kp and Kg against rows: at the highest Ra filled and full, open and dashed at the others."""
    chosen = chosen[chosen["ra"].isin(RA_SHOWN) & (chosen["energy"] != "Nu")]
    for (ra, energy), group in groups(chosen, ["ra", "energy"]):
        more = {"linestyle": "-"} if ra == max(RA_SHOWN) else {**OPEN, "linestyle": "--"}
        axes.errorbar(group["resolution"], 100*group["error"], 100*group["error_err"],
                      label=f"${energy[0]}_{energy[1]}$, Ra {ra:g}", **KIND[energy.lower()] | more)
        cross_out(axes, group["resolution"], 100*group["error"], group["steady"])
    axes.axhline(0, color="black", lw=1, marker="", ls="-", zorder=0)
    axes.set(ylabel="error  [%]",
             title="More particles: $K_p$ against $K$,\n$K_g$ against $K$ smoothed likewise")
    rows_axis(axes, chosen["resolution"], ncols=2)


def near_onset(axes: Axes, tables: Tables) -> None:
    """Energies little above onset, where the grid convects, from both starts."""
    scene = LAYER | {"ra": NEAR_ONSET}
    for start, kind, column, line, words in STARTS:
        chosen = particles(tables, **scene, **start)
        err = chosen[f"{column}_err"]
        low = np.minimum(err, 0.9*chosen[column])      # a logarithmic axis has no room for zero
        style = KIND[kind] | {"linestyle": line} | (OPEN if start else {})
        if len(chosen):
            axes.errorbar(chosen["resolution"], chosen[column], [low, err], label=words, **style)
    field = seen(tables, **scene)
    if len(field):
        axes.plot(field["rows"], field["ke_smoothed"], **SMOOTHED_GRID)
    axes.set(yscale="log", ylabel=r"energy per mass  [$\varepsilon/m$]",
             title=f"Near onset, Ra = {NEAR_ONSET}:\nwhat is left of convection")
    rows_axis(axes, [*particles(tables, **scene)["resolution"], *field["rows"]])


def rows_axis(axes: Axes, sizes: Any, **legend: Any) -> None:
    """Rows over the height, logarithmic, and the legend below."""
    axes.set(xscale="log", xlabel=ROWS)
    plain_ticks(axes, sorted({*sizes}))
    if len(sizes):
        below(axes, bbox_to_anchor=(0.5, -0.22), **legend)


#: tables that have energies and errors; what the tables lack is left out
OF_ENERGIES = ("means", "kinetic_energy", "smoothed")
OF_ERRORS = ("errors", "kinetic_energy")

figures = Drawings(
    Overview("main", (*OF_ENERGIES, "errors"), main),
    Overview("fig2_3", ("particles",), fig2_3),
    Overview("fig5", ("means", "kinetic_energy"), fig5),
    Overview("fig6", OF_ENERGIES, fig6),
    Overview("fig7", ("particles",), fig7),
    Overview("fig8", ("history",), fig8),
    Overview("fig9", ("fields",), fig9),
    Overview("fig12", ("particles",), fig12),
    Overview("convergence", (*OF_ERRORS, "smoothed"), convergence),
    Overview("fixed_points", (*OF_ERRORS, "means"), fixed_points),
    Overview("variants", OF_ERRORS, variants),
    Overview("moving_points", OF_ERRORS, moving_points),
)
