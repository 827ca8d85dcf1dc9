"""All figures of the study `rb`, from its tables alone; what the tables lack is left out."""
from collections.abc import Callable

from matplotlib.figure import Figure

from studies.kit.table import Tables
from studies.rb.figures import energy, errors, fields, points, time, variants
from studies.rb.figures import main as first

#: file name without .png -> figure, or None where the tables hold nothing to show
ALL: dict[str, Callable[[Tables], Figure | None]] = {
    "main": first.main, "fig2_3": fields.fig2_3, "fig5": energy.fig5, "fig6": energy.fig6, "fig7": fields.fig7,
    "fig8": time.fig8, "fig9": fields.fig9, "fig12": fields.fig12, "convergence": errors.convergence,
    "cost": errors.cost, "walls": variants.walls, "variants": variants.variants, "profiles": fields.profiles,
    "fluctuations": errors.fluctuations, "fixed_points": points.fixed, "moving_points": points.moving,
}


def figures(tables: Tables) -> dict[str, Figure]:
    """The figures for which there are rows."""
    drawn = {name: draw(tables) for name, draw in ALL.items()}
    return {name: page for name, page in drawn.items() if page is not None}
