"""Claims that printed numbers decide alone: do they agree with each other?    [KHP95]"""
from itertools import product
from math import sqrt

from continuum.published import published
from continuum.scene import RayleighBenard, Walls
from studies.build.read import exact, onset
from studies.kit.claim import Claim
from studies.kit.stats import Measured

RULE = "what rounding of the printed digits allows"
BOXES = (2, 3, 4, 7, 9, 10, 12)


def number(key: str) -> float:
    """A number printed in KHP95."""
    return published(f"khp95-{key}").value


def as_printed(key: str) -> dict:
    """Accepted range of a printed number: its value and what its last digit, or its words, leave open."""
    value = published(f"khp95-{key}")
    return {"expect": value.value, "within": value.uncertainty}


def caption(figure: int) -> float:
    """Ra = dT^2 L^2/eta^2 of an ideal gas with dT = 1; all these boxes are 50 high."""
    return (50/number(f"fig{figure}-eta"))**2


def density(figure: int) -> float:
    """Particles per area of a figure's box."""
    return number(f"fig{figure}-particles")/(number(f"fig{figure}-height")*number(f"fig{figure}-width"))


def energy_error(ra: int) -> Measured:
    """1 - K_particles/K_grid of the printed energies."""
    pair = [published(f"khp95-ke-{ra}{end}") for end in ("-spam", "")]
    ratio = pair[0].value/pair[1].value
    return Measured(1 - ratio, ratio*sum(p.uncertainty/p.value for p in pair))


def velocity_error(ra: int) -> Measured:
    """The same of velocities, 1 - (K_particles/K_grid)^(1/2)."""
    error = energy_error(ra)
    return Measured(1 - sqrt(1 - error.value), error.err/2/sqrt(1 - error.value))


def zero_of_pair() -> Measured:
    """Ra where the line in Ra^-1/2 through both printed grid energies is zero; error from rounding of both."""
    (a, k), (b, q) = ((ra**-0.5, published(f"khp95-ke-{ra}")) for ra in (5000, 10000))

    def zero(low: float = 0.0, high: float = 0.0) -> float:
        one, other = k.value + low*k.uncertainty, q.value + high*q.uncertainty
        return ((one*b - other*a)/(one - other))**-2
    corners = product((-1.0, 1.0), repeat=2)
    return Measured(zero(), max(abs(zero(*corner) - zero()) for corner in corners))


def read_line() -> Measured:
    """K at Ra 10 000 on the line through zero at onset and the printed K at Ra 5000."""
    start, k = onset("periodic"), published("khp95-ke-5000")
    factor = (1 - sqrt(start/10000))/(1 - sqrt(start/5000))
    return Measured(k.value*factor, k.uncertainty*factor)


def ra_by_expansivity() -> float:
    """Ra of Fig. 10 by the definition of Sec. I, alpha = 1/<T>."""
    scene = RayleighBenard(ra=1.0, L=number("fig10-height"), T_hot=number("fig10-temperature-hot"),
                           T_cold=number("fig10-temperature-cold"), aspect=1.0, sides=Walls())
    return scene.g*scene.alpha*scene.L**3*scene.dT/number("fig10-eta-ideal")**2


CLAIMS = (
    Claim(id="khp95-boxes", source="KHP95 Figs 2, 3, 4, 7, 9, 10, 12", printed="n sigma^2 = 1",
          statement="particles and boxes of the captions have unit density; largest deviation",
          value=exact(lambda: max(abs(density(figure) - 1) for figure in BOXES)), at_most=1e-12,
          because="exact numbers"),
    Claim(id="khp95-ra-captions", source="KHP95 Figs 2, 3, 8, 9, 12", printed="10 000",
          statement="eta = 0.5 at L = 50 is Ra 10 000, here by dT^2 L^2/eta^2; largest deviation",
          value=exact(lambda: max(abs(caption(figure) - number(f"fig{figure}-ra")) for figure in (2, 3, 8, 9, 12))),
          at_most=1e-9, because="exact numbers; alpha = 1, kappa = k/(rho C_V)"),
    Claim(id="khp95-ra-fig10", source="KHP95 Fig. 10", printed="350 000",
          statement="temperatures 10 and 0.5, eta = 0.8, L = 50 are Ra 350 000 by dT^2 L^2/eta^2",
          value=exact(lambda: (9.5*number("fig10-height")/number("fig10-eta-ideal"))**2), **as_printed("fig10-ra"),
          because="two digits are printed; this takes alpha = 1"),
    Claim(id="khp95-ra-fig10-expansivity", source="KHP95 Sec. I, Fig. 10", printed="350 000",
          statement="temperatures 10 and 0.5, eta = 0.8, L = 50 are Ra 350 000 by the definition of Sec. I, with the "
                    "gas's own alpha = 1/<T>", value=exact(ra_by_expansivity), **as_printed("fig10-ra"),
          because="two digits are printed"),
    Claim(id="khp95-ra-fig4", source="KHP95 Fig. 4", printed="about twice",
          statement="Ra 3000 is about twice the critical value (of the box, wavenumber pi)",
          value=exact(lambda: number("fig4-ra")/onset("periodic")), **as_printed("fig4-supercritical"),
          because='"about" and one digit'),
    Claim(id="khp95-kinetic-errors", source="KHP95 Sec. VI", printed="10%",
          statement="at Ra 5000 the printed energies of particles and grid differ by no more than 10 %",
          value=lambda tables: energy_error(5000), at_most=0.105,
          because="two digits are printed; 0.0030 and 0.003 40 differ by 10.3 % to 13.2 %, by rounding alone"),
    Claim(id="khp95-kinetic-errors-10000", source="KHP95 Sec. VI", printed="10%",
          statement="at Ra 10 000 the printed energies of particles and grid differ by no more than 10 %",
          value=lambda tables: energy_error(10000), at_most=0.105, because="two digits are printed"),
    Claim(id="khp95-velocity-errors-printed", source="KHP95 Sec. VI", printed="5%",
          statement="the printed energies at Ra 5000 mean velocity errors of the order of 5 %",
          value=lambda tables: velocity_error(5000), at_most=0.075,
          because='"of the order of", one digit: half as much again'),
    Claim(id="khp95-velocity-errors-printed-10000", source="KHP95 Sec. VI", printed="5%",
          statement="the printed energies at Ra 10 000 mean velocity errors of the order of 5 %",
          value=lambda tables: velocity_error(10000), at_most=0.075,
          because='"of the order of", one digit: half as much again; less is no contradiction'),
    Claim(id="khp95-line-pair", source="KHP95 Secs V, VI", printed="0.003 40, 0.004 81",
          statement="both printed grid energies lie on one line in Ra^-1/2 that begins at the critical Ra",
          value=lambda tables: zero_of_pair(), **as_printed("ra-critical"),
          because="the last printed digit of 1708; the error is what rounding of the pair leaves open"),
    Claim(id="khp95-line-read", source="KHP95 Secs V, VI", printed="0.004 81",
          statement="the printed K at Ra 10 000 is the line through the critical Ra and the printed K at Ra 5000",
          value=lambda tables: read_line(), **as_printed("ke-10000"), because=f"{RULE}, of both energies"),
    Claim(id="khp95-range-consistent", source="KHP95 Secs I, V", printed="2, 4",
          statement="a factor of 2 in Ra^-1/2 and four times the critical Ra are the same range",
          value=exact(lambda: number("line-range")**-number("line-exponent")), expect=2, within=1e-12,
          because="exact numbers"),
    Claim(id="khp95-initial-energy", source="KHP95 Figs 8, 9", printed="9, one half",
          statement="9 epsilon of initial kinetic energy in 5000 particles are about half of the printed final value",
          value=lambda tables: Measured(*(x/5000/number("ke-10000") for x in (9.0, 0.5))), **as_printed("fig8-initial"),
          because='"about one half": 10 %; "about 9" is 8.5 to 9.5; if Figs 8 and 9 show the same run, which is not '
                  "said"),
    Claim(id="khp95-fig9-diffusion-time", source="KHP95 Figs 9, 12", printed="5000",
          statement="t = 5000 is one diffusion time L^2/eta", value=exact(lambda: number("fig9-time")*0.5/50**2),
          expect=1, within=1e-12, because="exact numbers"),
    Claim(id="khp95-fig12-grid", source="KHP95 Fig. 12", printed="1800",
          statement="1800 points of a square grid over 50 x 100 are whole rows: 30 of 60",
          value=exact(lambda: sqrt(number("fig12-points")/2)), expect=30, within=1e-12, because="exact numbers"),
)
