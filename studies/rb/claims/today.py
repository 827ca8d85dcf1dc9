"""Claims about smooth particles as people use them, with corrected sums, at a fixed range of 3 spacings."""
from typing import Any

import numpy as np

from studies.kit import fits
from studies.kit.ask import Value
from studies.kit.claim import Claim
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.rb.claims.questions import limit, mean
from studies.rb.tables import particles

RA = 1e4
ROWS = (25, 35, 50, 70)


def error(variant: str, height: float = np.inf) -> Value:
    """K over that of the grid, less 1, of all particles; extrapolated without rows."""
    return mean(particles(RA, height, variant=variant))/limit(RA) - 1


def order(variant: str, sizes: tuple[int, ...]) -> Value:
    """-d ln|K/K_grid - 1|/d ln rows."""
    def answer(tables: Tables) -> Measured:
        off = [error(variant, rows)(tables) for rows in sizes]
        return -fits.power_law(sizes, [abs(one.value) for one in off], err=[one.err for one in off]).slope
    return Value(answer, f"-d ln|K/K_grid - 1|/d ln rows, {variant}, {sizes[0]} to {sizes[-1]} rows")


FIXED = "runs of one seed had been seen"
SCHWAIGER = "Schwaiger 2008"
FRONTIERE = "Frontiere, Raskin & Owen 2017"


def near(name: str, rows: int, **known: Any) -> Claim:
    """What the paper of a maker of areas has us expect of K."""
    return Claim(id=f"own-today-{name.lower()}", value=abs(error(name, rows)), at_most=0.05, **known,
                 because="a tenth of what classic particles lose, as of sumB",
                 statement=f"areas of {name} mend classic particles: |K/K_grid - 1|, {2*rows**2} particles, "
                           "Ra 10 000")


CLAIMS = (
    Claim(id="own-today-sph", source="Monaghan 1992", value=abs(error("sph", 50)), at_most=0.1, after=FIXED,
          because="a tenth: what a change of walls makes",
          statement="classic smooth particles, friction along pairs, odd images, are near the gas with 5000 "
                    "particles: |K/K_grid - 1|, Ra 10 000"),
    Claim(id="own-today-sumb", source="Bonet & Lok 1999", value=abs(error("sumB", 50)), at_most=0.05,
          after=FIXED, because="a tenth of what classic particles lose",
          statement="one ingredient, pressures over each particle's corrected gradient, mends this: "
                    "|K/K_grid - 1|, 5000 particles, Ra 10 000"),
    Claim(id="own-today-sumb-limit", source="Bonet & Lok 1999", value=abs(error("sumB")), at_most=0.005,
          after=FIXED, because="0.5 %: points that scatter are good to that",
          statement="with pressures alone corrected smooth particles converge on the gas: |K/K_grid - 1|, "
                    "extrapolated over 1/rows^2, Ra 10 000"),
    Claim(id="own-today-corrected-limit", source=SCHWAIGER, value=abs(error("corrected")), at_most=0.005,
          after=FIXED, because="0.5 %: points that scatter are good to that",
          statement="with friction and heat corrected, too, they do: |K/K_grid - 1| extrapolated, Ra 1e4"),
    Claim(id="own-today-corrected-order", source=SCHWAIGER, value=order("corrected", ROWS), expect=2,
          within=0.4, after=FIXED, because="second order, seen through seeds over a factor of three in rows",
          statement="their error of K falls as the square of the spacing: order, 25 to 70 rows, Ra 10 000"),
    near("CRKSPH", 50, source=FRONTIERE),
    Claim(id="own-today-crksph-limit", source=FRONTIERE, value=abs(error("CRKSPH")), at_most=0.005,
          because="0.5 %: points that scatter are good to that",
          statement="CRKSPH converges on the gas at a fixed range: |K/K_grid - 1|, over 1/rows^2, Ra 10 000"),
    Claim(id="own-today-crksph-order", source=FRONTIERE, value=order("CRKSPH", ROWS[:3]), expect=2,
          within=0.4,
          because="second order in smooth flows, says the paper; seen through seeds over a factor of two",
          statement="the error of K of CRKSPH falls as the square of the spacing: order, 25 to 50 rows"),
    near("MFM", 35, source="Hopkins 2015",
         after="runs of 25 rows had been seen, whose images had a speed of sound of their own"),
    near("MFM-adiabatic", 35, source="Hopkins 2015",
         after="40 and 60 free-fall times of one run of 25 and of 35 rows had been seen"),
    Claim(id="own-today-riemann", source="Zhang, Hu & Adams 2017", value=abs(error("riemann", 35)),
          at_most=0.1, because="a tenth, as of classic particles: dissipation is called low",
          statement="classic particles with a Riemann problem of low dissipation are near the gas: "
                    "|K/K_grid - 1|, 2450 particles, Ra 10 000"),
    Claim(id="own-today-delta-plus", source="Sun et al. 2019", value=abs(error("delta-plus", 35)),
          at_most=0.05, after="the first 20 free-fall times of one run of 25 rows had been seen",
          because="a tenth of what classic particles lose: shifted particles lie evenly, says the paper",
          statement="densities by continuity and shifted places bring particles near the gas: "
                    "|K/K_grid - 1|, 2450 particles, Ra 10 000"),
    Claim(id="own-today-transport-velocity", source="Adami, Hu & Adams 2013",
          value=abs(error("transport-velocity", 35)), at_most=0.05,
          after="runs of 25 rows had been seen, whose usual step died; the range was fixed before",
          because="a tenth of what classic particles lose: P0, whose residues damp, is out of the forces",
          statement="a transport velocity brings particles near the gas: |K/K_grid - 1|, 2450 particles, "
                    "Ra 10 000"),
)
