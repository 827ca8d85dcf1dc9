"""Up to which Rayleigh number 16 rows last, as a part of the study: claims and a figure."""
from math import log

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.build.read import Value, over_seeds, select
from studies.hardcases.high_ra import runs as high_ra
from studies.hardcases.high_ra.runs import CELL_NUMBER, METHODS, OFF, STEPS, cell_numbers
from studies.hardcases.tube.claims import WORDS
from studies.kit.claim import Claim
from studies.kit.figure import figure, look
from studies.kit.stats import Measured
from studies.kit.study import Part
from studies.kit.table import Tables

WORTH = 2.0             # factor that a rule of thumb is worth


def cell_number(method: str) -> Value:
    """v a/nu of the fastest flow at the limit, mean over starts; at the highest Ra that was tried where there is no limit."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "high_ra", method=method, kind="wrong", step=STEPS[0])
        slope, constant = cell_numbers(select(tables, "high_ra_grid"))
        return over_seeds([float(np.exp(constant + slope*log(ra))) for ra in rows["ra"].fillna(rows["tried"])])
    return value


def shorter(method: str) -> Value:
    """Ra from which runs end in the shortest steps over that in the longest, geometric mean over starts."""
    def value(tables: Tables) -> Measured:
        both = [select(tables, "high_ra", method=method, kind="ends", step=step).set_index("seed")["ra"] for step in STEPS]
        logs = over_seeds([log(ratio) for ratio in (both[1]/both[0]).dropna()])
        return Measured(float(np.exp(logs.value)), float(np.exp(logs.value)*logs.err))
    return value


def of(method: str, words: str) -> tuple[Claim, ...]:
    """What is claimed of each method."""
    key, said = method.replace(" ", "-"), f"v a/nu of the fastest flow, where K is off by a factor of {OFF:g} or runs end"
    return (Claim(id=f"high-ra-{key}-safe", source="KHP95 Sec. VI", value=cell_number(method), at_least=CELL_NUMBER,
                  statement=f"{words}, 16 rows: as Ra is raised nothing ends or goes wrong below a cell number of 2: {said}",
                  because="central differences keep order below 2"),
            Claim(id=f"high-ra-{key}-foretold", source="KHP95 Sec. VI", value=cell_number(method), at_most=WORTH*CELL_NUMBER,
                  statement=f"{words}, 16 rows: as Ra is raised a cell number of 2 foretells what ends or goes wrong: {said}",
                  because="no formula is known for the end of a run; a rule of thumb is worth a factor of 2"),
            Claim(id=f"high-ra-{key}-step", source="KHP95 Sec. VI", value=shorter(method), expect=1, within=0.1,
                  statement=f"{words}, 16 rows: it is not the step that ends runs as Ra is raised: Ra from which they end in "
                            "quarter steps over that in whole ones [asked after quarter steps had mended shock tubes]",
                  because="a tenth is asked of limits"))


def figures(tables: Tables) -> dict[str, Figure]:
    """One, of all trials."""
    if not all(len(tables.get(name, ())) for name in ("high_ra_trials", "high_ra_summary")):
        return {}
    return {"high_ra": trials(tables["high_ra_trials"], tables["high_ra_summary"])}


def trials(rows: pd.DataFrame, summary: pd.DataFrame) -> Figure:
    """K over the fine grid's against Ra, and the part of the time that was reached."""
    page, (above, below) = figure(2, 1, width=6.4, height=2.9, sharex=True)
    for number, method in enumerate(METHODS):
        at = 10**(0.01*number)      # that marks on one another are seen
        some = rows[(rows["method"] == method) & (rows["step"] == STEPS[0])].sort_values("ra")
        style = {**look(number), "linestyle": "none", "markersize": 4}
        above.plot(at*some["ra"], some["over"], **style, label=method)
        below.plot(at*some["ra"], some["reached"], **style, label=method)
    for level in (OFF, 1/OFF):
        above.axhline(level, color="grey", linewidth=0.8)
    for axes in (above, below):
        axes.axvline(summary["predicted"].dropna().iloc[0], color="black", linestyle=":", linewidth=1)
    above.set(xscale="log", ylabel="K / K of 48 rows of the grid")
    below.set(xlabel="Ra", ylabel="part of the time reached")
    below.legend(loc="lower left")
    page.suptitle(f"How high may Ra be on 16 rows? Grey: a factor of {OFF:g};\n"
                  "dotted: cell number 2 of the fastest flow; all starts and trials", fontsize=10)
    return page


PART = Part(cases=high_ra.cases, tables=high_ra.TABLES, derive=high_ra.derive, figures=figures,
            claims=[claim for method in METHODS for claim in of(method, WORDS[method])])
