"""What papers say of the areas of today's smooth particles: exact on linear fields, second order."""
from typing import Any

from studies.kit.ask import largest, least, one
from studies.kit.claim import Claim

SECOND = "second order, as the paper has it; seeds and longer errors change slopes over 16 to 48 cells by 0.4"
EXACT = "round-off of sums of 30 terms, of matrices with condition numbers of 10"
CRKSPH, MFM = "Frontiere, Raskin & Owen 2017", "Hopkins 2015"


def error(maker: Any, quantity: str, **where: Any) -> Any:
    """Largest over points, seeds and cells."""
    return largest("makers", quantity, err="0", maker=maker, **where)


def second(name: str, maker: str, source: str, points: str) -> Claim:
    """A scheme's pressure gradient is of second order. Of MFM the limiter clips waves at their crests."""
    return Claim(id=f"own-makers-{name}-{points}", source=source, expect=2, within=0.4, because=SECOND,
                 value=one("maker_orders", "order", quantity="divergence", maker=maker, points=points),
                 statement=f"pressures of {maker} push to second order, points {points}: order, waves of "
                           "16 to 48 spacings",
                 after="three sizes of a lattice had left MFM open: a fourth was run"*(points == "lattice"))


MAKERS = (
    Claim(id="own-makers-lattice", source="Monaghan 1992", at_most=1e-10, because=EXACT,
          value=largest("makers", "closure", err="0", points=("lattice", "hexagonal")),
          statement="areas of all makers close on lattices: rms of sum_j S_ij/V_i, in 1/a"),
    Claim(id="own-makers-linear", source="Bonet & Lok 1999", at_most=1e-10, because=EXACT,
          value=error(("sumB", "corrected", "closed faces", "delaunay"), "linear"),
          statement="gradients of sumB are exact on linear fields on all points, as are those of closed "
                    "faces and Delaunay triangles: largest rms error"),
    Claim(id="own-makers-reproducing", source=CRKSPH, at_most=1e-10, because=EXACT,
          value=error("CRKSPH", "linear"),
          statement="areas of CRKSPH, of kernels that reproduce linear fields, are exact on them though made "
                    "antisymmetric: largest rms error"),
    Claim(id="own-makers-closed", source="Springel 2010", at_most=1e-9, because=EXACT,
          value=error(("closed faces", "delaunay"), "closure"),
          statement="closed faces and triangles close on all points: rms of sum_j S_ij/V_i, in 1/a"),
    Claim(id="own-makers-open", source="Monaghan 1992", at_least=1e-3,
          because="what a tenth of a spacing of jitter leaves in sums of 28 terms of a tenth",
          value=least("makers", "closure", err="0", points=("jittered-0.3", "random", "flowed"),
                      maker=("sph", "sumB", "RKGC", "bonet-lok", "CRKSPH", "MFM")),
          statement="areas of all smooth particles stay open off a lattice: least rms of sum_j S_ij/V_i"),
    *(second(name, maker, source, points) for name, maker, source in
      (("crksph", "CRKSPH", CRKSPH), ("mfm", "MFM", MFM)) for points in ("lattice", "flowed")),
    Claim(id="own-makers-laplacian", source="Brookshaw 1985", at_most=0.5,
          because="half an order: conductances along pairs are right on lattices only",
          value=largest("maker_orders", "order", err="order_err", quantity="laplacian", maker=("sph", "sumB"),
                        points=("jittered-0.1", "jittered-0.3", "random")),
          statement="heat along pairs does not converge on points at rest that are jittered: largest order"),
    Claim(id="own-makers-wall-heat", source="Ng et al. 2020", at_most=1.0,
          because="order 0 to 1, as the paper has it of images and of dummy particles",
          after="errors of 16 rows on two sets of points had been seen",
          value=largest("wall_orders", "order", err="order_err", maker=("sph", "corrected", "delta-plus"),
                        points=("jittered-0.1", "jittered-0.3", "random")),
          statement="heat through plates with images is of first order at most on irregular points: largest "
                    "order of its error, 16 to 64 rows"),
)
