"""Figure and claims of the study streams."""
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.kit.ask import Value, first, one, share, spread
from studies.kit.claim import Claim
from studies.kit.figure import Drawing, Drawings, figure, look
from studies.streams.cases import LAYER_RIDERS, RIDERS, STREAMS
from studies.streams.tables import MOVING, STILL

METHODS = list(dict.fromkeys([*RIDERS, *LAYER_RIDERS]))
#: scene -> quantity that counts, title of its panel
PANELS = {
    "vortex": ("velocity", "a vortex that decays"), "gresho": ("velocity", "a vortex of even density"),
    "spot": ("temperature", "a hot spot"), "contact": ("density", "a contact, 1 to 2"),
    "shear": ("wave", "a wave that grows in shear"), "mixing": ("stripe", "a stripe, wound up"),
    "convection": ("K", "convection, sliding plates: K"), "expansion": ("density", "a slab that expands")}


def seconds(needed: pd.DataFrame, crossings: pd.DataFrame) -> Figure:
    """CPU seconds to an error of 1 % against the speed of a stream that carries the flow along.

    Hollow: by the order of the error. Grey: where moving points become cheaper than the grid for good; in
    convection, whose costs are alike, they do not.
    """
    page, panels = figure(2, 4, width=2.7, height=2.6)
    for axes, (name, (quantity, title)) in zip(panels.flat, PANELS.items()):
        here = f"scene == '{name}' and quantity == '{quantity}'"
        told = crossings.query(f"{here} and rival == 'grid' and scene != 'convection'")
        panel(axes, needed.query(here), told)
        axes.set_title(title)
    some = set(needed.query(f"cpu_s == cpu_s and ({COUNTED})").method)
    handles = [axes.plot([], [], **look(number), label=name)[0] for number, name in enumerate(METHODS)
               if name in some]
    page.legend(handles=handles, loc="outside lower center", ncols=4)
    page.supylabel("CPU seconds to 1 %", fontsize=10)
    for axes in panels[-1]:
        axes.set_xlabel("speed of stream / of flow")
    never = " and ".join(name for name in METHODS if name not in some)
    page.suptitle("In fast streams points that move come to an error of 1 % first in most flows\n"
                  "hollow: extrapolated by order; grey: moving points become cheaper than the grid for good\n"
                  "a flow that is at rest: speed of stream / of sound"
                  + f"\n{never} never come to 1 %"*bool(never))
    return page


def panel(axes: Axes, needed: pd.DataFrame, crossings: pd.DataFrame) -> None:
    """Draw a line for each method, over streams at equal distances."""
    for number, name in enumerate(METHODS):
        rows = needed[(needed.method == name) & needed.cpu_s.notna()].sort_values("stream")
        x, style = place(rows.stream.to_numpy()), look(number)
        bars = np.array([np.minimum(rows.cpu_s - rows.low, 0.9*rows.cpu_s), rows.high - rows.cpu_s])
        axes.errorbar(x, rows.cpu_s, yerr=bars, **style)
        hollow = (rows.reached == "by order").to_numpy()
        axes.plot(x[hollow], rows.cpu_s[hollow], **{**style, "linestyle": "none"}, zorder=5, mfc="white")
    for ends in crossings.dropna(subset=["low"])[["low", "high"]].to_numpy():
        axes.axvspan(*place(ends), color="0.85", zorder=0)
    axes.set(yscale="log")
    axes.set_xticks(range(len(STREAMS)), labels=[f"{stream:g}" for stream in STREAMS])


def place(streams: np.ndarray) -> np.ndarray:
    """Positions of streams along the axis."""
    return np.interp(streams, STREAMS, range(len(STREAMS)))


FIGURES = Drawings(Drawing("seconds", ("needed", "crossings"), seconds))


VORTEX = {"scene": "vortex", "quantity": "velocity"}


def cost(method: str, stream: float) -> Value:
    """CPU seconds to 1 % in a vortex; the upper half of the interval is the wider one."""
    return one("needed", "cpu_s", err="high - cpu_s", **VORTEX, method=method, stream=stream)


STILL_COST = first("needed", "cpu_s", "reached != 'no'", by="cpu_s", err="high - cpu_s", **VORTEX,
                   method=STILL, stream=10.0)
COUNTED = " or ".join(f"(scene == '{name}' and quantity == '{of}')" for name, (of, _) in PANELS.items())


def K_error(stream: float) -> Value:
    """The error of K of convection with seed 1."""
    return one("runs", "error", scene="convection", quantity="K", method=MOVING, stream=stream, rows=24,
               seed=1)


def own(name: str, statement: str, because: str, value: Value, **limits: float) -> Claim:
    """A claim of ours about points that move."""
    return Claim(id=f"own-streams-{name}", source="RR98 Sec. III", statement=statement, because=because,
                 evidence="streams/seconds.png", value=value, **limits)  # type: ignore[arg-type]


ASKED = "asked for before anything was measured"
CLAIMS = (
    own("frame", "a stream changes nothing for points that move with their triangulation: largest over "
        "smallest error of a vortex in all streams, 32 rows, one seed", "round-off, which flips may amplify",
        spread("runs", "error", scene="vortex", method=MOVING, rows=32, seed=1), expect=1, within=1e-6),
    own("vortex-still", "at rest points that move cost little more than a grid: CPU seconds for 1 % in a "
        "vortex over the compressible grid's", f"one and a half was {ASKED}",
        cost(MOVING, 0.0)/cost("grid", 0.0), at_most=1.5),
    own("vortex-fast", "in a stream of ten times the flow points that move are cheapest: CPU seconds for 1 % "
        "in a vortex over those of the cheapest grid, lattice or triangulation that stands still",
        f"no more was {ASKED}", cost(MOVING, 10.0)/STILL_COST, at_most=1),
    own("vortex-crossing", "points that move win in a vortex once a stream is as fast as the flow: speed "
        "over the flow's from which on they are cheaper than the compressible grid",
        "a flow that moves by its own size while it turns is what carried means",
        one("crossings", "stream", err="high - stream", **VORTEX, rival="grid"),
        at_most=1),
    own("scenes", "in the fastest stream points that move win in every scene: share of those with fewer CPU "
        "seconds for 1 % than the compressible grid, if one of both comes to 1 %", "every one",
        share("crossings", "fastest < 1", f"({COUNTED}) and fastest == fastest", rival="grid"), at_least=1),
    own("plates", "plates that slide along with the stream change nothing, either: |K in the fastest stream "
        "- K at rest|/K of convection, 24 rows", "1 %, the error at which methods are compared",
        abs(K_error(10.0) - K_error(0.0)), at_most=0.01),
    own("closed-faces", "closed faces do not see a stream, either: share of runs in streams of 1 or more "
        "that come to their end", "every run: without a stream all do",
        share("runs", "error == error", "stream >= 1", method="moving"), at_least=1),
)
