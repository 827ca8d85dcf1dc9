"""Figures of the study onset, from its tables alone."""
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.build.labels import ENERGY, ra_axis
from studies.kit.figure import COLOURS, MARKERS, Drawing, Drawings, below, errorbar, figure, look
from studies.onset.tables import means

GAS = {"method": "compressible", "eos": "ideal", "transport": "const-eta", "dT": 1.0, "sides": "periodic"}
#: series of growth rates: label -> rows
GRIDS: dict[str, dict[str, Any]] = {
    "Boussinesq, staggered": {"method": "boussinesq"},
    r"gas, $\eta$ constant": GAS,
    r"gas, $\nu$ constant": {**GAS, "transport": "const-nu"},
    r"gas, $\eta$ constant, py-pde": {**GAS, "method": "pypde-compressible"},
    "van der Waals": {**GAS, "eos": "vdw"},
}
#: schemes of particles that have a panel: variant -> title
SCHEMES = {"printed": "particles as printed", "less-static-90": "particles, a tenth of the static pressure"}
#: linear theory in the gas's free-fall time: half of the gradient is adiabatic
GAS_TIME = r"the same for the gas: over $\sqrt{2}$, half of" "\nits gradient is adiabatic"
NARROW = (1550.0, 1860.0)
ZERO: dict[str, Any] = {"color": "black", "linewidth": 0.6, "linestyle": "-", "marker": ""}


def rows(frame: pd.DataFrame, **wanted: Any) -> pd.DataFrame:
    """Rows of a table where each column has the wanted value."""
    for name, value in wanted.items():
        frame = frame[frame[name] == value]
    return frame


def growth(rates: pd.DataFrame) -> Figure | None:
    """sigma against Ra: weak rolls of grids and linear theory; stronger rolls of particles and of the gas."""
    weakest = rows(rates, way="operator")
    if weakest.empty:
        return None
    known = rows(rates, method="linear").sort_values("ra")
    finite = rows(rates, way="run")
    schemes = [name for name in SCHEMES if name in set(finite["variant"])]
    page, all_axes = figure(1, 1 + len(schemes), width=4.6, height=5.6, squeeze=False)
    weak, *strong = all_axes[0]
    draw_weakest(weak, weakest, known)
    for axes, name in zip(strong, schemes, strict=True):
        theory(axes, known, 1/np.sqrt(2), "--", GAS_TIME)
        draw_rolls(axes, finite[finite["method"] != "spam"], first=0)
        draw_rolls(axes, finite[finite["variant"] == name], first=1)
        axes.set_title(SCHEMES[name])
        axes.sharey(strong[0])
    for axes in all_axes[0]:
        axes.axhline(0, **ZERO)
        axes.set(xlabel="Rayleigh number Ra", ylabel=r"growth rate $\sigma$  [1/free-fall time]")
        below(axes)
    page.suptitle("From which Ra on do rolls grow? Right: rolls of K = 0.0004; bars: 95 % over seeds",
                  fontsize=10)
    return page


def theory(axes: Axes, known: pd.DataFrame, factor: float, style: str, label: str) -> None:
    """Boussinesq fluid of Pr = 2."""
    axes.plot(known["ra"], factor*known["sigma"], color="black", linestyle=style, marker="", label=label)


def draw_weakest(axes: Axes, rates: pd.DataFrame, known: pd.DataFrame) -> None:
    """Rates of the finest grids."""
    theory(axes, known, 1.0, "-", "linear theory, Pr = 2")
    theory(axes, known, 1/np.sqrt(2), "--", GAS_TIME)
    rates = rates[(rates["sides"] == "periodic") & rates["ra"].between(*NARROW)].sort_values("ra")
    for number, (label, wanted) in enumerate(GRIDS.items()):
        series = rows(rates, **wanted)
        finest = series[series["resolution"] == series["resolution"].max()]
        style = {**look(number), "linestyle": "none", "markerfacecolor": "none"}
        axes.plot(finest["ra"], finest["sigma"], **style, label=label)
    axes.set(title="weakest disturbances, finest grids", xlim=NARROW, ylim=(-0.02, 0.03))


def draw_rolls(axes: Axes, runs: pd.DataFrame, first: int) -> None:
    """Means over seeds for each number of rows."""
    for number, ((method, size), group) in enumerate(runs.groupby(["method", "resolution"])):
        where = "" if method == "spam" else "gas on a grid, "
        style = look(first + number) | {"lw": 0.9, "label": f"{where}{size:.0f} rows"}
        errorbar(axes, *means(group).to_numpy().T.tolist(), **style)


def line(energies: pd.DataFrame, lines: pd.DataFrame, critical: pd.DataFrame) -> Figure | None:
    """K against Ra^-1/2 on KHP95's grids, its lines, what is left; where they and growth rates put Ra_c."""
    K, far = rows(energies, **GAS), rows(lines, **GAS)
    if K.empty:
        return None
    page = Figure(figsize=(11.2, 5.2), layout="constrained")
    axes = page.subplot_mosaic([["K", "zeros"], ["rest", "zeros"]], height_ratios=(3, 1))
    khp95 = np.isfinite(far["resolution"]) | (far["lines"] != "")
    far = far[khp95 & (far["reach"] == far["reach"].max())].sort_values("resolution")
    for number, (_, at) in enumerate(far.iterrows()):
        one_line(axes["K"], axes["rest"], rows(K, resolution=at["resolution"]), at, number)
    axes["K"].set(ylabel=ENERGY, ylim=(0, None))
    axes["rest"].axhline(0, **ZERO)
    axes["rest"].set(xlabel=r"$\mathrm{Ra}^{-1/2}$", xlim=axes["K"].get_xlim(),
                     ylabel="off the line\n[% of largest $K$]")
    ra_axis(axes["K"])
    axes["K"].set(xlabel="")
    axes["K"].legend(title="gas, $\\eta$ constant, line to 4 Ra$_c$")
    zeros(axes["zeros"], critical)
    return page


def one_line(upper: Axes, lower: Axes, points: pd.DataFrame, at: pd.Series, number: int) -> None:
    """K of one grid with its line; below, what is left, in per cent of the largest K."""
    limit, x = np.isinf(at["resolution"]), points["ra"]**-0.5
    colour = "black" if limit else COLOURS[number]
    style: dict[str, Any] = {"color": colour, "marker": MARKERS[number], "linestyle": "none"}
    name = r"$L \to \infty$" if limit else f"L = {at['resolution']:.0f} cells"
    upper.plot(x, points["ke"], **style, label=f"{name}: zero at {at['ra_c']:.1f}")
    ends = np.array([x.min(), at["ra_c"]**-0.5])
    upper.plot(ends, at["slope"]*ends + at["intercept"], **style | {"linestyle": "-", "marker": ""})
    rest = points["ke"] - at["slope"]*x - at["intercept"]
    lower.plot(x, 100*rest/points["ke"].max(), **style, markerfacecolor="none")


def zeros(axes: Axes, critical: pd.DataFrame) -> None:
    """Ra_c of lines of each reach and of growth rates; the interval of a line, alike at all L, once."""
    of_gas = rows(critical, **GAS)
    of_gas = of_gas[(of_gas["way"] != "run") & (of_gas["resolution"] >= 24)].sort_values("resolution")
    through_limits = np.isinf(of_gas["resolution"]) & ~of_gas["quantity"].str.contains("L^-2", regex=False)
    of_gas = of_gas[(of_gas["way"] == "operator") | ~through_limits]
    for number, ((way, reach), group) in enumerate(of_gas.groupby(["way", "reach"])):
        label = "growth rates" if way == "operator" else f"line to {reach:g} Ra$_c$"
        err = group["err"].where(np.isinf(group["resolution"]), 0.0)
        errorbar(axes, group["resolution"]**-2.0*1e3, group["value"], err, number=number, label=label)
    for value in rows(critical, method="linear", quantity="ra_c periodic aspect 2")["value"]:
        axes.axhline(value, color="black", linestyle=":", marker="", label=f"Boussinesq, {value:.2f}")
    axes.set(xlabel=r"$10^3\,L^{-2}$, L in cells", ylabel=r"Ra$_c$")
    axes.legend(title=r"bars at $L \to \infty$: 95 %, scatter about the line", title_fontsize=8)


FIGURES = Drawings(
    Drawing("growth", ("growth_rates",), growth),
    Drawing("line", ("energies", "lines", "critical_ra"), line))
