"""Claims about the energies of smooth particles against the grid's    [KHP95, Sec. VI]

The text squares the smoothed velocity, (rho/2)<v>^2, so K is that of the field where nothing else is said; the printed
numbers may be of the particles themselves, and which wall gave them is not said: each has its row.
"""
from collections.abc import Iterator
from contextlib import suppress
from itertools import product
from math import sqrt

import pandas as pd

from studies.convection.claims.lines import STILL, finest
from studies.convection.claims.printed import as_printed
from studies.convection.claims.read import (
    Value,
    grid,
    largest,
    limit,
    mean,
    mean_of,
    off,
    particles,
    ratio,
    rolls,
    same_flow,
    select,
    shared_height,
)
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables

COARSEST = 8        # rows of the coarsest grid that the solver takes
WALLS = {"": ("printed", "mirror images"), "-fixed-rows": ("printed-fixed-rows", "fixed rows")}
ENERGIES = {"": ("ke_field", "energy of the field"), "-particles": ("ke", "energy of the particles")}


def against_grid(tables: Tables, ra: float, height: int = 50, variant="printed", energy="ke_field", **where) -> Measured:
    """K_particles/K_grid of the same flow, the grid extrapolated."""
    point = particles(ra, height, variant, **where)
    same_flow(tables, point, grid(ra, **where))
    return ratio(mean(tables, point, energy), limit(tables, ra, **where))


def error(tables: Tables, ra: float, **where) -> Measured:
    """|K_particles/K_grid - 1|."""
    return off(against_grid(tables, ra, **where))


def error_of(ra: float, variant: str, energy: str) -> Value:
    """The same as a value function."""
    return lambda tables: error(tables, ra, variant=variant, energy=energy)


def velocity(tables: Tables, ra: float, height: int = 50, **where) -> Measured:
    """|1 - (K_particles/K_grid)^(1/2)|, the paper's way to an error of velocity."""
    found = against_grid(tables, ra, height, **where)
    return Measured(abs(1 - sqrt(found.value)), found.err/2/sqrt(found.value))


def images_worse(tables: Tables) -> Measured:
    """Error of K with mirror images over that with fixed rows, Ra 10 000."""
    return ratio(error(tables, 1e4), error(tables, 1e4, variant="printed-fixed-rows"))


def share(**where) -> Value:
    """K of 512 particles at Ra 10 000 over the grid's."""
    return lambda tables: against_grid(tables, 1e4, 16, **where)


def relative_noise(tables: Tables, ra: float) -> Measured:
    """Energy of the fluctuations over that of the field, 5000 particles."""
    point = particles(ra)
    return ratio(mean(tables, point, "ke_fluctuation"), mean(tables, point, "ke_field"))


def relative_err(tables: Tables) -> Measured:
    """Error of the particles' mean K at Ra 2500, all seeds together, over the grid's K."""
    return Measured(mean(tables, particles(2500), "ke_field").err/limit(tables, 2500).value, 0.0)


def variants(one: str, other: str) -> Value:
    """|K/K - 1| of two variants at Ra 10 000, the largest particle number that both have."""
    def value(tables: Tables) -> Measured:
        height = shared_height(tables, 1e4, one, other)
        a, b = (particles(1e4, height, name) for name in (one, other))
        same_flow(tables, a, b)
        return off(ratio(mean(tables, a, "ke_field"), mean(tables, b, "ke_field")))
    return value


def freedoms(tables: Tables) -> Measured:
    """Numbers of particles (5 each) over those of a grid with the same error of K (4 a cell), the least of all runs."""
    frame = select(tables, "means", method="spam", variant="printed", transport="const-eta", eos="ideal")
    found = []
    for ra, sides in sorted({*zip(frame["ra"], frame["sides"], strict=True)}):
        with suppress(CannotTell):
            flow = rolls(tables, grid(ra, sides=sides))
            runs = frame[(frame["ra"] == ra) & (frame["sides"] == sides) & (frame["rolls"] == flow)]
            found += freedom(tables, ra, sides, runs.sort_values("particles"))
    if not found:
        raise CannotTell("no smooth particles that flow have grids of the same scene beside them")
    return min(found)


def freedom(tables: Tables, ra: float, sides: str, runs: pd.DataFrame) -> list[Measured]:
    """The same of all particle numbers of one scene; the grid's error is C/rows^2, on 8 rows or more.

    The error of so many particles is the largest of these and of more: K that passes the right value as the number
    grows is not accurate where it does. With half of K lost there is nothing to compare.
    """
    end = limit(tables, ra, sides=sides)
    (fine, height), area = finest(tables, ra, sides=sides), 2 if sides == "periodic" else 1
    if end.value < STILL:
        raise CannotTell(f"nothing flows at Ra {ra:g}")
    errors = [off(ratio(Measured(row["ke_field"], row["ke_field_err"]), end)) for _, row in runs.iterrows()]
    found = []
    for number, points in enumerate(runs["particles"]):
        mine = max(errors[number:])
        rows = max(COARSEST, height*sqrt(abs(fine.value/end.value - 1)/mine.value))
        share = float(5*points/(4*rows**2*area))
        found += [Measured(share, share*mine.err/mine.value)]*(mine.value < 0.5)
    return found


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
                        statement=f"energy errors no worse than 10 %: {said}", because="two digits are printed",
                        value=error_of(ra, variant, energy))


SOME = '"about 5 %": half as much again; Ra of the points is not printed, near onset particles do not flow at all'
FIVE = '"about 5 %": half as much again'
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
          value=lambda tables: largest([velocity(tables, ra) for ra in (5e3, 1e4)]), because="a few are five at most"),
    *figure_points(),
    Claim(id="khp95-ra2500-fluctuations", source="KHP95 Sec. VI", printed="relatively large", at_least=2,
          statement="fluctuations at Ra 2500 are relatively large: their energy over the field's, over the same at Ra "
                    "10 000", value=lambda tables: ratio(relative_noise(tables, 2500), relative_noise(tables, 10000)),
          because='"relatively large" has no number: twice'),
    Claim(id="khp95-ra2500-usable", source="KHP95 Sec. VI", printed="abandoned", at_least=0.1, value=relative_err,
          statement="fluctuations prevent a comparison at Ra 2500: error of the particles' mean K over the grid's K",
          because="smaller than the 10 % that they find at higher Ra, a comparison is possible"),
    Claim(id="khp95-ra2500-flows", source="KHP95 Sec. VI", printed="relatively large fluctuations", at_least=0.5,
          statement="particles convect at Ra 2500, where only fluctuations are said to be in the way: K over the "
                    "grid's",
          value=lambda tables: ratio(mean(tables, particles(2500), "ke_field"), limit(tables, 2500)),
          because="half of the energy"),
    Claim(id="khp95-walls-both", source="KHP95 Secs II, IV", printed="two natural ways", at_most=0.1,
          statement="fixed rows and mirror images are both natural boundaries: K between them at Ra 10 000",
          value=variants("printed-fixed-rows", "printed"),
          because="10 % is the paper's error of K; it does not tell which wall it used"),
    Claim(id="khp95-realistic-walls", source="KHP95 Sec. II", printed='more "realistic"', at_most=1, value=images_worse,
          statement='mirror images are more "realistic" than fixed rows: error of the field\'s K with images over that with '
                    "rows, Ra 10 000", because="realistic is what is nearer to the gas; equal errors are 1"),
    Claim(id="khp95-mean-geometric", source="KHP95 Sec. II", printed="either", at_most=0.01,
          statement="the mean density may be arithmetic or geometric: K between them at Ra 10 000",
          value=variants("arithmetic-mean", "printed"), because="1 % is what they say that fluctuations disguise"),
    Claim(id="khp95-weight-same", source="KHP95 Sec. IV", printed="both", at_most=0.1,
          statement="Lucy's and Monaghan's weights both simulate convection: K between them at Ra 10 000",
          value=variants("printed-monaghan", "printed"), because="10 % is the paper's error of K"),
    Claim(id="khp95-fewer-freedoms", source="KHP95 Sec. VII", printed="many fewer", at_most=1, value=freedoms,
          statement="sometimes particles need fewer numbers than an equally accurate grid: ratio in the case that "
                    "suits them best", because="fewer is below 1; other flows than convection are not judged"),
    Claim(id="khp95-500-particles", source="KHP95 Sec. VI", printed="five hundred", at_least=0.5,
          statement="some 500 particles make convincing currents: K of 512, ideal gas, Ra 10 000, over the grid's",
          value=share(), because='"convincing" has no number: half of the energy'),
    Claim(id="khp95-500-particles-vdw", source="KHP95 Sec. VI, Fig. 7", printed="five hundred", at_least=0.5,
          statement="some 500 particles make convincing currents: K of 512, van der Waals, Ra 10 000, over the grid's",
          because='"convincing" has no number: half of the energy; Ra of Fig. 7 is not printed',
          value=share(eos="vdw")),
    Claim(id="khp95-fig7-runs", source="KHP95 Fig. 7", printed="two rolls", expect=2, within=0,
          statement="512 van der Waals particles convect with two rolls, Ra 10 000",
          because="a whole number; Ra is not printed", value=mean_of(particles(1e4, 16, eos="vdw"), "rolls")),
)
