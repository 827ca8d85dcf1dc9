"""Sound on lattices that are not stable, as a part of the study."""
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from particles.smooth.spam import Direct
from particles.weights import Lucy, Monaghan, WendlandC2
from studies.build.read import Value, over_seeds, select
from studies.kit.case import Case
from studies.kit.claim import CannotTell, Claim
from studies.kit.figure import below, figure, look
from studies.kit.stats import Measured
from studies.kit.study import Part
from studies.kit.table import Table, Tables
from studies.lattices.claims import TENTH
from studies.lattices.ringing import Ringing

KEY = ["lattice", "weight", "h", "transport", "length", "amplitude", "step", "seed"]
#: rate of the fastest growing motion, predicted and measured; time: that the wave rings; rms velocities then: wave: of the exact
#: wave of the usual amplitude; foretold, across: along y, where the wave has none, by linear theory from round-off and measured
RINGING = Table("ringing", key=KEY, columns=[*KEY, "predicted", "measured", "measured_err", "time", "wave", "foretold", "across"])
#: t: time; across: rms velocity along y; along: part of the fastest growing motion
PATHS = Table("ringing_paths", key=[*KEY, "t"], columns=[*KEY, "t", "across", "along"])
#: length of the wave, spacings, from which what grows is as fast as the wave when it has rung, over seeds
LOST = Table("ringing_lost", key=["lattice", "weight"], columns=["lattice", "weight", "seeds", "predicted", "measured",
                                                                 "measured_err"])
SQUARE = Ringing(lattice="square", weight=Lucy, length=64)
LENGTHS = ((SQUARE, (48, 56, 64, 72, 80)), (replace(SQUARE, weight=Monaghan), (36, 40, 44, 48, 52)),
           (replace(SQUARE, lattice="hexagonal"), (192, 224, 256, 288)))
#: one thing changed: another step, no wave, friction along pairs, weights and ranges about which the lattice keeps
OTHERS = (replace(SQUARE, step=0.5), replace(SQUARE, amplitude=0.0), replace(SQUARE, transport=Direct))
KEPT = (replace(SQUARE, h=2.5, length=128), replace(SQUARE, weight=WendlandC2, length=128))


def cases(size: str) -> Iterator[Case]:
    """Waves of many lengths; `quick` has the shortest of them."""
    if size == "quick":
        yield from (replace(LENGTHS[1][0], length=length) for length in (40, 44, 48))
        return
    for seed in (1, 2, 3):
        yield from (replace(case, length=length, seed=seed, path=seed == 1 and length == SQUARE.length)
                    for case, lengths in LENGTHS for length in lengths)
        yield from (replace(case, seed=seed, path=seed == 1) for case in OTHERS)
    yield from (replace(case, path=True) for case in KEPT)


# --- rows that follow -------------------------------------------------------------------------------------------------


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Where waves are lost."""
    return {"ringing_lost": list(lost(tables["ringing"]))} if "ringing" in tables else {}


def lost(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Of the lattices and weights of which many lengths ring."""
    same = ["h", "transport", "amplitude", "step"]
    usual = rows[(rows[same] == [SQUARE.columns[name] for name in same]).all(axis=1)]
    for (kind, weight), group in usual.groupby(["lattice", "weight"]):
        seeds = [one.sort_values("length") for _, one in group.groupby("seed")]
        found = [(crossing(one, "foretold"), crossing(one, "across")) for one in seeds]
        if len(found) > 1 and np.isfinite(found).all():
            measured = over_seeds([across for _, across in found])
            yield {"lattice": kind, "weight": weight, "seeds": len(found), "predicted": float(np.mean([a for a, _ in found])),
                   "measured": measured.value, "measured_err": measured.err}


def crossing(rows: pd.DataFrame, name: str) -> float:
    """Length at which a velocity passes that of the wave, its logarithm interpolated; nan if it does not."""
    off, length = np.log(rows[name].to_numpy()/rows["wave"].to_numpy()), rows["length"].to_numpy(float)
    i = int(np.argmax(off > 0))
    return float(np.interp(0.0, off[i - 1:i + 1], length[i - 1:i + 1])) if i else np.nan


# --- claims -----------------------------------------------------------------------------------------------------------


def rates(tables: Tables) -> Measured:
    """Largest |measured/predicted - 1| of what grows by five e-foldings."""
    rows = select(tables, "ringing").dropna(subset=["measured"])
    off = (rows["measured"]/rows["predicted"] - 1).abs()
    return Measured(float(off.max()), float((rows["measured_err"]/rows["predicted"]).max()))


def lengths(tables: Tables) -> Measured:
    """Largest |measured/predicted - 1| of the lengths from which waves are lost."""
    rows = select(tables, "ringing_lost")
    if len(rows) < len(LENGTHS):
        raise CannotTell(f"{len(rows)} of {len(LENGTHS)} lattices lose a wave among the lengths that rang")
    off = (rows["measured"]/rows["predicted"] - 1).abs()
    return Measured(float(off.max()), float((rows["measured_err"]/rows["predicted"]).max()))


def changed(**other: float) -> Value:
    """Measured rate with something changed over that without, Lucy's square lattice, over seeds."""
    def value(tables: Tables) -> Measured:
        where = {name: SQUARE.columns[name] for name in KEY if name != "seed"}
        one, usual = (select(tables, "ringing", **{**where, **more}).set_index("seed")["measured"] for more in (other, {}))
        return over_seeds((one/usual).dropna().tolist())
    return value


def kept(tables: Tables) -> Measured:
    """Largest velocity across the wave over the wave's, of the lattices that keep."""
    found = [select(tables, "ringing", **case.columns).iloc[0] for case in KEPT]
    return Measured(float(max(row["across"]/row["wave"] for row in found)), 0.0)


ALIKE = "1 %: rates of one run are told to a thousandth"
CLAIMS = (
    Claim(id="khp95-hard-sound-rate", source="KHP95 Sec. II", value=rates, at_most=0.1, because=TENTH,
          statement="what grows beside a sound wave on a lattice grows at the rate of the lattice's fastest motion, viscosity "
                    "and conduction included: largest relative difference, from round-off"),
    Claim(id="khp95-hard-sound-length", source="KHP95 Sec. II", value=lengths, at_most=0.1,
          statement="sound on a lattice is lost to round-off that grew, from the length that lattice sums and the last digit of "
                    "places foretell: largest relative difference, two periods, Lucy and Monaghan, square and hexagonal",
          because=f"{TENTH}; three e-foldings of some thirty for how much of the round-off is alike"),
    Claim(id="khp95-hard-sound-step", source="KHP95 Sec. II", value=changed(step=0.5), expect=1, within=0.01, because=ALIKE,
          statement="what sound on a square lattice is lost to is not of the integrator: rate with half of the step over that "
                    "with all of it"),
    Claim(id="khp95-hard-sound-wave", source="KHP95 Sec. II", value=changed(amplitude=0.0), expect=1, within=0.01, because=ALIKE,
          statement="what sound on a square lattice is lost to is not of the wave: rate without a wave over that with it"),
    Claim(id="khp95-hard-sound-kept", source="KHP95 Sec. II", value=kept, at_most=1e-6,
          statement="on a square lattice that is stable, Lucy's with h = 2.5 a, or all but stable, Wendland's with h = 3 a, "
                    "sound of 128 spacings rings for two periods: velocity across the wave over the wave's",
          because="round-off of places, 1e-15 in hundreds of steps, is 1e-8 of the wave; a hundred times that is none of its"),
)


# --- figure -----------------------------------------------------------------------------------------------------------


def figures(tables: Tables) -> dict[str, Figure]:
    """One: in time, and over the length."""
    if any(name not in tables or tables[name].empty for name in ("ringing", "ringing_paths")):
        return {}
    page, (left, right) = figure(1, 2, width=4.6, height=4.2)
    in_time(left, tables["ringing_paths"], tables["ringing"])
    over_length(right, tables["ringing"])
    page.suptitle("Sound on a lattice: what grows across it, where the wave has no velocity\nleft: 64 spacings, those that keep "
                  "128; dashed: rates of lattice sums; right: points seeds, lines round-off grown",
                  fontsize=10)
    return {"ringing": page}


def in_time(axes: Any, paths: pd.DataFrame, rows: pd.DataFrame) -> None:
    """Velocities across the wave, and slopes of the predicted rates through where they are small."""
    axes.axhline(float(rows["wave"].iloc[0]), color="grey", linewidth=0.8)
    for number, case in enumerate((SQUARE, *OTHERS, *KEPT)):
        path, row = (some[(some[KEY] == list(case.columns.values())).all(axis=1)] for some in (paths, rows))
        axes.plot(path["t"], path["across"], **{**look(number), "linestyle": "-"}, markevery=(2*number, 12),
                  label=told(case.columns))
        if row["measured"].notna().any():
            late, t = path[path["across"] < 1e-6].iloc[-1], np.linspace(0.4, 1, 2)*path["t"].max()
            axes.plot(t, 10*late["across"]*np.exp(float(row["predicted"].iloc[0])*(t - late["t"])), color=look(number)["color"],
                      linestyle="--", marker="", linewidth=0.8)
    axes.set(yscale="log", xlabel=r"time $t\,(k_BT/m)^{1/2}/a$", ylabel=r"rms $v_y$; grey: the wave's $v_x$")
    below(axes, ncols=2)


def told(row: dict[str, Any]) -> str:
    """What is changed in a run."""
    if row["lattice"] != "square" or row["weight"] != "Lucy":
        return f"{row['lattice']}, {row['weight']}"
    changes = {"half of the step": row["step"] != 1, "no wave": row["amplitude"] == 0, "friction along pairs":
               row["transport"] == "Direct", f"$h$ = {row['h']:g} $a$": row["h"] != SQUARE.h}
    return next((name for name, so in changes.items() if so), "square, Lucy")


def over_length(axes: Any, rows: pd.DataFrame) -> None:
    """Velocities across the wave over the wave's when it has rung."""
    axes.axhline(1.0, color="grey", linewidth=0.8)
    for number, (case, some_lengths) in enumerate(LENGTHS):
        where = {name: case.columns[name] for name in KEY if name not in ("seed", "length")}
        some = rows[(rows[list(where)] == list(where.values())).all(axis=1) & rows["length"].isin(some_lengths)]
        axes.plot(some["length"], some["across"]/some["wave"], **{**look(number), "linestyle": "none"},
                  label=f"{where['lattice']}, {where['weight']}")
        line = some.groupby("length")[["foretold", "wave"]].mean()
        axes.plot(line.index, line["foretold"]/line["wave"], color=look(number)["color"], linestyle="-", marker="")
    axes.set(yscale="log", xscale="log", ylim=(1e-4, 1e6), xlabel="length of the wave / spacings",
             ylabel=r"$v_y$ over the wave's $v_x$, two periods on")
    axes.set_xticks([40, 60, 100, 200, 300], labels=["40", "60", "100", "200", "300"])
    axes.minorticks_off()
    below(axes, ncols=3)


PART = Part(cases=cases, tables=(RINGING, PATHS, LOST), claims=CLAIMS, derive=derive, figures=figures)
