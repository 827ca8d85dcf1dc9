"""The study fluctuations: a small rebuild, and what the committed tables must say."""
import re
import subprocess
import sys
from dataclasses import replace

import pytest

import studies.noise.fluctuations.cases as fluctuations
from studies.kit.claim import judge
from studies.kit.sweep import RESULTS, load
from studies.kit.table import read
from studies.noise.fluctuations import tables as fluct_tables
from studies.noise.fluctuations.algebra import PrintedWaves
from studies.noise.fluctuations.flows import BelowOnset, Gradient, Rest
from studies.noise.fluctuations.given import About, Shear
from studies.noise.fluctuations.modes import Equipartition
from studies.noise.fluctuations.nonlinear import Capacity, Nonlinear
from studies.noise.fluctuations.peaks import Brillouin
from studies.noise.fluctuations.tail import Tail, TailSampled
from studies.build.disorder import DISORDERS


def small(size: str) -> list:
    """One or two of each kind of case."""
    lat, jit = DISORDERS["lattice"], DISORDERS["jittered-0.3"]
    kinds = [case for case in fluctuations.algebra((), {})
             if isinstance(case, PrintedWaves) and (case.d == 1 or case.h in (1.2, 3.0))]
    return [*fluctuations.algebra(("lattice",), {2: (6, 6)}), *kinds, *list(fluctuations.steps()),
            Rest(maker="renormalised", disorder=lat, counts=(5, 5), share=0.1),
            Rest(maker="plain", disorder=jit, counts=(5, 5), share=0.0), Gradient(period=12, k=(0.1, 0.14, 0.2)),
            BelowOnset(rows=4, below=(0.5, 0.05, 0.02, 0.01, 0.005)),
            Equipartition(counts=(5, 5), turns=((1, 0), (1, 1)), share=0.5, steps=110, dt=3.0),
            Brillouin(points=9, turns=(1,), steps=430), Nonlinear(counts=(5, 5), share=0.1, k=1e-3, time=112.0, of_limit=0.9,
                      batches=2),
            *(Capacity(C=20.0, corrected=one, steps=100, counts=(4, 4), dt=0.2) for one in (True, False)),
            Rest(maker="delaunay", disorder=jit, counts=(5, 5), share=0.0, speed=0.5),
            Rest(maker="delaunay", disorder=jit, counts=(5, 5), share=1.0, speed=0.5),
            Brillouin(points=9, turns=(1,), steps=430, speed=1.0),
            Equipartition(counts=(3, 3, 3), turns=((1, 0, 0), (1, 1, 1)), share=0.0, steps=40, dt=30.0),
            *fluctuations.shears(8, (0.9, 1.0, 1.1)), *fluctuations.about(6, 4, (0.1, 0.05), (0.4,), 10.0),
            About(flow=Shear(0.2), counts=(3, 3), turns=((1, 0),), share=0.5, eta=0.4, time=135.0, of_limit=0.9, batches=2),
            *(Tail(side=8, share=share, nu_t=(30.0, 3000.0)) for share in (0.0, 0.1, 1.0)),
            *(TailSampled(side=4, share=share, lags=(0, 20, 60), steps=200) for share in (0.0, 0.1))]


@pytest.fixture(scope="module")
def rebuilt(tmp_path_factory):
    out = tmp_path_factory.mktemp("results")
    study = replace(fluctuations.STUDY, cases=small)
    return study, study.run("quick", workers=1, out=out), out


def test_a_small_rebuild_fills_every_table_and_draws_every_figure(rebuilt):
    study, found, out = rebuilt
    for table in fluct_tables.ALL:
        assert set(table.columns) <= set(found[table.name].columns) and len(found[table.name])
    assert {path.stem for path in study.draw(out)} == {"printed", "gradient", "steps", "spectrum", "modes", "cubes",
                                                          "shear", "tail"}


def test_what_is_algebra_holds_at_any_size(rebuilt):
    study, found, _ = rebuilt
    rows = {row["id"]: row for row in judge(study.claims, found, "fluctuations")}
    for name in ("own-fluct-partners", "own-fluct-symmetric", "own-fluct-eq42-cosine", "own-fluct-eq42-sums",
                 "own-fluct-eq43-cosine", "own-fluct-eq42-partner", "rr98-fluct-eq20-rest", "own-fluct-crank-nicolson",
                 "own-fluct-three-stage", "own-fluct-nulls", "own-fluct-no-nulls", "own-fluct-tail", "rr98-fluct-eq22-momentum",
                 "rr98-fluct-eq25-onset", "rr98-fluct-galilean-static", "own-fluct-galilean-order", "own-fluct-tail-floor",
                 "own-fluct-tail-no-floor"):
        assert rows[name]["verdict"] == "holds", rows[name]
    for name in ("rr98-fluct-eq21-growth", "rr98-fluct-eq42-shape", "rr98-fluct-eq37-symmetric",
                 "rr98-fluct-eq43-doubled", "rr98-fluct-eq40-euler", "own-fluct-galilean-mended"):
        assert rows[name]["verdict"] == "fails", rows[name]
    assert rows["rr98-fluct-eq43-doubled"]["measured"] == pytest.approx(1/0.7, rel=0.01)


def test_every_fluctuation_equation_has_its_claim():
    sources = " ".join(claim.source for claim in fluctuations.STUDY.claims)
    for equation in (20, 21, 22, 23, 24, 25, 42, 43, 44):
        assert f"Eq. {equation}" in sources


def test_every_equation_of_noise_and_of_pairs_has_its_verdict():
    """Those of dissipative particles, 49 to 51, are judged by other studies."""
    sources = " ".join(read(RESULTS/"claims.csv")["source"])
    for equation in (20, 21, 22, 23, 24, 25, 42, 43, 44, 49, 50, 51):
        assert re.search(rf"\bEq\. {equation}\b", sources), equation


def test_a_scene_without_noise_knows_no_random_numbers():
    code = "import sys, particles.integral.dih, particles.integral.layer; print('particles.noise' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip() == "False"


def test_the_cases_of_all_sizes_can_be_made():
    assert len(fluctuations.cases("quick")) < len(fluctuations.cases("paper"))


committed = pytest.mark.skipif(not (RESULTS/"fluctuations"/"partners.csv").exists(), reason="no tables are committed yet")


@committed
def test_committed_verdicts_follow_from_committed_tables():
    rows = {row["id"]: row["verdict"] for row in judge(fluctuations.STUDY.claims, load(fluct_tables.ALL, "fluctuations"),
                                                       "fluctuations")}
    kept = read(RESULTS/"claims.csv")
    kept = kept[kept["study"] == "fluctuations"]
    assert dict(zip(kept["id"], kept["verdict"], strict=True)) == rows
