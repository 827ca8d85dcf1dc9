"""Tables of the study. Lengths in spacings, masses of particles or points; `_err` 95 % half widths."""
from studies.kit.table import Table

TUBE = "method eta step L seed"

ALL = (
    #: squares of Fig. 10: expansivity at mid-height; rolls; K at the start and of the mean flow; at the end
    #: the median of second over first neighbour distance, and the part that shares a site
    Table.of("squares", "eos weight ra seed", "alpha rolls begun flow ratio ratio_err shared"),
    #: mean |error| over the range of the exact solution, against it and against the viscous grid; variation
    #: of v beyond that of the exact one; reached: part of the time
    Table.of("method_tubes", TUBE, "rho_exact v_exact P_exact rho_grid v_grid P_grid wiggles reached"),
    #: x: from the diaphragm, over L
    Table.of("method_tube_profiles", f"{TUBE} x", "rho v P", once=TUBE.split(),
             digits=dict.fromkeys(("x", "rho", "v", "P"), ".5g")),
    #: mean height and amplitude of the interface, nothing where a run diverged; lengths over the printed
    #: ones, k a before the shock
    Table.of("ripples", "scale steep seed time", "height amplitude"),
    #: growth rate over that of theory
    Table.of("ripple_growth", "scale steep", "seeds growth growth_err"),
    #: K of the last third and cell number v a/nu of the fastest flow at the end, a of 16 rows; reached: part
    #: of the time
    Table.of("high_ra_grid", "ra rows", "k cell_number reached"),
    #: every run of a search: K of its last third, over that of the fine grid where this is known
    Table.of("high_ra_trials", "method step seed ra", "k over reached"),
    #: Ra from which on runs are wrong (K, or they ended), and end; half of the interval between two trials;
    #: none is up to `tried` if there is no such Ra; outcome: of the first bad one
    Table.of("high_ra", "method step seed kind", "ra ra_err tried outcome"),
    #: means over seeds, of logarithms; predicted: where the cell number of the fastest flow is 2; outcome:
    #: wrong but stable, or ends; cell_number: of the fastest flow at the limit, or at the highest Ra tried
    Table.of("high_ra_summary", "method step kind",
             "predicted ra ra_low ra_high seeds outcome cell_number cell_number_err"),
    #: largest stable steps in units of spacing over (P/rho)^(1/2). predicted : by the method's own formula;
    #: shorter : of the steps that sound alone and diffusion alone allow; exact : by eigenvalues of the rates
    #: of the same points; measured : by trial. measured_err : half of the last interval of the search, and
    #: how far beyond the limit growth stays unseen in so many steps
    Table.of("limits", "method scene", "eta k predicted shorter exact measured measured_err"),
    #: K and K of the flow (velocities averaged over 4 x 4 spacings), means of the last third; mass at the end
    #: over that of the start less 1; reached: part of the time; refused: why a method does not take the case;
    #: rows: over the height
    Table.of("hard_runs", "case method rows", "k flow mass_drift k_start flow_start reached refused"),
    #: growth rates of the wave on a shear flow; reached: part of the time
    Table.of("shear", "method", "predicted measured measured_err reached"),
    #: the grid at high Ra: largest less smallest K over the mean in the last quarter of the time and in the
    #: one before; reached: part of the time, where it diverges
    Table.of("steadiness", "ra rows", "swing before reached"),
    #: outcome by the rules of `derive`; number: the name of what is predicted and measured
    Table.of("map", "case method variant", "number predicted measured measured_err outcome"),
)
