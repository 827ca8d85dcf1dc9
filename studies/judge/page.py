"""One page of a judged method: verdicts, numbers, rules, the picture; and the numbers as CSV."""
import base64
import io
from collections.abc import Sequence
from pathlib import Path

import pandas as pd
from jinja2 import Environment

from studies.judge.ladder import Take, judged
from studies.judge.picture import beside
from studies.judge.rungs import RUNGS, Rung
from studies.kit.csvfile import commit, cpu, now, versions, write, write_atomic

PAGE = Environment(autoescape=True).from_string("""<!doctype html>
<html lang="en"><meta charset="utf-8"><title>{{ name }}, judged</title>
<style>
body { font: 16px/1.45 system-ui, sans-serif; color: #222 }
body { max-width: 72rem; margin: 2rem auto; padding: 0 1rem }
table { border-collapse: collapse } .good { color: #00664a } .bad { color: #a33c00 } small { color: #555 }
th, td { text-align: left; vertical-align: top; padding: .4rem .8rem .4rem 0; border-top: 1px solid #ccc }
img { max-width: 100% }
</style>
<h1>{{ name }}</h1>
<p>{{ good }} of {{ rungs|length }} rungs are good. {{ when }}.</p>
<table><tr><th>Rung<th>Verdict<th>Numbers<th>Seconds
{% for one in rungs %}<tr><td>{{ one.name }}<br><small>{{ one.asks }}</small>
<td class="{{ one.mark }}">{{ one.words }}<br><small>Rule: {{ one.rule }}.</small>
<td>{% for line in one.lines %}{{ line }}<br>{% endfor %}<td>{{ one.seconds }}
{% endfor %}</table>
{% if image %}<h2>Error of K against cost</h2>
<p>Rayleigh-Benard convection, Ra 10 000, Pr 1, over 90 free-fall times. The other methods are those of
results/cost, each at its longest step. Seconds of {{ name }} are converted to the machine of these tables
by a lattice that both have run.</p>
<img alt="Error of K against CPU seconds" src="data:image/png;base64,{{ image }}">{% endif %}
<p><small>{{ made }}</small>
""")


def write_page(name: str, takes: Sequence[Take], out: Path) -> Path:
    """judge-NAME.html and judge-NAME.csv in a folder; the page."""
    picture, path = beside(name, takes), out/f"judge-{name}.html"
    image = io.BytesIO()
    if picture is not None:
        picture.savefig(image, format="png")
    rungs = [row(rung, takes) for rung in RUNGS]
    text = PAGE.render(name=name, rungs=rungs, good=sum(one["mark"] == "good" for one in rungs), when=now(),
                       image=base64.b64encode(image.getvalue()).decode(),
                       made=f"commit {commit()}, {versions()}, {cpu()}")
    write_atomic(path, text)
    write(path.with_suffix(".csv"), table(takes), head=[f"commit {commit()}", versions(), cpu(), now()])
    return path


def row(rung: Rung, takes: Sequence[Take]) -> dict:
    """A row of the page."""
    verdict, mine = judged(rung, takes), [take for take in takes if take.rung == rung.name]
    numbers = [(take.rows, {key: f"{value:.3g}" for key, value in take.numbers.items()}) for take in mine]
    lines = [f"{rows} rows: " + ", ".join(f"{key} {value}" for key, value in part.items())
             for rows, part in numbers if part]
    mark = {True: "good", False: "bad", None: ""}[verdict.good]
    return {"name": rung.name, "asks": rung.asks, "rule": rung.rule, "words": verdict.words, "mark": mark,
            "lines": lines, "seconds": f"{sum(take.seconds for take in mine):.1f}"}


def table(takes: Sequence[Take]) -> pd.DataFrame:
    """A row for each number, or for what there is in its place."""
    return pd.DataFrame([{"rung": take.rung, "rows": take.rows, "quantity": key, "value": value,
                          "seconds": take.seconds, "fault": take.fault.replace("#", "")}
                         for take in takes for key, value in (take.numbers or {"": float("nan")}).items()])
