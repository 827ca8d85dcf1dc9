"""Tables of the study fluctuations."""
from studies.kit.table import Table

PARTNERS = Table("partners", key=["maker", "points", "d", "noise"],
                 columns=["maker", "points", "d", "noise", "mismatch", "asymmetry", "sums", "uniform", "nulls", "negative"])
WAVE = ["equation", "term", "reading", "d", "h", "wavenumber"]
PRINTED = Table("printed", key=WAVE, columns=[*WAVE, "ratio", "predicted"])
REST = Table("rest", key=["maker", "points", "d", "share", "n"],
             columns=["maker", "points", "d", "share", "n", "growth", "error", "kinetic"])
STREAM = Table("stream", key=["speed", *REST.key], columns=["speed", *REST.columns])
GRADIENT = Table("gradient", key=["period", "wavenumber"], columns=["period", "wavenumber", "extra", "predicted"])
ONSET = Table("onset", key=["rows", "below"], columns=["rows", "below", "ra_c", "slowest", "velocity"])
STEPS = Table("steps", key=["integrator", "fluid", "wavenumber", "dt"],
              columns=["integrator", "fluid", "wavenumber", "dt", "velocity", "density", "error", "by_hand"])
MODE = ["points", "share", "field", "turns_x", "turns_y", "phase"]
MODES = Table("modes", key=MODE, columns=[*MODE, "wavenumber", "ratio", "ratio_err"])
PEAKS = Table("peaks", key=["points", "turns", "peak"],
              columns=["points", "turns", "wavenumber", "peak", "measured", "measured_err", "symbol"])
SHIFTED = Table("shifted", key=["speed", *PEAKS.key], columns=["speed", *PEAKS.columns])
SPECTRUM = Table("spectrum", key=["points", "turns", "omega"], columns=["points", "turns", "omega", "measured", "predicted"])
NONLINEAR = Table("nonlinear", key=["share", "k", "field"], columns=["share", "k", "field", "ratio", "ratio_err", "drift"])
CAPACITY = Table("capacity", key=["C", "noise"], columns=["C", "noise", "measured", "measured_err", "predicted"])
CUBE = ["points", "share", "field", "turns_x", "turns_y", "turns_z", "phase"]
CUBES = Table("cubes", key=CUBE, columns=[*CUBE, "wavenumber", "ratio", "ratio_err"])
SHEAR = Table("shear", key=["period", "U", "wavenumber"],
              columns=["period", "U", "wavenumber", "extra", "vortical", "second", "uniform"])
ABOUT = ["flow", "U", "field", "turns_x", "turns_y", "phase"]
FLOWS = Table("flows", key=ABOUT, columns=[*ABOUT, "exact", "ratio", "ratio_err"])
GIVEN = ["flow", "strength", "rows", "wavenumber", "field"]
#: strength : contrast of T, or 1 - Ra/Ra_c; exact : variance by Lyapunov, 1 of a field at rest; the sampled one over that
SAMPLED = Table("sampled", key=GIVEN, columns=[*GIVEN, "exact", "ratio", "ratio_err"])
TAIL = Table("tail", key=["side", "share", "nu_t"], columns=["side", "share", "nu_t", "correlation", "continuum"])
TAIL_SAMPLED = Table("tail_sampled", key=["side", "share", "lag"],
                     columns=["side", "share", "lag", "measured", "measured_err", "exact"])

ALL = (PARTNERS, PRINTED, REST, GRADIENT, ONSET, STEPS, MODES, PEAKS, SPECTRUM, NONLINEAR, CAPACITY, STREAM, SHIFTED, CUBES,
       SHEAR, FLOWS, SAMPLED, TAIL, TAIL_SAMPLED)
