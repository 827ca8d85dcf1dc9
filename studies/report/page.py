"""results/index.html: one file with everything in it, from tables, figures and films on disk; no solver is run."""
import base64
import gzip
import hashlib
import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from importlib.resources import files
from pathlib import Path
from typing import Any

import pandas as pd
from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape
from markupsafe import Markup

from studies.kit.csvfile import write_atomic
from studies.report import cost, needs
from studies.report.behind import catalogue, digest
from studies.report.chart import HEIGHT, WIDTH, chart
from studies.report.findings import Known, answer, claims_of, findings
from studies.report.found import NoReport, Part, Sheet, check_columns, parts, rows_of, sheets_of
from studies.report.numbers import short, signed, told
from studies.report.pictures import NEAR, opened, still, webp
from studies.report.tables import FILMS, ORDER

QUESTION = ("Do fluid particles converge on the continuum equations, at what error, at what cost, and where do they break?")
#: rows of a table that are in the page as they are; more of them when it is opened, if the file is below EMBED
ROWS, EMBED = 5, 60_000
#: what the page may weigh [bytes]
LIMIT = 7_800_000
VERDICTS = {"holds": "✓", "fails": "✗", "undecidable": "?"}


def write_page(out: Path, say: Callable[[str], None] = lambda text: None) -> Path:
    """Write index.html, all or nothing; its path.

    Raises
    ------
    NoReport
        Something is missing or broken; an older page stays as it is.
    """
    found = parts(out)
    check_columns(found)
    known = catalogue(out, found, say)
    for near in NEAR:
        text = render(out, found, known, partial(webp, near=near))
        if (size := len(text.encode())) <= LIMIT:
            write_atomic(out/"index.html", text)
            return out/"index.html"
        say(f"{size/1e6:.1f} MB with figures in which colours nearer than {near} of 441 are one")
    raise NoReport(f"the page has {size/1e6:.1f} MB, {LIMIT/1e6:.1f} are allowed, fewer colours would mix up series: draw "
                   f"smaller, or take out of {out}, what is large, {', '.join(largest(out, found))}")


def largest(out: Path, found: list[Part]) -> list[str]:
    """Figures and films that weigh most."""
    files = [*(path for part in found for path in part.pictures), *out.glob("films/*.mp4")]
    heavy = sorted(files, key=lambda path: -path.stat().st_size)[:5]
    return [f"{path.relative_to(out)} ({path.stat().st_size/1000:.0f} kB)" for path in heavy]


def render(out: Path, found: list[Part], known: pd.DataFrame, encode: Callable[[Path], str] | None = None) -> str:
    """The page as text; ``encode`` makes the address of a figure from its PNG."""
    claims, panels = claims_of(out), cost.panels(found)
    knows = Known(out, claims, panels)
    env = Environment(loader=PackageLoader("studies.report", "page"), autoescape=select_autoescape(), undefined=StrictUndefined,
                      trim_blocks=True, lstrip_blocks=True)
    env.filters |= {"short": short, "signed": signed}
    shown = figures(out, found, known, encode or webp)
    return env.get_template("page.html").render(
        question=QUESTION, answer=answer(knows), findings=findings(knows), claims=claim_rows(claims), verdicts=VERDICTS,
        counts=claims["verdict"].value_counts().to_dict(), papers=sorted({paper(source) for source in claims["source"]}),
        claims_made=" ".join(Sheet(out/"claims.csv").commits), panels=[(panel, chart(panel)) for panel in panels],
        size=(WIDTH, HEIGHT), levels=needs.LEVELS, said=needs.said, parts=found, figures=shown, films=films(out),
        main=shown["rb"][0] if shown.get("rb") and shown["rb"][0].name == "main" else None,
        tables={sheet.name: table(sheet) for sheet in sheets_of(found)}, style=part_of("style.css"), script=part_of("script.js"),
        inputs=fingerprint(out))


def fingerprint(out: Path) -> str:
    """Hash of everything that the page is made of."""
    made_of = [*out.glob("*/*.csv"), *out.glob("*/*.png"), *out.glob("films/*.mp4"), out/"claims.csv", out/"figures.csv"]
    kept = [path for path in made_of if path.exists() and path.parent.name not in ("raw", "quick")]
    lines = sorted(f"{path.relative_to(out)} {digest(path)}" for path in kept)
    sources = sorted(f"{path.name} {digest(Path(str(path)))}" for path in files("studies.report").joinpath("page").iterdir()
                     if path.is_file())
    return hashlib.sha256("\n".join([*lines, *sources]).encode()).hexdigest()[:16]


def part_of(name: str) -> Markup:
    """A file of the page as it is."""
    return Markup(files("studies.report").joinpath("page", name).read_text())


# --- claims -------------------------------------------------------------------------------------------------------


def paper(source: str) -> str:
    """The paper that a source names."""
    year = re.match(r"KHP95|RR98|.*?\b(?:1[89]|20)\d\d\b", source)
    return year.group(0) if year else source


def claim_rows(claims: pd.DataFrame) -> list[dict[str, Any]]:
    """Claims with numbers as people read them, those that fail first within a study."""
    rows = [{str(name): value for name, value in row.items()} for row in claims.to_dict("records")]
    return [{**row, "paper": paper(row["source"]), "accepted": accepted(row["low"], row["high"]),
             "found": found_value(row["measured"], row["err"])} for row in rows]


def accepted(low: float, high: float) -> str:
    """A range in words."""
    if math.isnan(low) and math.isnan(high):
        return ""
    if math.isinf(high):
        return f"≥ {short(low)}"
    return f"≤ {short(high)}" if math.isinf(low) else f"{short(low)} to {short(high)}"


def found_value(value: float, err: float) -> str:
    """A measured value with its interval; none."""
    if math.isnan(value):
        return "—"
    small = value != 0 and (abs(value) < 1e-3 or abs(value) >= 1e6)
    if err > 0 and not small and err > 1e-6*abs(value):
        return told(value, err)
    return signed(f"{value:.3g}" + (f" ± {err:.1g}" if err > 0 else ""))


# --- figures, films -------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Shown:
    """A figure: its address, size in pixels, words, and the tables behind it."""

    study: str
    name: str
    src: str
    size: tuple[int, int]
    title: str
    alt: str
    sheets: list[Sheet]

    @property
    def made(self) -> str:
        """Commits of the tables behind it."""
        return ", ".join(dict.fromkeys(commit for sheet in self.sheets for commit in sheet.commits))


def figures(out: Path, found: list[Part], known: pd.DataFrame, encode: Callable[[Path], str]) -> dict[str, list[Shown]]:
    """Figures by study, `main` first."""
    about = {(row["study"], row["figure"]): row for row in known.to_dict("records")}
    shown: dict[str, list[Shown]] = {}
    for part in found:
        by_name = {sheet.path.stem: sheet for sheet in part.sheets}
        for png in sorted(part.pictures, key=lambda path: (path.stem != "main", path.stem)):
            unknown = {"title": png.stem.replace("_", " "), "panels": part.question, "tables": " ".join(by_name)}
            row = about.get((part.name, png.stem), unknown)
            sheets = [by_name[name] for name in row["tables"].split() if name in by_name]
            alt = f"{row['title']}. {row['panels']}".strip()
            shown.setdefault(part.name, []).append(
                Shown(part.name, png.stem, encode(png), opened(png).size, row["title"], alt, sheets))
    return shown


def films(out: Path) -> list[dict[str, Any]]:
    """Films with their last picture and what films.csv says of them."""
    rows = rows_of(out/"films/films.csv", (*FILMS.columns, "seed", "commit"))
    made = []
    for row in sorted(rows.to_dict("records"), key=lambda row: ORDER.index(row["film"]) if row["film"] in ORDER else len(ORDER)):
        path = out/"films"/f"{row['film']}.mp4"
        if not path.exists():
            raise NoReport(f"{path} is missing: make films makes it again")
        made.append({**{str(name): value for name, value in row.items()}, **still(path),
                     "content": base64.b64encode(path.read_bytes()).decode()})
    return made


# --- tables ---------------------------------------------------------------------------------------------------------


def table(sheet: Sheet) -> dict[str, Any]:
    """A table: its head, its first rows, and, of one that is not too large, all of it packed."""
    size = sheet.path.stat().st_size
    content = gzip.compress(sheet.path.read_bytes(), 9, mtime=0) if size <= EMBED else b""
    frame = sheet.frame.head(ROWS)
    return {"sheet": sheet, "bytes": size, "rows": len(sheet.frame), "columns": list(frame.columns),
            "first": [[short(value) for value in row] for row in frame.itertuples(index=False)],
            "packed": base64.b64encode(content).decode()}
