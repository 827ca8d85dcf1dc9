"""Tables of the study fluctuations."""
from studies.kit.table import Table

PARTNERS = Table("partners", key=["maker", "points", "d", "noise"],
                 columns=["maker", "points", "d", "noise", "mismatch", "asymmetry", "sums", "uniform", "nulls", "negative"])
WAVE = ["equation", "term", "reading", "d", "h", "wavenumber"]
PRINTED = Table("printed", key=WAVE, columns=[*WAVE, "ratio", "predicted"])
REST = Table("rest", key=["maker", "points", "d", "share", "n"],
             columns=["maker", "points", "d", "share", "n", "growth", "error", "kinetic"])
ONSET = Table("onset", key=["rows", "below"], columns=["rows", "below", "ra_c", "slowest", "velocity"])
STEPS = Table("steps", key=["integrator", "fluid", "wavenumber", "dt"],
              columns=["integrator", "fluid", "wavenumber", "dt", "velocity", "density", "error", "by_hand"])
MODE = ["points", "share", "field", "turns_x", "turns_y", "phase"]
MODES = Table("modes", key=MODE, columns=[*MODE, "wavenumber", "ratio", "ratio_err"])
PEAKS = Table("peaks", key=["points", "turns", "peak"],
              columns=["points", "turns", "wavenumber", "peak", "measured", "measured_err", "symbol"])
SPECTRUM = Table("spectrum", key=["points", "turns", "omega"], columns=["points", "turns", "omega", "measured", "predicted"])
NONLINEAR = Table("nonlinear", key=["share", "k", "field"], columns=["share", "k", "field", "ratio", "ratio_err", "drift"])
CAPACITY = Table("capacity", key=["C", "noise"], columns=["C", "noise", "measured", "measured_err", "predicted"])
CUBE = ["points", "share", "field", "turns_x", "turns_y", "turns_z", "phase"]
CUBES = Table("cubes", key=CUBE, columns=[*CUBE, "wavenumber", "ratio", "ratio_err"])
GIVEN = ["flow", "strength", "rows", "wavenumber", "field"]
#: strength : 1 - Ra/Ra_c; exact : variance by Lyapunov, 1 of a field at rest; the sampled one over that
SAMPLED = Table("sampled", key=GIVEN, columns=[*GIVEN, "exact", "ratio", "ratio_err"])

#: what printed formulas give by arithmetic
FORMULAS = Table("formulas", key=["name"], columns=["name", "value"])

ALL = (PARTNERS, PRINTED, REST, ONSET, STEPS, MODES, PEAKS, SPECTRUM, NONLINEAR, CAPACITY, CUBES, SAMPLED, FORMULAS)
