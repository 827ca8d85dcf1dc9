"""Model only what a scene needs, judged: what is left out costs nothing, and what matters is not left out    [RR98 Sec. III]"""
import numpy as np

from studies.build.read import Value, select
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables

VORTEX, LAYER = {"scene": "taylor-green"}, {"scene": "convection"}
FIXED, ALIKE = {"base": "fixed points"}, {"base": "fixed points, loops of all fluids"}


def saved(column: str, **where) -> Value:
    """A ratio with its error where it has one.

    Raises
    ------
    CannotTell
        The times that it is of scatter as much as they last.
    """
    def value(tables: Tables) -> Measured:
        row = select(tables, "scenes", **where).iloc[0]
        if not np.isfinite(row[column]):
            raise CannotTell("times scatter as much as they last: the study wants the machine for itself")
        return Measured(float(row[column]), float(row.get(f"{column}_err", 0.0)))
    return value


def wrong(**where) -> Value:
    """What leaving out changes.

    Raises
    ------
    CannotTell
        The run diverged.
    """
    def value(tables: Tables) -> Measured:
        row = select(tables, "scenes", **where).iloc[0]
        if not np.isfinite(row["changed"]):
            raise CannotTell(f"without {row['left_out']} the run diverges: there is no error to tell")
        known = select(tables, "measured", **where).iloc[0]
        return Measured(float(row["changed"]), float(known["error_err"]))
    return value


MATTERS = "1 % of the answer is the error at which methods are compared"
CLAIMS = (
    Claim(id="own-scenes-heat", source="RR98 Sec. III", at_most=0.8,
          value=saved("step_ratio", **VORTEX, **FIXED, left_out="heat"),
          statement="a scene without heat pays for none: CPU seconds of a point and step of a Taylor-Green vortex without its "
                    "energy equation over those with it", because="one of four equations and all of the temperature are gone"),
    Claim(id="own-scenes-heat-alike", source="RR98 Sec. III", at_most=0.8,
          value=saved("step_ratio", **VORTEX, **ALIKE, left_out="heat"),
          statement="a scene without heat pays for none, loop for like loop: CPU seconds of a point and step of a Taylor-Green "
                    "vortex without its energy equation over those with it, both in the loops that all fluids take [asked after "
                    "the ideal gas's own loops had been as fast with heat]",
          because="one of four equations and all of the temperature are gone"),
    Claim(id="own-scenes-mending-alike", source="RR98 Eq. 51", at_most=0.95,
          value=saved("step_ratio", **LAYER, **ALIKE, left_out="mended heating"),
          statement="heating that is not mended saves its loop: CPU seconds of a point and step of convection without it over "
                    "those with it, both in the loops that all fluids take", because="5 % is what a spread of seconds can hide"),
    Claim(id="own-scenes-heat-memory", source="RR98 Sec. III", at_most=0.8,
          value=saved("bytes_ratio", **VORTEX, **FIXED, left_out="heat"),
          statement="a scene without heat has no arrays of it: bytes a point of a Taylor-Green vortex without its energy "
                    "equation over those with it", because="one of four equations and all of the temperature are gone"),
    Claim(id="own-scenes-heat-error", source="RR98 Sec. III", at_most=0.01, value=wrong(**VORTEX, **FIXED, left_out="heat"),
          statement="slow vortices need no heat: what the missing energy equation changes of the velocity, Mach 0.05",
          because=MATTERS),
    Claim(id="own-scenes-viscosity", source="RR98 Sec. III", at_most=0.95,
          value=saved("step_ratio", **VORTEX, base="fixed points without heat", left_out="viscosity"),
          statement="a term that is not listed is not computed: CPU seconds of a point and step without friction over "
                    "those with it",
          because="5 % is what a spread of seconds can hide"),
    Claim(id="own-scenes-noise", source="RR98 Sec. II", at_most=0.8,
          value=saved("step_ratio", **VORTEX, base="fixed points with noise", left_out="noise"),
          statement="a scene without noise pays for none: CPU seconds of a point and step of the readable sums, four "
                    "evaluations, over those with noise, three", because="random numbers for each pair and step are gone"),
    Claim(id="own-scenes-motion", source="RR98 Sec. III", at_most=0.1,
          value=saved("time_ratio", **VORTEX, base="moving points", left_out="motion"),
          statement="points that stay are ten times cheaper: CPU seconds of a point and unit of time of a Taylor-Green vortex on "
                    "a lattice over those on moving points", because="an order of magnitude"),
    Claim(id="own-scenes-motion-error", source="RR98 Sec. III", at_most=0.01,
          value=wrong(**LAYER, base="moving points", left_out="motion"),
          statement="convection needs no moving points: what fixing them adds to the error of K, 16 rows", because=MATTERS),
    Claim(id="own-scenes-compressibility", source="RR98 Sec. III", at_most=0.1,
          value=saved("time_ratio", **VORTEX, **FIXED, left_out="compressibility"),
          statement="a slow flow without sound is ten times cheaper: CPU seconds of a cell and unit of time of a Taylor-Green "
                    "vortex on the MAC grid over those of a point of the gas, Mach 0.05",
          because="steps are longer by one over the Mach number, and cost more"),
    Claim(id="own-scenes-compressibility-error", source="KHP95 Sec. IV", at_most=0.01,
          value=wrong(**LAYER, **FIXED, left_out="compressibility"),
          statement="the gas of the paper convects like a Boussinesq fluid: how far half of its K "
                    "at Pr 2 is from that of the gas at Ra 10 000", because=MATTERS),
    Claim(id="own-scenes-mending", source="RR98 Eq. 51", at_most=0.01, value=wrong(**LAYER, **FIXED, left_out="mended heating"),
          statement="the work of forces along edges is heating enough: what it changes of K, 16 rows", because=MATTERS),
    Claim(id="own-scenes-gravity", source="KHP95 Sec. IV", at_least=0.5, value=wrong(**LAYER, **FIXED, left_out="gravity"),
          statement="gravity drives convection: what its absence changes of K", because="most of K"),
)
