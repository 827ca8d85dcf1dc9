"""The README's figure: K against Ra^-1/2 beside the grid, errors over rows, energies near onset."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from continuum.published import published
from studies.build.axes import ENERGY
from studies.kit.figure import below, plain_ticks
from studies.kit.table import Tables, groups
from studies.rb.figures.energy import ASIDE, ENERGIES, SMOOTHED_GRID, finish, grid, name_frozen, smoothed_grid
from studies.rb.looks import (
    FROM_FLOW,
    GRID,
    KHP95_PARTICLES,
    KIND,
    LAYER,
    MARKS,
    OPEN,
    PRINTED_WEIGHT,
    RA_C,
    RA_SHOWN,
    cross_out,
    errors,
    finest,
    of_energy,
    particles,
    reference,
    rows,
    straight_line,
)

#: an Ra little above onset, where particles come to rest
NEAR_ONSET = 2500
#: series near onset: from which start, look, column, line, label
STARTS = ((False, "kp", "ke", "--", "$K_p$ from weak rolls"), (False, "kg", "ke_field", "-", "$K_g$ from weak rolls"),
          (True, "from-flow", "ke_field", "-.", "$K_g$, started from the grid's flow"))


def main(tables: Tables) -> Figure | None:
    """Convection of an ideal gas: kinetic energy K of smooth particles beside a converged grid. Below, their errors with
    more rows of particles, and what is left of the flow near onset.
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
    near_onset(right, tables, spam)
    page.suptitle("Convection of an ideal gas: are smooth particles on the grid's line?", fontsize=11)
    return page


def whole(axes: Axes, tables: Tables, limit: pd.DataFrame, spam: pd.DataFrame) -> None:
    """K against Ra^-1/2: grid, its line, Boussinesq, particles, and the printed numbers."""
    grid(axes, limit, "compressible grid, extrapolated")
    if len(spam):
        smoothed_grid(axes, tables, LAYER, spam["resolution"].iloc[0], limit)
    fitted_line(axes, limit)
    boussinesq(axes, tables)
    for kind, column, label in ENERGIES if len(spam) else ():
        x, style = spam["ra"]**-0.5, KIND[kind] | MARKS | {"markersize": 6}
        axes.errorbar(x, spam[column], spam[f"{column}_err"], zorder=4, **style,
                      label=f"{label}, {spam['resolution'].iloc[0]:.0f} rows")
        cross_out(axes, x, spam[column], spam["steady"])
    name_frozen(axes, limit, spam)
    printed_numbers(axes)
    axes.set(ylabel=ENERGY)
    finish(axes, f"; particles: {spam['particles'].iloc[0]:.0f}" if len(spam) else "")


def fitted_line(axes: Axes, limit: pd.DataFrame) -> None:
    """The straight line between Ra_c and 4 Ra_c, dotted beyond."""
    line = straight_line(limit)
    if line is None:
        return
    zero = -line.coefficients[0]/line.coefficients[1]
    onset = RA_C**-0.5
    axes.axvline(onset, ymax=0.6, color="0.4", lw=0.8, marker="", ls="--", zorder=0)
    axes.annotate(f"onset, linear theory: {RA_C:.0f}", (onset, 0.3), xycoords=("data", "axes fraction"),
                  xytext=(3, 0), textcoords="offset points", rotation=90, ha="left", va="center", fontsize=8)
    inside, beyond = np.array([(4*RA_C)**-0.5, zero]), np.array([limit["ra"].max()**-0.5, (4*RA_C)**-0.5])
    axes.plot(inside, [line.at(x).value for x in inside], color="0.55", lw=5, alpha=0.5, marker="", ls="-", zorder=0,
              label=r"line fitted from Ra$_c$ to 4 Ra$_c$, dotted beyond")
    axes.plot(beyond, [line.at(x).value for x in beyond], color="0.4", lw=1.5, marker="", ls=":", zorder=0)


def boussinesq(axes: Axes, tables: Tables) -> None:
    """K_ff(Ra, Pr = 2)/2: at gamma = 2 half of the gradient is adiabatic and heat travels isobarically."""
    there = rows(tables, "means", method="boussinesq", sides="periodic", pr=2, resolution=np.inf)
    if len(there):
        style = KIND["boussinesq"] | {"markerfacecolor": "none", "markersize": 8}
        label = "Boussinesq, Pr = 2, halved"
        axes.errorbar(there["ra"]**-0.5, there["ke"]/2, there["ke_err"]/2, label=label, **style)


def printed_numbers(axes: Axes) -> None:
    """KHP95's four numbers, a little aside of ours."""
    x = [ra**-0.5 - ASIDE for ra in RA_SHOWN]
    for end, marker, label in (("", "o", "KHP95, grid"), ("-spam", "D", "KHP95, 5000 particles")):
        printed = [published(f"khp95-ke-{ra}{end}") for ra in RA_SHOWN]
        axes.errorbar(x, [one.value for one in printed], [one.uncertainty for one in printed], marker=marker,
                      label=f"{label}, printed (moved left)", capsize=0, **KIND["khp"])


def over_rows(axes: Axes, chosen: pd.DataFrame) -> None:
    """Errors of Kp and Kg against rows, filled and joined by full lines at the highest Ra, open and dashed at the others."""
    chosen = of_energy(chosen[chosen["ra"].isin(RA_SHOWN)]).sort_values("resolution")
    for (ra, energy), group in groups(chosen, ["ra", "energy"]):
        more = {} if ra == max(RA_SHOWN) else {**OPEN, "linestyle": "--"}
        style = KIND[energy.lower()] | {"linestyle": "-"} | more
        axes.errorbar(group["resolution"], 100*group["error"], 100*group["error_err"],
                      label=f"${energy[0]}_{energy[1]}$, Ra {ra:g}", **style)
        cross_out(axes, group["resolution"], 100*group["error"], group["steady"])
    axes.axhline(0, color="black", lw=1, marker="", ls="-", zorder=0)
    axes.set(xscale="log", xlabel="rows over the height $L$", ylabel="error  [%]",
             title="More particles: $K_p$ against $K$,\n$K_g$ against $K$ smoothed likewise")
    plain_ticks(axes, sorted({*chosen["resolution"]}))
    if len(chosen):
        below(axes, ncols=2, bbox_to_anchor=(0.5, -0.22))


def near_onset(axes: Axes, tables: Tables, spam: pd.DataFrame) -> None:
    """Energies little above onset, where the grid convects, from both starts."""
    scene = LAYER | {"ra": NEAR_ONSET}
    weak, strong = spam[spam["ra"] == NEAR_ONSET], particles(tables, **scene, **FROM_FLOW)
    for flow, kind, column, line, label in STARTS:
        chosen = strong if flow else weak
        if len(chosen):
            err = chosen[f"{column}_err"]
            low = np.minimum(err, 0.9*chosen[column])      # a logarithmic axis has no room for zero
            style = KIND[kind] | {"linestyle": line, "markerfacecolor": "white" if flow else None}
            axes.errorbar(chosen["resolution"], chosen[column], [low, err], label=label, **style)
    seen = rows(tables, "smoothed", **GRID, **scene, **PRINTED_WEIGHT).sort_values("rows")
    if len(seen):
        axes.plot(seen["rows"], seen["ke_smoothed"], label="the grid's field, smoothed like $K_g$", **SMOOTHED_GRID)
    axes.set(xscale="log", yscale="log", xlabel="rows over the height $L$", ylabel=r"energy per mass  [$\varepsilon/m$]",
             title=f"Near onset, Ra = {NEAR_ONSET}:\nwhat is left of convection")
    plain_ticks(axes, sorted({*weak["resolution"], *strong["resolution"], *seen["rows"]}))
    if axes.get_legend_handles_labels()[0]:
        below(axes, bbox_to_anchor=(0.5, -0.22))
