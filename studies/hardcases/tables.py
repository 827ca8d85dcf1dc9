"""Tables of the study. Lengths in spacings, masses of particles or points; `_err` 95 % half widths."""
from studies.kit.table import Table

TUBE = "method eta step L seed"

MEAN_FLOW = ("K of the flow of the last third: velocities averaged over 4 x 4 spacings", "epsilon/m")
STEP = {"step": ("step over that at the limit of stability", "")}

ALL = (
    Table.of("squares", "eos weight ra seed", "alpha rolls begun flow ratio ratio_err shared",
             about="Particles in the square box of KHP95's Fig. 10 at the end.",
             means={"flow": ("K of the mean flow", "epsilon/m"),
                    "ratio": ("median of second over first neighbour distance", "")}),
    Table.of("method_tubes", TUBE, "rho_exact v_exact P_exact rho_grid v_grid P_grid wiggles reached",
             means=STEP, about="Sod's shock tube by one method, at the end."),
    Table.of("method_tube_profiles", f"{TUBE} x", "rho v P", large=True,
             digits=dict.fromkeys(("x", "rho", "v", "P"), ".5g"), about="A place of such a tube.",
             means=STEP | {"x": ("distance from the diaphragm", "L")}),
    Table.of("ripples", "scale steep seed time", "height amplitude",
             about="An instant of an interface that a shock runs over [KHP95, Fig. 11]."),
    Table.of("ripple_growth", "scale steep", "seeds growth growth_err",
             about="The growth of such ripples, means over seeds.",
             means={"growth": ("growth rate over that of theory", "")}),
    Table.of("high_ra_grid", "ra rows", "k cell_number reached",
             about="A run of the fine grid at high Ra.",
             means={"cell_number": ("cell number v a/nu of the fastest flow at the end, a of 16 rows", "")}),
    Table.of("high_ra_trials", "method step seed ra", "k over reached",
             about="A run of the search for the highest Ra."),
    Table.of("high_ra", "method step seed kind", "ra ra_err tried outcome",
             about="What a search found.",
             means={"kind": ("wrong: K is, or the run ended; ends: the run ended", ""),
                    "ra": ("Ra from which on runs are so; none if they are nowhere. Its error is half of the "
                           "interval between two trials", ""),
                    "outcome": ("of the first bad run", "")}),
    Table.of("high_ra_summary", "method step kind",
             "predicted ra ra_low ra_high seeds outcome cell_number cell_number_err",
             about="The same over seeds, means of logarithms.",
             means={"predicted": ("Ra where the cell number of the fastest flow is 2", ""),
                    "kind": ("wrong or ends", ""), "ra": ("Ra from which on runs are so", ""),
                    "outcome": ("what most runs do there", ""),
                    "cell_number": ("cell number at that Ra, or at the highest Ra tried", "")}),
    Table.of("limits", "method scene", "eta k predicted shorter exact measured measured_err",
             about="The largest stable step of a method.",
             means={"k": ("conductivity", "m kB/(epsilon t0)"), "predicted": ("by the method's own "
                                                                              "formula", "t0"),
                    "exact": ("by eigenvalues of the rates of the same points", "t0"),
                    "measured": ("by trial; its error is half of the last interval and how far beyond the "
                                 "limit "
                                 "growth stays unseen", "t0")}),
    Table.of("hard_runs", "case method rows", "k flow mass_drift k_start flow_start reached refused",
             about="A hard case by one method.", means={"flow": MEAN_FLOW}),
    Table.of("shear", "method", "predicted measured measured_err reached",
             about="A wave on a shear flow by one method.", means={"measured": ("growth rate", "1/t0")}),
    Table.of("steadiness", "ra rows", "swing before reached",
             about="A run of the grid at high Ra; no numbers where it diverged."),
    Table.of("map", "case method variant", "number predicted measured measured_err outcome",
             about="The verdict on a method in a hard case.",
             means={"variant": ("which runs of the case", ""),
                    "outcome": ("by the rules at the head of studies/hardcases/derive.py", "")}),
)
