"""What RR98 says of conservation, judged    [RR98 Eqs 34-38, Secs III A and III B]"""
import pandas as pd

from studies.build.read import Value, select
from studies.conservation.derive import RR98, claimed, finished
from studies.conservation.sums import ROUND_OFF
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables

CLOSING = ("closed", "exact", "delaunay")
BY_CONSTRUCTION = "by construction, the total mass, total momentum, and total energy are conserved"
LIMIT = "1e-13: sums of some hundred numbers that 40 000 additions have rounded"


def worst(name: str, schemes: tuple[str, ...], **where) -> Value:
    """Largest relative change of a sum over all runs that claim to keep it and reached the end."""
    def value(tables: Tables) -> Measured:
        rows = finished(select(tables, "drift", **where))
        return largest(rows[rows["scheme"].isin(schemes) & claimed(rows, name).notna()], name)
    return value


def largest(rows: pd.DataFrame, name: str) -> Measured:
    """Of a column.

    Raises
    ------
    CannotTell
        There are no rows.
    """
    if rows.empty:
        raise CannotTell(f"not run yet: no run that reached its end tells of {name}")
    return Measured(float(rows[name].max()), ROUND_OFF)


def worst_of_all(scheme: str) -> Value:
    """Largest relative change of mass, momentum or energy over the runs of a scheme that claim to keep it and reached the end."""
    return lambda tables: max((worst(name, (scheme,))(tables) for name in RR98), key=lambda found: found.value)


def stopped(tables: Tables) -> Measured:
    """The same of runs that stopped before their end, up to where they were looked at last."""
    rows = select(tables, "drift")
    rows = rows[rows["reached"] < rows["steps"]]
    return max((largest(rows[claimed(rows, name).notna()], name) for name in RR98), key=lambda found: found.value)


def lost(name: str, **where) -> Value:
    """Largest change of a sum in runs that do not claim to keep it, as far as they went."""
    return lambda tables: largest(select(tables, "drift", **where), name)


def share_finished(maker: str, points: str) -> Value:
    """Share of the steps that runs with forces along edges reached before they diverged."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "drift", scheme="layer", mode="pairwise", maker=maker, points=points, wall="periodic")
        return Measured(float((rows["reached"]/rows["steps"]).min()), 0.0)
    return value


def frame(column: str, modes: tuple[str, ...], makers: tuple[str, ...]) -> Value:
    """Largest difference of rates in a wind, over point sets."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "frames")
        return largest(rows[rows["mode"].isin(modes) & rows["maker"].isin(makers)], column)
    return value


def frame_mean(column: str, **where) -> Value:
    """Its mean over point sets."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "frame_means", **where).iloc[0]
        return Measured(float(row[column]), float(row[f"{column}_err"]))
    return value


def growth(bracket: str, makers: tuple[str, ...]) -> Value:
    """Largest ln of the energy of sound after all periods, over that at the start."""
    def value(tables: Tables) -> Measured:
        rows = select(tables, "sound", bracket=bracket)
        rows = rows[rows["maker"].isin(makers)]
        if rows.empty:
            raise CannotTell("not run yet: no such sound in the table")
        return Measured(float(rows["ln_energy"].abs().max()), 0.0)
    return value


def rate(maker: str, points: str) -> Value:
    """Growth per period with the "+" bracket in both, mean over point sets."""
    def value(tables: Tables) -> Measured:
        row = select(tables, "sound_means", bracket="plus", maker=maker, points=points).iloc[0]
        return Measured(float(row["growth"]), float(row["growth_err"]))
    return value


FIXED = ("layer", "dih")
CLAIMS = (
    Claim(id="rr98-conservation-mass", source="RR98 Eq. 34", printed=BY_CONSTRUCTION, at_most=1e-13, because=LIMIT,
          value=worst("mass", FIXED),
          statement="total mass is conserved: largest relative change in any run of 10 000 steps on fixed points, every "
                    "transport, weight, maker of edges and set of points, in periodic boxes, between plates, in all dimensions"),
    Claim(id="rr98-conservation-momentum", source="RR98 Eq. 35", printed=BY_CONSTRUCTION, at_most=1e-13, because=LIMIT,
          value=worst("momentum", FIXED),
          statement="total momentum is conserved: largest change over the sum of its sizes in any run of 10 000 steps on fixed "
                    "points, in periodic boxes and along plates without friction"),
    Claim(id="rr98-conservation-energy", source="RR98 Eq. 36", printed=BY_CONSTRUCTION, at_most=1e-13, because=LIMIT,
          value=worst("energy", FIXED),
          statement="total energy is conserved: largest relative change in any run of 10 000 steps on fixed points, in periodic "
                    "boxes and between plates without friction and conduction"),
    Claim(id="rr98-conservation-stopped", source="RR98 Eqs 34-36", at_most=1e-13, because=LIMIT, value=stopped,
          statement="runs that diverge or heat too far within 10 000 steps keep their sums until they are looked at last: "
                    "largest relative change of mass, momentum, energy"),
    *(Claim(id=f"rr98-conservation-held-{name}", source="RR98 Secs III A, IV", at_most=1e-13, because=LIMIT,
            value=worst(name, ("held",)),
            statement=f"rows of held points and frozen bodies take what the fluid loses of {name}: largest relative change of "
                      "both together in 10 000 steps, every maker of edges, set of points and weight") for name in RR98),
    Claim(id="rr98-conservation-sliding", source="RR98 Sec. IV", at_most=1e-13, because=LIMIT, value=worst_of_all("sliding"),
          statement="sliding sides give momentum and energy to what passes through them from one speed to the other, and none "
                    "besides: largest relative change of mass, momentum, energy in 10 000 steps, every weight, lattice"),
    Claim(id="rr98-conservation-motions", source="RR98 Eqs 39-41, 49", at_most=1e-13, because=LIMIT,
          value=worst_of_all("motions"),
          statement="points that move literally or at constant mass keep mass, momentum and energy: largest relative change in "
                    "10 000 steps, every weight, nested transport and forces along edges with both heatings"),
    Claim(id="rr98-conservation-survival-lattice", source="RR98 Eqs 34-36", at_least=1.0, because="all of them",
          value=share_finished("plain", "lattice"),
          statement="the brackets with plain quadrature carry a random start through 10 000 steps on a lattice: share of the "
                    "steps before divergence"),
    Claim(id="rr98-conservation-survival-jittered", source="RR98 Eqs 34-36", at_least=1.0, because="all of them",
          value=share_finished("plain", "jittered-0.3"),
          statement="the brackets with plain quadrature carry a random start through 10 000 steps on points jittered by 0.3 a: "
                    "share of the steps before divergence"),
    Claim(id="rr98-conservation-survival-delaunay", source="RR98 Eqs 34-36", at_least=1.0, because="all of them",
          value=share_finished("delaunay", "random"),
          statement="the brackets over Delaunay edges carry a random start through 10 000 steps on random points: share of the "
                    "steps before divergence"),
    Claim(id="rr98-conservation-sound-closed", source="RR98 Eqs 34, 35", at_most=1e-9, value=growth("plus", CLOSING),
          statement="linear sound neither grows nor decays with (f_i + f_j) in divergence and gradient over edges that close: "
                    "largest |ln| of its energy after 10 000 periods", because="10 000 products of 192 terms: 4e-10"),
    Claim(id="rr98-conservation-sound-adjoint", source="RR98 Eqs 34, 35", at_most=1e-9,
          because="10 000 products of 192 terms: 4e-10",
          value=growth("adjoint", ("printed", "plain", "renormalised", *CLOSING)),
          statement="linear sound neither grows nor decays with differences in the gradient, on all edges and points: largest "
                    "|ln| of its energy after 10 000 periods"),
    Claim(id="rr98-conservation-sound-jittered", source="RR98 Eqs 34, 35", at_most=1e-9, value=rate("plain", "jittered-0.3"),
          statement="linear sound does not grow with the brackets as printed and plain quadrature on points jittered by 0.3 a: "
                    "growth per period of a wave of 8 spacings", because="round-off of eigenvalues is 1e-12"),
    Claim(id="rr98-conservation-sound-relaxed", source="RR98 Eqs 34, 35", at_most=1e-9, value=rate("plain", "relaxed"),
          statement="linear sound does not grow with the brackets as printed and plain quadrature on relaxed points: growth per "
                    "period of a wave of 8 spacings", because="round-off of eigenvalues is 1e-12"),
    Claim(id="rr98-conservation-galilean-closed", source="RR98 Eqs 34-38", at_most=1e-12, because="round-off of sums of 30 terms",
          value=frame("momentum", ("nested", "printed", "pairwise", "unmended"), CLOSING),
          statement="rates of momentum in a wind are those at rest, carried along, on edges that close, all transports: largest "
                    "difference over the largest rate"),
    Claim(id="rr98-conservation-galilean-energy", source="RR98 Eqs 34-38", at_most=1e-12, because="round-off of sums of 30 terms",
          value=frame("energy", ("nested", "printed", "unmended"), CLOSING),
          statement="rates of energy in a wind are those at rest, carried along, on edges that close, nested transport and "
                    "forces along edges with their own work for heating: largest difference over the largest rate"),
    Claim(id="rr98-conservation-galilean-printed", source="RR98 Eq. 37", at_most=1e-12, because="round-off of sums of 30 terms",
          value=frame_mean("momentum", mode="printed", maker="plain", points="jittered-0.3"),
          statement="rates of momentum in a wind are those at rest, carried along, with the inner sum of Eq. 37 as printed and "
                    "plain quadrature on points jittered by 0.3 a: largest difference over the largest rate"),
    Claim(id="rr98-conservation-galilean-heating", source="RR98 Eq. 51", at_most=1e-12, because="round-off of sums of 30 terms",
          value=frame_mean("energy", mode="pairwise", maker="delaunay", points="jittered-0.3"),
          statement="rates of energy in a wind are those at rest, carried along, with the mended heating of forces along edges, "
                    "Delaunay edges on points jittered by 0.3 a: largest difference over the largest rate"),
    Claim(id="own-conservation-galilean-everywhere", source="RR98 Eq. 51", at_most=1e-12, because="round-off of sums of 30 terms",
          value=frame("energy", ("everywhere",), CLOSING),
          statement="they are with the force of the stress whose work mends the heating, which the continuum would not miss, on "
                    "edges that close: largest difference over the largest rate [a repair made after the claim on the mended "
                    "heating had failed]"),
    Claim(id="rr98-conservation-plates-gravity", source="RR98 Sec. III A", at_most=1e-13, because=LIMIT,
          value=lost("energy", mode="ideal", wall="plates, gravity"),
          statement="energy with that of height is conserved between plates without friction under gravity: relative change in "
                    "10 000 steps"),
    *(Claim(id=f"rr98-conservation-moving-{name}", source="RR98 Sec. III B", at_most=1e-13, because=LIMIT,
            value=worst(name, ("moving",)),
            statement=f"points can move and keep {name}: largest relative change in 10 000 steps of volumes, masses, momenta and "
                      "energies exchanged over faces") for name in ("mass", "momentum", "energy", "volume")),
)
