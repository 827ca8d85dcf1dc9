"""Tables of KHP95's hard cases. Lengths in spacings, masses of particles, T = 1 or as said; `_err` 95 % half widths."""
from studies.kit.table import Table

#: shear over bulk modulus: by lattice sums, and by the compiled sums of particles (ranges to 6); lattice "diagonal": sheared at
#: 45 degrees
MODULI = Table("moduli", key=["lattice", "weight", "h"], columns=["lattice", "weight", "h", "exact", "measured"])
#: order: -d ln(rms modulus over one period)/d ln h
MODULUS_ORDERS = Table("modulus_orders", key=["lattice", "weight"], columns=["lattice", "weight", "order", "order_err"])

CRYSTAL = ["lattice", "weight", "h", "eos", "T", "rho"]
#: rate of the fastest growing motion: by lattice sums, and measured
GROWTH = Table("growth", key=CRYSTAL, columns=[*CRYSTAL, "predicted", "measured", "measured_err"])
#: value of a parameter (h or T, its own column is then 0) at which motions begin to grow
ONSETS = Table("onsets", key=[*CRYSTAL, "parameter", "seed"],
               columns=[*CRYSTAL, "parameter", "seed", "predicted", "measured", "measured_err"])
#: particles a site: of least energy, and the median of runs; shared: part of the particles that share a site, chance: the part of
#: particles at random that would; ratio: median of second over first neighbour distance
FATES = Table("fates", key=["weight", "h", "seed"],
              columns=["weight", "h", "seed", "predicted", "sites", "shared", "ratio", "chance"])

#: squares of Fig. 10: expansivity at mid-height; rolls; K at the start, of particles and of the mean flow; at the end the median
#: of second over first neighbour distance, and the part that shares a site
SQUARES = Table("squares", key=["eos", "weight", "ra", "seed"],
                columns=["eos", "weight", "ra", "seed", "eta", "alpha", "rolls", "begun", "ke", "flow", "ratio", "ratio_err",
                         "shared"])

#: step: over that of other studies
LAYER = ["eos", "weight", "ra", "seed", "step"]
#: K of the mean flow and of the particles over that of the grid's smoothed field, fluctuation of distances of neighbours over
#: their mean, at pressures P; nothing where a run diverged
FREEZING = Table("freezing", key=[*LAYER, "P"],
                 columns=[*LAYER, "P", "flow", "flow_err", "kp", "kp_err", "lindemann"])
#: particles of four layers y (over L) at the end of these runs: T, part that comes less far than half a spacing in two free-fall
#: times, fluctuation of distances of neighbours, K over that of the grid's smoothed field
FREEZING_LAYERS = Table("freezing_layers", key=[*LAYER, "P", "y"], columns=[*LAYER, "P", "y", "T", "stuck", "lindemann", "kp"])
#: P at which K of the mean flow falls below a tenth; K of the grid, and P at which 2 K is 2 P w(0), 2 P [w(0.9) - w(1)]
FREEZING_LIMITS = Table("freezing_limits", key=LAYER, columns=[*LAYER, "measured", "measured_err", "K", "barrier", "melting"])

#: rms distance of places of the same path by smooth particles and as molecules
TWINS = Table("twins", key=["weight", "seed", "time"], columns=["weight", "seed", "time", "apart"])
#: rms distance from the start, and part of the coordinates that are it to the last bit, after so much time there and back
REVERSAL = Table("reversal", key=["integrator", "weight", "seed", "time"],
                 columns=["integrator", "weight", "seed", "time", "apart", "equal"])
#: rate at which twins part; time to a tenth of a spacing of leapfrog there and back: by that rate from round-off, and measured
RETURNS = Table("returns", key=["weight", "seed"], columns=["weight", "seed", "rate", "rate_err", "predicted", "measured"])

TUBE = ["L", "eta", "seed"]
ERRORS = [f"{name}_{of}" for of in ("exact", "grid") for name in ("rho", "v", "P")]
#: mean |error| over the range of the exact solution, against it and against the viscous grid; variation of v beyond that of the
#: exact one; overlap of both gases, spacings; rms v across the tube over the contact's v; time over L at which it diverged
TUBES = Table("tubes", key=TUBE, columns=[*TUBE, *ERRORS, "wiggles", "overlap", "noise", "diverged"])
#: x: from the diaphragm, over L
TUBE_PROFILES = Table("tube_profiles", key=[*TUBE, "x"],
                      columns=[*TUBE, "x", *(f"{name}{of}" for of in ("", "_exact", "_grid") for name in ("rho", "v", "P"))])
#: order: -d ln error/d ln L
TUBE_ORDERS = Table("tube_orders", key=["eta", "quantity"], columns=["eta", "quantity", "order", "order_err"])

RIPPLE = ["scale", "steep"]
#: mean height and amplitude of the interface, spacings, nothing where a run diverged; lengths over the printed ones, k a before
#: the shock
RIPPLES = Table("ripples", key=[*RIPPLE, "seed", "time"], columns=[*RIPPLE, "seed", "time", "height", "amplitude"])
#: velocity given to the interface, amplitude behind the shock and its growth rate, over those of theory
RIPPLE_GROWTH = Table("ripple_growth", key=RIPPLE, columns=[*RIPPLE, "seeds", "kick", "kick_err", "amplitude", "amplitude_err",
                                                            "growth", "growth_err"])

ALL = (MODULI, MODULUS_ORDERS, GROWTH, ONSETS, FATES, SQUARES, FREEZING, FREEZING_LAYERS, FREEZING_LIMITS, TWINS, REVERSAL,
       RETURNS, TUBES, TUBE_PROFILES, TUBE_ORDERS, RIPPLES, RIPPLE_GROWTH)
