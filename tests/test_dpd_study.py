"""The study dpd: a quick rebuild of its tables, honest errors of what is derived, and what the committed tables must say."""
import numpy as np
import pandas as pd
import pytest

from studies.kit.claim import judge
from studies.kit.sweep import RESULTS, load
from studies.kit.table import read
from studies.noise.dpd import cases as dpd
from studies.noise.dpd import derive as dpd_derive
from studies.noise.dpd import tables as dpd_tables
from studies.noise.dpd.runs import diffusion


@pytest.fixture(scope="module")
def quick(tmp_path_factory):
    out = tmp_path_factory.mktemp("results")
    return dpd.STUDY.run("quick", workers=1, out=out), out


def test_quick_rebuild_writes_every_table(quick):
    found, out = quick
    for table in dpd_tables.ALL:
        assert len(found[table.name]) and set(table.columns) <= set(found[table.name].columns)
    pictures = {"temperature.png", "structure.png", "second.png", "cylinder.png", "surface.png"}
    assert {path.name for path in dpd.STUDY.draw(out)} == pictures
    assert {row["id"] for row in dpd.STUDY.judge(out)} == {claim.id for claim in dpd.STUDY.claims}
    assert found["states"]["drift"].max() < 1e-13


def states(rng, law, err):
    """A table of kT over the step, with so much chance in it."""
    dt = np.array([0.01, 0.02, 0.03, 0.04, 0.06, 0.08])
    off = law(dt) + rng.normal(0, err/1.96, dt.size)
    return pd.DataFrame({"integrator": "made up", "noise": "Uniform", "d": 3, "a": 25.0, "kT": 1.0, "rho": 3.0, "n": 1000,
                         "dt": dt, **{name: 1 + off for name in ("kinetic", "configurational")},
                         **{f"{name}_err": err for name in ("kinetic", "configurational")}})


@pytest.mark.parametrize("law, column, truth", [(lambda dt: 0.9*dt + 2*dt**2, "linear", 0.9),
                                                (lambda dt: 40*dt**2, "order", 2.0)])
def test_fits_have_honest_errors(law, column, truth):
    """The 95 % interval covers the truth in 95 % of 200 trials, give or take three sigma."""
    rng, hits = np.random.default_rng(0), []
    for _ in range(200):
        row = next(dpd_derive.errors(states(rng, law, 0.002)))
        hits.append(abs(row[column] - truth) < row[f"{column}_err"])
    assert 0.90 < np.mean(hits) <= 1.0


def test_diffusion_of_a_random_walk():
    """5000 walkers with D = 0.5: 2 D d t, the interval covers it."""
    rng, records, d = np.random.default_rng(1), 50, 3
    steps = rng.normal(0, np.sqrt(0.1), (5*records, 5000, d))       # 2 D times 0.1
    x = np.cumsum(steps, axis=0)
    msd = np.array([((x[k] - x[k - k % records])**2).sum(axis=1).mean() for k in range(len(x))])
    found = diffusion(msd, 0.1*np.arange(len(x)), records, d)
    assert abs(found.value - 0.5) < 1.5*found.err and found.err < 0.05


committed = pytest.mark.skipif(not (RESULTS/"dpd"/"states.csv").exists(), reason="no tables are committed yet")


@committed
def test_committed_verdicts_follow_from_committed_tables():
    rows = {row["id"]: row["verdict"] for row in judge(dpd.STUDY.claims, load(dpd_tables.ALL, "dpd"), "dpd")}
    kept = read(RESULTS/"claims.csv")
    kept = kept[kept["study"] == "dpd"]
    assert dict(zip(kept["id"], kept["verdict"], strict=True)) == rows


@committed
def test_the_pressure_of_print_is_met():
    """23.635 to 23.637 [Allen & Tildesley 2017]; 0.02 is what was asked for."""
    rows = read(RESULTS/"dpd"/"excess.csv", dpd_tables.EXCESS.columns)
    row = rows[(rows["a"] == 25) & (rows["kT"] == 1) & (rows["rho"] == 3)].iloc[0]
    assert abs(row["P"] - 23.64) < 0.02 + row["P_err"]
