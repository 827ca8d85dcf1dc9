"""What the study streams shows and says."""
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.kit.ask import Value, one
from studies.kit.claim import Claim
from studies.kit.figure import Drawing, Drawings, figure, look
from studies.streams.cases import LAYER_RIDERS, RIDERS, STREAMS
from studies.streams.tables import MOVING

METHODS = list(dict.fromkeys([*RIDERS, *LAYER_RIDERS]))
#: scene -> quantity that counts, title of its panel
PANELS = {
    "vortex": ("velocity", "a vortex that decays"), "gresho": ("velocity", "a vortex of even density"),
    "spot": ("temperature", "a hot spot"), "contact": ("density", "a contact, 1 to 2"),
    "shear": ("growth", "growth in a shear layer"), "mixing": ("stripe", "a stripe, wound up"),
    "convection": ("K", "convection, plates slide: K"), "expansion": ("density", "a slab that expands")}


def crossing(needed: pd.DataFrame, crossings: pd.DataFrame) -> Figure:
    """CPU seconds to an error of 1 % against the speed of a stream that carries the flow along.

    Hollow: by the order of finer rows. Grey: where moving points become cheaper than the grid.
    """
    shown = [name for name in PANELS if name in set(needed.scene)]
    page, panels = figure(-(-len(shown)//4), min(4, len(shown)), width=2.7, height=2.6, squeeze=False)
    for axes, name in zip(panels.flat, shown):
        quantity, title = PANELS[name]
        of = "scene == @name and quantity == @quantity"
        panel(axes, needed.query(of), crossings.query(of + " and rival == 'grid'"))
        axes.set(title=title)
    for axes in panels.flat[len(shown):]:
        axes.set_visible(False)
    for axes in panels[:, 0]:
        axes.set_ylabel("CPU seconds to 1 %")
    for axes in panels[-1]:
        axes.set_xlabel("speed of the stream over the flow's")
    handles = [axes.plot([], [], **look(number), label=name)[0] for number, name in enumerate(METHODS)]
    page.legend(handles=handles, loc="outside lower center", ncols=4)
    page.suptitle("What does 1 % cost in a stream? Points that move do not see it\n"
                  "hollow: by the order of the error; grey: they become cheaper than the grid", fontsize=10)
    return page


def panel(axes: Axes, needed: pd.DataFrame, crossings: pd.DataFrame) -> None:
    """A line a method, over places of the streams."""
    for number, name in enumerate(METHODS):
        rows = needed[(needed.method == name) & needed.cpu_s.notna()].sort_values("stream")
        x, bars = place(rows.stream), np.abs([rows.cpu_s - rows.low, rows.high - rows.cpu_s])
        axes.errorbar(x, rows.cpu_s, yerr=np.minimum(bars, [0.9*rows.cpu_s, np.inf*rows.cpu_s]), **look(number))
        hollow = (rows.reached == "by order").to_numpy()
        axes.plot(x[hollow], rows.cpu_s[hollow], **look(number) | {"linestyle": "none"}, zorder=5,
                  markerfacecolor="white")
    for row in crossings.dropna(subset=["low"]).itertuples():
        axes.axvspan(*place(np.clip([row.low, row.high], 0, STREAMS[-1])), color="0.85", zorder=0)
    axes.set(yscale="log")
    axes.set_xticks(range(len(STREAMS)), labels=[f"{stream:g}" for stream in STREAMS])


def place(stream: np.ndarray) -> np.ndarray:
    """Along the axis: streams that ran are one apart."""
    return np.interp(stream, STREAMS, range(len(STREAMS)))


FIGURES = Drawings(Drawing("seconds", ("needed", "crossings"), crossing))

FASTEST = STREAMS[-1]


def seconds(scene: str, method: str, stream: float) -> Value:
    """To 1 % in what counts; the upper half of the interval is the wider one."""
    return one("needed", "cpu_s", err="high - cpu_s", scene=scene, quantity=PANELS[scene][0], method=method,
               stream=stream)


CLAIMS = (
    Claim(id="own-streams-vortex-fastest", source="RR98 Sec. III", at_most=1, headline=False,
          evidence="streams/seconds.png", because="cheaper is cheaper",
          value=seconds("vortex", MOVING, FASTEST)/seconds("vortex", "grid", FASTEST),
          statement="points that move are cheaper than a grid in a vortex that a stream of ten times its "
                    "speed carries: CPU seconds for 1 % in velocity over the compressible grid's"),
)
