"""Claims about freezing    [KHP95, Sec. IV, Fig. 4]"""
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from particles.weights import Lucy, Monaghan
from studies.build.read import Value, over_seeds, ratio, select
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables

GAS: dict[str, Any] = {"eos": "IdealGas", "weight": "Lucy", "ra": 3000.0, "step": 1.0}
FROZEN = 0.1        # of the grid's energy, as in the bisection
SHORT = 0.25        # of the step of other studies
LEAST = 1/128       # of a layer: one particle


def bracketed(tables: Tables, where: dict[str, Any]) -> pd.DataFrame:
    """Limits of a layer; a bisection without a run on either side of its limit has only come to its end.

    Raises
    ------
    CannotTell
        One has.
    """
    rows, looks = select(tables, "freezing_limits", **where), select(tables, "freezing", **where)
    for seed, group in looks.groupby("seed"):
        if not (group["flow"] < FROZEN).any() or not (group["flow"] >= FROZEN).any():
            raise CannotTell(f"seed {seed}: no change between frozen and flowing from P = {group['P'].min():.2g} to "
                             f"{group['P'].max():.2g}; flow {group['flow'].min():.2g} to {group['flow'].max():.2g} of the grid's")
    return rows


def frozen_at(criterion: str, **where) -> Value:
    """Pressure at which the flow freezes over that of a printed criterion, seeds by seeds."""
    def value(tables: Tables) -> Measured:
        rows = bracketed(tables, where)
        found = rows["measured"]/rows[criterion]
        spread = over_seeds(found.tolist()).err if len(found) > 1 else 0.0
        return Measured(float(found.mean()), max(spread, float((rows["measured_err"]/rows[criterion]).max())))
    return value


def next_to_limit(frozen: bool) -> Value:
    """Fluctuation of neighbours' distances at the pressure next to the limit, on one side of it, over seeds."""
    def value(tables: Tables) -> Measured:
        limits = select(tables, "freezing_limits", **GAS).set_index("seed")["measured"]
        rows = select(tables, "freezing", **GAS)
        beyond = rows[(rows["P"] > rows["seed"].map(limits)) == frozen].dropna()
        if beyond.groupby("seed").ngroups < len(limits):
            raise CannotTell("the bisection has no run on one side of the limit")
        near = beyond.assign(far=np.abs(np.log(beyond["P"]/beyond["seed"].map(limits)))).sort_values("far")
        return over_seeds(near.groupby("seed")["lindemann"].first().tolist())
    return value


def limits_ratio(one: dict, other: dict, per_K: bool = False) -> Value:
    """Freezing pressure of one layer over that of another, each over the grid's K if wanted."""
    def limit(tables: Tables, where: dict) -> Measured:
        rows = bracketed(tables, where)
        scale = float(rows["K"].mean()) if per_K else 1.0
        return Measured(float(rows["measured"].mean())/scale, float(rows["measured_err"].max())/scale)
    return lambda tables: ratio(limit(tables, one), limit(tables, other))


def most_stuck(tables: Tables) -> Measured:
    """Of all layers and pressures at Ra 10 000 whose runs came to their end, with all of the step."""
    return Measured(float(select(tables, "freezing_layers", **{**GAS, "ra": 1e4})["stuck"].max()), 0.0)


def quieter(tables: Tables) -> Measured:
    """K of particles at Ra 10 000 with a quarter of the step over that with all, at the highest pressure that both ran."""
    whole, short = (select(tables, "freezing", **{**GAS, "ra": 1e4, "step": step}).dropna().set_index("P").sort_index()
                    for step in (1.0, SHORT))
    common = [P for P in short.index if np.isclose(whole.index, P).any()]
    if not common:
        raise CannotTell("no pressure that both steps ran")
    one, other = (rows.iloc[int(np.argmin(np.abs(rows.index - common[-1])))] for rows in (short, whole))
    return ratio(Measured(float(one["kp"]), float(one["kp_err"])), Measured(float(other["kp"]), float(other["kp_err"])))


def cold_first(tables: Tables) -> Measured:
    """Part that stays in the uppermost over that in the lowermost layer, over seeds."""
    limits = select(tables, "freezing_limits", **GAS).set_index("seed")["measured"]
    found = []
    for seed, rows in select(tables, "freezing_layers", **GAS).groupby("seed"):
        frozen = rows[rows["P"] > limits[seed]]
        if frozen.empty:
            raise CannotTell("the bisection has no run on the frozen side of the limit")
        near = frozen[frozen["P"] == frozen["P"].min()].sort_values("y")["stuck"]
        found.append(float(near.iloc[-1]/max(near.iloc[0], LEAST)))
    return over_seeds(found)


RULE = "a criterion from a rule of thumb is good to a factor of two at best"
FREEZING = (
    *(Claim(id=f"khp95-hard-freezing-{name}-{weight.__name__.lower()}", source="KHP95 Sec. IV, Fig. 4", printed=printed,
            at_least=0.5, at_most=2, because=RULE, value=frozen_at(name, **{**GAS, "weight": weight.__name__}),
            statement=f"convection freezes at the pressure of the {words}: measured over printed, {weight.__name__}, 512 "
                      "particles, ideal gas, Ra 3000, v^2 of the grid")
      for weight, (name, printed, words) in product((Lucy, Monaghan), (
          ("melting", "mv^2 > 2Pn^-2[w(0.9)-w(1)]", "Lindemann-like criterion"),
          ("barrier", "mv^2 > 2Pn^-2 w(0)", "largest potential")))),
    Claim(id="khp95-hard-freezing-lindemann", source="KHP95 Sec. IV", printed="of the order of 10%", at_least=0.05, at_most=0.2,
          statement="melting occurs when neighbours' distances fluctuate by about 10 %: fluctuation in the frozen run next to "
                    "the limit, Lucy, ideal gas, Ra 3000", value=next_to_limit(frozen=True),
          because='"of the order of": a factor of two'),
    Claim(id="khp95-hard-freezing-molten", source="KHP95 Sec. IV", printed="of the order of 10%", at_least=0.1,
          statement="where particles flow neighbours' distances fluctuate by more than 10 %: fluctuation in the flowing run next "
                    "to the limit, Lucy, ideal gas, Ra 3000", value=next_to_limit(frozen=False), because="the printed number"),
    Claim(id="khp95-hard-freezing-dense", source="KHP95 Sec. IV", at_least=0.5, at_most=2,
          statement="it is the pressure that freezes, not the equation of state: limit of the dense fluid over that of the ideal "
                    "gas, Lucy, Ra 3000", value=limits_ratio({**GAS, "eos": "DenseFluid"}, GAS), because=RULE),
    Claim(id="khp95-hard-freezing-energy", source="KHP95 Sec. IV", at_least=0.5, at_most=2,
          statement="the pressure at which flow freezes grows in proportion to its v^2: limit over the grid's K at Ra 10 000 "
                    "over the same at Ra 3000, Lucy, ideal gas", value=limits_ratio({**GAS, "ra": 1e4}, GAS, per_K=True),
          because=RULE),
    # asked after bisection at Ra 10 000 had come to its end, and one run had frozen there with a quarter of the step
    Claim(id="khp95-hard-freezing-nowhere", source="KHP95 Sec. IV", at_most=0.5, value=most_stuck, because="half of them",
          statement="at Ra 10 000, with the step of other studies, nothing freezes at the pressures that runs come through, 1.4 "
                    "to 5.2, in no corner and in no cold layer: largest part of a layer's particles that stay, Lucy, ideal gas "
                    "[asked after no limit had been found; a quarter of the step has one]"),
    Claim(id="khp95-hard-freezing-step-noise", source="KHP95 Sec. IV", at_most=0.5, value=quieter,
          statement="what keeps particles at Ra 10 000 from freezing is noise that the step makes where they turn at the plates: "
                    "their K with a quarter of the step over that with all, highest pressure of both [asked after]",
          because="noise of the flow does not hang on the step; half is far from it"),
    Claim(id="khp95-hard-freezing-energy-short", source="KHP95 Sec. IV", at_least=0.5, at_most=2, because=RULE,
          statement="with a quarter of the step the pressure at which flow freezes grows in proportion to its v^2: limit over "
                    "the grid's K at Ra 10 000 over the same at Ra 3000, Lucy, ideal gas [asked after none with all of it]",
          value=limits_ratio({**GAS, "ra": 1e4, "step": SHORT}, {**GAS, "step": SHORT}, per_K=True)),
    Claim(id="khp95-hard-freezing-dense-short", source="KHP95 Sec. IV", at_least=0.5, at_most=2, because=RULE,
          statement="with a quarter of the step it is the pressure that freezes, too, not the equation of state: limit of the "
                    "dense fluid over that of the ideal gas, Lucy, Ra 3000",
          value=limits_ratio({**GAS, "eos": "DenseFluid", "step": SHORT}, {**GAS, "step": SHORT})),
    Claim(id="khp95-hard-freezing-melting-short", source="KHP95 Sec. IV, Fig. 4", at_least=0.5, at_most=2, because=RULE,
          printed="mv^2 > 2Pn^-2[w(0.9)-w(1)]", value=frozen_at("melting", **{**GAS, "step": SHORT}),
          statement="with a quarter of the step convection freezes at the pressure of the Lindemann-like criterion: measured "
                    "over printed, Lucy, ideal gas, Ra 3000, v^2 of the grid"),
    Claim(id="khp95-hard-freezing-step", source="KHP95 Sec. IV", expect=1, within=0.1,
          value=limits_ratio({**GAS, "step": SHORT, "seed": 1}, {**GAS, "seed": 1}),
          statement="the pressure at which flow freezes does not hang on the step: limit with a quarter of it over that with "
                    "all, Lucy, ideal gas, Ra 3000", because="bisection leaves 5 % to each"),
    Claim(id="khp95-hard-freezing-cold", source="KHP95 Sec. IV", at_least=1, value=cold_first,
          statement="particles freeze from the cold plate on: part that stays in the coldest over that in the hottest quarter, "
                    "frozen run next to the limit, Lucy, ideal gas, Ra 3000 [asked after one run had been seen]",
          because="1 is no difference"),
)
