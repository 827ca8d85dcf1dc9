"""What is computed once of the edges of one maker on one set of points, as a case."""
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from particles.integral.edges import Edges
from particles.integral.points import Points
from particles.weights import Lucy
from studies.build.disorder import Disorder
from studies.kit.case import Case, Outcome, Report

H = 3.0                 # spacings: the range of Lucy's weight


@dataclass(frozen=True, kw_only=True)
class OnEdges(Case):
    """A row of `table`; none where no such edges exist on these points.

    make : of `particles.integral.edge_makers.MAKERS`. counts : points along each axis.
    """
    maker: str
    make: Callable[[Points, Any], Edges]
    disorder: Disorder
    seed: int = 1
    table: ClassVar[str]
    counts: ClassVar[tuple[int, ...]] = (12, 12)

    @property
    def cost(self) -> float:
        return 0.05

    def found(self, points: Points, edges: Edges) -> dict[str, Any]:
        """The columns besides maker, points and seed."""
        raise NotImplementedError

    def run(self, report: Report, folder: Path) -> Outcome:
        points = self.disorder.make(self.counts, self.disorder.size, self.seed)
        try:
            edges = self.make(points, Lucy.of(h=H))
        except ArithmeticError:
            return Outcome({})
        return Outcome({self.table: [{"maker": self.maker, "points": self.disorder.name, "seed": self.seed,
                                      **self.found(points, edges)}]})
