"""Claims about the grid's solutions    [KHP95, Sec. V]"""
from math import sqrt

import numpy as np
import pandas as pd

from studies.build.read import grid, largest, limit, limit_of, mean, off, ratio, rolls_of, scene, select
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.rb.claims.histories import History, histories
from studies.rb.claims.lines import against_cells, beyond, extrapolated, finest, line, read_at, straightness
from studies.rb.claims.printed import as_printed, number

DENSE: dict = {"eos": "dense"}
LONG = 20.0     # L^2/eta: "very long times"
RINGING = 2.0   # L^2/eta, after half of which what is left of the start is gone
WILD = 5e4      # "higher values" of Ra begin here
FLUCTUATES = 1e-3
PYPDE: dict = {**grid(1e4, variant="staggered"), "method": "pypde-compressible"}
CELLS = 5000    # of the largest grid that is named, 50 x 100
LAST_DIGIT = 5e-6   # half of it, of the printed K


def steady_by_5000(tables: Tables) -> Measured:
    """|K(0.8)/K(end) - 1| of the approach at Ra 10 000 on the finest grid, t in L^2/eta, end at 0.9 or later."""
    found = select(tables, "history", method="compressible", variant="flux-form", **scene(1e4))
    found = found[found["resolution"] == found["resolution"].max()].sort_values("t_viscous")
    t, ke = (found[name].to_numpy(float) for name in ("t_viscous", "ke"))
    if t[-1] < 0.89:
        raise CannotTell(f"the grid's approach was run until {t[-1]:.2f} L^2/eta only: SIZE=paper goes on to 0.9")
    return Measured(abs(float(np.interp(0.8, t, ke))/ke[-1] - 1), 0.0)


def grid_error(tables: Tables) -> Measured:
    """|K/K_limit - 1| at Ra 10 000 on the finest grid of 1800 (30 x 60) to 5000 cells."""
    return off(ratio(finest(tables, 1e4, (1800, 5000))[0], limit(tables, 1e4)))


def two_solvers(tables: Tables) -> Measured:
    """Distance between limits of K at Ra 10 000: from grids of 5000 cells at most, and py-pde's, another discretisation."""
    mine, other = extrapolated(tables, 1e4, CELLS), mean(tables, PYPDE)
    return Measured(abs(mine.value - other.value), mine.err + other.err)


def leak(tables: Tables) -> Measured:
    """Relative drift of mass per L^2/eta with ghost density 1, at Ra 10 000 on the worst grid."""
    frame = finished(tables, variant="paper-form", **scene(1e4))
    diffusion_times = frame["t_end"]/(50*sqrt(1e4))  # L^2/eta = L sqrt(Ra) in a box 50 high
    return Measured(float((frame["mass_drift"].abs()/diffusion_times).max()), 0.0)


def paper_form(tables: Tables) -> Measured:
    """|K/K_flux - 1| at Ra 10 000 of the paper's form of continuity over the flux form, worst grid."""
    paper, flux = ({k: v for k, v in grid(1e4, variant=name).items() if k != "resolution"}
                   for name in ("paper-form", "flux-form"))
    shared = set(select(tables, "means", **paper)["resolution"]) & set(select(tables, "means", **flux)["resolution"])
    if not (heights := sorted(filter(np.isfinite, shared))):
        raise CannotTell("paper-form and flux-form were run on different grids only")
    return largest([off(ratio(mean(tables, grid(1e4, height, "paper-form")), mean(tables, grid(1e4, height))))
                    for height in heights])


def finished(tables: Tables, **where) -> pd.DataFrame:
    """Rows of `kinetic_energy` of compressible grids that did not diverge.

    Raises
    ------
    CannotTell
        All did.
    """
    frame = select(tables, "kinetic_energy", method="compressible", **where)
    left = frame[frame["ke"].notna()]
    if left.empty:
        raise CannotTell(f"all {len(frame)} runs of the grid diverged, the last at t = {frame['t_end'].max():.0f}")
    return left


def scatters(tables: Tables, height: float) -> dict[tuple, float]:
    """Relative standard deviation of K(t) in the last half of runs at Ra 50 000 or more, by scene.

    Runs are 2 L^2/eta or longer: shorter ones still ring from their start.
    """
    frame = select(tables, "history", method="compressible", variant="flux-form", resolution=float(height), eos="ideal")
    longest = frame.groupby(["ra", "transport", "sides"])["t_viscous"].transform("max")
    wild = frame[(frame["ra"] >= WILD) & (longest >= RINGING)]
    if wild.empty:
        raise CannotTell(f"the K(t) of {height} rows was not run at Ra {WILD:g} or more over {RINGING:g} L^2/eta: "
                         f"it ends at Ra {frame['ra'].max():g} and {frame['t_viscous'].max():.2g} L^2/eta")
    return {where: History(group["t"].to_numpy(float), group["ke"].to_numpy(float)).scatter
            for where, group in wild.sort_values("t").groupby(["ra", "transport", "sides"])}


def refined(tables: Tables) -> Measured:
    """Scatter on 100 rows over that on 50 rows, in the scene of both that fluctuates most on 50."""
    coarse, fine = scatters(tables, 50), scatters(tables, 100)
    if not (both := coarse.keys() & fine.keys()):
        raise CannotTell("50 and 100 rows were run at different Rayleigh numbers only")
    worst = max(both, key=lambda where: coarse[where])
    if coarse[worst] < FLUCTUATES:
        raise CannotTell(f"K scatters by {coarse[worst]:.1g} on 50 rows: nothing fluctuates that a finer grid could calm")
    return Measured(fine[worst]/coarse[worst], 0.0)


def drift(tables: Tables) -> Measured:
    """Relative change of K of the dense fluid at Ra 3000 over the last quarter of a very long run."""
    frame = select(tables, "history", method="compressible", variant="flux-form", **scene(3000, **DENSE))
    if frame["t_viscous"].max() < LONG:
        raise CannotTell(f"the dense fluid was run until {frame['t_viscous'].max():.1f} L^2/eta only, not {LONG:g}")
    found = max(run.drift for run in histories(tables, grid_of(frame)))
    if found < DRIFTS:
        raise CannotTell(f'"some of our attempts" diverged: that one run does not (change of K {found:.2g}) is no proof')
    return Measured(found, 0.0)


def grid_of(frame) -> dict:
    """The point of the finest grid in a frame of `history`."""
    row = frame.sort_values("resolution").iloc[-1]
    return {name: row[name] for name in ("method", "variant", "eos", "transport", "sides", "ra", "pr", "resolution")}


LAST = "half of the last printed digit"
DRIFTS = 1e-3       # change of K that is more than what steady runs leave
ALMOST = ('"almost exactly" has no number: 1 %, what Sec. VI says that the fluctuations disguise of the particles which the '
          "line is there to be compared with")
CLAIMS = (
    Claim(id="khp95-ke-5000", source="KHP95 Sec. VI", printed="0.003 40",
          statement="K of the infinitely fine grid, ideal gas, Ra 5000, constant eta", value=limit_of(5000),
          **as_printed("ke-5000"), because=LAST),
    Claim(id="khp95-ke-5000-const-nu", source="KHP95 Sec. VI", printed="0.003 40",
          statement="K of the infinitely fine grid, ideal gas, Ra 5000, read as constant nu (which one is not said)",
          value=limit_of(5000, transport="const-nu"), **as_printed("ke-5000"), because=LAST),
    Claim(id="khp95-ke-10000", source="KHP95 Sec. VI", printed="0.004 81",
          statement="K of the infinitely fine grid, ideal gas, Ra 10 000, constant eta", value=limit_of(10000),
          **as_printed("ke-10000"), because=LAST),
    Claim(id="khp95-ke-10000-const-nu", source="KHP95 Sec. VI", printed="0.004 81",
          statement="K of the infinitely fine grid, ideal gas, Ra 10 000, read as constant nu (which one is not said)",
          value=limit_of(10000, transport="const-nu"), **as_printed("ke-10000"), because=LAST),
    Claim(id="khp95-ke-10000-line", source="KHP95 Secs V, VI", printed="0.004 81",
          statement="0.004 81 is what the straight line in Ra^-1/2 through 1.2 to 4 times onset gives at Ra 10 000",
          value=read_at(1e4), **as_printed("ke-10000"), because=LAST),
    Claim(id="khp95-ke-line-digits", source="KHP95 Secs V, VI",
          statement="K is linear in Ra^-1/2 from onset to four times onset as far as its digits are printed, ideal gas, "
                    "constant eta: largest distance", value=lambda tables: line(tables).bend, at_most=LAST_DIGIT,
          because=f"{LAST} of K: what is linear almost exactly is so in all three"),
    Claim(id="khp95-ke-line", source="KHP95 Sec. V, Fig. 5", printed="almost exactly linearly",
          statement="K is linear in Ra^-1/2 from onset to four times onset, ideal gas, constant eta: largest distance "
                    "over K(4 Ra_c)", value=straightness(), at_most=0.01, because=ALMOST),
    Claim(id="khp95-ke-line-const-nu", source="KHP95 Sec. V, Fig. 5", printed="almost exactly linearly",
          statement="K is linear in Ra^-1/2 from onset to four times onset, ideal gas, constant nu: largest distance "
                    "over K(4 Ra_c)", value=straightness(transport="const-nu"), at_most=0.01, because=ALMOST),
    Claim(id="khp95-vdw-panel", source="KHP95 Sec. V, Fig. 5", printed="almost exactly linearly",
          statement="K is linear in Ra^-1/2 from onset to four times onset, van der Waals: largest distance over K(4 "
                    "Ra_c)", value=straightness(eos="vdw"), at_most=0.01, because=ALMOST),
    Claim(id="khp95-ke-line-square", source="KHP95 Sec. V, Fig. 6", printed="almost exactly linearly",
          statement="K is linear in Ra^-1/2 from onset, 5012, to four times onset in the square, one roll: largest "
                    "distance over K(4 Ra_c)", value=straightness(sides="walls"), at_most=0.01, because=ALMOST),
    Claim(id="khp95-ke-line-beyond", source="KHP95 Secs V, VI", printed="to four times that value",
          statement="the line may be read at Ra 10 000 = 5.9 times onset: K over the line, less 1", value=beyond,
          expect=0, within=LAST_DIGIT/number("ke-10000"), because=f"{LAST} of K at Ra 10 000"),
    Claim(id="khp95-slopes-l2", source="KHP95 Sec. V", printed="almost exactly linearly with L^-2",
          statement="slopes of the lines are linear in L^-2: largest distance over the whole change",
          value=against_cells("slope"), at_most=0.05,
          because="the next term, L^-4, is 0.1 % of the first at 30 rows, times a factor that may be tens at thin "
                  "layers"),
    Claim(id="khp95-intercepts-l2", source="KHP95 Sec. V", printed="almost exactly linearly with L^-2",
          statement="intercepts of the lines are linear in L^-2: largest distance over the whole change",
          value=against_cells("intercept"), at_most=0.05,
          because="the next term, L^-4, is 0.1 % of the first at 30 rows, times a factor that may be tens at thin "
                  "layers"),
    Claim(id="khp95-ghost-density-mass", source="KHP95 Sec. V", printed="unity", at_most=1e-3,
          statement="density 1 outside of the system is no trouble: mass lost per L^2/eta", value=leak,
          because="no trouble is less than the last printed digit of K, near onset after some time of 10 L^2/eta"),
    Claim(id="khp95-ghost-density-energy", source="KHP95 Sec. V", printed="unity", at_most=1e-3,
          statement="density 1 outside of the system is no trouble: K against the conservative form on the same grid",
          value=paper_form, because="half of the last printed digit of 0.004 81"),
    Claim(id="khp95-grid-converged", source="KHP95 Sec. V", printed="several thousand cells",
          statement="several thousand cells are fully converged by themselves: error of K at Ra 10 000 on the finest "
                    "grid of 1800 (30 x 60) to 5000", value=grid_error, at_most=LAST_DIGIT/number("ke-10000"),
          because=f"{LAST} of K: fully converged, all of them are right"),
    Claim(id="khp95-grid-cells", source="KHP95 Secs V, VI", printed="several thousand cells", at_most=LAST_DIGIT,
          statement="grids of 5000 cells at most, extrapolated in L^-2, give K at Ra 10 000 fully converged: distance "
                    "between this limit and that of another solver, py-pde", value=two_solvers,
          because=f"{LAST} of K; 50 x 100 is the largest grid that is named"),
    Claim(id="khp95-grid-fluctuates", source="KHP95 Sec. VI", printed="begin to fluctuate", at_least=FLUCTUATES,
          statement="K of centred differences on 50 rows fluctuates at Ra of 50 000 or more",
          value=lambda tables: Measured(max(scatters(tables, 50).values()), 0.0),
          because="steady runs leave less than 1e-5"),
    Claim(id="khp95-fluctuate-physical", source="KHP95 Sec. VI", printed="more sophisticated techniques", at_most=0.25,
          statement="fluctuations at Ra of 50 000 or more are of the grid, not of the flow: scatter on 100 rows over "
                    "that on 50 rows", value=refined,
          because="second order; if it stays, it is the flow"),
    Claim(id="khp95-transient-grid", source="KHP95 Fig. 8", printed="two rolls",
          statement="the printed initial rolls lead to a steady state of two rolls at Ra 10 000",
          value=rolls_of(grid(1e4)), **as_printed("fig8-rolls"), because="a whole number"),
    Claim(id="khp95-fig9-time", source="KHP95 Figs 8, 9, 12", printed="5000", at_most=0.01,
          statement="the flow at Ra 10 000 is steady by t = 5000: change of K from 4000 on", value=steady_by_5000,
          because="no number is printed: 1 %, the size of the fluctuations of particles"),
    Claim(id="khp95-heat-transport", source="KHP95 Sec. IV", printed="more efficiently", at_least=1,
          statement="convection carries heat better than conduction alone: Nusselt number at Ra 10 000",
          value=limit_of(1e4, "nu"), because="conduction alone is 1"),
    Claim(id="khp95-dense-divergence", source="KHP95 Sec. IV", printed="slow divergence", at_least=DRIFTS,
          statement="grid runs of the dense fluid slowly diverge at very long times: change of K over a quarter of 20 "
                    "L^2/eta", value=drift,
          because="steady runs leave less than 1e-5"),
)
