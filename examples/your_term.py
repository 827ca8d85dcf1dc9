"""Your own pair term: Rusanov's dissipation, along edges, calms a shock tube on lattice points.

Each edge takes away (c/2) |S| of the difference of mass, momentum and energy between its ends.
"""
from dataclasses import replace
from typing import NamedTuple

from examples import OWN, sized
from particles.pairs import rate, zero
from studies.build import ready
from studies.build.named import SCENES
from studies.front import solve


class Rusanov(NamedTuple):
    """Spreads all that is conserved with the speed c."""
    c: float


zero.of(Rusanov)(lambda term: (0.0, 0.0, 0.0, 0.0))


@rate.of(Rusanov)
def _(term, a, b, ab):
    f = term.c*(ab.sx*ab.sx + ab.sy*ab.sy)**0.5
    return (f*(b.rho - a.rho), f*(b.rho*b.vx - a.rho*a.vx), f*(b.rho*b.vy - a.rho*a.vy), f*(b.eps - a.eps))


scene = SCENES["shock-tube"](rows=sized(60, 24))
plain = ready(scene, "fixed-lattice-h1.2").method
mine = replace(plain, transport=(*plain.transport, Rusanov(c=1.2)))
for name, method in (("as it is", plain), ("with Rusanov's term", mine)):
    done = solve(scene, method)
    print(name, done)
    done.plot(OWN/f"your_term_{name.split()[0]}.png")
