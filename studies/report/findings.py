"""What was found, in words whose numbers and verdicts follow from tables and claims."""
import math
from collections import Counter
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
#: of error, whose cost is told, and of how many methods
LEVEL = 0.01
SHOWN = 5


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

    def onset(self, method: str, variant: str) -> pd.DataFrame:
        """Ra from which on weak rolls grow, by resolution."""
        wanted = {"way": "run", "method": method, "variant": variant}
        rows = rows_of(self.out/"onset/critical_ra.csv", CRITICAL, **wanted)
        weak = rows["quantity"].str.contains("K = 0.0004,", regex=False)
        return rows[weak].sort_values("resolution")

    def measured_claims(self, *names: str) -> list:
        """Rows of those of these claims that were measured, in this order."""
        rows = self.claims.dropna(subset="measured").set_index("id")
        return [rows.loc[name] for name in names if name in rows.index]


def claims_of(out: Path) -> pd.DataFrame:
    """All claims; NoReport where there are none, or the table lacks columns."""
    path = out/"claims.csv"
    if not path.exists():
        raise NoReport(f"{path} does not exist: studies write their verdicts there: make study-rb")
    return rows_of(path, COLUMNS)


def listed(rows: pd.DataFrame) -> str:
    """Errors in per cent with their rows over the height."""
    percents = each(100*rows["error"], 100*rows["error_err"])
    return f"{percents} % with {resolutions(rows)} rows"


def each(values: pd.Series, errors: pd.Series) -> str:
    """Numbers with their errors."""
    return many([with_error(*pair) for pair in zip(values, errors)])


def resolutions(rows: pd.DataFrame) -> str:
    """The rows over the height."""
    return many([f"{number:.0f}" for number in rows["resolution"]])


def measured(claim: Any, times: float = 1.0) -> str:
    """What a claim measured, 100 times that for per cent."""
    return with_error(times*claim.measured, times*claim.err)


def falls(rows: pd.DataFrame) -> bool:
    """Whether the finest error with its interval is below all others, or errors fell until they are noise."""
    size = rows["error"].abs().to_numpy()
    err = rows["error_err"].fillna(0.0).to_numpy()
    low, high = size - err, size + err
    below = high[-1] < low[:-1]
    fell = low[1:] <= high[:-1]
    until_noise = size[-1] <= err[-1] and fell.all()
    return bool(below.all() or (until_noise and below[0]))


def ends(rows: pd.DataFrame, limits: list) -> str:
    """Whether a method converges: by its limits, one for each extrapolation, or by its errors."""
    if limits and all(abs(one.measured) > one.err for one in limits):
        sizes = sorted(abs(one.measured) for one in limits)
        shares = dict.fromkeys(f"{100*size:.1g}" for size in sizes)
        return f"end {' to '.join(shares)} % off"
    return "converge" if falls(rows) else "do not converge"


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
    spam = known.onset("spam", "printed")
    grid = known.onset("compressible", "")[-1:]
    if len(spam) < 2 or grid.empty:
        return None
    low = spam["value"] - spam["err"]
    high = grid["value"] + grid["err"]
    title = "Smooth particles begin to convect as the gas does"
    if low.iloc[-1] > high.iloc[0]:
        title = "Near onset smooth particles come to rest where the gas convects"
    text = (f"Rolls of K = 0.0004 grow above Ra {each(spam['value'], spam['err'])} with {resolutions(spam)} "
            f"rows, on the grid above {each(grid['value'], grid['err'])}. [KHP95]")
    return Finding(title, text, "onset/critical_ra")


def fixed_points(known: Known) -> Finding | None:
    """K on a lattice of points that stay."""
    rows = known.errors("dih", "fixed-lattice")
    if len(rows) < 2:
        return None
    end = ""
    for limit in known.measured_claims("rr98-rb-lattice-10000"):
        end = f", {measured(limit, 100)} % off in the limit ({limit.verdict})"
    text = f"Energy on a lattice at Ra 10 000: {listed(rows)}{end}. [RR98, friction along edges]"
    return Finding(f"Sums over neighbours {ends(rows, [])} on points that stay", text, "rb/errors")


def moving_points(known: Known) -> Finding | None:
    """Points that move, as printed and over closed faces."""
    printed = known.errors("dih", "moving-literal")[-1:]
    closed = known.errors("dih", "moving")
    if printed.empty or len(closed) < 2:
        return None
    least = printed["error"].abs() - printed["error_err"]
    verb = "fail" if least.iloc[0] > 0.1 else "convect"
    limits = known.measured_claims(*MOVING_LIMITS)
    sizes = " or ".join(measured(one, 100) for one in limits)
    end = f"; in the limit {sizes} % off" if limits else ""
    title = f"Points that move as printed {verb}, over closed faces they {ends(closed, limits)}"
    text = (f"Energy at Ra 10 000, as printed: {listed(printed)}; over closed faces, a repair: "
            f"{listed(closed)}{end}. [RR98]")
    return Finding(title, text, "rb/errors")


def off_lattice(known: Known) -> Finding | None:
    """A fluid at rest on irregular points."""
    claims = known.measured_claims("rr98-eq35-rest", "rr98-conservation-survival-delaunay")
    if len(claims) < 2:
        return None
    rest, kept = claims
    verb = "accelerates" if rest.verdict == "fails" else "stays at rest"
    goes = "goes" if kept.verdict == "holds" else "does not go"
    text = (f"By {measured(rest)} P/(ρa) at most as printed, points shifted by up to 0.3 spacings; over "
            f"Delaunay edges, which close, a random start {goes} through 10 000 steps. [RR98 Eqs 34-36]")
    return Finding(f"Off a lattice a fluid at rest {verb}", text, "claims")


def noise(known: Known) -> Finding | None:
    """Which noise heats a fluid right."""
    of_equations = known.claims["id"].str.match(r"rr98-fluct-eq4[2-4]")
    verdicts = list(known.claims["verdict"][of_equations])
    claims = known.measured_claims("own-fluct-partners", "rr98-fluct-brillouin-position")
    if not verdicts or len(claims) < 2:
        return None
    ours, mode = claims
    fails = verdicts.count("fails")
    title = "Printed noise holds"
    if fails:
        title = "Printed noise heats no fluid right, one random stress a point does"
    off = signed(f"{ours.measured:.0e}")
    text = (f"Eqs 42-44: {fails} of {len(verdicts)} statements fail. [RR98] With one stress and heat current "
            f"a point |Q − 2kTΓ| is {off}, sampled sound peaks at {measured(mode)} of its place.")
    return Finding(title, text, "claims")


def price(known: Known) -> Finding | None:
    """CPU seconds for an error of 1 %, of the panel shown first."""
    if not known.panels:
        return None
    panel = known.panels[0]
    reach = [line for line in panel.lines if LEVEL in line.needs]
    if not reach:
        return None
    reach.sort(key=lambda line: line.needs[LEVEL].cpu_s)
    best = reach[0]
    shown = [line for line in reach if line.usual or line is best]
    costs = "; ".join(f"{line.needs[LEVEL]} s, {line.label}" for line in shown[:SHOWN])
    never = [line for line in panel.lines if line.usual and line not in reach]
    if never:
        names = dict.fromkeys(line.label.split(",")[0] for line in never)
        costs += f"; not reached by {many(list(names))}"
    title = f"An error of 1 % costs {best.needs[LEVEL]} CPU seconds at best"
    source = panel.needed or panel.sheet
    return Finding(title, f"{panel.scene}: {costs}.", source.name)


def findings(known: Known) -> list[Finding]:
    """Those for which there are numbers, one screen of them."""
    ways = (smooth_particles, onset, fixed_points, moving_points, off_lattice, noise, price)
    made = [find(known) for find in ways]
    return [one for one in made if one]


def answer(known: Known) -> str:
    """The question's answer in two sentences: the most particles beside the coarsest grid; what holds."""
    sentences = []
    spam = known.errors("spam", "printed", "Kg")
    grid = known.errors("compressible", "flux-form")
    if len(spam) and len(grid):
        most = spam.iloc[-1]
        coarse = grid.iloc[0]
        sentences.append(
            f"{grouped(most['particles'])} smooth particles as printed miss the energy of convection by "
            f"{percent(most['error'])}, where a grid of {coarse['resolution']:.0f} rows is off by "
            f"{percent(coarse['error'])} in {seconds(coarse['cpu_s'])} CPU seconds.")
    of_papers = known.claims["whose"] == "paper"
    count = Counter(known.claims["verdict"][of_papers])
    if count:
        sentences.append(f"Of {count.total()} statements of the papers {count['holds']} hold, "
                         f"{count['fails']} fail, {count['undecidable']} are undecidable here.")
    return " ".join(sentences)
