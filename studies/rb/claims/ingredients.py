"""What points that move and exchange over closed faces are made of, each part left out at two sizes: is it needed?

    [RR98 Eqs 46-48, which they replace; the paper shows no simulation]
"""
from studies.build.read import Value, diverged, mean, off, ratio, select
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.rb.claims.points import points

RA = 1e4
SIZES = (25, 40)        # rows
LITTLE = 0.005          # of K: what sets of points scatter by at these sizes


def change(tables: Tables, name: str, rows: int) -> Measured:
    """|K/K - 1| of the scheme without a part and with all.

    Raises
    ------
    CannotTell
        A run diverged.
    """
    if diverged(tables, points(RA, name, rows)):
        raise CannotTell(f"runs of {name} with {rows} rows diverged: there is no K to compare")
    return off(ratio(mean(tables, points(RA, name, rows)), mean(tables, points(RA, "moving", rows))))


def least_change(name: str) -> Value:
    """The smaller of both sizes, by its lower end."""
    return lambda tables: min((change(tables, name, rows) for rows in SIZES), key=lambda found: found.value - found.err)


def largest_change(name: str) -> Value:
    """The larger of both sizes, by its upper end."""
    return lambda tables: max((change(tables, name, rows) for rows in SIZES), key=lambda found: found.value + found.err)


def finished(name: str, rows: int) -> Value:
    """Share of the runs that came to their end."""
    return lambda tables: Measured(float(select(tables, "kinetic_energy", **points(RA, name, rows))["ke"].notna().mean()), 0.0)


SOURCE = "RR98 Eqs 46-48"
SCATTER = "0.5 %: sets of points scatter by 0.2 to 0.7 % at these sizes"
WITHOUT = {"shift": ("no-shift", "shifting points towards even places"),
           "follow": ("no-follow", "letting volumes follow the number density"),
           "faces": ("open-faces", "closing faces and making them exact on linear fields"),
           "static": ("whole-pressure", "leaving the static pressure out of what faces exchange"),
           "heat": ("printed-heat", "the mended heating of friction along pairs"),
           "spread": ("no-spread", "spreading density from point to point"),
           "step": ("half-step", "half of the step")}
#: foretold by trials: runs end early without them; they change K; they do not
ENDING, TELLING, IDLE = ("shift", "follow", "faces"), ("faces", "static", "heat"), ("spread", "step")
CLAIMS = (
    *(Claim(id=f"own-rb-moving-without-{part}-{rows}", source=SOURCE, value=finished(f"moving-{WITHOUT[part][0]}", rows),
            at_most=0, because="a part that is needed lets no run through",
            statement=f"moving points need {WITHOUT[part][1]}: share of the runs without it that come to their end, Ra 10 000, "
                      f"{rows} rows") for part in ENDING for rows in SIZES),
    *(Claim(id=f"own-rb-moving-{part}-matters", source=SOURCE, value=least_change(f"moving-{WITHOUT[part][0]}"),
            at_least=LITTLE, because=SCATTER,
            statement=f"moving points need {WITHOUT[part][1]}: |K/K - 1| without and with it, Ra 10 000, the smaller of 25 and "
                      "40 rows") for part in TELLING),
    *(Claim(id=f"own-rb-moving-{part}-idle", source=SOURCE, value=largest_change(f"moving-{WITHOUT[part][0]}"),
            at_most=LITTLE, because=SCATTER,
            statement=f"moving points do not need {WITHOUT[part][1]}: |K/K - 1| with the whole scheme's and with the other, Ra "
                      "10 000, the larger of 25 and 40 rows") for part in IDLE),
)
