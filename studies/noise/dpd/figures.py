"""Figures of the study dpd, from its tables."""
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.kit.figure import below, errorbar, figure
from studies.kit.table import Tables
from studies.noise.dpd.derive import standard

NAMES = {"TwoStep": "RR98 Eqs 40, 41", "GrootWarren": r"Groot-Warren, $\lambda = 1/2$",
         "GrootWarren65": r"Groot-Warren, $\lambda = 0.65$", "VelocityVerlet": "velocity-Verlet, friction twice",
         "Shardlow": "Shardlow's splitting", "KickDriftFrictionDriftKick": "kick, drift, friction, drift, kick"}


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    made = {}
    if len(tables.get("states", [])):
        made["temperature"] = temperature(tables["states"])
    if all(len(tables.get(name, [])) for name in ("pairs", "structure", "excess")):
        made["structure"] = structure(tables["pairs"], tables["structure"], tables["excess"])
    return made


def temperature(states: pd.DataFrame) -> Figure:
    """Error of kT over the step."""
    page, axes = figure(1, 2, width=4.6, height=4.2, sharey=True)
    chosen = standard(states)
    chosen = chosen[(chosen["a"] == 25) & (chosen["rho"] == 3)]
    chosen = chosen.sort_values("time").drop_duplicates(["integrator", "dt"], keep="last").sort_values("dt")
    everyone = chosen.groupby("dt")["integrator"].transform("nunique") == chosen["integrator"].nunique()
    chosen = chosen[everyone]
    for panel, name in zip(axes, ("kinetic", "configurational"), strict=True):
        for number, (integrator, label) in enumerate(NAMES.items()):
            some = chosen[chosen["integrator"] == integrator]
            off, err = (100*(some[name] - 1)).tolist(), (100*some[f"{name}_err"]).tolist()
            errorbar(panel, some["dt"].tolist(), off, err, number=number, label=label, linestyle="-")
        panel.axhspan(-1, 1, color="0.9")
        panel.set(title=f"{name} temperature", xlabel=r"$\Delta t$", ylabel="error of $kT$ in %" if panel is axes[0] else "")
        panel.set_yscale("symlog", linthresh=2)
    below(axes[0], ncol=2)
    page.suptitle(r"Dissipative particles, $a = 25$, $\rho = 3$", fontsize=10)
    return page


def structure(pairs: pd.DataFrame, waves: pd.DataFrame, excess: pd.DataFrame) -> Figure:
    """Pair distribution, structure factor, excess pressure."""
    page, (left, middle, right) = figure(1, 3, width=3.8, height=3.4)
    some = pairs[(pairs["a"] == 25) & (pairs["rho"] == 3)]
    left.plot(some["r"], some["g"], marker="")
    left.set(xlabel="$r/r_c$", ylabel="$g(r)$", title="pair distribution")
    errorbar(middle, *(waves[name].tolist() for name in ("k", "S", "S_err")))
    middle.set(xlabel="$k r_c$", ylabel="$S(k)$", title="structure factor")
    rows = excess[(excess["a"] == 25) & (excess["kT"] == 1)].sort_values("rho")
    errorbar(right, *(rows[name].tolist() for name in ("rho", "alpha", "alpha_err")), label="measured", linestyle="-")
    right.axhline(0.101, color="0.3", linestyle="--", label="Groot & Warren, 0.101")
    right.axhline(np.pi/30, color="0.6", linestyle=":", label=r"mean field, $\pi/30$")
    right.set(xlabel=r"$\rho r_c^3$", ylabel=r"$(P - \rho kT)/(a \rho^2)$", title="excess pressure")
    right.legend()
    page.suptitle(r"Dissipative particles, $a = 25$; left and middle $\rho = 3$", fontsize=10)
    return page
