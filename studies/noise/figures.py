"""Figures of the study, from its tables."""
import pandas as pd
from matplotlib.figure import Figure

from studies.kit.figure import Drawing, Drawings, figure, look
from studies.kit.table import groups

READINGS: dict[str, dict[str, str]] = {"doubled": {}, "single": {"markerfacecolor": "white"}}


def printed(rows: pd.DataFrame) -> Figure:
    """Variance that printed noise gives waves, over what is due beside the transport of Eqs 37, 38 (T = 0.7).

    Lines are sums over the lattice. Each equation has two readings.
    """
    page, panels = figure(1, 2, width=3.7, height=4.4, sharey=True)
    shown = ((1, 1.5, "a line, nearest neighbours"), (2, 3.0, "square lattice, $h = 3a$"))
    formulas = sorted(set(zip(rows["equation"], rows["term"], strict=True)))
    for axes, (d, h, title) in zip(panels, shown, strict=True):
        some = rows[(rows["d"] == d) & (rows["h"] == h)]
        for name, group in groups(some, ["equation", "term", "reading"]):
            number = formulas.index(name[:2])
            style, k = look(number) | READINGS[name[2]], group["wavenumber"]
            words = r"Eq. {} $\{}$".format(*name) if name[2] == "doubled" else ""
            more = {"linestyle": "none", "markersize": 7.5 - number}      # some lie on each other
            axes.plot(k, group["ratio"], **style | more, label=words)
            axes.plot(k, group["predicted"], color=style["color"], marker="", lw=0.8)
        axes.axhline(1, color="black", lw=1)
        axes.set(yscale="log", title=title, xlabel="$ka$")
    panels[0].set_ylabel("variance of the noise / its due, $2k_BT\\Gamma$")
    page.legend(*panels[1].get_legend_handles_labels(), loc="outside lower center", ncols=5)
    page.suptitle("No printed noise fits the transport of Eqs 37, 38 at all wavelengths ($T = 0.7$)\n"
                  r"filled: stress read as $\pi_{ij} + \pi_{ji}$; open: as $\pi_{ij}$; lines: lattice sums"
                  "\nEq. 23 lies below Eq. 25 on the left")
    return page


FIGURES = Drawings(Drawing("printed", ("printed",), printed))
