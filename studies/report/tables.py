"""Tables of results/: tables.md says for each what a row is, its columns, and their units. No solver runs."""
import csv
from collections.abc import Iterator, Sequence
from pathlib import Path

from studies.kit.study import study_of
from studies.kit.table import Table
from studies.report.inventory import FIRST, NoReport

#: column -> (meaning, unit), for all tables without a meaning of their own for the column
COLUMNS: dict[str, tuple[str, str]] = {}
with Path(__file__).with_name("columns.csv").open(newline="") as file:
    for line in csv.DictReader(file):
        COLUMNS[line["column"]] = line["meaning"], line["unit"]

TIMED = "ns_per_particle_evaluation q25 q75 repeats value unit cpu versions date commit"
WHAT = {"what": ("what was timed or counted", ""), "value": ("a number that is no such time", "`unit`")}


def speed(name: str, about: str) -> Table:
    """A table of times that `bench` writes."""
    return Table.of(name, "what particles threads", TIMED, means=WHAT,
                    about=f"A time, or another number. {about}.")


#: table of films: caption and numbers of each
FILMS = Table.of("films", "method", "caption ra rows grid_rows t_end last_ke last_ke_grid",
                 about="A film of convection beside the grid.",
                 means={"t_end": ("free-fall times that it shows", "")})
#: folder -> tables that no study fills
OTHERS = {
    "bench": [speed("spam_speed", "Smooth particles beside LAMMPS"),
              speed("points_speed", "Points that stay and that move"),
              speed("dpd_speed", "Dissipative particles beside LAMMPS"),
              Table.of("ethersph", "ra rows factor", "heat heat_err read read_err inside steps commit date",
                       about="The cavity by the scheme of EtherSPH.jl, made again.",
                       means={"factor": ("factor on the conductivity of walls", ""),
                              "heat": ("heat that the sides exchange, over conduction", ""),
                              "read": ("Nu as the code reads it, from smoothed temperatures", ""),
                              "inside": ("share of particles between the walls at the end", "")}),
              Table.of("lammps", "scene style rows quantity", "value err expected commit date",
                       about="What LAMMPS makes of our scenes; time: CPU seconds of convection, ours too.",
                       means={"style": ("of LAMMPS, as bench/lammps_scenes.py has it", ""),
                              "value": ("of a run, as its scene says", ""),
                              "err": ("half width of the 95 % interval of a mean over time, else 0", ""),
                              "expected": ("exact, or of the spectral Boussinesq fluid", "")})],
    "films": [FILMS]}
HEAD = Path(__file__).parent/"sentences"/"tables.md"


def text(out: Path | None = None) -> str:
    """Text of the whole file, the same for every folder of results."""
    parts = [HEAD.read_text()]
    for folder, tables in folders():
        parts.append(f"\n## {folder}\n")
        parts += ["\n".join(lines(folder, table)) for table in tables]
    return "\n".join(parts) + "\n"


def folders() -> Iterator[tuple[str, Sequence[Table]]]:
    """Folders of results with their tables, in the order of the page."""
    for name in FIRST:
        yield name, study_of(name).tables
    yield from OTHERS.items()


def lines(folder: str, table: Table) -> Iterator[str]:
    """Markdown of a table: what a row is, then its columns."""
    path = f"{folder}/{table.file}"
    yield f"### [{path}]({path})\n\n{table.about}\n\n| column | meaning | unit |\n|---|---|---|"
    for column in table.columns:
        if column.removesuffix("_err") in {*table.columns} - {column}:
            continue        # listed together with its value
        what, unit = meaning(table, column)
        name = f"**`{column}`**" if column in table.key else f"`{column}`"
        error = f", `{column}_err`" if f"{column}_err" in table.columns else ""
        yield f"| {name}{error} | {what.replace('|', chr(92) + '|')} | {unit} |"
    yield ""


def meaning(table: Table, column: str) -> tuple[str, str]:
    """Meaning and unit of a column. Raises NoReport: they are not defined."""
    if column in table.means:
        return table.means[column]
    if column not in COLUMNS:
        raise NoReport(f"column {column} of table {table.name} has no meaning: give it one in "
                       "studies/report/columns.csv, or in means= of the table")
    return COLUMNS[column]
