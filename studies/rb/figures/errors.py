"""Errors of K and of heat transport against rows over the height: of methods, of edges of fixed points."""
from collections.abc import Iterable
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.build.names import name_of
from studies.kit import fits
from studies.kit.figure import LINES, below, figure, look, numbered, plain_ticks
from studies.kit.table import Tables
from studies.rb import looks
from studies.rb.looks import ENERGIES, KIND, LAYER, MARKS, OPEN, RA_SHOWN

Style = dict[str, Any]
ROWS = "rows over the height $L$"
SIGNS = "filled marks: too large, open: too small; bars: 95 % intervals"
PALE = "pale lines: no power law, but a range"
PANEL: Style = {"width": 5.2, "sharex": "row", "sharey": "row", "squeeze": False}
#: of smooth particles
WORDS = {"spam printed Kp": f"spam: {ENERGIES['kp'][1]}", "spam printed Kg": f"spam: {ENERGIES['kg'][1]}",
         "spam printed Nu": "spam: Nusselt number", "spam sph Kp": "spam-sph: kinetic energy",
         "spam sumB Kp": "spam-sumB: kinetic energy",
         "spam corrected Kp": "spam-corrected: kinetic energy"}
#: "method variant energy" -> look
METHODS: dict[str, Style] = {
    "compressible flux-form Kp": KIND["grid"],
    "compressible paper-form Kp": {"color": "0.45", "marker": "X", "linestyle": ":"},
    "pypde-compressible staggered Kp": look(5),
    "dih fixed-lattice Kp": {**look(2), "marker": "v", "linestyle": LINES[4]},
    "dih fixed-jittered-plates Kp": {**look(4), "marker": "<"},
    "dih moving-delaunay Kp": {**look(7), "marker": "*", "markersize": 8},
    "dih moving Kp": {**look(6), "marker": ">"},
    "spam printed Kp": KIND["kp"],
    "spam printed Kg": KIND["kg"],
    "spam printed Nu": KIND["nu"],
    "spam sph Kp": {**look(5), "marker": "X"},
    "spam sumB Kp": {**look(6), "marker": "<"},
    "spam corrected Kp": {**look(7), "marker": "*", "markersize": 8},
}
EDGES = {
    "on a lattice, weight of Lucy": (
        "fixed-lattice", "fixed-lattice-h3", "fixed-lattice-nested", "fixed-lattice-nested-only",
        "fixed-lattice-printed-heat"),
    "off a lattice, Delaunay edges (-plates: rows on plates)": (
        "relaxed-plates", "relaxed-delaunay", "fixed-jittered-plates", "fixed-jittered-delaunay",
        "fixed-random-plates", "fixed-random-delaunay"),
    "off a lattice, edges of a weight": (
        "relaxed-plain", "fixed-jittered-plain", "fixed-jittered-closed", "fixed-jittered-exact"),
}


def convergence(tables: Tables) -> Figure | None:
    """Relative errors of kinetic energy and heat transport against rows over the height, for each method. A
    dotted line is what smoothing alone takes from the grid.
    """
    chosen = of_series(looks.errors(tables, **LAYER), METHODS)
    ras = [ra for ra in RA_SHOWN if (chosen.ra == ra).any()]
    kinds = [{key: METHODS[key] for key in METHODS if (key in WORDS) == smooth} for smooth in (False, True)]
    kinds = [keys for keys in kinds if len(of_series(chosen, keys))]
    if not ras:
        return None
    page, lines = figure(len(kinds), len(ras), height=4.4, **PANEL)
    for line, keys in zip(lines, kinds):
        rows = of_series(chosen, keys)
        for axes, ra in zip(line, ras):
            if keys.keys() == WORDS.keys():
                smoothing(axes, tables, ra)
            over_rows(axes, rows[rows.ra == ra], keys)
            finish(axes, f"Ra = {ra:g}", rows)
            below(axes, title=PALE, title_fontsize=8)
        line[0].set_ylabel("relative error")
    page.suptitle("Grids and points converge, smooth particles only with corrected sums\n"
                  r"$|K_p/K - 1|$, $|K_g/K_\mathrm{smoothed} - 1|$, $|\mathrm{Nu}_p/\mathrm{Nu} - 1|$"
                  f"\n{SIGNS}")
    return page


def fixed_points(tables: Tables) -> Figure | None:
    """Errors of K on points that stay, against rows over the height: lattices above, then points off a
    lattice. Each line is one kind of edges. Crossed out is also what ended in another number of rolls.
    """
    scene = {**LAYER, "method": "dih", "ra": max(RA_SHOWN)}
    chosen = pd.concat([looks.errors(tables, energy="Kp", **scene), other_flows(tables, scene)])
    gone = looks.diverged(tables, **scene)
    kinds = {kind: {f"dih {name} Kp": look(number) for number, name in enumerate(names)}
             for kind, names in EDGES.items()}
    kinds = {kind: keys for kind, keys in kinds.items() if len(of_series(chosen, keys))}
    if not kinds:
        return None
    page, all_axes = figure(len(kinds), 1, width=7.4, height=2.9, squeeze=False)
    for axes, (kind, keys) in zip(all_axes[:, 0], kinds.items()):
        over_rows(axes, chosen, keys, gone)
        finish(axes, kind, of_series(chosen, keys))
        axes.legend(loc="center left", bbox_to_anchor=(1, 0.5), title=PALE, title_fontsize=8)
        axes.set_ylabel(r"$|K/K_\mathrm{grid} - 1|$")
    page.suptitle("Points that stay converge on a lattice and with Delaunay edges that end on plates,\n"
                  f"not with edges of a weight off a lattice (Ra = {max(RA_SHOWN)})\n{SIGNS}")
    return page


def of_series(chosen: pd.DataFrame, keys: Iterable[str]) -> pd.DataFrame:
    """Rows of `errors` of these series, coarse ones first."""
    names = chosen.method + " " + chosen.variant + " " + chosen.energy
    return chosen[names.isin(keys)].sort_values("resolution")


def other_flows(tables: Tables, scene: dict[str, Any]) -> pd.DataFrame:
    """Points whose flow has another number of rolls than the grid's: not in `errors`, and not steady."""
    limit = looks.reference(tables, **LAYER)[["ra", "ke", "rolls"]]
    both = looks.rows(tables, "means", **scene).merge(limit, on="ra", suffixes=("", "_grid"))
    other = both[(both.resolution.astype(float) < np.inf) & (both.rolls != both.rolls_grid)]
    return other.assign(error=other.ke/other.ke_grid - 1, error_err=other.ke_err/other.ke_grid,
                        energy="Kp", steady=False)


def smoothing(axes: Axes, tables: Tables, ra: float) -> None:
    """1 - K_smoothed/K of the grid's own field: what Lucy's weight alone takes away, drawn as a line."""
    grid = looks.rows(tables, "smoothed", **looks.GRID, **LAYER, ra=ra, weight="Lucy", h=3)
    if len(grid):
        grid = grid.sort_values("rows")
        taken = 1 - grid.ke_smoothed/grid.ke
        axes.plot(grid.rows, taken, color=KIND["kg"]["color"], marker="", lw=2.5, ls=":",
                  label=r"$1 - K_\mathrm{smoothed}/K$: the smoothing alone")


def over_rows(axes: Axes, chosen: pd.DataFrame, keys: dict[str, Style],
              gone: pd.DataFrame | None = None) -> None:
    """Errors of each series with its power law; at which rows runs diverged is said in the legend."""
    for key, style in keys.items():
        series, (method, variant, _) = of_series(chosen, [key]), key.split()
        words = WORDS[key] if key in WORDS else name_of(method, variant)
        if gone is not None and (lost := gone.loc[gone.variant == variant, "resolution"]).any():
            words += f" [{', '.join(f'{size:.0f}' for size in lost)} rows: diverged]"
        if len(series):
            powers(axes, series, words, style)
        elif "diverged" in words:
            axes.errorbar([], [], [], label=words, **style)


def powers(axes: Axes, series: pd.DataFrame, words: str, style: Style) -> None:
    """Errors of one method with the power law through them or, where there is none, their range."""
    n, error, err = (series[name].to_numpy(float) for name in ("resolution", "error", "error_err"))
    line = style | {"marker": "", "lw": 0.8}
    if falling(error):
        fit = fits.weighted(np.log(n), np.log(np.abs(error)), np.maximum(err/np.abs(error), 1e-6))
        power = fit.slope
        axes.plot(n, np.exp([fit.at(x).value for x in np.log(n)]), **line)
        words += f": slope {power.value:.1f}" + f" $\\pm$ {power.err:.1f}"*bool(power.err > 0.05)
    elif len(n) > 1:
        axes.plot(n, np.abs(error), **line | {"alpha": 0.4})
        words += f": {100*error.min():+.2g} to {100*error.max():+.2g} %"
    signed(axes, series, words, style)


def falling(error: np.ndarray) -> bool:
    """Whether three errors or more, of one sign, become ever smaller: others have no power."""
    one_sign = abs(np.sign(error).sum()) == len(error)
    return bool(len(error) > 2 and one_sign and (np.diff(np.abs(error)) < 0).all())


def signed(axes: Axes, series: pd.DataFrame, words: str, style: Style) -> None:
    """|error| over rows, with its interval; filled where the error is positive, open where negative."""
    axes.errorbar([], [], [], label=words, **style | {"lw": 0.8})
    x, size, err = series.resolution, series.error.abs(), series.error_err
    down = np.minimum(err, 0.999*size)       # a logarithmic axis has no room for an interval across zero
    positive = series.error >= 0
    for sign, face in ((positive, {}), (~positive, OPEN)):
        axes.errorbar(x[sign], size[sign], [down[sign], err[sign]], **style | face | MARKS)
    looks.cross_out(axes, x, size, series.steady)


def finish(axes: Axes, title: str, line: pd.DataFrame) -> None:
    """Logarithmic axes in the range of a line of panels, numbers written out."""
    size = line.error.abs()
    axes.set(xscale="log", yscale="log", title=title, xlabel=ROWS, ylim=(0.4*size.min(), 2*size.max()))
    numbered(axes.yaxis, (1, 2, 5))
    plain_ticks(axes, sorted({*line.resolution}, key=lambda rows: (rows not in (25, 50, 100), rows)))
    axes.tick_params(labelbottom=True)
