"""Figures of the step's second order and of the cylinder, from the tables of the study dpd."""
import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from studies.kit.figure import COLOURS, errorbar, figure
from studies.kit.table import Tables
from studies.noise.dpd.derive import standard
from studies.noise.dpd.figures import NAMES


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    made = {}
    if all(len(tables.get(name, [])) for name in ("states", "dpd_steps", "second")):
        made["second"] = second(tables["states"], tables["dpd_steps"], tables["second"])
    if all(len(tables.get(name, [])) for name in ("flow", "drag", "cylinders")):
        made["cylinder"] = cylinder(tables["flow"], tables["drag"], tables["cylinders"])
    return made


def second(states: pd.DataFrame, steps: pd.DataFrame, order: pd.DataFrame) -> Figure:
    """Error of kT over dt^2 against dt, and the prediction at dt = 0."""
    page, axes = figure(1, 2, width=4.6, height=4.2)
    chosen = standard(states)
    chosen = chosen[(chosen["a"] == 25) & (chosen["rho"] == 3) & (chosen["dt"] >= 0.02)]
    chosen = chosen[chosen.groupby("dt")["integrator"].transform("nunique") == chosen["integrator"].nunique()]
    for panel, name in zip(axes, ("kinetic", "configurational"), strict=True):
        for number, (integrator, label) in enumerate(NAMES.items()):
            some = chosen[chosen["integrator"] == integrator].sort_values("time").drop_duplicates("dt", keep="last")
            if name == "kinetic" and integrator == "TwoStep":
                continue        # of first order
            over(panel, some.sort_values("dt"), name, number=number, label=label, linestyle="-", alpha=0.7)
        over(panel, steps.sort_values("dt"), name, number=len(NAMES), label="splitting, long runs", linestyle="none")
        said = order[order["temperature"] == name].iloc[0]
        panel.axhline(said["predicted"], color="0.3", linestyle="--", marker="", label="predicted at 0 for splitting")
        panel.set(title=f"{name} temperature", xlabel=r"$\Delta t$", xlim=(0, None))
    axes[0].set_ylabel(r"$(T/T_0 - 1)/\Delta t^2$")
    page.legend(*axes[1].get_legend_handles_labels(), loc="outside lower center", ncol=3)
    page.suptitle(r"Dissipative particles, $a = 25$, $\rho = 3$: second order in the step", fontsize=10)
    return page


def over(panel, rows: pd.DataFrame, name: str, **more) -> None:
    """(T - 1)/dt^2 with its interval."""
    dt2 = rows["dt"]**2
    errorbar(panel, rows["dt"].tolist(), ((rows[name] - 1)/dt2).tolist(), (rows[f"{name}_err"]/dt2).tolist(), **more)


def cylinder(flow: pd.DataFrame, drag: pd.DataFrame, cylinders: pd.DataFrame) -> Figure:
    """The stream, and drag over that of a smooth cylinder."""
    page, (left, right) = figure(1, 2, width=4.4, height=3.8)
    last = drag[drag["variant"] == "frozen"].sort_values("radius").iloc[0]
    some = flow[(flow["variant"] == last["variant"]) & (flow["radius"] == last["radius"])]
    u, v = (some.pivot(index="y", columns="x", values=name) for name in ("u", "v"))
    x, y = u.columns.to_numpy(float), u.index.to_numpy(float)
    half = (x[1] - x[0])/2
    shown = left.pcolormesh(x, y, np.hypot(u, v).to_numpy(), shading="nearest", vmin=0)
    left.quiver(x, y, u.to_numpy(), v.to_numpy(), color="white", edgecolor="black", linewidth=0.4, width=0.007)
    left.add_patch(Circle((0, 0), 1.0, fill=False, color=COLOURS[1], linewidth=1.5))
    left.set(aspect="equal", xlabel="$x/R$", ylabel="$y/R$", title=f"mean speed over $U$, $R = {last['radius']:g}\\,r_c$",
             xlim=(x[0] - half, x[-1] + half), ylim=(y[0] - half, y[-1] + half))
    left.grid(visible=False)
    page.colorbar(shown, ax=left)
    for number, (variant, rows) in enumerate(drag.groupby("variant")):
        errorbar(right, *(rows[name].tolist() for name in ("radius", "ratio", "ratio_err")), number=number, label=str(variant))
        errorbar(right, (rows["radius"] + 0.06).tolist(), *(rows[f"outer_{name}"].tolist() for name in ("ratio", "ratio_err")),
                 number=number, markerfacecolor="white", label=f"{variant}, density outside")
    right.axhspan(0.95, 1.05, color="0.9")
    right.axhline(1, color="0.3", linestyle="--", marker="", label="Sangani & Acrivos 1982")
    right.set(xlabel="$R/r_c$", ylabel="drag over that of a smooth cylinder", title="solid fraction 0.2, inertia taken out",
              xlim=(drag["radius"].min() - 0.5, drag["radius"].max() + 0.5))
    right.legend(loc="lower right")
    right.set_ylim(0.4, 1.1)
    return page
