"""The figures of a study: of each its name, its tables, and the function that draws it."""
from collections.abc import Callable
from typing import NamedTuple

from matplotlib.figure import Figure

from studies.kit.table import Tables


class Drawing(NamedTuple):
    """A figure that needs rows of all its tables. draw : takes their frames; its docstring is the caption."""
    name: str
    tables: tuple[str, ...]
    draw: Callable[..., Figure | None]

    def page(self, tables: Tables) -> Figure | None:
        """The figure; none where a table lacks rows, or has none to show."""
        if not all(len(tables.get(name, ())) for name in self.tables):
            return None
        return self.draw(*(tables[name] for name in self.tables))


class Overview(NamedTuple):
    """A figure of what there is of its tables. draw : takes `Tables`; its docstring is the caption."""
    name: str
    tables: tuple[str, ...]
    draw: Callable[[Tables], Figure | None]

    def page(self, tables: Tables) -> Figure | None:
        """The figure; none where the tables have nothing to show."""
        return self.draw(Tables({name: tables[name] for name in self.tables if name in tables}))


class Drawings:
    """Drawings and overviews, called with tables as one function that gives figures by name."""

    def __init__(self, *drawings: Drawing | Overview):
        self.drawings = drawings

    def __call__(self, tables: Tables) -> dict[str, Figure]:
        """The figures for which there are rows."""
        pages = {drawing.name: drawing.page(tables) for drawing in self.drawings}
        return {name: page for name, page in pages.items() if page is not None}


def caption(drawing: Drawing | Overview) -> str:
    """First sentences of what draws it, up to an empty line."""
    text = (drawing.draw.__doc__ or drawing.name.replace("_", " ")).split("\n\n")[0]
    return " ".join(text.split())
