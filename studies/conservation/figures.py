"""Figures of the study conservation, from its tables."""
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.kit.figure import Drawing, Drawings, bars, figure, logarithmic, look, numbered

BODIES = {"surface": "points on the surface", "frozen": "frozen lattice points"}


def drags(drag: pd.DataFrame) -> Figure:
    """Error of the drag against the published value over the resolution, one panel a solid fraction."""
    fractions = sorted(set(drag["fraction"]))
    page, axes = figure(1, len(fractions), width=4.4, height=4.2, squeeze=False, sharey=True)
    drag = drag.assign(percent=100*drag["error"].abs(), percent_err=100*drag["error_err"])
    for panel, fraction in zip(axes[0], fractions, strict=True):
        rows = drag[drag["fraction"] == fraction]
        for number, (name, words) in enumerate(BODIES.items()):
            bars(panel, rows[rows["variant"] == name], "radius", "percent", number=number, label=words,
                 linestyle=look(number)["linestyle"])
        for power, style, at in ((1, ":", 60.0), (2, "--", 16.0)):
            radius = np.array([drag["radius"].min(), drag["radius"].max()])
            panel.plot(radius, at*radius**-power, color="grey", linestyle=style, marker="",
                       label=f"$(a/R)^{power}$")
        panel.set(title=f"solid fraction {fraction:g}", xlabel="radius $R/a$")
        logarithmic(panel, (4, 6, 10, 20))
        numbered(panel.yaxis, (1, 3))
    axes[0, 0].set_ylabel("|error| of the drag  [%]")
    page.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    page.suptitle("Points on its surface give a cylinder's drag, frozen lattice points err without order\n"
                  "against Sangani & Acrivos (1982); bars: rounding in print and drift of the run")
    return page


FIGURES = Drawings(Drawing("drag", ("drag",), drags))
