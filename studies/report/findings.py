"""What was found, in words whose numbers and verdicts are computed from tables and claims; what a table lacks is left out."""
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from studies.kit.claim import COLUMNS
from studies.report.cost import Panel
from studies.report.found import NoReport, rows_of
from studies.report.numbers import grouped, many, percent, seconds, signed, told

LAYER = {"eos": "ideal", "transport": "const-eta", "sides": "periodic", "pr": 1}
#: |K/K_grid - 1| extrapolated over 1/rows^2, and with a term of 1/rows besides
MOVING_LIMITS = ("own-rb-moving-limit", "own-rb-moving-limit-plates")
ERRORS = ("resolution", "error", "error_err", "cpu_s", "particles")


@dataclass(frozen=True)
class Finding:
    """A sentence, its numbers, and the table or claims that have them."""

    title: str
    text: str
    source: str


@dataclass(frozen=True)
class Known:
    """Tables by name, claims, panels of cost."""

    out: Path
    claims: pd.DataFrame
    panels: list[Panel]

    def errors(self, ra: float = 1e4, energy: str = "Kp", **who: str) -> pd.DataFrame:
        """Errors of one method in the layer, by resolution; means over grids alone."""
        found = rows_of(self.out/"rb/errors.csv", ERRORS, **LAYER, ra=ra, energy=energy, **who)
        return found[found["resolution"] < math.inf].sort_values("resolution")

    def claim(self, name: str) -> pd.Series | None:
        """A claim that was measured."""
        found = self.claims[(self.claims["id"] == name) & self.claims["measured"].notna()]
        return found.iloc[0] if len(found) else None


def claims_of(out: Path) -> pd.DataFrame:
    """All claims.

    Raises
    ------
    NoReport
        There are none, or the table lacks columns.
    """
    path = out/"claims.csv"
    if not path.exists():
        raise NoReport(f"{path} does not exist: a study writes its verdicts there, make study-rb the main ones")
    return rows_of(path, COLUMNS)


def findings(known: Known) -> list[Finding]:
    """Those for which there are numbers."""
    made = (find(known) for find in ALL)
    return [one for one in made if one]


def listed(rows: pd.DataFrame) -> str:
    """Errors in per cent with their rows over the height."""
    errors = [told(e, d, 100) for e, d in zip(rows["error"], rows["error_err"])]
    return f"{many(errors)} % with {many([f'{n:.0f}' for n in rows['resolution']])} rows"


def falls(rows: pd.DataFrame) -> bool:
    """Whether the finest error with its interval is below all others, or errors fell until they are not told from zero."""
    size, err = rows["error"].abs().to_numpy(), rows["error_err"].fillna(0.0).to_numpy()
    if len(rows) < 2:
        return False
    below, fell = size[-1] + err[-1] < size[:-1] - err[:-1], size[1:] - err[1:] <= size[:-1] + err[:-1]
    return bool(below.all() or (size[-1] <= err[-1] and fell.all() and below[0]))


def smooth_particles(known: Known) -> Finding | None:
    """Kg of KHP95's particles against the grid's field smoothed alike."""
    rows = known.errors(method="spam", variant="printed", energy="Kg")
    if len(rows) < 2:
        return None
    verb = "come ever nearer to" if falls(rows) else "do not converge on"
    return Finding(f"Smooth particles as printed {verb} the gas", "Energy of their flow at Ra 10 000, against the grid's field "
                   f"smoothed alike: {listed(rows)}. [KHP95]", "rb/errors")


def onset(known: Known) -> Finding | None:
    """From which Ra on rolls of the same strength grow."""
    found = rows_of(known.out/"onset/critical_ra.csv", ("quantity", "value", "err", "variant", "method", "resolution"), way="run")
    found = found[found["quantity"].str.contains("K = 0.0004,", regex=False)].sort_values("resolution")
    spam, grid = (found[(found["method"] == m) & (found["variant"].isin(["", "printed"]))] for m in ("spam", "compressible"))
    if len(spam) < 2 or grid.empty:
        return None
    later = (spam["value"] - spam["err"]).iloc[-1] > (grid["value"] + grid["err"]).iloc[-1]
    numbers = many([told(v, e) for v, e in zip(spam["value"], spam["err"])])
    return Finding("Near onset smooth particles come to rest where the gas convects" if later else
                   "Smooth particles begin to convect as the gas does",
                   f"Rolls of K = 0.0004 grow above Ra {numbers} with {many([f'{n:.0f}' for n in spam['resolution']])} rows, on "
                   f"the grid above {told(grid['value'].iloc[-1], grid['err'].iloc[-1])}. [KHP95]", "onset/critical_ra")


def fixed_points(known: Known) -> Finding | None:
    """K on a lattice of points that stay."""
    rows = known.errors(method="dih", variant="fixed-lattice")
    if len(rows) < 2:
        return None
    limit = known.claim("rr98-rb-lattice-10000")
    end = f", {told(limit['measured'], limit['err'], 100)} % off in the limit ({limit['verdict']})" if limit is not None else ""
    return Finding(f"Sums over neighbours {'converge' if falls(rows) else 'do not converge'} on points that stay",
                   f"Energy on a lattice at Ra 10 000: {listed(rows)}{end}. [RR98, friction along edges, heated right]",
                   "rb/errors")


def moving_points(known: Known) -> Finding | None:
    """Points that move, as printed and over closed faces."""
    printed, closed = (known.errors(method="dih", variant=name) for name in ("moving-literal", "moving"))
    if printed.empty or len(closed) < 2:
        return None
    bad = printed["error"].abs().iloc[-1] - printed["error_err"].iloc[-1] > 0.1
    limits = [one for one in map(known.claim, MOVING_LIMITS) if one is not None]
    end = f"; in the limit {' or '.join(told(one['measured'], one['err'], 100) for one in limits)} % off" if limits else ""
    return Finding(f"Points that move as printed {'fail' if bad else 'convect'}, over closed faces they {ends(closed, limits)}",
                   f"Energy at Ra 10 000, as printed: {listed(printed[-1:])}; over closed faces, a repair: "
                   f"{listed(closed)}{end}. [RR98]", "rb/errors")


def ends(rows: pd.DataFrame, limits: list[pd.Series]) -> str:
    """Whether a method converges: by its limit (one for each way to extrapolate) where that is told from zero, else by errors."""
    off = [one["measured"] for one in limits if abs(one["measured"]) > one["err"]]
    if off and len(off) == len(limits):
        least = " to ".join(dict.fromkeys(f"{100*size:.1g}" for size in sorted(map(abs, off))))
        return f"end {least} % off"
    return "converge" if falls(rows) else "do not converge"


def off_lattice(known: Known) -> Finding | None:
    """A fluid at rest on irregular points."""
    rest, kept = known.claim("rr98-eq35-rest"), known.claim("rr98-conservation-survival-delaunay")
    if rest is None or kept is None:
        return None
    return Finding(f"Off a lattice a fluid at rest {'accelerates' if rest['verdict'] == 'fails' else 'stays at rest'}",
                   f"By {told(rest['measured'], rest['err'])} P/(ρa) at most as printed, points shifted by up to 0.3 spacings; "
                   "over Delaunay edges, which close, a random start "
                   f"{'goes' if kept['verdict'] == 'holds' else 'does not go'} through 10 000 steps. [RR98 Eqs 34-36]", "claims")


def noise(known: Known) -> Finding | None:
    """Which noise heats a fluid right."""
    printed = known.claims[known.claims["id"].str.match(r"rr98-fluct-eq4[2-4]")]
    ours, mode = known.claim("own-fluct-partners"), known.claim("rr98-fluct-brillouin-position")
    if printed.empty or ours is None or mode is None:
        return None
    fails = int(printed["verdict"].eq("fails").sum())
    title = "Printed noise heats no fluid right, one random stress a point does" if fails else "Printed noise holds"
    return Finding(title, f"Eqs 42-44: {fails} of {len(printed)} statements fail. [RR98] With one stress and heat current a "
                   f"point |Q − 2kTΓ| is {signed(format(ours['measured'], '.0e'))}, sampled sound peaks at "
                   f"{told(mode['measured'], mode['err'])} of its place.", "claims")


def price(known: Known) -> Finding | None:
    """CPU seconds for an error of 1 %, of the panel shown first, and in which scenes the cheapest method was no contestant."""
    if not known.panels:
        return None
    panel, level = known.panels[0], 0.01
    cheapest = sorted((one for one in panel.series if level in one.needs), key=lambda one: one.needs[level].cpu_s)
    never = dict.fromkeys(one.label.split(",")[0] for one in panel.series if one.usual and level not in one.needs)
    if not cheapest:
        return None
    shown = [one for one in cheapest if one.usual or one is cheapest[0]][:5]
    costs = "; ".join(f"{one.needs[level]} s, {one.label}" for one in shown)
    rest = f"; not reached by {many(list(never))}" if never else ""
    return Finding(f"An error of 1 % costs {cheapest[0].needs[level]} CPU seconds at best",
                   f"{panel.title.split(': ', 1)[-1]}: {costs}{rest}.", (panel.needed or panel.sheet).name)


#: one screen of them
ALL: tuple[Callable[[Known], Finding | None], ...] = (smooth_particles, onset, fixed_points, moving_points, off_lattice, noise,
                                                      price)


def answer(known: Known) -> str:
    """The question's answer in two sentences."""
    spam = known.errors(method="spam", variant="printed", energy="Kg")
    grid = known.errors(method="compressible", variant="flux-form")
    said = []
    if len(spam) and len(grid):
        far, near = spam.iloc[-1], grid.iloc[0]
        said.append(f"{grouped(far['particles'])} smooth particles as printed miss the energy of convection by "
                    f"{percent(far['error'])}, where a grid of {near['resolution']:.0f} rows is off by "
                    f"{percent(near['error'])} in {seconds(near['cpu_s'])} CPU seconds.")
    return " ".join([*said, *counts(known.claims)])


def counts(claims: pd.DataFrame) -> Iterator[str]:
    """How many statements hold."""
    papers = claims[claims["whose"] == "paper"]
    if len(papers):
        number = papers["verdict"].value_counts()
        yield (f"Of {len(papers)} statements of the papers {number.get('holds', 0)} hold, {number.get('fails', 0)} fail, "
               f"{number.get('undecidable', 0)} are undecidable here.")
