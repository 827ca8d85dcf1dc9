"""Your own pair term: Rusanov's dissipation along edges calms a shock tube on lattice points."""
from dataclasses import replace
from typing import NamedTuple

from examples import OWN, sized
from particles.pairs import rate, zero
from studies.build import ready
from studies.build.answers import answer
from studies.build.named import SCENES
from studies.front import solve
from studies.kit.figure import figure, save


class Rusanov(NamedTuple):
    """Each edge takes away c |S|/2 of the difference of mass, momentum and energy between its ends."""
    c: float


zero.of(Rusanov)(lambda term: (0.0, 0.0, 0.0, 0.0))


@rate.of(Rusanov)
def _(term, a, b, ab):          # ab.sx, ab.sy: half of S
    f = term.c*(ab.sx*ab.sx + ab.sy*ab.sy)**0.5
    return f*(b.rho - a.rho), f*(b.rho*b.vx - a.rho*a.vx), f*(b.rho*b.vy - a.rho*a.vy), f*(b.eps - a.eps)


scene = SCENES["shock-tube"](rows=sized(60, 24), eta=0.05)
plain = ready(scene, "fixed-lattice-h1.2").method
mine = replace(plain, transport=(*plain.transport, Rusanov(c=1.2)))
page, axes = figure(width=6.5)
for name, method in (("as it is", plain), ("with Rusanov's term", mine)):
    row = solve(scene, method).fields().query("0 < x and 0 < y < 1").sort_values("x")
    axes.plot(row.x, row.rho, markersize=3, label=name)
axes.plot(row.x, answer(scene, row[["x", "y"]].to_numpy())["rho"], color="black", marker="", label="exact")
axes.set(xlabel="x", ylabel="density")
axes.legend()
save(page, OWN/"your_term.png")
