"""Your own pair term: Rusanov's dissipation along edges calms a shock tube on lattice points."""
from examples import picture, sized
from particles.pairs import pair_term
from studies.build import ready
from studies.build.fixed import with_term
from studies.front import compare


@pair_term(4, "c")
def Rusanov(term, a, b, ab):
    """Flux over an edge: c |S|/2 times the difference of mass, momentum and energy between its ends."""
    # points have rho, vx, vy, T, P, eps (energy per volume); (ab.sx, ab.sy) = S/2
    f = term.c*(ab.sx*ab.sx + ab.sy*ab.sy)**0.5
    return f*(b.rho - a.rho), f*(b.rho*b.vx - a.rho*a.vx), f*(b.rho*b.vy - a.rho*a.vy), f*(b.eps - a.eps)


def rusanov(scene):
    """Lattice points with the term, in any scene: `solve` and `compare` take such a function as a method."""
    return with_term(ready(scene, "fixed-lattice-h1.2").method, Rusanov(c=1.2))


done = compare("shock-tube", ["fixed-lattice-h1.2", rusanov], rows=sized((60, 120), (18, 24)), eta=0.05)
print(done)
done.plot(picture("your_term"))
