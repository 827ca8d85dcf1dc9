"""Figures of the study motions, from its tables."""
from collections.abc import Callable

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.kit.figure import below, errorbar, figure
from studies.kit.table import Tables

MOTIONS = ("literal", "convective", "carried", "constant-mass")
LABELS = {"literal": "literal (39-41)", "convective": "convective (46-48)", "carried": "46-48, dV carried",
          "constant-mass": "constant mass (49)"}


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    drawn: dict[str, tuple[tuple[str, ...], Callable[..., Figure]]] = {
        "speeds": (("patterns", "sound"), speeds), "steps": (("euler", "history", "steps"), steps),
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
            errorbar(axes, *(group[c].tolist() for c in ("wavelength", "speed", "speed_err")), number=number, label=LABELS[name])
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
    page.suptitle("Lucy's weight, $h = 3a$; dotted: predicted from sums over the lattice", fontsize=10)
    return page


def steps(euler: pd.DataFrame, history: pd.DataFrame, places: pd.DataFrame) -> Figure:
    """Forward Euler and sound on fixed points; places of points that move."""
    page, (left, middle, right) = figure(1, 3, width=4.4, height=4.8)
    nested = euler[euler["transport"] == "nested"]
    for number, (wavelength, group) in enumerate(nested.groupby("wavelength")):
        k2 = (2*np.pi/group["wavelength"])**2
        errorbar(left, group["dt_over_limit"].tolist(), (group["growth"]/k2).tolist(), (group["growth_err"]/k2).tolist(),
                 number=number, label=rf"$\lambda = {wavelength:g}a$")
        left.plot(group["dt_over_limit"], group["predicted"]/k2, color="grey", linestyle=":", marker="")
    left.axhline(0, color="black", linewidth=0.6)
    left.set(xlabel=r"$\Delta t\, \rho c^2/(\eta + \zeta + \kappa/2)$", ylabel="growth rate$/k^2$", title="forward Euler (Eq. "
                                                                                                          "40)")
    for number, (of_limit, group) in enumerate(history.groupby("dt_over_limit")):
        middle.plot(group["time"], group["amplitude"].abs(), label=rf"$\Delta t = {of_limit:g}$ of the limit", linestyle="none",
                    marker="os^"[number % 3], markersize=3)
        middle.plot(group["time"], group["predicted"], color="grey", linestyle=":", marker="")
    middle.set(xlabel="time", ylabel="|amplitude| of standing sound", title="forward Euler; dotted: envelope predicted",
               yscale="log", ylim=(0.02, None))
    for number, ((motion, flow, integrator), group) in enumerate(places.groupby(["motion", "flow", "integrator"])):
        errorbar(right, *(group.sort_values("dt")[c].tolist() for c in ("dt", "error", "error_err")), number=number,
                 linestyle="-", label=f"{motion},\n{flow}, {integrator}")
    right.set(xlabel=r"$\Delta t$", ylabel="rms error of places/displacement", xscale="log", yscale="log", title="Eqs 40, 41")
    right.set_xticks([0.03, 0.1, 0.3], labels=["0.03", "0.1", "0.3"])
    right.minorticks_off()
    for axes, columns in ((left, 2), (middle, 1), (right, 2)):
        below(axes, ncols=columns, bbox_to_anchor=(0.5, -0.16))
    return page


def conservation(drifts: pd.DataFrame) -> Figure:
    """Largest drift of every run."""
    page, axes = figure(1, 1, width=7.0, height=4.6)
    filtered = drifts["filter"].map(lambda chi: " filtered" if chi else "")
    names = drifts[["motion", "weight", "points", "integrator"]].agg(" ".join, axis=1) + filtered
    order = sorted(set(names), key=lambda name: (MOTIONS.index(name.split()[0]), name))
    for number, quantity in enumerate(("mass", "momentum", "energy")):
        chosen = drifts[drifts["quantity"] == quantity]
        axes.plot(chosen["drift"].clip(lower=1e-17), names[chosen.index].map(order.index), linestyle="none",
                  marker="os^"[number], label=quantity)
    axes.set(xscale="log", xlabel=f"largest relative drift in {drifts['steps'].max():g} steps (0 at 1e-17)")
    axes.set_yticks(range(len(order)), labels=order)
    axes.axvline(1e-13, color="grey", linestyle=":")
    below(axes, ncols=3)
    return page


def brackets(forces: pd.DataFrame, filters: pd.DataFrame) -> Figure:
    """The force of Eq. 50 over a + b; decay rates of density under filters."""
    page, (left, right) = figure(1, 2, width=4.4, height=4.0)
    lost = forces["a"] + forces["b"]
    left.plot(lost, forces["force"], linestyle="none", label="measured")
    left.plot(np.sort(lost), 1 - np.sort(lost)/2, color="grey", linestyle=":", marker="", label="$1 - (a + b)/\\gamma$")
    left.axhline(1, color="black", linewidth=0.6)
    left.set(xlabel="$a + b$", ylabel=r"force over $-\nabla P$", title="Eq. 50, wave without entropy")
    for number, (name, group) in enumerate(filters[(filters["filter"] != "none") & (filters["h"] == 3.0)].groupby("filter")):
        group = group.sort_values("k")
        errorbar(right, *(group[c].tolist() for c in ("k", "rate", "rate_err")), number=number, label=f"{name} filter")
        right.plot(group["k"], group["predicted"], color="grey", linestyle=":", marker="")
    right.set(xscale="log", yscale="log", xlabel="wave number $k a$, largest at the corner",
              ylabel=r"decay rate of density over $\chi$", title="$h = 3a$; without a filter: none")
    for axes in (left, right):
        below(axes, ncols=2)
    return page
