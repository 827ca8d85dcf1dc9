"""Model only what a scene needs: what do heat, gravity, viscosity, noise, motion and compressibility cost, and who needs them?

A Taylor-Green vortex and Rayleigh-Benard convection with everything and with one thing left out: CPU seconds of a point and step,
bytes a point, which compiled loops an evaluation calls, and the error that is made (studies/cost/scenes/runs.py).
Writes results/cost/*.csv and *.png and the rows of study cost in results/claims.csv; `paper` takes two minutes.
"""
from studies.cost.scenes import claims as scenes_claims
from studies.cost.scenes import derive as scenes_derive
from studies.cost.scenes import figures as scenes_figures
from studies.cost.scenes import runs as scenes_cases
from studies.cost.scenes import tables as scenes_tables
from studies.kit.case import Case
from studies.kit.study import Part

QUICK = (("taylor-green", "fixed points without heat"), ("convection", "fixed points"))


def cases(size: str) -> list[Case]:
    """`quick` has two of the bases, timed shortly."""
    if size == "quick":
        return [scenes_cases.Compared(scene=scene, base=base, size=12, short=0.001) for scene, base in QUICK]
    return [scenes_cases.Compared(scene=scene, base=base, size=scenes_cases.SIZE[scene]) for scene, base in scenes_cases.BASES]


PART = Part(cases=cases, tables=scenes_tables.ALL, derive=scenes_derive.derive, figures=scenes_figures.figures,
              claims=scenes_claims.CLAIMS)
