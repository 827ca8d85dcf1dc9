"""Figures of the study bodies, from its tables."""
import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from matplotlib.tri import LinearTriInterpolator, Triangulation

from studies.kit.figure import below, errorbar, figure
from studies.kit.table import Tables

NAMES = {"surface": "points on the surface", "surface-unfiltered": "the same without filter", "frozen": "frozen lattice points",
         "frozen-grown": "frozen, half a spacing more", "frozen-h3": "frozen, $h = 3a$"}
SLOW = 1e-3


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    made = {}
    if len(tables.get("field", [])):
        made["stream"] = stream(tables["field"])
    if len(tables.get("drag", [])):
        made["drag"] = drags(tables["drag"])
    if all(len(tables.get(name, [])) for name in ("wave", "walls", "torque")):
        made["sides"] = sides(tables["wave"], tables["walls"], tables["torque"])
    return made


def stream(field: pd.DataFrame) -> Figure:
    """Streamlines and speed, one panel a variant."""
    variants = [name for name in NAMES if name in set(field["variant"])]
    page, axes = figure(1, len(variants), width=4.4, height=4.0, squeeze=False, sharey=True)
    for panel, variant in zip(axes[0], variants, strict=True):
        some = field[field["variant"] == variant]
        draw_stream(panel, some)
        panel.set(title=f"{NAMES[variant]}, {some['rows'].iloc[0]} rows", xlabel="$x/R$", aspect="equal")
    axes[0, 0].set_ylabel("$y/R$")
    page.suptitle(f"Slow stream through a square array of cylinders, solid fraction {field['fraction'].iloc[0]:g}", fontsize=10)
    return page


def draw_stream(panel, some: pd.DataFrame) -> None:
    """Points of the fluid (dots) and of the body (circles), streamlines coloured by speed over the mean."""
    x, y, held = some["x"].to_numpy(), some["y"].to_numpy(), some["held"].to_numpy() == 1
    mesh = Triangulation(x, y)
    half = np.abs(np.concatenate([x, y])).max()
    grid = np.linspace(-0.98*half, 0.98*half, 81)
    X, Y = np.meshgrid(grid, grid)
    u, v = (LinearTriInterpolator(mesh, some[name].to_numpy())(X, Y).filled(0.0) for name in ("u", "v"))
    inside = np.hypot(X, Y) < 1
    u, v = (np.where(inside, np.nan, q) for q in (u, v))
    lines = panel.streamplot(grid, grid, u, v, color=np.hypot(u, v), density=1.1, linewidth=0.9, arrowsize=0.7)
    panel.figure.colorbar(lines.lines, ax=panel, label="speed over mean velocity", shrink=0.8)
    panel.plot(x[~held], y[~held], marker=".", markersize=1.5, linestyle="none", color="grey", zorder=0)
    panel.plot(x[held], y[held], marker="o", markersize=2.5, linestyle="none", color="black", markerfacecolor="white")
    panel.add_patch(Circle((0, 0), 1.0, fill=False, color="black", linewidth=0.8))
    panel.set(xlim=(-half, half), ylim=(-half, half))


def drags(drag: pd.DataFrame) -> Figure:
    """Error of the drag against the published value over the resolution, one panel a solid fraction."""
    slow = drag[drag["mach"] < SLOW]
    fractions = sorted(set(slow["fraction"]))
    page, axes = figure(1, len(fractions), width=4.4, height=4.2, squeeze=False, sharey=True)
    for panel, fraction in zip(axes[0], fractions, strict=True):
        for number, name in enumerate(NAMES):
            group = slow[(slow["variant"] == name) & (slow["fraction"] == fraction)].sort_values("rows")
            if len(group):
                errorbar(panel, group["radius"].tolist(), (100*group["error"].abs()).tolist(), (100*group["error_err"]).tolist(),
                         number=number, linestyle="-", label=NAMES[name])
        across = np.array([slow["radius"].min(), slow["radius"].max()])
        for power, style, at in ((1, ":", 60.0), (2, "--", 16.0)):
            panel.plot(across, at*across**-power, color="grey", linestyle=style, marker="", label=f"$(a/R)^{power}$")
        panel.set(xscale="log", yscale="log", title=f"solid fraction {fraction:g}", xlabel="radius $R/a$")
        panel.set_xticks([4, 6, 10, 20], labels=["4", "6", "10", "20"])
        panel.minorticks_off()
        below(panel, ncols=2, bbox_to_anchor=(0.5, -0.16))
    axes[0, 0].set_ylabel("|error| of the drag, %")
    page.suptitle("Drag of a cylinder against Sangani & Acrivos (1982); bars: print and what was not steady", fontsize=10)
    return page


def sides(wave: pd.DataFrame, walls: pd.DataFrame, torque: pd.DataFrame) -> Figure:
    """Sliding sides: error of a wave that the shear turns. Fixed rows: where a flow stops. A cylinder that turns: its torque."""
    page, (left, right, last) = figure(1, 3, width=4.1, height=4.0)
    wave = wave.sort_values("rows")
    left.plot(wave["rows"], 100*wave["error"], label="without divergence")
    left.plot(wave["rows"], 100*wave["divergent"], label="with divergence (sound)")
    rows = np.array([wave["rows"].min(), wave["rows"].max()])
    left.plot(rows, 100*wave["error"].iloc[0]*(rows[0]/rows)**2, color="grey", linestyle=":", marker="", label="rows$^{-2}$")
    left.set(xscale="log", yscale="log", xlabel="rows", ylabel="relative error of the wave, %",
             title="sliding sides: a turning wave")
    left.set_xticks(wave["rows"].tolist(), labels=[str(n) for n in wave["rows"]])
    left.minorticks_off()
    below(left, ncols=2)
    for (maker, h), group in walls.groupby(["maker", "h"]):
        group = group.sort_values("rows")
        right.plot(group["rows"], group["offset"], label=f"{maker}" + f", $h = {h:g}a$"*(maker != "delaunay"))
    right.set(xlabel="rows of fluid", ylabel="zero of the parabola behind the plate, $a$",
              title="fixed rows: where the flow stops", ylim=(0, 1.15*walls["offset"].max()))
    below(right, ncols=2)
    torque = torque.sort_values("rows")
    last.plot(torque["radius"], 100*torque["turned"].abs(), label="that turns")
    last.plot(torque["radius"], 100*torque["fixed"].abs(), label="at rest around it")
    across = np.array([torque["radius"].min(), torque["radius"].max()])
    last.plot(across, 12*across**-2, color="grey", linestyle=":", marker="", label="$(a/R)^2$")
    last.set(xscale="log", yscale="log", xlabel="inner radius $R/a$", ylabel="|error| of the torque, %",
             title="cylinder that turns")
    last.set_xticks([4, 6, 8, 12], labels=["4", "6", "8", "12"])
    last.set_yticks([0.1, 0.2, 0.5, 1], labels=["0.1", "0.2", "0.5", "1"])
    last.minorticks_off()
    below(last, ncols=2)
    return page
