"""All figures of the study `rb`, from its tables alone; what the tables lack is left out."""
from collections.abc import Callable

from matplotlib.figure import Figure

from studies.convection import figures_energy as energy
from studies.kit.table import Tables

#: file name without .png -> figure, or None where the tables hold nothing to show
ALL: dict[str, Callable[[Tables], Figure | None]] = {
    "main": energy.main, "fig5": energy.fig5, "fig6": energy.fig6, "fig8": energy.fig8,
}


def figures(tables: Tables) -> dict[str, Figure]:
    """The figures for which there are rows."""
    drawn = {name: draw(tables) for name, draw in ALL.items()}
    return {name: page for name, page in drawn.items() if page is not None}
