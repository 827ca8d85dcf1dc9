"""All figures of `rb`; here the README's: K of particles and points beside the grid, errors over rows."""
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from continuum.published import published
from studies.build.axes import ra_axis
from studies.build.names import ENERGY, name_of
from studies.kit.figure import Drawings, Overview
from studies.kit.table import Tables
from studies.rb import looks
from studies.rb.figures import energy, errors, flow
from studies.rb.looks import ENERGIES, KHP95_PARTICLES, KIND, LAYER, RA_SHOWN, SPAM

RA_C = published("chandrasekhar-ra-rigid").value
#: points beside the grid and smooth particles, and how far their marks are moved right
POINTS = {"fixed-lattice": -energy.ASIDE, "fixed-jittered-plates": 0.0, "moving-delaunay": energy.ASIDE}
SHOWN = {key: errors.METHODS[key] for key in (
    "compressible flux-form Kp", "spam printed Kp", "spam printed Kg",
    "dih fixed-lattice Kp", "dih fixed-jittered-plates Kp", "dih moving-delaunay Kp")}


def main(tables: Tables) -> Figure | None:
    """Convection of an ideal gas: kinetic energy K of smooth particles and of points beside a converged grid.
    Below, their errors with more rows: those of points vanish, those of smooth particles do not.
    """
    limit, spam = looks.reference(tables, **LAYER), looks.rows(tables, "means", **SPAM, **LAYER)
    if limit.empty and spam.empty:
        return None
    page = Figure(figsize=(7, 8.6), layout="constrained")
    upper, lower = page.subplots(2, 1, height_ratios=(5, 4))
    spam = looks.finest(spam[spam.particles <= KHP95_PARTICLES]).sort_values("ra")
    whole(upper, tables, limit, spam.assign(steady=looks.steady(tables, spam)))
    over_rows(lower, errors.of_series(looks.errors(tables, **LAYER, ra=max(RA_SHOWN)), SHOWN))
    page.suptitle("Points converge on the grid, smooth particles as printed do not", fontsize=12)
    return page


def whole(axes: Axes, tables: Tables, limit: pd.DataFrame, spam: pd.DataFrame) -> None:
    """K against Ra^-1/2: grid, points and particles with as many rows, and the printed numbers."""
    size = spam.resolution.max()
    energy.grid(axes, limit, "grid, extrapolated")
    for kind, (column, words) in ENERGIES.items():
        style = KIND[kind] | {"markersize": 6, "zorder": 4}
        energy.energies(axes, spam, column, f"spam: {words}", style)
    for variant, aside in POINTS.items():
        same = looks.rows(tables, "means", method="dih", variant=variant, **LAYER, resolution=size)
        style = errors.METHODS[f"dih {variant} Kp"] | {"markersize": 8, "zorder": 5}
        energy.energies(axes, same.assign(steady=True), "ke", name_of("dih", variant), style, aside)
    energy.name_frozen(axes, limit, spam)
    name_onset(axes)
    printed_numbers(axes)
    axes.set(ylabel=ENERGY, title=f"particles and points: {size:.0f} rows")
    top = axes.get_ylim()[1]
    axes.set_ylim(-0.02*top, top)       # a little room below zero, where motion has died out
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
    axes.errorbar([ra**-0.5 - 2*energy.ASIDE for ra in RA_SHOWN], [one.value for one in printed],
                  [one.uncertainty for one in printed], marker="D", capsize=0,
                  label=f"KHP95, {KHP95_PARTICLES} particles, printed (moved left)", **KIND["khp"])


def over_rows(axes: Axes, chosen: pd.DataFrame) -> None:
    """|error| of K against rows, with lines; the look of a series is in the legend above."""
    for key, style in SHOWN.items():
        series = errors.of_series(chosen, [key])
        axes.plot(series.resolution, series.error.abs(), **style | {"marker": "", "lw": 0.8})
        errors.signed(axes, series, "", style)
    if len(chosen):
        beside = "$K_g$ beside the grid's field, smoothed likewise"
        errors.finish(axes, f"Ra = {max(RA_SHOWN)}; {beside}\n{errors.SIGNS}", chosen)
    axes.set_ylabel("relative error of $K$")


#: tables that have errors; what the tables lack is left out
OF_ERRORS = ("errors", "kinetic_energy")

figures = Drawings(
    Overview("main", ("means", *OF_ERRORS), main),
    Overview("fig8", ("history",), energy.fig8),
    Overview("fig9", ("fields",), flow.fig9),
    Overview("fig12", ("particles",), flow.fig12),
    Overview("convergence", (*OF_ERRORS, "smoothed"), errors.convergence),
    Overview("fixed_points", (*OF_ERRORS, "means"), errors.fixed_points),
    Overview("variants", OF_ERRORS, energy.variants),
    Overview("moving_points", OF_ERRORS, energy.moving_points),
)
