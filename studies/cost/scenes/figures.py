"""What leaving out saves, as bars of cost and memory beside the error that it makes."""
import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from studies.kit.figure import COLOURS, figure
from studies.kit.table import Tables

KINDS = (("step_ratio", "CPU seconds of a point and step"), ("time_ratio", "CPU seconds of a point and unit of time"),
         ("bytes_ratio", "bytes a point"))
THICK = 0.26


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    return {"scenes": saved(tables["scenes"])} if len(tables.get("scenes", ())) else {}


def saved(rows: pd.DataFrame) -> Figure:
    """One group of bars a variant; its name says what it was left out of, and the error."""
    rows = rows[rows["left_out"] != "nothing"].sort_values(["scene", "base", "left_out"], ascending=False)
    page, axes = figure(width=8.4, height=1.4 + 0.62*len(rows))
    at = np.arange(len(rows))
    for number, (column, label) in enumerate(KINDS):
        err = rows[f"{column}_err"] if f"{column}_err" in rows else None
        axes.barh(at + THICK*(1 - number), rows[column], THICK, xerr=err, label=label, color=COLOURS[number],
                  hatch=("", "//", "..")[number], edgecolor="white", capsize=2)
    names = [f"{row['scene']}, {row['base']}\nwithout {row['left_out']}: {told(row['changed'], row['needed'])}"
             for row in rows.to_dict("records")]
    axes.axvline(1, color="black", linewidth=0.8)
    axes.set_yticks(at, labels=names)
    axes.set(xscale="log", xlabel="what is left over what the whole takes; bars: 95 %")
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    page.suptitle("Model only what a scene needs: what does leaving out save, and what error does it make?", fontsize=10)
    page.legend(loc="outside lower center", ncols=3)
    return page


def told(changed: float, needed: str) -> str:
    """What it makes of the answer, in words."""
    if not np.isfinite(changed):
        return f"diverges, {'needed' if needed == 'yes' else 'not needed'}"
    words = f"off by {100*changed:.0f} %" if changed > 0.1 else f"off by {100*changed:.2g} %"
    return f"{words}, {'needed' if needed == 'yes' else 'not needed'}"
