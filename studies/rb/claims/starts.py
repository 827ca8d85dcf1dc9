"""Ra 2500, where particles that start from weak rolls stand still    [KHP95, Sec. VI]

The paper does not say from what its runs at this Rayleigh number started: judged is the start that leaves them more flow.
"""
from studies.build.read import ALIKE, PLAIN, Value, limit, over_runs, over_seeds, particles, ratio, select, settled
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.rb.claims.spam import against_alike

STARTS = ("printed", "printed-from-flow")   # from the weak rolls of Sec. VI, from the grid's steady flow


def most_flow(tables: Tables, ra: float) -> tuple[dict, Measured]:
    """5000 particles started from weak rolls or from the grid's flow: those with the larger Kg, and Kg over the grid's.

    Both are needed: a flow may go on where it does not begin.
    """
    found = [(particles(ra, variant=name), against_alike(tables, ra, variant=name)) for name in STARTS]
    return max(found, key=lambda one: one[1].value)


def left(ra: float) -> Value:
    """Kg over the grid's smoothed alike, of the start with the larger one; what has not settled may die: then from 0 to it."""
    def value(tables: Tables) -> Measured:
        point, found = most_flow(tables, ra)
        most = found.value + found.err
        return found if settled(tables, point) else Measured(most/2, most/2)
    return value


def relative_noise(tables: Tables, point: dict) -> Measured:
    """Energy of the fluctuations over that of the field."""
    noise = select(tables, "kinetic_energy", **point)["ke_fluctuation"].dropna()
    return ratio(over_seeds(noise.tolist()), over_runs(tables, point, "ke_field"))


def noisier(tables: Tables) -> Measured:
    """The same of 5000 particles at Ra 2500, of the start with the larger Kg, over that at Ra 10 000."""
    return ratio(*(relative_noise(tables, point) for point in (most_flow(tables, 2500)[0], particles(1e4))))


def relative_err(tables: Tables) -> Measured:
    """Statistical error of Kg at Ra 2500, all seeds together, over the grid's K; of the start with the larger Kg."""
    point, _ = most_flow(tables, 2500)
    if not settled(tables, point):
        raise CannotTell(f"{point['variant']}: K still drifts at Ra 2500, so that its error is no measure of fluctuations")
    return Measured(over_runs(tables, point, "ke_field").err/limit(tables, 2500).value, 0.0)


BOTH = "of both starts, weak rolls and the grid's flow, the one that leaves more"
CLAIMS = (
    Claim(id="khp95-ra2500-flows", source="KHP95 Sec. VI", printed="relatively large fluctuations", at_least=0.5,
          statement="particles convect at Ra 2500, where only fluctuations are said to be in the way: K of the field of 5000 "
                    "particles over the grid's", value=left(2500), because=f"half of the energy, {ALIKE}; {BOTH}"),
    Claim(id="khp95-ra2500-fluctuations", source="KHP95 Sec. VI", printed="relatively large", at_least=2, value=noisier,
          statement="fluctuations at Ra 2500 are relatively large: their energy over the field's, over the same at Ra "
                    "10 000", because=f'"relatively large" has no number: twice; {BOTH}'),
    Claim(id="khp95-ra2500-usable", source="KHP95 Sec. VI", printed="abandoned", at_least=0.1, value=relative_err,
          statement="fluctuations prevent a comparison at Ra 2500: error of the mean K of the particles' field over the grid's K",
          because=f"smaller than the 10 % that they find at higher Ra, a comparison is possible; {PLAIN}; {BOTH}"),
)
