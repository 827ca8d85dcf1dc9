"""Several methods at several resolutions in one scene: a table and a figure."""
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from particles.run import Divergence
from studies.front.picture import flow
from studies.front.solution import Solution
from studies.front.solving import called, solve
from studies.kit.figure import errorbar, look, save


@dataclass(frozen=True)
class Comparison:
    """Solutions, and a table of them: a row a method and resolution. diverged : why some have none."""
    solutions: list[Solution]
    table: pd.DataFrame
    diverged: dict[str, str] = field(default_factory=dict)

    def plot(self, path: str | Path | None = None) -> Figure:
        """Flows of the finest resolution above; each number against the cost below."""
        finest = list({one.method: one for one in sorted(self.solutions, key=lambda one: one.rows)}.values())
        names = [name for name in ("K", "Nu", "error") if name in self.table]
        page = Figure(figsize=(3.4*max(len(finest), len(names)), 5.6), layout="constrained")
        halves: Any = page.subfigures(2, 1)
        for axes, one in zip(halves[0].subplots(1, len(finest), squeeze=False)[0], finest, strict=True):
            flow(axes, one, one.method)
        for axes, name in zip(halves[1].subplots(1, len(names), squeeze=False)[0], names, strict=True):
            against_cost(axes, self.table, name)
        if path is not None:
            save(page, Path(path))
        return page

    def __str__(self) -> str:
        """The table, then what diverged."""
        diverged = [f"{name}: {why}" for name, why in self.diverged.items()]
        return "\n".join([self.table.to_string(index=False), *diverged])


def against_cost(axes: Any, table: pd.DataFrame, name: str) -> None:
    """One number of all methods, with its errors, against seconds of CPU; points carry their rows."""
    for number, (method, rows) in enumerate(table.dropna(subset=[name]).groupby("method", sort=False)):
        errorbar(axes, rows["cpu_s"], rows[name], rows[f"{name}_err"], number=number, label=str(method),
                 linestyle=look(number)["linestyle"])
        for cost, value, count in zip(rows["cpu_s"], rows[name], rows["rows"], strict=True):
            axes.annotate(f"{count}", (cost, value), textcoords="offset points", xytext=(4, 4), fontsize=7)
    axes.set(xscale="log", xlabel="CPU  [s]", ylabel=name, yscale="log" if name == "error" else "linear")
    axes.legend(fontsize=7)


def compare(scene: Any, methods: Sequence[Any], rows: Sequence[int] | int = (16, 25),
            **more: Any) -> Comparison:
    """Solve a scene by several methods at several resolutions; what diverges is told beside the table.

    scene, methods, more : as of `solve`. Raises ValueError: as `solve`, before anything runs.
    """
    solutions, diverged = [], {}
    for method in methods:
        for count in [rows] if isinstance(rows, int) else rows:
            try:
                solutions.append(solve(scene, method, rows=count, **more))
            except Divergence as error:
                diverged[f"{called(method)}, {count} rows"] = str(error)
    return Comparison(solutions, pd.DataFrame(map(row, solutions)), diverged)


def row(one: Solution) -> dict[str, Any]:
    """One line of the table."""
    values = {name: value.value for name, value in one.numbers.items()}
    errors = {f"{name}_err": value.err for name, value in one.numbers.items()}
    both = {key: (values | errors)[key] for name in values for key in (name, f"{name}_err")}
    return {"method": one.method, "rows": one.rows, **both, "cpu_s": one.cpu_s, "steps": one.steps}
