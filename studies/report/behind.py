"""Which tables are behind a figure: those without which it is missing or another one. Kept in results/figures.csv."""
import hashlib
import re
import warnings
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.collections import Collection
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.text import Text

from studies.kit import provenance
from studies.kit.csvfile import write
from studies.kit.sweep import load
from studies.kit.table import Tables
from studies.report.found import NoReport, Part, rows_of, study_of

#: title and panels describe the figure; tables: names, one after the other; picture: hash of the PNG that was looked at
COLUMNS = ("study", "figure", "title", "panels", "tables", "picture")
Draw = Callable[[Tables], Mapping[str, Figure]]


def catalogue(out: Path, found: list[Part], say: Callable[[str], None] = lambda text: None) -> pd.DataFrame:
    """A row for each figure; studies of which one is new or was drawn anew are looked at again.

    Raises
    ------
    NoReport
        A figure that is known or that the tables give is not there.
    """
    path = out/"figures.csv"
    known = rows_of(path, COLUMNS)
    rows: list[dict[str, Any]] = []
    for part in found:
        there, old = {png.stem: digest(png) for png in part.pictures}, known[known["study"] == part.name]
        if dict(zip(old["figure"], old["picture"])) == there:
            rows += [{str(name): value for name, value in row.items()} for row in old[list(COLUMNS)].to_dict("records")]
            continue
        say(f"looking at what the figures of {part.name} stand on")
        rows += [{**row, "picture": there.get(row["figure"], "")} for row in looked_at(out, part)]
    for row in rows:
        if not (out/row["study"]/f"{row['figure']}.png").exists():
            raise NoReport(f"{out/row['study']/row['figure']}.png is missing: make figures-{row['study']} draws it from the "
                           "tables")
    if rows:
        write(path, pd.DataFrame(rows)[list(COLUMNS)].sort_values(["study", "figure"]), head=head())
    return pd.DataFrame(rows, columns=list(COLUMNS))


def head() -> Iterator[str]:
    """Where it comes from."""
    yield f"commit {provenance.commit()}"
    yield "tables: those without which the figure is missing or another one, found by leaving out one at a time"


def digest(path: Path) -> str:
    """Hash of a file."""
    return hashlib.sha256(path.read_bytes()).hexdigest()[:16]


def looked_at(out: Path, part: Part) -> Iterator[dict[str, Any]]:
    """Rows of a study without the hash: from its own figures, and of pictures that it does not draw what the folder tells."""
    pages, needs = {}, {}
    study = study_of(part.name) if part.sheets else None
    if study:
        tables = load(study.tables, part.name, out)
        pages, needs = dict(study.figures(tables)), needed(study.figures, tables)
    everything = [sheet.path.stem for sheet in part.sheets]
    for name in sorted({*pages, *(png.stem for png in part.pictures)}):
        yield {"study": part.name, "figure": name, "title": title(pages[name]) if name in pages else name.replace("_", " "),
               "panels": panels(pages[name]) if name in pages else "", "tables": " ".join(needs.get(name) or everything)}


def needed(draw: Draw, tables: Tables) -> dict[str, list[str]]:
    """Figure -> tables without which it is not the same."""
    whole = {name: marks(page) for name, page in draw(tables).items()}
    found: dict[str, list[str]] = {name: [] for name in whole}
    for lost in tables:
        if not len(tables[lost]):
            continue
        rest = without(draw, tables, lost)
        for name, page in whole.items():
            if rest.get(name) != page:
                found[name].append(lost)
    return found


def without(draw: Draw, tables: Tables, lost: str) -> dict[str, str]:
    """Marks of the figures without a table, or with it empty; of figures that need it in either case none can be told."""
    for rest in ({name: rows for name, rows in tables.items() if name != lost}, {**tables, lost: tables[lost].iloc[:0]}):
        try:
            with warnings.catch_warnings(action="ignore"):      # legends without lines
                return {name: marks(page) for name, page in draw(Tables(rest)).items()}
        except Exception:       # whatever a study raises that cannot do without it
            continue
    return {}


def marks(page: Figure) -> str:
    """Hash of everything that is drawn: texts, lines, areas, pictures."""
    found = hashlib.sha256()
    for artist in page.findobj():
        for value in drawn(artist):
            found.update(value if isinstance(value, bytes) else np.ascontiguousarray(value).tobytes())
    return found.hexdigest()


def drawn(artist: Any) -> Iterator[Any]:
    """Numbers and texts of one artist."""
    if isinstance(artist, Text):
        yield artist.get_text().encode()
    elif isinstance(artist, Line2D):
        yield np.asarray(artist.get_xydata(), float)
        yield str((artist.get_marker(), artist.get_color())).encode()
    elif isinstance(artist, Collection):
        yield np.ma.filled(np.ma.asarray(artist.get_offsets(), float), np.nan)
        yield from (np.asarray(path.vertices, float) for path in artist.get_paths())
        arrows = getattr(artist, "U", None), getattr(artist, "V", None)
        yield from (np.ma.filled(np.ma.asarray(values, float), np.nan) for values in (artist.get_array(), *arrows)
                    if values is not None)
    elif isinstance(artist, AxesImage):
        yield np.ma.filled(np.ma.asarray(artist.get_array(), float), np.nan)
    elif isinstance(artist, Patch):
        yield np.asarray(artist.get_path().vertices, float)


def title(page: Figure) -> str:
    """Title of the page, or those of its panels, or what is drawn over what."""
    if page.get_suptitle().strip():
        return plain(page.get_suptitle()).splitlines()[0]
    titles = [plain(axes.get_title()).splitlines()[0] for axes in page.axes if axes.get_title().strip()]
    return "; ".join(dict.fromkeys(titles)) or panels(page) or "figure"


def panels(page: Figure) -> str:
    """What is drawn over what, panel by panel."""
    told = []
    for axes in page.axes:
        x, y = (plain(label).replace("\n", " ") for label in (axes.get_xlabel(), axes.get_ylabel()))
        what = f"{y or 'the same'} over {x}" if x else y
        name = plain(axes.get_title()).replace("\n", " ")
        told.append(": ".join(text for text in (name, what) if text))
    return "; ".join(dict.fromkeys(text for text in told if text))


def plain(text: str) -> str:
    """TeX of matplotlib as words."""
    text = re.sub(r"\\(mathrm|mathit|mathbf|rm)\b", "", text)
    text = re.sub(r"\\frac\{([^{}]*)\}\{([^{}]*)\}", r"\1/\2", text)
    for word, sign in SIGNS.items():
        text = re.sub(rf"\\{word}(?![a-zA-Z])", sign, text)
    text = re.sub(r"\^\{?([^{}$]*?)\}?(?=[\s$)\]/,]|$)", r"^\1", text)
    text = re.sub(r"(?<=[A-Za-zα-ω])_\{?([A-Za-z0-9])\}?(?![A-Za-z])", r"\1", re.sub(r"\\[,;! ]", " ", text))
    return re.sub(r"[ \t]+", " ", re.sub(r"[${}\\#]", "", text)).strip()



SIGNS = {
    "nu": "ν", "eta": "η", "zeta": "ζ", "kappa": "κ", "rho": "ρ", "lambda": "λ", "Delta": "Δ", "alpha": "α", "epsilon": "ε",
    "varepsilon": "ε", "sigma": "σ", "gamma": "γ", "pi": "π", "pm": "±", "times": "×", "partial": "∂", "nabla": "∇",
    "cdot": "·", "omega": "ω", "phi": "φ", "tau": "τ", "sqrt": "√", "langle": "<", "rangle": ">", "le": "≤", "ge": "≥",
    "infty": "∞", "approx": "≈", "Gamma": "Γ", "theta": "θ", "psi": "ψ", "beta": "β", "mu": "μ", "xi": "ξ", "chi": "χ",
    "delta": "δ"}
