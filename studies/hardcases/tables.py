"""Tables of the study. Lengths in spacings, masses of particles or points; `_err` 95 % half widths."""
from studies.hardcases.sod import ERRORS, NAMES
from studies.kit.table import Table

#: squares of Fig. 10: expansivity at mid-height; rolls; K at the start, of particles and of the mean flow; at
#: the end the median of second over first neighbour distance, and the part that shares a site
SQUARES = Table("squares", key=["eos", "weight", "ra", "seed"],
                columns=["eos",
                "weight", "ra", "seed", "eta", "alpha", "rolls", "begun", "ke", "flow", "ratio", "ratio_err",
                         "shared"])

TUBE = ["L", "eta", "seed"]
#: mean |error| over the range of the exact solution, against it and against the viscous grid; variation of v
#: beyond that of the exact one; overlap of both gases; rms v across the tube over the contact's v; time over
#: L at which it diverged
TUBES = Table("tubes", key=TUBE, columns=[*TUBE, *ERRORS, "wiggles", "overlap", "noise", "diverged"])
#: x: from the diaphragm, over L
TUBE_PROFILES = Table("tube_profiles", key=[*TUBE, "x"],
                      columns=[*TUBE, "x",
                      *(f"{name}{of}" for of in ("", "_exact", "_grid") for name in NAMES)])
METHOD_TUBE = ["method", "eta", "step", "L", "seed"]
#: the same of other methods; reached: part of the time
METHOD_TUBES = Table("method_tubes",
                     key=METHOD_TUBE, columns=[*METHOD_TUBE, *ERRORS, "wiggles", "noise", "reached"])
METHOD_PROFILES = Table("method_tube_profiles", key=[*METHOD_TUBE, "x"], columns=[*METHOD_TUBE, "x", *NAMES],
                        digits=dict.fromkeys(("x", *NAMES), ".5g"), once=METHOD_TUBE)

RIPPLE = ["scale", "steep"]
#: mean height and amplitude of the interface, nothing where a run diverged; lengths over the printed ones, k
#: a before the shock
RIPPLES = Table("ripples",
                key=[*RIPPLE, "seed", "time"], columns=[*RIPPLE, "seed", "time", "height", "amplitude"])
#: velocity given to the interface, amplitude behind the shock and its growth rate, over those of theory
RIPPLE_GROWTH = Table("ripple_growth", key=RIPPLE, columns=[*RIPPLE, "seeds", "kick", "kick_err", "amplitude",
                                                            "amplitude_err", "growth", "growth_err"])

#: K of the last third and cell number v a/nu of the fastest flow at the end, a of 16 rows; reached: part of
#: the time
REFERENCE = Table("high_ra_grid", key=["ra", "rows"], columns=["ra", "rows", "k", "cell_number", "reached"])
#: every run of a search: K of its last third, over that of the fine grid where this is known
TRIALS = Table("high_ra_trials", key=["method", "step", "seed", "ra"],
               columns=["method", "step", "seed", "ra", "k", "over", "reached"])
#: Ra from which on runs are wrong (K, or they ended), and end; half of the interval between two trials; none
#: is up to `tried` if there is no such Ra; again: trials beyond it that are not bad, as where islands end;
#: outcome: of the first bad one
HIGHEST = Table("high_ra", key=["method", "step", "seed", "kind"],
                columns=["method", "step", "seed", "kind", "ra", "ra_err", "tried", "again", "outcome"])
#: means over seeds, of logarithms; predicted: where the cell number of the fastest flow is 2; outcome: wrong
#: but stable, or ends; cell_number: of the fastest flow at the limit, or at the highest Ra that was tried
SUMMARY = Table("high_ra_summary", key=["method", "step", "kind"],
                columns=["method", "step", "kind", "predicted", "ra", "ra_low", "ra_high", "seeds", "outcome",
                         "cell_number", "cell_number_err"])

#: largest stable steps in units of spacing over (P/rho)^(1/2). predicted : by the method's own formula,
#: smaller by `margin` for disorder; shorter : of the steps that sound alone and diffusion alone allow; exact
#: : by eigenvalues of the rates of the same points; measured : by trial. measured_err : half of the last
#: interval of the search, and how far beyond the limit growth stays unseen in so many steps
LIMITS = Table("limits",
               key=["method",
               "scene"], columns=["method", "scene", "eta", "k", "integrator", "predicted", "margin",
                                                           "shorter", "exact", "measured", "measured_err"])

#: K and K of the flow (velocities averaged over 4 x 4 spacings), means of the last third; mass at the end
#: over that of the start less 1; reached: part of the time; refused: why a method does not take the case;
#: rows: over the height
RUNS = Table("hard_runs", key=["case", "method", "rows"],
             columns=["case",
             "method", "rows", "k", "flow", "mass_drift", "k_start", "flow_start", "reached", "refused"])
#: growth rates of the wave on a shear flow; reached: part of the time
SHEAR = Table("shear", key=["method"], columns=["method", "predicted", "measured", "measured_err", "reached"])
#: the grid at high Ra: mean K, and largest less smallest K over the mean in the last quarter of the time and
#: in the one before; reached: part of the time, where it diverges
STEADINESS = Table("steadiness",
                   key=["ra", "rows"], columns=["ra", "rows", "k", "swing", "before", "rolls", "reached"])
#: outcome by the rules of `derive`; number: the name of what is predicted and measured
MAP = Table("map", key=["case", "method", "variant"],
            columns=["case", "method", "variant",
            "number", "predicted", "measured", "measured_err", "outcome"])

ALL = (SQUARES, TUBES, TUBE_PROFILES, METHOD_TUBES, METHOD_PROFILES, RIPPLES, RIPPLE_GROWTH, REFERENCE, TRIALS, HIGHEST,
       SUMMARY, LIMITS, RUNS, SHEAR, STEADINESS, MAP)
