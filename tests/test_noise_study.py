"""The study noise: what its algebra gives at any size, honest errors of what is derived, which equations are judged."""
import re
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest

from studies.kit.claim import judge
from studies.kit.sweep import RESULTS
from studies.kit.table import Tables, read
from studies.noise import STUDY, cases, derive
from studies.noise.printed import PrintedWaves


@pytest.fixture(scope="module")
def algebra():
    """Tables of small cases that sample nothing."""
    waves = [case for case in cases.algebra((), {})
             if isinstance(case, PrintedWaves) and (case.d == 1 or case.h in (1.2, 3.0))]
    some = [*cases.quick()[:2], *cases.algebra(("lattice",), {2: (6, 6)}), *waves, *cases.steps()]
    rows: dict[str, list[dict]] = {}
    for case in some:
        for name, new in case.run(lambda done: None, RESULTS).rows.items():
            rows.setdefault(name, []).extend(new)
    return Tables({name: pd.DataFrame(new).drop_duplicates() for name, new in rows.items()})


@pytest.mark.parametrize("verdict, names", [
    ("holds", ("own-fluct-partners", "own-fluct-eq42-cosine", "own-fluct-eq43-cosine", "own-fluct-eq42-partner",
               "rr98-fluct-eq22-momentum", "rr98-fluct-sec3b-partner")),
    ("fails", ("rr98-fluct-eq21-growth", "rr98-fluct-eq42-shape", "rr98-fluct-eq37-symmetric",
               "rr98-fluct-eq43-doubled", "rr98-fluct-eq40-euler"))])
def test_what_is_algebra_holds_at_any_size(algebra, verdict, names):
    claims = [claim for claim in STUDY.claims if claim.id in names]
    rows = judge(claims, algebra, "noise")
    assert [row["verdict"] for row in rows] == [verdict]*len(names), rows


def test_printed_noise_has_the_variance_of_lattice_sums(algebra):
    """To nine digits: solves with condition 1e3."""
    printed = algebra["printed"]
    assert printed["ratio"].to_numpy() == pytest.approx(printed["predicted"].to_numpy(), rel=1e-8)


def test_every_equation_of_noise_and_of_pairs_has_its_verdict():
    """Those of dissipative particles, 49 to 51, are judged by other studies."""
    sources = " ".join(read(RESULTS/"claims.csv")["source"])
    for equation in (20, 21, 22, 23, 24, 25, 42, 43, 44, 49, 50, 51):
        assert re.search(rf"\bEq\. {equation}\b", sources), equation


def test_a_scene_without_noise_knows_no_random_numbers():
    code = "import sys, particles.integral.dih, particles.integral.layer; print('particles.noise' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


# --- errors of kT over the step ---------------------------------------------------------------


def states(rng, law, err):
    """A table of kT over the step, with so much chance in it."""
    dt = np.array([0.01, 0.02, 0.03, 0.04, 0.06, 0.08])
    off = law(dt) + rng.normal(0, err/1.96, dt.size)
    kT = {name: 1 + off for name in ("kinetic", "configurational")}
    errs = {f"{name}_err": err for name in kT}
    return pd.DataFrame({"integrator": "made up", "a": 25.0, "n": 1000, "dt": dt, **kT, **errs})


@pytest.mark.parametrize("law, column, truth", [(lambda dt: 0.9*dt + 2*dt**2, "linear", 0.9),
                                                (lambda dt: 40*dt**2, "order", 2.0)])
def test_fits_have_honest_errors(law, column, truth):
    """The 95 % interval covers the truth in 95 % of 200 trials, give or take three sigma."""
    rng, hits = np.random.default_rng(0), []
    for _ in range(200):
        row = next(derive.errors(states(rng, law, 0.002)))
        hits.append(abs(row[column] - truth) < row[f"{column}_err"])
    assert 0.90 < np.mean(hits) <= 1.0
