"""Error of K against cost: the method among those that the study of cost has measured."""
from collections.abc import Sequence
from time import process_time

import pandas as pd
from matplotlib.figure import Figure

from particles.run import Plan, run
from studies.build import ready
from studies.build.named import SCENES
from studies.judge.ladder import Take
from studies.kit import csvfile
from studies.kit.figure import errorbar, figure, look
from studies.kit.store import RESULTS

SCENE = "rayleigh-benard"
#: a method that both this machine and that of the tables have run, its rows there and its steps here
SHARED, LABEL, ROWS, STEPS = "fixed-lattice-h1.2", "DIH lattice, h = 1.2 a", 16, 400


def beside(name: str, takes: Sequence[Take]) -> Figure | None:
    """The figure; None where no run of convection has an energy."""
    mine = [take.numbers for take in takes if take.rung == SCENE and take.numbers]
    if not mine:
        return None
    known = csvfile.read(RESULTS/"cost"/"points.csv").query("scene == 'convection' and quantity == 'K'")
    page, axes = figure(width=7.0, height=4.6)
    for number, (method, rows) in enumerate(known.groupby("method", sort=False)):
        other = look(number) | {"marker": look(number + number//8)["marker"]}      # there are more than eight
        errorbar(axes, rows["cpu_s"], rows["error"].abs(), rows["error_err"], label=str(method), **other,
                 alpha=0.6)
    own = pd.DataFrame(mine)
    axes.errorbar(own["cpu_s"]/pace(), own["error"].abs(), own["error_err"], color="red", marker="*",
                  markersize=13, label=name, zorder=9)
    axes.set(xscale="log", yscale="log", xlabel="CPU on the machine of the tables  [s]",
             ylabel="error of K, relative")
    axes.legend(fontsize=7, loc="lower left")
    return page


def pace() -> float:
    """Seconds that this machine takes for one of the machine of the tables, by some steps of points."""
    runs = csvfile.read(RESULTS/"cost"/"runs.csv")
    runs = runs.query("scene == 'convection' and method == @LABEL and resolution == @ROWS")
    method, start, dt = ready(SCENES[SCENE](rows=ROWS), SHARED)
    run(method, start, Plan(dt=dt, steps=1))        # compiles
    began = process_time()
    run(method, start, Plan(dt=dt, steps=STEPS))
    return (process_time() - began)/STEPS/float((runs["run_s"]/runs["steps"]).median())
