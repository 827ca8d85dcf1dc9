"""How does the heat that convection carries depend on the Prandtl number?"""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from studies.front import solve
from studies.kit.ask import one
from studies.kit.case import Case, Outcome, Report
from studies.kit.claim import Claim
from studies.kit.figure import Drawing, Drawings, bars, figure, look
from studies.kit.study import Study
from studies.kit.table import Table

HEAT = Table.of("heat", "method pr resolution", "nu nu_err", about="Nu of convection at Ra 5000.")


@dataclass(frozen=True, kw_only=True)
class Heat(Case):
    """One run: its fields are all that it depends on, and `run` gives rows of the table."""
    method: str
    pr: float
    rows: int

    def run(self, report: Report, folder: Path) -> Outcome:
        Nu = solve("rayleigh-benard", self.method, rows=self.rows, ra=5000.0, pr=self.pr).Nu
        return Outcome({"heat": [{"method": self.method, "pr": self.pr, "resolution": self.rows,
                                  "nu": Nu.value, "nu_err": Nu.err}]})


def cases(size: str) -> list[Case]:
    """`size` is quick, paper or fine."""
    rows = {"quick": 8, "paper": 16, "fine": 32}[size]
    return [Heat(method=method, pr=pr, rows=rows)
            for method in ("grid", "fixed-lattice") for pr in (0.5, 1.0, 2.0)]


def draw(heat: Any) -> Any:
    """Nu against Pr: this line is the caption on the page."""
    page, axes = figure()
    for number, (method, rows) in enumerate(heat.groupby("method")):
        bars(axes, rows, "pr", "nu", number=number, label=method, linestyle=look(number)["linestyle"])
    axes.set(xlabel="Pr", ylabel="Nu", title="Heat of convection at Ra 5000")
    axes.legend()
    return page


# a source is a paper or an author and a year; the id of a claim of one's own begins with own-
CLAIM = Claim(id="own-prandtl", source="Rayleigh 1916", statement="heat is carried, at Ra 5000 and Pr 1: Nu",
              value=one("heat", "nu", method="grid", pr=1.0), at_least=1.0, because="1 is conduction alone")
STUDY = Study(name=Path(__file__).parent.name, question=__doc__ or "", cases=cases, tables=(HEAT,),
              figures=Drawings(Drawing("heat", ("heat",), draw)), claims=(CLAIM,))
