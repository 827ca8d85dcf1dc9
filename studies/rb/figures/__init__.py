"""All figures of `rb`; here the README's: K of particles and points beside the grid, errors over rows."""
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from continuum.published import published
from studies.build.axes import ENERGY, ra_axis
from studies.build.words import name_of
from studies.kit.figure import Drawings, Overview
from studies.kit.table import Tables
from studies.rb.figures.energy import (
    ASIDE,
    energies,
    fig5,
    fig6,
    fig8,
    grid,
    moving_points,
    name_frozen,
    variants,
)
from studies.rb.figures.errors import METHODS, SIGNS, convergence, fixed_points, of_methods, signed
from studies.rb.figures.errors import finish as finish_errors
from studies.rb.figures.flow import fig2_3, fig7, fig9, fig12
from studies.rb.looks import (
    ENERGIES,
    KHP95_PARTICLES,
    KIND,
    LAYER,
    RA_SHOWN,
    errors,
    finest,
    particles,
    reference,
    rows,
)

RA_C = published("chandrasekhar-ra-rigid").value
#: points beside the grid and smooth particles, and how far their marks are moved right
POINTS = {"fixed-lattice": -ASIDE, "fixed-jittered-plates": 0.0, "moving": ASIDE}
SHOWN = {key: METHODS[key] for key in (
    ("compressible", "flux-form", "Kp"), ("spam", "printed", "Kp"), ("spam", "printed", "Kg"),
    ("dih", "fixed-lattice", "Kp"), ("dih", "fixed-jittered-plates", "Kp"), ("dih", "moving", "Kp"))}


def main(tables: Tables) -> Figure | None:
    """Convection of an ideal gas: kinetic energy K of smooth particles and of points beside a converged grid.
    Below, their errors with more rows: those of points vanish, those of smooth particles do not.
    """
    limit, spam = reference(tables, **LAYER), particles(tables, **LAYER)
    found = errors(tables, **LAYER, ra=max(RA_SHOWN))
    if limit.empty and spam.empty:
        return None
    page = Figure(figsize=(7, 8.6), layout="constrained")
    upper, lower = page.subplots(2, 1, height_ratios=(5, 4))
    whole(upper, tables, limit, finest(spam[spam["particles"] <= KHP95_PARTICLES]))
    over_rows(lower, found[of_methods(found, SHOWN)])
    page.suptitle("Points converge on the grid, smooth particles do not", fontsize=12)
    return page


def whole(axes: Axes, tables: Tables, limit: pd.DataFrame, spam: pd.DataFrame) -> None:
    """K against Ra^-1/2: grid, points and particles with as many rows, and the printed numbers."""
    size = spam["resolution"].max()
    grid(axes, limit, "grid, extrapolated")
    for kind, (column, words) in ENERGIES.items():
        style = KIND[kind] | {"markersize": 6, "zorder": 4}
        energies(axes, spam, column, f"spam: {words}", style)
    for variant, aside in POINTS.items():
        same = rows(tables, "means", method="dih", variant=variant, **LAYER, resolution=size)
        style = METHODS["dih", variant, "Kp"] | {"markersize": 8, "zorder": 5}
        energies(axes, same.assign(steady=True), "ke", name_of("dih", variant), style, aside)
    name_frozen(axes, limit, spam)
    name_onset(axes)
    printed_numbers(axes)
    top = axes.get_ylim()[1]
    axes.set(ylabel=ENERGY, ylim=(-0.02*top, top), title=f"particles and points: {size:.0f} rows")
    ra_axis(axes)
    axes.legend(loc="upper right", title="bars: 95 % intervals", title_fontsize=8)


def name_onset(axes: Axes) -> None:
    """Where linear theory has the first motion."""
    onset = RA_C**-0.5
    axes.axvline(onset, ymax=0.5, color="0.4", lw=0.8, marker="", ls="--", zorder=0)
    axes.annotate(f"onset, linear theory: {RA_C:.0f}", (onset, 0.28), xycoords=("data", "axes fraction"),
                  xytext=(3, 0), textcoords="offset points", rotation=90, ha="left", va="center", fontsize=8)


def printed_numbers(axes: Axes) -> None:
    """What KHP95 print of their particles, a little aside of ours."""
    printed = [published(f"khp95-ke-{ra}-spam") for ra in RA_SHOWN]
    axes.errorbar([ra**-0.5 - 2*ASIDE for ra in RA_SHOWN], [one.value for one in printed],
                  [one.uncertainty for one in printed], marker="D", capsize=0,
                  label=f"KHP95, {KHP95_PARTICLES} particles, printed (moved left)", **KIND["khp"])


def over_rows(axes: Axes, chosen: pd.DataFrame) -> None:
    """|error| of K against rows, with lines; the look of a series is in the legend above."""
    for key, style in SHOWN.items():
        series = chosen[of_methods(chosen, {key: style})].sort_values("resolution")
        axes.plot(series["resolution"], series["error"].abs(), **style | {"marker": "", "lw": 0.8})
        signed(axes, series, "", style)
    if len(chosen):
        beside = "$K_g$ beside the grid's field, smoothed likewise"
        finish_errors(axes, f"Ra = {max(RA_SHOWN)}; {beside}\n{SIGNS}", chosen)
    axes.set_ylabel("relative error of $K$")


#: tables that have energies and errors; what the tables lack is left out
OF_ENERGIES = ("means", "kinetic_energy", "smoothed")
OF_ERRORS = ("errors", "kinetic_energy")

figures = Drawings(
    Overview("main", ("means", *OF_ERRORS), main),
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
