"""Rayleigh-Benard convection: do particles converge on the gas, and what does KHP95 print that holds?

Besides the study: a method of one's own with few rows, its K beside that of its kin in the tables.
"""
from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from continuum.scene import RayleighBenard
from studies.build import METHODS, near
from studies.build.fixed import Scheme
from studies.build.moving import Carriage, DriftMotion, FacesMotion
from studies.build.names import name_of
from studies.build.spam import Variant
from studies.kit.case import Case
from studies.kit.study import Own, Study
from studies.kit.sweep import NoSuchCase
from studies.kit.table import Tables
from studies.rb import cases, claims, derive, figures, tables
from studies.rb.runs.points import CarriedRun, DihRun, DriftRun, MovingRun
from studies.rb.runs.spam import SpamRun

RA = 1e4
#: family of variants -> its case
RUNS: dict[type, Any] = {Variant: SpamRun, Scheme: DihRun, FacesMotion: MovingRun, DriftMotion: DriftRun,
                         Carriage: CarriedRun}
SAME = ["method", "variant"]


def own(text: str, rows: int, seeds: int) -> list[Case]:
    """Runs in the layer of the variant of this name, within its family or with it; else of all with the text
    in their names.

    Raises NoSuchCase: There is none.
    """
    known = {name: variant for name, variant in METHODS.items() if type(variant) in RUNS}
    exact = [variant for name, variant in known.items() if text in (name, variant.name)]
    some = exact or [variant for name, variant in known.items() if text.casefold() in name]
    if not some:
        raise NoSuchCase(f"no method on points has {text!r} in its name; {near(text, known)}")
    scene = RayleighBenard(ra=RA, L=float(rows))
    return [RUNS[type(variant)](scene=scene, variant=variant, seed=seed)
            for variant, seed in product(some, range(1, seeds + 1))]


def beside(tried: Sequence[Any], here: Tables, others: Tables) -> Iterator[str]:
    """K of cases, then of others of their kind with the nearest rows, and the grid's; the largest first."""
    points = pd.DataFrame([one.point for one in tried])[[*SAME, "resolution"]].drop_duplicates()
    points["resolution"] = points.resolution.astype(float)
    ours, known = (tables.rows(frames, "means", **tables.scene(RA)) for frames in (here, others))
    known = known.merge(points, how="left", indicator="own").query("own == 'left_only'")
    limit = known.query("method == 'compressible' and variant == 'flux-form' and resolution == inf")
    right = limit.ke_field.max()
    yield f"K of the flow (smooth particles: Kg) at Ra {RA:g}, Pr 1, run now; +- : half of the 95 % interval"
    yield from lines(ours.merge(points, how="right"), right)
    yield "beside it, from the tables, the largest K first: its kin with the nearest rows, means over seeds;"
    yield "limit: the grid's K at infinitely many rows, which is the right one; %: off this limit"
    kin = known[known.method.isin(points.method) & np.isfinite(known.resolution)]
    apart = (kin.resolution - points.resolution.iloc[0]).abs()
    nearest = kin.loc[apart.sort_values(kind="stable").index].drop_duplicates(SAME)
    yield from lines(pd.concat([nearest, limit]), right)


def lines(frame: pd.DataFrame, right: float) -> Iterator[str]:
    """Rows, K with its error and how far it is off, words for the method; the largest K first."""
    columns = [*SAME, "resolution", "ke_field", "ke_field_err"]
    for method, variant, rows, ke, err in frame.sort_values("ke_field", ascending=False)[columns].to_numpy():
        size = "limit" if np.isinf(rows) else f"{rows:g} rows"
        value = f"{ke:.6f} +- {err:.6f} {100*(ke/right - 1):+7.1f} %" if np.isfinite(ke) else "diverged"
        yield f"{size:>8}  {value:<30}  {name_of(method, variant) or f'{method} {variant}'}"


STUDY = Study(name="rb", question=__doc__.split("\n")[0], cases=cases.cases, tables=tables.ALL,
              derive=derive.derive, figures=figures.figures, claims=claims.RB_CLAIMS, own=Own(own, beside))
