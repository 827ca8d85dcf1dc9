"""Figures of the study `onset`, from its tables alone; what the tables lack is left out."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.build.axes import ENERGY, ra_axis
from studies.kit.drawing import Drawings, Overview
from studies.kit.figure import COLOURS, MARKERS, below, errorbar, figure, look
from studies.kit.stats import combine
from studies.kit.table import Tables
from studies.onset.tables import ALL

COLUMNS = {table.name: table.columns for table in ALL}
GAS = {"method": "compressible", "eos": "ideal", "transport": "const-eta", "dT": 1.0, "sides": "periodic"}
LAYER = {"sides": "periodic"}
#: series of growth rates: label -> rows
GRIDS: dict[str, dict[str, Any]] = {
    "Boussinesq, staggered": {"method": "boussinesq", **LAYER},
    "Boussinesq, py-pde": {"method": "pypde-boussinesq", **LAYER},
    r"gas, $\eta$ constant": GAS,
    r"gas, $\nu$ constant": {**GAS, "transport": "const-nu"},
    r"gas, $\eta$ constant, py-pde": {**GAS, "method": "pypde-compressible"},
    "van der Waals": {**GAS, "eos": "vdw"},
}
#: schemes of particles that have a panel: variant -> title
SCHEMES = {"printed": "particles as printed", "less-static-90": "particles, a tenth of the static pressure"}
#: linear theory in the gas's free-fall time: half of the gradient is adiabatic, so that rolls grow sqrt 2 times more slowly
GAS_TIME = r"the same for the gas: over $\sqrt{2}$, half of" "\nits gradient is adiabatic"
WIDE, NARROW = (950.0, 3500.0), (1550.0, 1860.0)


def rows(tables: Tables, name: str, **wanted: Any) -> pd.DataFrame:
    """Rows of a table where each column has the wanted value; none if there is no such table."""
    frame = tables.get(name)
    if frame is None:
        return pd.DataFrame(columns=list(COLUMNS[name]))
    return frame[np.logical_and.reduce([np.ones(len(frame), bool), *(frame[key] == value for key, value in wanted.items())])]


# --- growth rates -----------------------------------------------------------------------------------------


def growth(tables: Tables) -> Figure | None:
    """sigma against Ra: weak rolls on all grids with linear theory; stronger rolls of particles and of the gas."""
    if rows(tables, "growth_rates", way="operator").empty:
        return None
    finite = finite_rolls(tables)
    schemes = [name for name in SCHEMES if name in set(finite["variant"])]
    page, all_axes = figure(1, 1 + len(schemes), width=4.6, height=5.6, squeeze=False)
    weak, strong = all_axes[0, 0], all_axes[0, 1:]
    theory(weak, tables)
    for number, (label, wanted) in enumerate(GRIDS.items()):
        found = rows(tables, "growth_rates", way="operator", **wanted)
        found = found[(found["resolution"] == found["resolution"].max()) & found["ra"].between(*NARROW)].sort_values("ra")
        weak.plot(found["ra"], found["sigma"], **{**look(number), "linestyle": "none"}, markerfacecolor="none", label=label)
    weak.set(title="weakest disturbances, finest grids", xlim=NARROW, ylim=(-0.02, 0.03))
    for axes, name in zip(strong, schemes):
        theory(axes, tables, low=1/np.sqrt(2))
        draw_rolls(axes, finite[finite["method"] != "spam"], first=0)
        draw_rolls(axes, finite[finite["variant"] == name], first=1)
        axes.set_title(SCHEMES[name])
        axes.sharey(strong[0])
    for axes in all_axes[0]:
        axes.axhline(0, color="black", linewidth=0.6, linestyle="-", marker="")
        axes.set(xlabel="Rayleigh number Ra", ylabel=r"growth rate $\sigma$  [1/free-fall time]")
        below(axes)
    page.suptitle("From which Ra on do rolls grow? Right: rolls of finite energy $K_0$, filled marks: the stronger ones; "
                  "bars: 95 % over seeds", fontsize=10)
    return page


def theory(axes: Axes, tables: Tables, low: float = 1.0) -> None:
    """Boussinesq fluid of Pr = 2, also in the gas's free-fall times: of half the gradient, sqrt 2 longer."""
    found = rows(tables, "growth_rates", method="linear", pr=2.0).sort_values("ra")
    for factor, style, label in ((1.0, "-", "linear theory, Pr = 2"), (1/np.sqrt(2), "--", GAS_TIME)):
        if factor <= low:
            axes.plot(found["ra"], factor*found["sigma"], color="black", linestyle=style, marker="", label=label)


def finite_rolls(tables: Tables) -> pd.DataFrame:
    """Runs from rolls whose energy is no small disturbance; grids have no name of a variant."""
    runs = rows(tables, "growth_rates", way="run")
    return runs[(runs["ke_start"] > 1e-6) & runs["ra"].between(*WIDE)]


def draw_rolls(axes: Axes, runs: pd.DataFrame, first: int) -> None:
    """Means over seeds for each number of rows, which has a look, and strength: full where strong, open where weak."""
    sizes, strongest = sorted(runs["resolution"].unique()), runs["ke_start"].max()
    for (method, size, ke), group in runs.groupby(["method", "resolution", "ke_start"]):
        of_ra = [(ra, *combine(list(zip(one["sigma"], one["err"])))) for ra, one in group.groupby("ra")]
        ra, sigma, err = np.array(of_ra).T
        style = look(first + sizes.index(size))
        errorbar(axes, list(ra), list(sigma), list(err), label=f"{'gas on a grid, ' * (method != 'spam')}{size:.0f} rows, "
                                                               f"$K_0$ = {ke:g}",
                 **style | {"lw": 0.9, "markerfacecolor": None if ke == strongest else "white"})


# --- straight lines ---------------------------------------------------------------------------------------


def line(tables: Tables) -> Figure | None:
    """K against Ra^-1/2 on KHP95's grids with its lines, how far K is from the line; where they and growth rates put Ra_c."""
    K = rows(tables, "energies", **GAS)
    if K.empty:
        return None
    page = Figure(figsize=(11.2, 5.2), layout="constrained")
    axes = page.subplot_mosaic([["K", "zeros"], ["rest", "zeros"]], height_ratios=(3, 1))
    far = rows(tables, "lines", **GAS)
    khp95 = np.isfinite(far["resolution"]) | (far["lines"] != "")
    far = far[khp95 & (far["reach"] == far["reach"].max())].sort_values("resolution")
    for number, (_, at) in enumerate(far.iterrows()):
        one_line(axes["K"], axes["rest"], K[K["resolution"] == at["resolution"]], at, number)
    axes["K"].set(ylabel=ENERGY, ylim=(0, None))
    axes["rest"].axhline(0, color="black", linewidth=0.6, linestyle="-", marker="")
    axes["rest"].set(xlabel=r"$\mathrm{Ra}^{-1/2}$", xlim=axes["K"].get_xlim(), ylabel="off the line\n[% of largest $K$]")
    ra_axis(axes["K"])
    axes["K"].set(xlabel="")
    axes["K"].legend(title="gas, $\\eta$ constant, line to 4 Ra$_c$")
    zeros(axes["zeros"], tables)
    return page


def one_line(upper: Axes, lower: Axes, points: pd.DataFrame, at: pd.Series, number: int) -> None:
    """K of one grid with its line; below, what is left, in per cent of the largest K."""
    x = np.array([points["ra"].max()**-0.5, at["ra_c"]**-0.5])
    limit = np.isinf(at["resolution"])
    look_of: dict[str, Any] = {"color": "black" if limit else COLOURS[number], "marker": MARKERS[number]}
    name = r"$L \to \infty$" if limit else f"L = {at['resolution']:.0f} cells"
    upper.plot(points["ra"]**-0.5, points["ke"], linestyle="none", **look_of, label=f"{name}: zero at {at['ra_c']:.1f}")
    upper.plot(x, at["slope"]*x + at["intercept"], **look_of | {"linestyle": "-", "marker": ""})
    rest = points["ke"] - at["slope"]*points["ra"]**-0.5 - at["intercept"]
    lower.plot(points["ra"]**-0.5, 100*rest/points["ke"].max(), linestyle="none", **look_of, markerfacecolor="none")


def zeros(axes: Axes, tables: Tables) -> None:
    """Ra_c of lines of each reach and of growth rates; the interval of a line, alike at all L, once."""
    found = rows(tables, "critical_ra", **GAS)
    single = np.isfinite(found["resolution"]) | (found["way"] == "operator") | found["quantity"].str.contains("L^-2", regex=False)
    found = found[(found["way"] != "run") & (found["resolution"] >= 24) & single]
    for number, ((way, reach), group) in enumerate(found.groupby(["way", "reach"], sort=True)):
        group = group.sort_values("resolution")
        label = "growth rates" if way == "operator" else f"line to {reach:g} Ra$_c$"
        err = group["err"].where(np.isinf(group["resolution"]), 0.0)
        errorbar(axes, group["resolution"]**-2.0*1e3, group["value"], err, number=number, label=label)
    known = rows(tables, "critical_ra", method="linear", quantity="ra_c periodic aspect 2")
    for value in known["value"]:
        axes.axhline(value, color="black", linestyle=":", marker="", label=f"Boussinesq, {value:.2f}")
    axes.set(xlabel=r"$10^3\,L^{-2}$, L in cells", ylabel=r"Ra$_c$")
    axes.legend(title=r"bars at $L \to \infty$: 95 %, scatter about the line", title_fontsize=8)


#: name of the file, tables that are needed, what draws it
FIGURES = Drawings(Overview("growth", ("growth_rates",), growth), Overview("line", ("energies", "lines", "critical_ra"), line))
