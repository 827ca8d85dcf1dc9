"""Figures of the study motions, from its tables."""
from collections.abc import Callable

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.kit.figure import below, errorbar, figure, look
from studies.kit.table import Tables

MOTIONS = ("literal", "convective", "carried", "constant-mass")
UNIT = r"$a\,(m/k_BT)^{1/2}$"      # of time
INTEGRATORS = {"euler": "forward Euler [40]", "two-step": "two steps [40, 41]", "TwoStep": "two steps [40, 41]",
               "RK4": "Runge-Kutta"}
POINTS = {"lattice": "lattice", "jittered-0.1": "points shifted"}
FILTERS = {"plain": "plain filter", "corrected": "filter of what a linear density leaves"}
LABELS = {"literal": "literal (39-41)", "convective": "convective (46-48)", "carried": "46-48, dV carried",
          "constant-mass": "constant mass (49)"}


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    drawn: dict[str, tuple[tuple[str, ...], Callable[..., Figure]]] = {
        "speeds": (("patterns", "moving_sound"), speeds), "steps": (("euler", "history", "steps"), steps),
        "conservation": (("conservation",), conservation), "filter": (("brackets", "filter"), brackets)}
    return {name: draw(*(tables[t] for t in wanted)) for name, (wanted, draw) in drawn.items()
            if all(t in tables and len(tables[t]) for t in wanted)}


def speeds(patterns: pd.DataFrame, sound: pd.DataFrame) -> Figure:
    """How fast a density pattern goes on a stream, and sound."""
    page, (left, right) = figure(1, 2, width=4.4, height=4.0)
    patterns = patterns[patterns["pattern"] == "density"]
    sound = sound[(sound["bracket"] == "none") & (sound["weight"] == "Lucy")]
    for number, name in enumerate(MOTIONS):
        for axes, frame in ((left, patterns), (right, sound)):
            group = frame[frame["motion"] == name].sort_values("wavelength")
            errorbar(axes, *(group[c].tolist() for c in ("wavelength", "speed", "speed_err")), number=number, label=LABELS[name],
                     markerfacecolor="none", markersize=10 - 2*number)      # some lie on each other
            axes.plot(group["wavelength"], group["predicted"], color="grey", linestyle=":", marker="")
    left.set(ylabel="speed of the pattern over the stream's", title="density pattern on a uniform stream")
    right.set(ylabel="speed of sound over $c$", title="standing sound")
    right.axhline(np.sqrt(2), color="grey", linewidth=0.6)
    right.annotate(r"$\sqrt{2}$", (8, np.sqrt(2)), textcoords="offset points", xytext=(0, -14))
    for axes in (left, right):
        axes.set(xlabel=r"wavelength $\lambda/a$", xscale="log")
        axes.set_xticks(sorted(set(sound["wavelength"])), labels=[f"{w:g}" for w in sorted(set(sound["wavelength"]))])
        axes.minorticks_off()
        below(axes, ncols=2)
    page.suptitle("Which motion of the points carries patterns and sound at the right speed?\n"
                  "Lucy's weight, $h = 3a$; dotted: predicted from sums over the lattice", fontsize=10)
    return page


def steps(euler: pd.DataFrame, history: pd.DataFrame, places: pd.DataFrame) -> Figure:
    """Forward Euler and sound on fixed points; places of points that move."""
    page, (left, middle, right) = figure(1, 3, width=4.4, height=5.2)
    nested = euler[euler["transport"] == "nested"]
    for number, (wavelength, group) in enumerate(nested.groupby("wavelength")):
        k2 = (2*np.pi/group["wavelength"])**2
        errorbar(left, group["dt_over_limit"].tolist(), (group["growth"]/k2).tolist(), (group["growth_err"]/k2).tolist(),
                 number=number, label=rf"$\lambda = {wavelength:g}a$")
        left.plot(group["dt_over_limit"], group["predicted"]/k2, color="grey", linestyle=":", marker="")
    left.axhline(0, color="black", linewidth=0.6, linestyle="-", marker="")
    left.set(xlabel=r"step $\Delta t\, \rho c^2/(\eta + \zeta + \kappa/2)$", title="fixed points: growth of sound",
             ylabel=r"growth rate$/(ka)^2$  [$(k_BT/m)^{1/2}/a$]")
    for number, (of_limit, group) in enumerate(history.groupby("dt_over_limit")):
        peaks = largest(group.sort_values("time"))
        middle.plot(peaks["time"], peaks["amplitude"].abs(), label=rf"$\Delta t = {of_limit:g}$ of the limit", **look(number))
        middle.plot(group["time"], group["predicted"], color="grey", linestyle=":", marker="")
    middle.set(xlabel=f"time  [{UNIT}]", ylabel="largest |amplitude| of each half period", yscale="log", ylim=(0.4, 2.5),
               title="fixed points: a standing wave")
    middle.set_yticks([0.5, 1, 2], labels=["0.5", "1", "2"])
    middle.minorticks_off()
    for number, ((motion, flow, integrator), group) in enumerate(places.groupby(["motion", "flow", "integrator"])):
        errorbar(right, *(group.sort_values("dt")[c].tolist() for c in ("dt", "error", "error_err")), number=number,
                 linestyle=look(number)["linestyle"], label=f"{LABELS[str(motion)]}, {flow},\n{INTEGRATORS[str(integrator)]}")
    right.set(xlabel=rf"step $\Delta t$  [{UNIT}]", ylabel="rms error of places over displacement", xscale="log", yscale="log",
              title="points that move: where they end")
    right.set_xticks([0.03, 0.1, 0.3], labels=["0.03", "0.1", "0.3"])
    right.minorticks_off()
    for axes, columns in ((left, 2), (middle, 1), (right, 2)):
        below(axes, ncols=columns, bbox_to_anchor=(0.5, -0.16))
    page.suptitle("Which steps do Eqs 40, 41 allow?\n"
                  "dotted: predicted growth; bars: what halves of a run, or finer steps, differ by", fontsize=10)
    return page


def largest(wave: pd.DataFrame) -> pd.DataFrame:
    """Samples of a standing wave that are not smaller than their neighbours: within 3 % of its envelope, at 13 a period."""
    size = wave["amplitude"].abs().to_numpy()
    inner = np.flatnonzero((size[1:-1] >= size[:-2]) & (size[1:-1] >= size[2:])) + 1
    return wave.iloc[[0, *inner]]


def conservation(drifts: pd.DataFrame) -> Figure:
    """Largest drift of every run."""
    page, axes = figure(1, 1, width=8.0, height=4.8)
    names = drifts.apply(run_name, axis=1)
    order = list(dict.fromkeys(names[drifts["motion"].map(MOTIONS.index).sort_values(kind="stable").index]))
    for number, quantity in enumerate(("mass", "momentum", "energy")):
        chosen = drifts[drifts["quantity"] == quantity]
        axes.plot(chosen["drift"].clip(lower=1e-17), [order.index(name) + 0.2*(number - 1) for name in names[chosen.index]],
                  linestyle="none", marker="os^"[number], label=quantity)
    axes.set(xscale="log", xlabel=r"largest drift; of momentum over $\sum |p_i|$, else over the whole",
             title=f"What do motions of points conserve in {drifts['steps'].max():g} steps?\n"
                   "dotted: 1e-13; no drift at all is drawn at 1e-17")
    axes.set_ylim(len(order) - 0.5, -0.5)
    axes.set_yticks(range(len(order)), labels=order, fontsize=8)
    axes.axvline(1e-13, color="grey", linestyle=":", marker="")
    below(axes, ncols=3)
    return page


def run_name(row: pd.Series) -> str:
    """Motion, weight, points and time steps of a run."""
    motion, weight, points, steps = (str(row[name]) for name in ("motion", "weight", "points", "integrator"))
    return ", ".join([LABELS[motion], weight, POINTS.get(points, points),
                      INTEGRATORS.get(steps, steps) + (", filtered" if row["filter"] else "")])


def brackets(forces: pd.DataFrame, filters: pd.DataFrame) -> Figure:
    """The force of Eq. 50 over the sum of its powers; decay rates of density under filters."""
    page, (left, right) = figure(1, 2, width=4.6, height=4.4)
    powers = forces["a"] + forces["b"]
    left.plot(powers, forces["force"], linestyle="none", label="measured")
    left.plot(np.sort(powers), 1 - np.sort(powers)/2, color="grey", linestyle=":", marker="", label="$1 - $sum$/\\gamma$")
    left.axhline(1, color="black", linewidth=0.6, linestyle="-", marker="")
    left.set(xlabel="sum $a + b$ of the powers of density", ylabel=r"force over $-\nabla P$",
             title="Eq. 50: $P_i/(\\rho_i^a\\,\\rho_j^b)$ for a pair,\nin a wave without entropy")
    for number, (name, group) in enumerate(filters[(filters["filter"] != "none") & (filters["h"] == 3.0)].groupby("filter")):
        group = group.sort_values("k")
        errorbar(right, *(group[c].tolist() for c in ("k", "rate", "rate_err")), number=number,
                 label=FILTERS.get(str(name), str(name)))
        right.plot(group["k"], group["predicted"], color="grey", linestyle=":", marker="")
    right.set(xscale="log", yscale="log", xlabel="wave number $\\times$ spacing; largest: from point to point",
              ylabel=r"decay rate of density over $\chi$  [1/spacing$^2$]",
              title=r"mass $\chi k_{ij} (\rho_i - \rho_j)$ along edges,""\nrange 3 spacings; without it: no decay")
    below(left, ncols=2)
    below(right, title="dotted: predicted from sums over the lattice", title_fontsize=8)
    page.suptitle("Is the force of Eq. 50 right? What does a filter of the density take away?", fontsize=10)
    return page
