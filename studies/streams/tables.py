"""Tables of the study streams, and derived rows: seconds to an error of 1 %, and where moving points win.

Errors are relative; `_err`: half of the 95 % interval; low, high: its ends.
"""
from collections.abc import Iterator

import numpy as np
import pandas as pd

from studies.kit import fits
from studies.kit.stats import seed_means
from studies.kit.table import Row, Rows, Table, Tables, groups

RIDE = "scene method stream rows"
SERIES = "scene quantity method stream"
STREAM = {"stream": ("speed of the stream over that of the flow, or of sound where it is at rest", "")}
RUNS = Table.of("runs", f"{RIDE} seed quantity", "error steps", means=STREAM,
                about="A run to the end of a scene; no error where it diverged.")
SECONDS = Table.of("seconds", RIDE, "step_s step_s_err setup_s setup_s_err", about="CPU seconds of a step.",
                   means=STREAM | {"step_s": ("CPU seconds of a step of all points", "s")})
NEEDED = Table.of("needed", SERIES, "reached cpu_s low high rows order least", means=STREAM | {
    "reached": ("yes; by order: beyond the rows that ran; at most: the coarsest is below already; no", ""),
    "cpu_s": ("CPU seconds to an error of 1 %", "s"), "order": ("observed order between the finest two", ""),
    "least": ("least error of all rows", "")}, about="What an error of 1 % costs.")
CROSSINGS = Table.of("crossings", "scene quantity rival", "moving stream low high slowest fastest", means={
    "rival": ("who stands still", ""), "low": ("lower end of its 95 % interval", ""),
    "high": ("upper end of its 95 % interval", ""),
    "moving": ("cheaper: always, never, from a stream on; as much: intervals overlap; none comes to 1 %", ""),
    "stream": ("that speed of the stream; none where one of both never comes to 1 % beyond `low`", ""),
    "slowest": ("their seconds over the rival's, at rest", ""),
    "fastest": ("the same in the fastest stream; 0 where the rival does not come to 1 %", "")},
    about="From which stream on points that move (moving-delaunay) are cheaper than one that stands still.")
TABLES = (RUNS, SECONDS, NEEDED, CROSSINGS)

WANTED = 0.01
MOVING = "moving-delaunay"
STILL = ("grid", "fixed-lattice-h1.2", "fixed-jittered-delaunay", "fixed-jittered-plates")
SANE = 0.2          # error beyond which no order is used
FARTHER = 4.0       # times the rows that ran: so far errors are extrapolated by their order


def derive(tables: Tables) -> Rows:
    """Derived rows of the study."""
    if "runs" not in tables or "seconds" not in tables:
        return {}
    points = means(tables["runs"], tables["seconds"])
    needs = [dict(zip(NEEDED.key, key)) | needed(group.sort_values("rows"))
             for key, group in groups(points, list(NEEDED.key))]
    return {"needed": needs, "crossings": list(crossings(pd.DataFrame(needs, columns=list(NEEDED.columns))))}


def means(runs: pd.DataFrame, seconds: pd.DataFrame) -> pd.DataFrame:
    """Errors and seconds of runs, means over seeds; no row where one diverged."""
    point, values = [*NEEDED.key, "rows"], ["error", "cpu_s"]
    rows = runs.merge(seconds, on=list(SECONDS.key))
    rows = rows.assign(cpu_s=rows.setup_s + rows.steps*rows.step_s, error=rows.error.abs(),
                       cpu_s_err=np.hypot(rows.setup_s_err, rows.steps*rows.step_s_err))
    lost = rows.error.isna().groupby([rows[name] for name in point]).transform("any")
    errors = [f"{name}_err" for name in values]
    return pd.DataFrame(seed_means(rows[~lost], point, values), columns=[*point, *values, *errors])


def needed(group: pd.DataFrame) -> Row:
    """Cost where errors at rising rows fall below 1 % for good, or would by the order of the last two."""
    least, below = group.error.min(), int((group.error <= WANTED)[::-1].cummin().sum())
    if below == len(group):
        first = group.iloc[0]
        return {"reached": "at most", "cpu_s": first.cpu_s, "low": 0.0, "high": first.cpu_s + first.cpu_s_err,
                "rows": first["rows"], "order": np.nan, "least": least}
    pair = group.iloc[-below - 1:].head(2) if below else group.tail(2)
    order = -np.diff(np.log(pair.error))[0]/np.diff(np.log(pair["rows"]))[0] if len(pair) == 2 else np.nan
    rows = pair["rows"].iloc[-1]*(pair.error.iloc[-1]/WANTED)**(1/order) if order > 0 else np.inf
    if not below and not (pair.error.iloc[0] < SANE and rows < FARTHER*pair["rows"].iloc[-1]):
        return {"reached": "no", "order": order, "least": least}
    cpu_s, half = fits.crossing(pair, "cpu_s", WANTED)
    if not below and len(group) > 2:        # the order may go on changing
        before, _ = fits.crossing(group.tail(3).head(2), "cpu_s", WANTED)
        half = np.hypot(half, abs(np.log(cpu_s/before))/2)
    low, high = cpu_s*np.exp([-half, half])
    return {"reached": "yes" if below else "by order", "cpu_s": cpu_s, "low": low, "high": high, "rows": rows,
            "order": order, "least": least}


def crossings(needs: pd.DataFrame) -> Iterator[Row]:
    """Crossings in each scene, against each method that stands still."""
    for (scene, quantity), here in groups(needs, ["scene", "quantity"]):
        moving = here[here.method == MOVING]
        for rival in STILL:
            both = here[here.method == rival].merge(moving, on="stream", suffixes=("", "_moving"))
            both = both.set_index("stream").sort_index()
            if len(both):
                yield {"scene": scene, "quantity": quantity, "rival": rival} | crossing(both)


def crossing(both: pd.DataFrame) -> Row:
    """The stream from which on moving points take fewer seconds for good; as much: at no stream do the two
    differ by more than their interval.

    A method that does not reach 1 % takes infinite seconds: a crossing is then between two known streams.
    """
    own, other = (both[name].fillna(np.inf) for name in ("cpu_s_moving", "cpu_s"))
    with np.errstate(divide="ignore"):
        ratio = np.log((own/other)[np.isfinite(own) | np.isfinite(other)])
    if ratio.empty:
        return {"moving": "none comes to 1 %"}
    ends = {"slowest": float(np.exp(ratio.get(0.0, np.nan))), "fastest": float(np.exp(ratio.iloc[-1]))}
    wins = int((ratio < 0)[::-1].cummin().sum())
    half = np.hypot(*(np.log(both["high" + end]/both["cpu_s" + end]) for end in ("", "_moving")))
    if (ratio.abs() < half[ratio.index]).all():
        return {"moving": "as much"} | ends
    if wins in (0, len(ratio)):
        return {"moving": "always" if wins else "never"} | ends
    pair = ratio.iloc[-wins - 1:].head(2)
    return {"moving": "from a stream on"} | zero(pair, half[pair.index]) | ends


def zero(pair: pd.Series, half: pd.Series) -> Row:
    """Zero of logarithms (2,) between two streams, linear in the stream, or in its logarithm from 0.1 on."""
    first, last = pair.index
    if not np.isfinite(pair).all():
        return {"stream": np.nan, "low": first, "high": last}
    into, back = (np.log, np.exp) if first else (float, float)
    a, b = into(first), into(last)
    share = pair.iloc[0]/(pair.iloc[0] - pair.iloc[1])
    err = np.hypot(*(np.array([1 - share, share])*half))/(pair.iloc[0] - pair.iloc[1])
    at = [back(a + place*(b - a)) for place in (share, share - err, share + err)]
    return dict(zip(("stream", "low", "high"), map(float, at)))
