"""What was found, in words whose numbers and verdicts follow from tables and claims."""
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import pandas as pd

from studies.kit.claim import COLUMNS
from studies.report.cost import Panel
from studies.report.inventory import NoReport, rows_of
from studies.report.numbers import grouped, many, percent, seconds, signed, with_error

LAYER = {"eos": "ideal", "transport": "const-eta", "sides": "periodic", "pr": 1, "ra": 1e4}
#: |K/K_grid - 1| extrapolated over 1/rows^2, and with a term of 1/rows besides
MOVING_LIMITS = ("own-rb-moving-limit", "own-rb-moving-limit-plates")
ERRORS = ("resolution", "error", "error_err", "cpu_s", "particles")
CRITICAL = ("quantity", "value", "err", "variant", "method", "resolution")
LEVEL, SHOWN = 0.01, 5


class Finding(NamedTuple):
    """A sentence, its numbers, and the table or claims that have them."""
    title: str
    text: str
    source: str


class Known(NamedTuple):
    """Tables by name, claims, panels of cost."""
    out: Path
    claims: pd.DataFrame
    panels: list[Panel]

    def errors(self, method: str, variant: str, energy: str = "Kp") -> pd.DataFrame:
        """Errors of one method in the layer at Ra 10 000, by resolution; means over grids alone."""
        wanted = {**LAYER, "method": method, "variant": variant, "energy": energy}
        rows = rows_of(self.out/"rb/errors.csv", ERRORS, **wanted)
        return rows[rows["resolution"] < math.inf].sort_values("resolution")

    def claim(self, name: str) -> pd.Series | None:
        """A claim that was measured."""
        rows = self.claims[(self.claims["id"] == name) & self.claims["measured"].notna()]
        return rows.iloc[0] if len(rows) else None


def claims_of(out: Path) -> pd.DataFrame:
    """All claims; NoReport where there are none, or the table lacks columns."""
    path = out/"claims.csv"
    if not path.exists():
        raise NoReport(f"{path} does not exist: studies write their verdicts there: make study-rb")
    return rows_of(path, COLUMNS)


def findings(known: Known) -> list[Finding]:
    """Those for which there are numbers."""
    return [one for find in ALL if (one := find(known))]


# --- words ----------------------------------------------------------------------------------------


def listed(rows: pd.DataFrame) -> str:
    """Errors in per cent with their rows over the height."""
    return f"{each(rows, 'error', 100)} % with {resolutions(rows)} rows"


def each(rows: pd.DataFrame, value: str, times: float = 1.0) -> str:
    """The numbers of a column with their errors, those of `error` in `error_err`."""
    errors = rows["error_err" if value == "error" else "err"]
    return many([with_error(x, dx, times) for x, dx in zip(rows[value], errors, strict=True)])


def resolutions(rows: pd.DataFrame) -> str:
    """The rows over the height."""
    return many([f"{number:.0f}" for number in rows["resolution"]])


def measured(claim: Any, times: float = 1.0) -> str:
    """What a claim measured."""
    return with_error(claim["measured"], claim["err"], times)


def falls(rows: pd.DataFrame) -> bool:
    """Whether the finest error with its interval is below all others, or errors fell until they are noise."""
    if len(rows) < 2:
        return False
    size, err = rows["error"].abs().to_numpy(), rows["error_err"].fillna(0.0).to_numpy()
    below = size[-1] + err[-1] < size[:-1] - err[:-1]
    fell = size[1:] - err[1:] <= size[:-1] + err[:-1]
    return bool(below.all() or (size[-1] <= err[-1] and fell.all() and below[0]))


def ends(rows: pd.DataFrame, limits: list[pd.Series]) -> str:
    """Whether a method converges: by its limits, one for each extrapolation, or by its errors."""
    sizes = sorted(abs(one["measured"]) for one in limits if abs(one["measured"]) > one["err"])
    if sizes and len(sizes) == len(limits):
        return f"end {' to '.join(dict.fromkeys(f'{100*size:.1g}' for size in sizes))} % off"
    return "converge" if falls(rows) else "do not converge"


# --- one each -------------------------------------------------------------------------------------


def smooth_particles(known: Known) -> Finding | None:
    """Kg of KHP95's particles against the grid's field smoothed alike."""
    rows = known.errors("spam", "printed", "Kg")
    if len(rows) < 2:
        return None
    verb = "come ever nearer to" if falls(rows) else "do not converge on"
    text = f"Energy of their flow at Ra 10 000, against the grid's field smoothed alike: {listed(rows)}."
    return Finding(f"Smooth particles as printed {verb} the gas", f"{text} [KHP95]", "rb/errors")


def onset(known: Known) -> Finding | None:
    """From which Ra on rolls of the same strength grow."""
    rows = rows_of(known.out/"onset/critical_ra.csv", CRITICAL, way="run").sort_values("resolution")
    weak = rows["quantity"].str.contains("K = 0.0004,", regex=False)
    rows = rows[weak & rows["variant"].isin(["", "printed"])]
    spam, grid = rows[rows["method"] == "spam"], rows[rows["method"] == "compressible"][-1:]
    if len(spam) < 2 or grid.empty:
        return None
    last, finest = spam.iloc[-1], grid.iloc[0]
    later = last["value"] - last["err"] > finest["value"] + finest["err"]
    title = ("Near onset smooth particles come to rest where the gas convects" if later
             else "Smooth particles begin to convect as the gas does")
    text = (f"Rolls of K = 0.0004 grow above Ra {each(spam, 'value')} with {resolutions(spam)} rows, "
            f"on the grid above {each(grid, 'value')}. [KHP95]")
    return Finding(title, text, "onset/critical_ra")


def fixed_points(known: Known) -> Finding | None:
    """K on a lattice of points that stay."""
    rows, limit = known.errors("dih", "fixed-lattice"), known.claim("rr98-rb-lattice-10000")
    if len(rows) < 2:
        return None
    verb = "converge" if falls(rows) else "do not converge"
    end = "" if limit is None else f", {measured(limit, 100)} % off in the limit ({limit['verdict']})"
    text = f"Energy on a lattice at Ra 10 000: {listed(rows)}{end}. [RR98, friction along edges]"
    return Finding(f"Sums over neighbours {verb} on points that stay", text, "rb/errors")


def moving_points(known: Known) -> Finding | None:
    """Points that move, as printed and over closed faces."""
    printed, closed = known.errors("dih", "moving-literal")[-1:], known.errors("dih", "moving")
    if printed.empty or len(closed) < 2:
        return None
    last = printed.iloc[0]
    verb = "fail" if abs(last["error"]) - last["error_err"] > 0.1 else "convect"
    limits = [one for one in map(known.claim, MOVING_LIMITS) if one is not None]
    sizes = " or ".join(measured(one, 100) for one in limits)
    end = f"; in the limit {sizes} % off" if limits else ""
    title = f"Points that move as printed {verb}, over closed faces they {ends(closed, limits)}"
    text = (f"Energy at Ra 10 000, as printed: {listed(printed)}; over closed faces, a repair: "
            f"{listed(closed)}{end}. [RR98]")
    return Finding(title, text, "rb/errors")


def off_lattice(known: Known) -> Finding | None:
    """A fluid at rest on irregular points."""
    rest, kept = known.claim("rr98-eq35-rest"), known.claim("rr98-conservation-survival-delaunay")
    if rest is None or kept is None:
        return None
    verb = "accelerates" if rest["verdict"] == "fails" else "stays at rest"
    goes = "goes" if kept["verdict"] == "holds" else "does not go"
    text = (f"By {measured(rest)} P/(ρa) at most as printed, points shifted by up to 0.3 spacings; over "
            f"Delaunay edges, which close, a random start {goes} through 10 000 steps. [RR98 Eqs 34-36]")
    return Finding(f"Off a lattice a fluid at rest {verb}", text, "claims")


def noise(known: Known) -> Finding | None:
    """Which noise heats a fluid right."""
    printed = known.claims[known.claims["id"].str.match(r"rr98-fluct-eq4[2-4]")]
    ours, mode = known.claim("own-fluct-partners"), known.claim("rr98-fluct-brillouin-position")
    if printed.empty or ours is None or mode is None:
        return None
    fails = int(printed["verdict"].eq("fails").sum())
    title = "Printed noise heats no fluid right, one random stress a point does"
    text = (f"Eqs 42-44: {fails} of {len(printed)} statements fail. [RR98] With one stress and heat current "
            f"a point |Q − 2kTΓ| is {signed(format(ours['measured'], '.0e'))}, sampled sound peaks at "
            f"{measured(mode)} of its place.")
    return Finding(title if fails else "Printed noise holds", text, "claims")


def price(known: Known) -> Finding | None:
    """CPU seconds for an error of 1 %, of the panel shown first."""
    lines = known.panels[0].lines if known.panels else []
    reach = sorted((line for line in lines if LEVEL in line.needs), key=lambda line: line.needs[LEVEL].cpu_s)
    if not reach:
        return None
    panel, best = known.panels[0], reach[0]
    shown = [line for line in reach if line.usual or line is best][:SHOWN]
    costs = "; ".join(f"{line.needs[LEVEL]} s, {line.label}" for line in shown)
    never = [line.label.split(",")[0] for line in lines if line.usual and LEVEL not in line.needs]
    rest = f"; not reached by {many(list(dict.fromkeys(never)))}" if never else ""
    text = f"{panel.title.split(': ', 1)[-1]}: {costs}{rest}."
    return Finding(f"An error of 1 % costs {best.needs[LEVEL]} CPU seconds at best", text,
                   (panel.needed or panel.sheet).name)


#: one screen of them
ALL: tuple[Callable[[Known], Finding | None], ...] = (
    smooth_particles, onset, fixed_points, moving_points, off_lattice, noise, price)


def answer(known: Known) -> str:
    """The question's answer in two sentences: the most particles beside the coarsest grid; what holds."""
    spam, grid = known.errors("spam", "printed", "Kg"), known.errors("compressible", "flux-form")
    sentences = []
    if len(spam) and len(grid):
        most, coarse = spam.iloc[-1], grid.iloc[0]
        sentences.append(
            f"{grouped(most['particles'])} smooth particles as printed miss the energy of convection by "
            f"{percent(most['error'])}, where a grid of {coarse['resolution']:.0f} rows is off by "
            f"{percent(coarse['error'])} in {seconds(coarse['cpu_s'])} CPU seconds.")
    verdicts = known.claims.loc[known.claims["whose"] == "paper", "verdict"]
    if len(verdicts):
        holds, fails, unknown = ((verdicts == one).sum() for one in ("holds", "fails", "undecidable"))
        sentences.append(f"Of {len(verdicts)} statements of the papers {holds} hold, {fails} fail, {unknown} "
                         "are undecidable here.")
    return " ".join(sentences)
