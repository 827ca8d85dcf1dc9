"""Texts and examples of the repository in the page, with links to figures, tables and words in it."""
import ast
import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from markdown_it import MarkdownIt
from markupsafe import Markup
from PIL import Image

from studies.build import names
from studies.kit.key import ROOT
from studies.kit.sweep import RESULTS
from studies.report.inventory import HIDDEN, NoReport

MARKDOWN = MarkdownIt("commonmark").enable("table")
#: suffix of a file of results -> its kind in the page
KINDS = {".png": "figure", ".csv": "table"}
#: beginning of README.md: question, words with the answer, picture, table with its note
OPENING = re.compile(r"\*\*(.+?)\*\*\n\n(.+?)\n<img .+?>\n(.+?)\n## ", re.DOTALL)
#: files that the page contains as a whole
TEXTS = ("equations", "findings", "tables")
#: beginnings of ids of claims
CLAIM = ("rr98-", "khp95-", "own-")
#: largest size of the picture of an example [pixels], and its number of colours
WIDTH, COLOURS = 960, 128
SCROLL = '<div class="scroll" tabindex="0" role="region" aria-label="Table"><table>'


def opening(out: Path) -> dict[str, str]:
    """First screen, from the beginning of README.md: question, words with the answer, table of methods to
    choose from. Raises NoReport: this has another form."""
    found = OPENING.search((ROOT/"README.md").read_text())
    if not found:
        raise NoReport("README.md does not begin with a bold question, words, an <img> and a table above its "
                       "first heading ##, of which the page makes its first screen: let it begin so")
    question, words_, choice = found.groups()
    return {"question": question, "words": html(words_, ROOT, out), "choice": html(choice, ROOT, out)}


def document(path: Path, out: Path) -> Markup:
    """HTML of a Markdown file without its title; empty if there is no file."""
    if not path.exists():
        return Markup()
    return html(path.read_text().partition("\n")[2], path.parent, out)


def html(text: str, home: Path, out: Path) -> Markup:
    """HTML of Markdown in the folder ``home``; headings two levels deeper, tables in boxes that scroll."""
    tokens = MARKDOWN.parse(text)
    for token in tokens:
        if token.type.startswith("heading"):
            token.tag = f"h{int(token.tag[1]) + 2}"
        for one in token.children or ():
            if one.type == "link_open":
                one.attrs["href"] = target(str(one.attrs["href"]), home, out)
    made = MARKDOWN.renderer.render(tokens, MARKDOWN.options, {})
    made = made.replace("<table>", SCROLL).replace("</table>", "</table></div>")
    return Markup(re.sub("<code>([^<]+)</code>", explained, made))


def explained(code: re.Match[str]) -> str:
    """Name of a method or id of a claim, linked to its explanation; other code as it is."""
    name = code[1]
    if name in names.METHODS or name in names.VARIATIONS:
        return f'<a class="word" href="#word-{name}">{code[0]}</a>'
    return f'<a class="word" href="#claim-{name}">{code[0]}</a>' if name.startswith(CLAIM) else code[0]


def target(href: str, home: Path, out: Path) -> str:
    """Target of a link in a file of the folder ``home``: an anchor in the page, or a path from the page."""
    if "://" in href or href.startswith("#"):
        return href
    path = (home/href).resolve()
    within = Path(os.path.relpath(path, RESULTS if path.is_relative_to(RESULTS) else out.resolve()))
    kind = KINDS.get("".join(within.suffixes[:1])) if within.parts[0] not in HIDDEN else None
    if kind and len(within.parts) == 2 and any(out.glob(f"{within}*")):     # gzipped or not
        return f"#{kind}-{within.parent}-{within.name.partition('.')[0]}"
    if within.suffix == ".md" and str(within.with_suffix("")) in TEXTS and (out/within).exists():
        return f"#text-{within.stem}"
    return os.path.relpath(path, out.resolve())


# --- examples ----------------------------------------------------------------------------------------


def examples(out: Path) -> Iterator[dict[str, Any]]:
    """Name, description, script and picture of examples that have one; the first paragraph of the docstring
    is the description."""
    for path in scripts():
        script, picture = path.read_text(), out/"gallery"/f"{path.stem}.png"
        about = (ast.get_docstring(ast.parse(script)) or path.stem).split("\n\n")[0].split("\n`")[0]
        if picture.exists():
            yield {"name": path.stem, "about": " ".join(about.split()), "script": script, "picture": picture}


def write_gallery(out: Path) -> list[Path]:
    """Write small copies of examples' pictures in out/own; return them. Raises NoReport: no picture."""
    drawn = [out/"own"/f"{path.stem}.png" for path in scripts()]
    there = [path for path in drawn if path.exists()]
    if not there:
        raise NoReport(f"no example has a picture in {out/'own'}: run one, python -m examples.convection")
    return [smaller(path, out/"gallery") for path in there]


def scripts() -> list[Path]:
    """Scripts of all examples."""
    return sorted((ROOT/"examples").glob("[!_]*.py"))


def smaller(path: Path, folder: Path) -> Path:
    """Write a smaller copy of a picture into another folder; return its path."""
    folder.mkdir(exist_ok=True)
    picture = Image.open(path).convert("RGB")
    picture.thumbnail((WIDTH, WIDTH))
    picture.quantize(COLOURS, kmeans=1, dither=Image.Dither.NONE).save(folder/path.name, optimize=True)
    return folder/path.name
