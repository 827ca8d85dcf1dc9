"""Your own weight, a class and two formulas: smooth particles with it beside those with Lucy's."""
from examples import picture, sized
from particles.weights import Weight, shape, slope
from studies.build.spam import PRINTED
from studies.front import compare


class Quartic(Weight):
    """(1 - q^2)^4, q = r/h"""


shape.of(Quartic)(lambda weight, q: (1 - q**2)**4)          # phi(q)
slope.of(Quartic)(lambda weight, q: -8*(1 - q**2)**3)       # phi'(q)/q

mine = PRINTED._replace(name="quartic", weight=Quartic)
done = compare("rayleigh-benard", ["grid", "spam", mine], rows=sized((16, 24), (8,)), time=sized(60, 5))
print(done)         # with this weight the flow stops and particles jostle: K is small, K_particles is not
done.plot(picture("your_weight"))
