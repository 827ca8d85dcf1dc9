"""Tables of the study `scenes`."""
from studies.kit.table import Table

WHAT = ["scene", "base", "left_out"]
#: `base` without `left_out` ("nothing": all of it). step_s: CPU seconds of a point and step; time_s: of a point and unit of time
#: (in which the steps are that long); bytes of arrays a point; loops: compiled loops that an evaluation calls, by name;
#: error: of the main quantity against the exact answer, nan where the run diverged; changed: what
#: leaving out changes of it at the same points, adds to its error on others, or makes of it whatever the grid (another fluid)
MEASURED = Table("measured", key=WHAT, columns=[*WHAT, "quantity", "points", "step_s", "step_s_err", "time_s", "time_s_err",
                                                "bytes", "loops", "names", "error", "error_err",
                                                "changed"])
#: step, time, memory: of what is left over the whole of the base; needed: yes where what it changes is above 1 %
SCENES = Table("scenes", key=WHAT, columns=[*WHAT, "quantity", "step_s", "step_s_err", "bytes", "step_ratio", "step_ratio_err",
                                            "time_ratio", "time_ratio_err", "bytes_ratio", "loops", "error", "changed",
                                            "needed"])

ALL = (MEASURED, SCENES)
