"""Claims about the grid's solutions    [KHP95, Sec. V]"""
from math import sqrt

import numpy as np

from studies.convection.claims.histories import History, histories
from studies.convection.claims.lines import against_cells, beyond, cells_for, finest, read_at, straightness
from studies.convection.claims.printed import as_printed
from studies.convection.claims.read import Value, grid, largest, limit, limit_of, mean, off, ratio, scene, select
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables

DENSE: dict = {"eos": "dense"}
LONG = 20.0     # L^2/eta: "very long times"
RINGING = 2.0   # L^2/eta, after half of which what is left of the start is gone
WILD = 5e4      # "higher values" of Ra begin here


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


def leak(tables: Tables) -> Measured:
    """Relative drift of mass per L^2/eta with ghost density 1, at Ra 10 000 on the worst grid."""
    frame = select(tables, "kinetic_energy", method="compressible", variant="paper-form", **scene(1e4))
    diffusion_times = frame["t_end"]/(50*sqrt(1e4))  # L^2/eta = L sqrt(Ra) in a box 50 high
    return Measured(float((frame["mass_drift"].abs()/diffusion_times).max()), 0.0)


def paper_form(tables: Tables) -> Measured:
    """|K/K_flux - 1| at Ra 10 000 of the paper's form of continuity over the flux form, worst grid."""
    frame = select(tables, "means", method="compressible", variant="paper-form", **scene(1e4))
    heights = frame["resolution"][np.isfinite(frame["resolution"])]
    return largest([off(ratio(mean(tables, grid(1e4, height, "paper-form")), mean(tables, grid(1e4, height))))
                    for height in heights])


def scatter(tables: Tables, height: float) -> Measured:
    """Relative standard deviation of K(t) in the last half of runs at Ra 50 000 or more, the largest.

    Runs are 2 L^2/eta or longer: shorter ones still ring from their start.
    """
    frame = select(tables, "history", method="compressible", variant="flux-form", resolution=height, eos="ideal")
    longest = frame.groupby(["ra", "transport", "sides"])["t_viscous"].transform("max")
    wild = frame[(frame["ra"] >= WILD) & (longest >= RINGING)]
    if wild.empty:
        raise CannotTell(f"the grid's K(t) was not run at Ra {WILD:g} or more over {RINGING:g} L^2/eta: SIZE=fine may")
    runs = [History(group["t"].to_numpy(float), group["ke"].to_numpy(float))
            for _, group in wild.sort_values("t").groupby(["ra", "transport", "sides"])]
    return Measured(max(run.scatter for run in runs), 0.0)


def drift(tables: Tables) -> Measured:
    """Relative change of K of the dense fluid at Ra 3000 over the last quarter of a very long run."""
    frame = select(tables, "history", method="compressible", variant="flux-form", **scene(3000, **DENSE))
    if frame["t_viscous"].max() < LONG:
        raise CannotTell(f"the dense fluid was run until {frame['t_viscous'].max():.1f} L^2/eta only, not {LONG:g}")
    return Measured(max(run.drift for run in histories(tables, grid_of(frame))), 0.0)


def grid_of(frame) -> dict:
    """The point of the finest grid in a frame of `history`."""
    row = frame.sort_values("resolution").iloc[-1]
    return {name: row[name] for name in ("method", "variant", "eos", "transport", "sides", "ra", "pr", "resolution")}


def rolls(variant: str, ra: float, **where) -> Value:
    """Rolls on the finest grid of a scene."""
    def value(tables: Tables) -> Measured:
        wanted = {k: v for k, v in grid(ra, variant=variant, **where).items() if k != "resolution"}
        frame = select(tables, "kinetic_energy", **wanted)
        frame = frame[np.isfinite(frame["resolution"])]
        return Measured(float(frame.sort_values("resolution")["rolls"].iloc[-1]), 0.0)
    return value


LAST = "half of the last printed digit"
ALMOST = '"almost exactly" has no number: 0.85 % is the bend of the converged Boussinesq solution'
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
          expect=0, within=0.005, because="three figures are printed of K at Ra 10 000; half a percent is kind"),
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
          statement="several thousand cells are fully converged: error of K on the finest grid of 1800 (30 x 60) to "
                    "5000", value=grid_error, at_most=0.01,
          because='"fully" has no number: a percent, as of the lines'),
    Claim(id="khp95-grid-cells", source="KHP95 Secs V, VI", printed="several thousand cells", at_most=5000,
          statement="several thousand cells give K at Ra 10 000 to the last printed digit: cells needed, without "
                    "extrapolation", value=cells_for(5e-6, 1e4), because="their largest named grid, 50 x 100"),
    Claim(id="khp95-grid-fluctuates", source="KHP95 Sec. VI", printed="begin to fluctuate", at_least=1e-3,
          statement="K of centred differences on 50 rows fluctuates at Ra of 50 000 or more",
          value=lambda tables: scatter(tables, 50), because="steady runs leave less than 1e-5"),
    Claim(id="khp95-fluctuate-physical", source="KHP95 Sec. VI", printed="more sophisticated techniques", at_most=0.25,
          statement="fluctuations at Ra of 50 000 or more are of the grid, not of the flow: scatter on 100 rows over "
                    "that on 50 rows", value=lambda tables: ratio(scatter(tables, 100), scatter(tables, 50)),
          because="second order; if it stays, it is the flow"),
    Claim(id="khp95-transient-grid", source="KHP95 Fig. 8", printed="two rolls",
          statement="the printed initial rolls lead to a steady state of two rolls at Ra 10 000",
          value=limit_of(1e4, "rolls"), **as_printed("fig8-rolls"), because="a whole number"),
    Claim(id="khp95-fig9-time", source="KHP95 Figs 8, 9, 12", printed="5000", at_most=0.01,
          statement="the flow at Ra 10 000 is steady by t = 5000: change of K from 4000 on", value=steady_by_5000,
          because="no number is printed: 1 %, the size of the fluctuations of particles"),
    Claim(id="khp95-heat-transport", source="KHP95 Sec. IV", printed="more efficiently", at_least=1,
          statement="convection carries heat better than conduction alone: Nusselt number at Ra 10 000",
          value=limit_of(1e4, "nu"), because="conduction alone is 1"),
    Claim(id="khp95-two-rolls-square", source="KHP95 Sec. VI, Fig. 10", printed="two rolls",
          statement="the ideal gas of Fig. 10 in the square convects with two rolls, on the grid",
          value=rolls("fig10", 67150, sides="walls"), **as_printed("fig10-rolls"), because="a whole number"),
    Claim(id="khp95-one-roll-square", source="KHP95 Sec. VI, Fig. 10", printed="one",
          statement="two rolls in the square give way to one near onset: rolls at Ra 7000 after a start with two",
          value=rolls("two-rolls", 7000, sides="walls"), expect=1, within=0, because="a whole number"),
    Claim(id="khp95-dense-divergence", source="KHP95 Sec. IV", printed="slow divergence", at_least=1e-3,
          statement="grid runs of the dense fluid slowly diverge at very long times: change of K over a quarter of 20 "
                    "L^2/eta", value=drift,
          because='steady runs leave less than 1e-5; "some attempts" diverged, so one run that does not is no proof'),
)
