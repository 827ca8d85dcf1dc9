"""Figures of the study, from its tables."""
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.build.names import name_of
from studies.kit.figure import Drawing, Drawings, errorbar, figure, look, numbered, plain_ticks
from studies.kit.table import groups
from studies.lattices.loss import fitted, projected

#: part of the static pressure that the sums hold -> label
HELD = {5.0: "five times", 2.0: "twice", 1.0: "as printed", 0.5: "half", 0.1: "a tenth"}
SERIES = {"printed": "Lucy, h = 3 a", "fixed": "Wendland C2, h = 3 a",
          "joint": r"Wendland C2, h $\propto$ rows$^{1/2}$"}


def stress(driven: pd.DataFrame, laws: pd.DataFrame, foretold: pd.DataFrame) -> Figure:
    """Stress of the pressure sum over rate and pressure; what is left of a flow over rows; K foretold."""
    page, (left, middle, right) = figure(1, 3, width=4.2, height=3.9)
    runs = fitted(driven).query("law == 'printed'")
    C, q = map(float, laws.set_index("variant").loc["printed", ["C", "q"]])
    for number, (P, label) in enumerate(HELD.items()):
        some = runs[np.isclose(runs.P, P)]
        left.plot(some.J, some.tau, **{**look(number), "linestyle": "none"}, label=f"$P$ {label}")
    J = np.geomspace(runs.J.min(), runs.J.max(), 50)
    left.plot(J, projected(q)*C*J**q, color="grey", marker="", linewidth=0.9, label=f"$q$ = {q:.2f}")
    left.set(xscale="log", yscale="log", xlabel=r"friction $\eta\gamma/P$",
             ylabel="stress of the pressure sum / $P$")
    for number, (name, label) in enumerate(SERIES.items()):
        flow = series(driven, name).groupby("rows")["flow"]
        spread = (flow.max() - flow.min())/2
        errorbar(middle, list(spread.index), flow.mean(), spread, number=number, label=label,
                 linestyle=look(number)["linestyle"])
    numbered(left.yaxis)
    middle.axhline(1, color="grey", linewidth=0.6)
    middle.set(xscale="log", xlabel="rows", ylabel="amplitude of vortices / exact")
    plain_ticks(middle, [25, 50, 100, 200])
    for number, (kind, some) in enumerate(groups(foretold[foretold.variant.map(shown)], "variant")):
        errorbar(right, some.measured, some.predicted, some.predicted_err, number=number,
                 label=name_of("spam", kind), xerr=some.measured_err)
    right.axline((0, 0), slope=1, color="grey", linewidth=0.6)
    right.set(xlabel="K measured / grid", ylabel="K predicted / grid", xlim=(-0.05, 1.3), ylim=(-0.05, 1.3))
    for axes in (left, middle, right):
        axes.legend(fontsize=7, loc=(0.48, 0.22) if axes is middle else "upper left")
    page.suptitle("Why smooth particles do not converge: sheared, they bear a stress that rows do not lessen")
    return page


def series(driven: pd.DataFrame, name: str) -> pd.DataFrame:
    """Runs of vortices at one force that belong to one of SERIES."""
    some = driven.query("mode == 'stirred' and U == 0.2 and thick == 1")
    wide = np.isclose(some.h, 3*np.sqrt(some.rows/25))
    kinds = {"printed": some.variant == "printed", "fixed": (some.variant == "wendland-c2") & (some.h == 3),
             "joint": (some.variant == "wendland-c2") & wide}
    return some[kinds[name]]


def shown(variant: str) -> bool:
    """Is it the printed scheme, or does it differ by its static pressure or its walls alone?"""
    return variant.startswith(("less", "more")) or variant in ("printed", "printed-fixed-rows", "walls-odd")


FIGURES = Drawings(Drawing("yield", ("driven", "laws", "foretold"), stress))
