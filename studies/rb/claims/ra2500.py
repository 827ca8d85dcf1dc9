"""Claims about Ra 2500, where particles may stand still    [KHP95, Sec. VI]

The paper does not say from what its runs started: judged is the start that leaves them more flow.
"""
from studies.kit.ask import of, rows
from studies.kit.claim import Claim
from studies.kit.stats import CannotTell, Measured, over_seeds
from studies.kit.table import Tables
from studies.rb.claims.flows import ALIKE, PLAIN, against_alike, limit, over_runs
from studies.rb.tables import Point, particles

STARTS = ("printed", "printed-from-flow")   # from the weak rolls of Sec. VI, from the grid's steady flow


def most_flow(tables: Tables) -> tuple[Point, Measured]:
    """5000 particles at Ra 2500, started from weak rolls or from the grid's flow: the larger Kg, over the
    grid's.

    Both are needed: a flow may go on where it does not begin.
    """
    points = [particles(2500, variant=name) for name in STARTS]
    left = [(point, against_alike(point)(tables)) for point in points]
    return max(left, key=lambda one: one[1].value)


def settled(tables: Tables, point: Point) -> bool:
    """Whether the halves of K agree in all runs of a point that did not diverge."""
    runs = rows(tables, "kinetic_energy", "ke == ke", **point)
    return bool(runs["converged"].astype(str).eq("True").all())


def flow_left(tables: Tables) -> Measured:
    """Kg at Ra 2500 over the grid's smoothed alike, the larger of two starts; 0 to it if it still changes."""
    point, left = most_flow(tables)
    most = left.value + left.err
    return left if settled(tables, point) else Measured(most/2, most/2)


def noisier(tables: Tables) -> Measured:
    """Noise over Kg of 5000 particles at Ra 2500, of the start with the larger Kg, over that at Ra 10 000."""
    near, far = (relative_noise(tables, point) for point in (most_flow(tables)[0], particles(1e4)))
    return near/far


def relative_noise(tables: Tables, point: Point) -> Measured:
    """Energy of the fluctuations over that of the field."""
    noise = rows(tables, "kinetic_energy", **point)["ke_fluctuation"].dropna()
    return over_seeds(noise)/over_runs(point)(tables)


def relative_err(tables: Tables) -> Measured:
    """Statistical error of Kg at Ra 2500, all seeds, over the grid's K; of the start with the larger Kg."""
    point, _ = most_flow(tables)
    if not settled(tables, point):
        raise CannotTell(f"{point['variant']}: K still drifts at Ra 2500, so that its error is no measure of "
                         "fluctuations")
    return Measured(over_runs(point)(tables).err/limit(2500)(tables).value)


BOTH = "of both starts, weak rolls and the grid's flow, the one that leaves more"
CLAIMS = (
    Claim(id="khp95-ra2500-flows", source="KHP95 Sec. VI", printed="relatively large fluctuations",
          at_least=0.5,
          statement="particles convect at Ra 2500, where only fluctuations are said to be in the way: K of "
                    "the field of 5000 particles over the grid's", value=of(flow_left),
          because=f"half of the energy, {ALIKE}; {BOTH}"),
    Claim(id="khp95-ra2500-fluctuations", source="KHP95 Sec. VI", printed="relatively large", at_least=2,
          value=of(noisier),
          statement="fluctuations at Ra 2500 are relatively large: their energy over the field's, over the "
                    "same at Ra 10 000", because=f'"relatively large" has no number: twice; {BOTH}'),
    Claim(id="khp95-ra2500-usable", source="KHP95 Sec. VI", printed="abandoned", at_least=0.1,
          value=of(relative_err),
          statement="fluctuations prevent a comparison at Ra 2500: error of the mean K of the particles' "
                    "field over the grid's K",
          because=f"smaller than the 10 % that they find at higher Ra, a comparison is possible; {PLAIN}; "
                  f"{BOTH}"),
)
