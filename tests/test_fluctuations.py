"""The study fluctuations: a small rebuild, and what the committed tables must say."""
import re
import subprocess
import sys
from dataclasses import replace

import pytest

import studies.noise.fluctuations.cases as fluctuations
from studies.build.disorder import DISORDERS
from studies.kit.ask import Value
from studies.kit.claim import judge
from studies.kit.sweep import RESULTS, load
from studies.kit.table import read
from studies.noise.fluctuations import tables as fluct_tables
from studies.noise.fluctuations.algebra import PrintedWaves
from studies.noise.fluctuations.flows import BelowOnset, Rest
from studies.noise.fluctuations.modes import Equipartition
from studies.noise.fluctuations.nonlinear import Capacity, Nonlinear
from studies.noise.fluctuations.peaks import Brillouin


def small(size: str) -> list:
    """One or two of each kind of case."""
    lat, jit = DISORDERS["lattice"], DISORDERS["jittered-0.3"]
    kinds = [case for case in fluctuations.algebra((), {})
             if isinstance(case, PrintedWaves) and (case.d == 1 or case.h in (1.2, 3.0))]
    return [*fluctuations.formulas(), *fluctuations.algebra(("lattice",), {2: (6, 6)}), *kinds, *list(fluctuations.steps()),
            Rest(maker="renormalised", disorder=lat, counts=(5, 5), share=0.1),
            Rest(maker="plain", disorder=jit, counts=(5, 5), share=0.0),
            BelowOnset(rows=4, below=(0.5, 0.05, 0.02, 0.01, 0.005)),
            Equipartition(counts=(5, 5), turns=((1, 0), (1, 1)), share=0.5, steps=110, dt=3.0),
            Brillouin(points=9, turns=(1,), steps=430), Nonlinear(counts=(5, 5), share=0.1, k=1e-3, time=112.0, of_limit=0.9,
                      batches=2),
            *(Capacity(C=20.0, corrected=one, steps=100, counts=(4, 4), dt=0.2) for one in (True, False)),
            Equipartition(counts=(3, 3, 3), turns=((1, 0, 0), (1, 1, 1)), share=0.0, steps=40, dt=30.0),
            *fluctuations.about(4, (0.1, 0.05), 10.0)]


@pytest.fixture(scope="module")
def rebuilt(tmp_path_factory):
    out = tmp_path_factory.mktemp("results")
    study = replace(fluctuations.STUDY, cases=small)
    return study, study.run("quick", workers=1, out=out), out


def test_a_small_rebuild_fills_every_table_and_draws_every_figure(rebuilt):
    study, found, out = rebuilt
    for table in fluct_tables.ALL:
        assert set(table.columns) <= set(found[table.name].columns) and len(found[table.name])
    assert {path.stem for path in study.draw(out)} == {"printed", "onset", "steps", "spectrum", "modes", "cubes"}


def test_what_is_algebra_holds_at_any_size(rebuilt):
    study, found, _ = rebuilt
    rows = {row["id"]: row for row in judge(study.claims, found, "fluctuations")}
    for name in ("own-fluct-partners", "own-fluct-eq42-cosine", "own-fluct-eq43-cosine", "own-fluct-eq42-partner",
                 "rr98-fluct-eq20-rest", "rr98-fluct-eq22-momentum", "rr98-fluct-eq25-onset", "rr98-fluct-sec3b-partner"):
        assert rows[name]["verdict"] == "holds", rows[name]
    for name in ("rr98-fluct-eq21-growth", "rr98-fluct-eq42-shape", "rr98-fluct-eq37-symmetric",
                 "rr98-fluct-eq43-doubled", "rr98-fluct-eq40-euler"):
        assert rows[name]["verdict"] == "fails", rows[name]
    assert rows["rr98-fluct-eq43-doubled"]["measured"] == pytest.approx(1/0.7, rel=0.01)


def test_printed_noise_has_the_variance_of_lattice_sums(rebuilt):
    printed = rebuilt[1]["printed"]
    assert printed["ratio"].to_numpy() == pytest.approx(printed["predicted"].to_numpy(), rel=1e-8)       # nine digits


def test_every_claim_tells_its_formula():
    assert all(isinstance(claim.value, Value) for claim in fluctuations.STUDY.claims)


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
