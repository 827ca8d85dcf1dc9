"""Claims about the energies of smooth particles against the grid's    [KHP95, Sec. VI]

The text squares the smoothed velocity, (rho/2)<v>^2, so K is that of the field where nothing else is said; the printed
numbers may be of the particles themselves, and which wall gave them is not said: each has its row. Claims on printed numbers
compare with the grid's K as it is, as the paper does; claims on whether the flow is right with the grid smoothed alike.
"""
from collections.abc import Iterator
from itertools import product
from math import sqrt

from studies.build.read import (
    ALIKE,
    PLAIN,
    Value,
    alike,
    grid,
    largest,
    limit,
    mean,
    mean_of,
    off,
    particles,
    ratio,
    rolls_of,
    same_flow,
    shared_height,
)
from studies.kit.claim import Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.rb.claims.printed import as_printed

WALLS = {"": ("printed", "mirror images"), "-fixed-rows": ("printed-fixed-rows", "fixed rows")}
ENERGIES = {"": ("ke_field", "energy of the field"), "-particles": ("ke", "energy of the particles")}


def against_grid(tables: Tables, ra: float, height: int = 50, variant="printed", energy="ke_field", **where) -> Measured:
    """K_particles/K_grid of the same flow, the grid extrapolated."""
    point = particles(ra, height, variant, **where)
    same_flow(tables, point, grid(ra, **where))
    return ratio(mean(tables, point, energy), limit(tables, ra, **where))


def against_alike(tables: Tables, ra: float, height: int = 50, variant="printed", **where) -> Measured:
    """Kg over K of the grid's field smoothed alike, the same flow: 1 if it is right."""
    point = particles(ra, height, variant, **where)
    same_flow(tables, point, grid(ra, **where))
    return ratio(mean(tables, point, "ke_field"), alike(tables, point))


def error(tables: Tables, ra: float, **where) -> Measured:
    """|Kg/K - 1|, K of the grid smoothed alike."""
    return off(against_alike(tables, ra, **where))


def error_of(ra: float, variant: str, energy: str) -> Value:
    """|K_particles/K_grid - 1| as in the paper."""
    return lambda tables: off(against_grid(tables, ra, variant=variant, energy=energy))


def velocity(tables: Tables, ra: float, height: int = 50, **where) -> Measured:
    """|1 - (K_particles/K_grid)^(1/2)|, the paper's way to an error of velocity."""
    found = against_grid(tables, ra, height, **where)
    return Measured(abs(1 - sqrt(found.value)), found.err/2/sqrt(found.value))


def images_worse(tables: Tables) -> Measured:
    """Error of Kg with mirror images over that with fixed rows, Ra 10 000."""
    return ratio(error(tables, 1e4), error(tables, 1e4, variant="printed-fixed-rows"))


def share(**where) -> Value:
    """Kg of 512 particles at Ra 10 000 over the grid's smoothed alike."""
    return lambda tables: against_alike(tables, 1e4, 16, **where)


def variants(one: str, other: str) -> Value:
    """|K/K - 1| of two variants at Ra 10 000, the largest particle number that both have."""
    def value(tables: Tables) -> Measured:
        height = shared_height(tables, 1e4, one, other)
        a, b = (particles(1e4, height, name) for name in (one, other))
        same_flow(tables, a, b)
        return off(ratio(mean(tables, a, "ke_field"), mean(tables, b, "ke_field")))
    return value


def figure_points() -> Iterator[Claim]:
    """Velocity errors of the particles in Figs 5 and 6, whose Ra are not printed."""
    def of(ra: float, height: int, **where) -> Value:
        return lambda tables: velocity(tables, ra, height, **where)
    said = {"vdw": ("van der Waals", {"eos": "vdw"}), "nu": ("constant nu", {"transport": "const-nu"})}
    for ra, (name, (words, where)) in product((5000, 10000), said.items()):
        yield Claim(id=f"khp95-fig5-{name}-{ra}", source="KHP95 Sec. VI, Fig. 5", printed="about 5%", at_most=0.075,
                    statement=f"velocities of 5000 particles, {words}, are good to about 5 % at Ra {ra}, from energies",
                    because=SOME, value=of(ra, 50, **where))
    for ra in (10000, 20000):
        yield Claim(id=f"khp95-fig6-{ra}", source="KHP95 Sec. VI, Fig. 6", printed="about 5%", at_most=0.075,
                    statement=f"velocities of 1600 particles in the square are good to about 5 % at Ra {ra}, from energies",
                    because=SOME, value=of(ra, 40, sides="walls"))


def energies() -> Iterator[Claim]:
    """The printed K and its error, for both Ra, energies and walls."""
    for ra, text in ((5000, "0.003 0"), (10000, "0.004 6")):
        for (wall, (variant, walls)), (of, (energy, kind)) in product(WALLS.items(), ENERGIES.items()):
            said = f"5000 particles, Lucy, Ra {ra}, {walls}, {kind}"
            yield Claim(id=f"khp95-spam-ke-{ra}{of}{wall}", source="KHP95 Sec. VI", printed=text,
                        statement=f"K of {said}", value=mean_of(particles(ra, variant=variant), energy),
                        **as_printed(f"ke-{ra}-spam"), because="half of the last printed digit")
            yield Claim(id=f"khp95-energy-error-{ra}{of}{wall}", source="KHP95 Sec. VI", printed="10%", at_most=0.105,
                        statement=f"energy errors no worse than 10 %: {said}", because=f"two digits are printed; {PLAIN}",
                        value=error_of(ra, variant, energy))


FIVE = f'"about 5 %": half as much again; {PLAIN}'
SOME = f"{FIVE}; Ra of the points is not printed, near onset particles that start from weak rolls do not flow at all"
CONVINCING = f'"convincing" has no number: half of the energy, {ALIKE}'
CLAIMS = (
    *energies(),
    Claim(id="khp95-velocity-error-5000", source="KHP95 Sec. VI", printed="5%", at_most=0.075, because=FIVE,
          statement="velocity errors of the order of 5 % at Ra 5000, from energies as in the paper",
          value=lambda tables: velocity(tables, 5000)),
    Claim(id="khp95-velocity-error-10000", source="KHP95 Sec. VI", printed="5%", at_most=0.075, because=FIVE,
          statement="velocity errors of the order of 5 % at Ra 10 000, from energies as in the paper",
          value=lambda tables: velocity(tables, 10000)),
    Claim(id="khp95-velocity-abstract", source="KHP95 abstract, Secs I, VII", printed="a few percent", at_most=0.05,
          statement="velocity errors of a few percent: the larger of those at Ra 5000 and 10 000, from energies",
          value=lambda tables: largest([velocity(tables, ra) for ra in (5e3, 1e4)]), because=f"a few are five at most; {PLAIN}"),
    *figure_points(),
    Claim(id="khp95-walls-both", source="KHP95 Secs II, IV", at_most=0.1,
          statement="fixed rows and mirror images are both natural boundaries: K between them at Ra 10 000",
          value=variants("printed-fixed-rows", "printed"),
          because="10 % is the paper's error of K; it does not tell which wall it used"),
    Claim(id="khp95-realistic-walls", source="KHP95 Sec. II", printed='more "realistic"', at_most=1, value=images_worse,
          statement='mirror images are more "realistic" than fixed rows: error of the field\'s K with images over that with '
                    "rows, Ra 10 000", because=f"realistic is what is nearer to the gas; equal errors are 1; {ALIKE}"),
    Claim(id="khp95-mean-geometric", source="KHP95 Sec. II", printed="either", at_most=0.01,
          statement="the mean density may be arithmetic or geometric: K between them at Ra 10 000",
          value=variants("arithmetic-mean", "printed"), because="1 % is what they say that fluctuations disguise"),
    Claim(id="khp95-weight-same", source="KHP95 Sec. IV", at_most=0.1,
          statement="Lucy's and Monaghan's weights both simulate convection: K between them at Ra 10 000",
          value=variants("printed-monaghan", "printed"), because="10 % is the paper's error of K"),
    Claim(id="khp95-500-particles", source="KHP95 Sec. VI", printed="five hundred", at_least=0.5,
          statement="some 500 particles make convincing currents: K of 512, ideal gas, Ra 10 000, over the grid's",
          value=share(), because=CONVINCING),
    Claim(id="khp95-500-particles-vdw", source="KHP95 Sec. VI, Fig. 7", printed="five hundred", at_least=0.5,
          statement="some 500 particles make convincing currents: K of 512, van der Waals, Ra 10 000, over the grid's",
          because=f"{CONVINCING}; Ra of Fig. 7 is not printed",
          value=share(eos="vdw")),
    Claim(id="khp95-fig7-runs", source="KHP95 Fig. 7", printed="two rolls", expect=2, within=0,
          statement="512 van der Waals particles convect with two rolls, Ra 10 000",
          because="a whole number; Ra is not printed", value=rolls_of(particles(1e4, 16, eos="vdw"))),
)
