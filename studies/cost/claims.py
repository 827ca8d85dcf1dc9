"""What errors cost, judged    [KHP95 Secs I, II, VII; RR98 Sec. III]"""
from typing import Any

import numpy as np

from studies.cost.tables import CARRIED, FIXED, GRID, LAMMPS, LUCY, MAC, MOVING, PYPDE, WIDE
from studies.kit.ask import Value, bench, first, largest_per, last, least, one
from studies.kit.claim import Claim

K = {"scene": "convection", "quantity": "K"}
LOWER_K = {"scene": "convection-5000", "quantity": "K"}
VORTEX = {"scene": "taylor-green", "quantity": "velocity"}
FLOW = {"scene": "convection", "quantity": "velocity"}
#: N ln N from 1e3 to 1e6: ln(1e6)/ln(1e3) = 2 over three decades
N_LN_N = round(1 + np.log10(2)/3, 3)
REACHED = 'reached == "yes"'    # runs on both sides of the level


def seconds(method: str, where: dict[str, str]) -> Value:
    """CPU seconds to an error of 1 %; the upper half of the interval is the wider one."""
    return one("needed", "cpu_s", REACHED, err="high - cpu_s", method=method, level=0.01, **where)


def points(method: str) -> Value:
    """Points for an error of 1 % in K, between resolutions by power laws."""
    return one("needed", "points", REACHED, err="0", method=method, level=0.01, **K)


def growth(method: str) -> Value:
    """Exponent of the seconds of a step over the number of particles, up to a million (to one digit)."""
    return one("growth_laws", "value", "most >= 0.95e6", method=method, what="exponent")


COST = {"by": "cpu_s", "err": "high - cpu_s", "level": 0.01}
CHEAPEST = first("needed", "cpu_s", REACHED, method=FIXED, **COST, **K)
STAGGERED = first("needed", "cpu_s", REACHED, **COST, method=(MAC, PYPDE), **VORTEX)
#: of convection by LAMMPS and ours, in one run
TIMED: dict[str, Any] = {"scene": "time", "quantity": "seconds", "err": "err"}
OUTSIDE: dict[str, Any] = {"source": "KHP95 Sec. VII"}
ASKED = "asked for before it had been raced"
POINTS = "points that move with their triangulation"


def carried(name: str, where: dict[str, str], rival: Value, at_most: float, words: str,
            after: str = "") -> Claim:
    """Of points that move with their triangulation."""
    return Claim(id=f"own-speed-carried-{name}", source="RR98 Sec. III", at_most=at_most, because=ASKED,
                 after=after, value=seconds(CARRIED, where)/rival,
                 statement=f"{POINTS} cost at most {words}: CPU seconds for 1 % in {where['quantity']} of "
                           f"{where['scene']} over theirs, each at its own longest step")


def two(name: str, method: str, at_least: float, because: str, words: str, printed: str = "") -> Claim:
    """How much faster two threads are than one, at the largest number of particles."""
    most = {"by": "most", "method": method, "what": "two threads"}
    return Claim(id=f"{'khp95' if printed else 'own'}-speed-threads-{name}", source="KHP95 Sec. I",
                 at_least=at_least, because=because, printed=printed,
                 value=last("growth_laws", "value", "most >= 1e5", **most),
                 statement=f"{words} are easily computed in parallel: time that passes with one thread over "
                           "that with two, at the largest number of particles")


CLAIMS = (
    carried("k", K, seconds(GRID, K), 1, "the seconds of the compressible grid"),
    carried("5000", LOWER_K, seconds(GRID, LOWER_K), 1, "the seconds of the compressible grid"),
    carried("velocity", FLOW, seconds(GRID, FLOW), 4, "four times the seconds of the compressible grid",
            "three seeds with 24 rows had left it open, twelve more were asked for; then 5.1(6) had been "
            "seen with rolls placed by a phase that is noisy on points that move"),
    carried("vortex", VORTEX, STAGGERED, 1.5, "one and a half times the seconds of staggered grids, at rest"),
    Claim(id="own-speed-carried-step", source="RR98 Sec. III", at_most=200, because=ASKED,
          value=one("growth", "1e9*step_s/points", "20000 <= points <= 21000 and threads == 1",
                    err="1e9*step_s_err/points", method=CARRIED),
          statement=f"a step of {POINTS} takes at most 200 ns a point at 20 000 points, flips and geometry "
                    "included [ns]"),
    two("carried", CARRIED, 1.6, ASKED, POINTS),
    Claim(id="own-speed-spectral", source="KHP95 Sec. VII", at_most=10,
          because="within seconds was asked for before it was raced; ten are the most that go by that name",
          value=first("points", "cpu_s", "error <= 1e-6", by="cpu_s", method="spectral-gas", **K),
          statement="the spectral method gives six digits of the gas within seconds: CPU seconds to an error "
                    "of 1e-6 in K at Ra 10 000"),
    Claim(id="own-speed-carried-memory", source="RR98 Sec. III", at_most=1, because=ASKED,
          value=one("memory", "resident/1e9", "points >= 1e6", err="0", method=CARRIED),
          after="1.003 had been seen in a process that also loads py-pde and what draws figures",
          statement=f"a million {POINTS} need less than 1 GB: resident size of their process in a step [GB]"),
    Claim(id="own-speed-fixed-points", source="RR98 Sec. III", at_most=2,
          value=CHEAPEST/seconds(GRID, K), because="a factor of 2 was asked for before anything was measured",
          statement="fixed points are no dearer than a grid: CPU seconds, setting up included, to the "
                    "steady state of Rayleigh-Benard at Ra 10 000 with 1 % in K, the cheapest fixed "
                    "points' over the compressible grid's"),
    Claim(id="own-speed-lammps", **OUTSIDE, at_most=1, because="no dearer", evidence="bench/lammps.csv",
          value=bench(largest_per("rows", one("lammps", "value", **TIMED, style="spam-corrected")
                                  / least("lammps", "value", **TIMED, style=tuple(LAMMPS)))),
          after="nanoseconds of sums and seconds of scenes had been seen",
          statement="smooth particles with corrected sums are no dearer than LAMMPS: CPU seconds of 90 "
                    "free-fall times of convection over those of its cheaper style, with steps at which its "
                    "vortex has converged, at the same rows, largest ratio of all rows"),
    Claim(id="own-speed-lammps-rheo", **OUTSIDE, at_most=0.01, evidence="cost/work_precision.png",
          value=one("points", "error", method=LAMMPS["rheo"], resolution=50),
          because="asked for before that run; with 16, 25, 35 rows it was 21, 7, 1.2 %",
          statement="LAMMPS' RHEO comes to 1 % in K of a Boussinesq fluid at Ra 10 000 with 50 rows: "
                    "relative error"),
    Claim(id="own-speed-moving-points", source="RR98 Sec. III", at_most=10, because="an order of magnitude",
          value=seconds(MOVING, K)/seconds(GRID, K),
          statement="points that move and exchange over closed faces cost less than ten grids: CPU seconds "
                    "for 1 % in K over those of the compressible grid"),
    Claim(id="khp95-speed-particles", source="KHP95 Sec. VII", printed="economically desirable", at_most=1,
          headline=True, evidence="cost/work_precision.png",
          value=one("rivals", "seconds", **K), because="as cheap as the grid that the paper compares with",
          statement="smooth particles are economical: CPU seconds of the printed scheme, at its least "
                    "error in K at Ra 10 000, over those of the compressible grid with that error (the "
                    "coarsest one if it is better)"),
    Claim(id="khp95-speed-freedoms", source="KHP95 Sec. VII", printed="many fewer degrees of freedom",
          value=first("rivals", "points", by="points"), at_most=0.5, because="half at most: many fewer",
          statement="in some cases particles need many fewer degrees of freedom than equally accurate "
                    "grids: particles of the printed scheme over points of a grid with the same error, "
                    "least ratio over all scenes"),
    *(Claim(id=f"{whose}-speed-growth-{name}", source=source, printed=printed, at_most=N_LN_N,
            value=growth(method),
            because="N ln N over three decades has the exponent 1 + log10(2)/3 = 1.100",
            statement=f"a step{of} takes a time no worse than N ln N: exponent of its CPU seconds over a "
                      f"thousand to a million {who}")
      for whose, name, method, source, printed, of, who in (
          ("khp95", "spam", LUCY, "KHP95 Sec. II", "N ln N", "", "smooth particles, lists included"),
          ("own", "carried", CARRIED, "RR98 Sec. III", "", " with flips", POINTS))),
    two("spam", LUCY, 1.7, "85 % of what two cores can give", "smooth particles", printed="straightforward"),
    #: RR98's r0, the rms width of Lucy's weight, is 1.27 spacings for h = 3
    Claim(id="rr98-speed-points-wide", source="RR98 Sec. IV", printed="more particles than points in a grid",
          at_least=1, value=points(WIDE)/points(GRID), because="as many",
          statement="one needs more particles than points in a grid, for Eq. 45: points of a lattice with "
                    "h = 3 a, r0 = 1.27 a above the spacing, over those of the compressible grid, each with "
                    "1 % error in K of Rayleigh-Benard at Ra 10 000"),
)
