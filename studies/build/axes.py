"""An axis that figures of several studies share."""
from typing import Any

from studies.kit.figure import width

#: least distance of two numbers above an axis  [inches]
LABEL = 0.42
#: Rayleigh numbers to label on an axis, the rounder ones first
NAMED = (10000, 5000, 2500, 20000, 1500, 3500, 1e5, 2000, 7000, 50000)


def ra_axis(axes: Any) -> None:
    """Label an axis by Ra^-1/2 below and Ra above: the rounder ones first, others where there is room."""
    low, high = axes.get_xlim()
    scale = width(axes)/(high - low)
    shown: list[float] = []
    for ra in NAMED:
        inches = [scale*abs(ra**-0.5 - other**-0.5) for other in shown]
        if low < ra**-0.5 < high and all(gap > LABEL for gap in inches):
            shown.append(ra)
    top = axes.secondary_xaxis("top")
    top.set_xticks([ra**-0.5 for ra in shown], labels=[f"{ra:g}" for ra in shown])
    top.tick_params(labelsize=8)
    top.set_xlabel("Rayleigh number Ra")
    axes.set_xlabel(r"$\mathrm{Ra}^{-1/2}$")
