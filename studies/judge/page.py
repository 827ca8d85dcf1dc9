"""Page of a judged method: verdicts, numbers, rules, error of K against cost; and the numbers as CSV."""
import base64
import io
from collections.abc import Sequence
from pathlib import Path

import pandas as pd
from jinja2 import Environment
from matplotlib.figure import Figure

from particles.run import Plan, run
from studies.build import SCENES, ready
from studies.judge.ladder import Rung, Take, verdicts
from studies.judge.measures import Numbers, Verdict
from studies.kit.csvfile import commit, cpu, now, read, versions, write, write_atomic
from studies.kit.figure import errorbar, figure, look
from studies.kit.stats import Measured
from studies.kit.store import RESULTS

SCENE = "rayleigh-benard"
#: method by which this machine is compared with that of the tables, its rows there and its steps here
SHARED, ROWS, STEPS = "fixed-lattice-h1.2", 16, 400
PAGE = Environment(autoescape=True).from_string(Path(__file__).with_suffix(".html").read_text())


def write_page(name: str, takes: Sequence[Take], out: Path) -> Path:
    """Write judge-NAME.html and judge-NAME.csv into a folder; return the path of the page."""
    picture, path = beside(name, takes), out/f"judge-{name}.html"
    image, head = io.BytesIO(), [f"commit {commit()}", versions(), cpu(), now()]
    if picture is not None:
        picture.savefig(image, format="png")
    rungs = [row(rung, verdict, takes) for rung, verdict in verdicts(takes)]
    text = PAGE.render(name=name, rungs=rungs, good=sum(one["mark"] == "good" for one in rungs),
                       image=base64.b64encode(image.getvalue()).decode(), made=", ".join(head))
    write_atomic(path, text)
    write(path.with_suffix(".csv"), table(takes), head=head)
    return path


def row(rung: Rung, verdict: Verdict, takes: Sequence[Take]) -> dict:
    """A rung and its verdict as a row of the page."""
    mine = [take for take in takes if take.rung == rung.name]
    lines = [f"{take.rows} rows: {in_words(take.numbers)}" for take in mine if take.numbers]
    mark = {True: "good", False: "bad", None: ""}[verdict.good]
    return {**rung._asdict(), "words": verdict.words, "mark": mark, "lines": lines,
            "seconds": f"{sum(take.seconds for take in mine):.1f}"}


def in_words(numbers: Numbers) -> str:
    """Names and numbers as text, with errors in units of the last digit."""
    errors = {name: numbers.get(f"{name}_err", 0.0) for name in numbers if not name.endswith("_err")}
    return ", ".join(f"{name} {in_digits(numbers[name], err)}" for name, err in errors.items())


def in_digits(value: float, err: float) -> str:
    """A number with its error; six digits if the error, of time alone, is tiny; three if there is none."""
    return str(Measured(value, err)) if err > 1e-5*abs(value) else f"{value:.6g}" if err else f"{value:.3g}"


def table(takes: Sequence[Take]) -> pd.DataFrame:
    """One row per number, or per fault of a rung without numbers."""
    return pd.DataFrame([{"rung": take.rung, "rows": take.rows, "quantity": key, "value": value,
                          "seconds": take.seconds, "fault": take.fault.replace("#", "")}
                         for take in takes for key, value in (take.numbers or {"": float("nan")}).items()])


def beside(name: str, takes: Sequence[Take]) -> Figure | None:
    """Error of K against cost beside methods of the study `cost`; None if no run of convection has a K."""
    own = pd.DataFrame([take.numbers for take in takes if take.rung == SCENE and take.numbers])
    if own.empty:
        return None
    known = read(RESULTS/"cost"/"points.csv").query("scene == 'convection' and quantity == 'K'")
    page, axes = figure(width=7.0, height=4.6)
    for number, (method, rows) in enumerate(known.groupby("method", sort=False)):
        other = look(number) | {"marker": look(number + number//8)["marker"]}      # more than eight series
        errorbar(axes, rows["cpu_s"], rows["error"].abs(), rows["error_err"], label=str(method), **other,
                 alpha=0.6)
    axes.errorbar(own["cpu_s"]/pace(), own["error"].abs(), own["error_err"], color="red", marker="*",
                  markersize=13, label=name, zorder=9)
    axes.set(xscale="log", yscale="log", xlabel="CPU on the machine of the tables  [s]",
             ylabel="error of K, relative")
    axes.legend(fontsize=7, loc="lower left")
    return page


def pace() -> float:
    """CPU time on this machine over that on the machine of the tables, measured on some steps of points."""
    runs = read(RESULTS/"cost"/"runs.csv")
    runs = runs.query("scene == 'convection' and method == @SHARED and resolution == @ROWS")
    method, start, dt = ready(SCENES[SCENE](rows=ROWS), SHARED)
    spent = run(method, start, Plan(dt=dt, steps=STEPS)).cpu_s
    return spent/STEPS/float((runs["run_s"]/runs["steps"]).median())
