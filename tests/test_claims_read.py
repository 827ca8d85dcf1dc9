"""Values of claims from tables of known content: flows that differ, fields, snapshots, runs that diverged."""
import math

import numpy as np
import pandas as pd
import pytest

from studies.build.names import one_energy
from studies.kit.claim import judge
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.rb import snapshots
from studies.rb.claims import RB_CLAIMS
from studies.rb.runs.few_particles import lattice
from studies.rb.tables import SCENE, grid, particles

BY_ID = {claim.id: claim for claim in RB_CLAIMS}
K = 0.0048          # of the grid at Ra 10 000
GRID = {**grid(1e4, math.inf), "ke": K, "ke_err": 1e-8}


def judged(name: str, tables: Tables) -> dict:
    """The whole row of a claim."""
    return judge([BY_ID[name]], tables, "rb")[0]


def means(*rows: dict) -> Tables:
    """Tables `means` and `errors` from points and K; smoothing takes nothing."""
    usual = {"particles": 0, "seeds": 3, "mixed": 0, "rolls": 2, "ke_fluctuation": 1e-4, "nu": 1.5,
             "nu_err": 0.0}
    full = pd.DataFrame([one_energy(row["ke"], row["ke_err"]) | usual | row for row in rows])
    limits = full[np.isinf(full["resolution"])].rename(columns={"ke": "reference"})
    spam = full[full["method"] == "spam"].merge(limits[[*SCENE, "reference"]], on=SCENE)
    return Tables({"means": full, "errors": spam.assign(energy="Kg", reference_err=0.0)})


def test_flows_with_other_rolls_are_not_compared():
    def said(rolls: int) -> dict:
        row = {**particles(1e4), "ke": 0.3*K, "ke_field": 0.2*K, "ke_err": 1e-7, "rolls": rolls}
        return judged("khp95-energy-error-10000", means(GRID, row))
    assert said(2)["verdict"] == "fails"
    assert said(4)["verdict"] == "undecidable" and "4 rolls against 2" in said(4)["reason"]
    assert said(0)["verdict"] == "fails"        # at rest: not another flow but none


def test_seeds_in_different_flows_decide_nothing():
    row = {**particles(1e4), "ke": 0.9*K, "ke_err": 0.0, "seeds": 2, "mixed": 1}
    tables = means(GRID, row, {**row, "variant": "printed-fixed-rows", "mixed": 0})
    for name in ("khp95-energy-error-10000", "khp95-walls-both"):
        assert "1 of 3 seeds of printed" in judged(name, tables)["reason"], name


def test_variants_are_compared_seed_by_seed():
    """Starts that all have in common are no difference."""
    points = {name: {**particles(1e4, variant=name), "ke": K, "ke_err": 1e-4}
              for name in ("printed", "arithmetic-mean")}
    runs = [{**point, "seed": seed,
             "ke_field": K*(1 + 0.1*seed)*(1 if name == "printed" else 1.004 + 1e-5*seed)}
            for name, point in points.items() for seed in (1, 2, 3)]
    tables = Tables({**means(*points.values()), "kinetic_energy": pd.DataFrame(runs)})
    compared = judged("khp95-mean-geometric", tables)
    assert compared["measured"] == pytest.approx(0.00402, abs=1e-5) and compared["err"] < 1e-4


def test_readings_of_images_widen_what_the_print_leaves_open():
    """As far as they have been run."""
    printed, odd = ({**particles(5e3, variant=name), "ke": ke, "ke_err": 1e-6}
                    for name, ke in (("printed", 0.0031), ("walls-odd", 0.0029)))
    for rows, err, verdict in (([printed], 1e-6, "fails"), ([printed, odd], 2e-4, "undecidable")):
        row = judged("khp95-spam-ke-5000-particles", means(GRID, *rows))
        assert row["err"] == pytest.approx(err, rel=0.01) and row["verdict"] == verdict


def flow(shift: float, share: float = 1.0, noise: float = 0.0) -> dict[str, np.ndarray]:
    """Two rolls on 30 x 60 places, moved along x (in L), their velocity times `share`."""
    x, y = (np.arange(60) + 0.5)/30 - 1 - shift, ((np.arange(30) + 0.5)/30 - 0.5)[:, None]
    wave = np.cos(np.pi*x)
    random = np.random.default_rng(1).standard_normal((2, 30, 60))*noise
    return {"rho": 1 + 0.1*y - 0.1*wave*np.cos(np.pi*y), "T": 1 - y + 0.2*wave*np.cos(np.pi*y),
            "vx": share*0.1*np.sin(np.pi*x)*np.sin(2*np.pi*y) + random[0],
            "vy": share*0.1*wave*np.cos(np.pi*y) + random[1]}


def kept(point: dict, at: dict[str, np.ndarray], rows: float) -> pd.DataFrame:
    """Rows of the table `fields`."""
    x, y = np.meshgrid((np.arange(60) + 0.5)/30 - 1, (np.arange(30) + 0.5)/30 - 0.5)
    fields = {name: f.ravel() for name, f in {"x": x, "y": y, **at}.items()}
    return pd.DataFrame({**point, "resolution": rows, "seed": 1, **fields})


def error(ke: tuple[float, ...] = (0.005, 0.005), **changes) -> Measured:
    """Of the velocities of 5000 particles with these K, one a seed, against the grid's."""
    point, cells = particles(1e4), grid(1e4)
    mean = {**point, "ke": np.mean(ke), "ke_err": 0.02*np.mean(ke)*(np.ptp(ke) > 0)}
    seeds = pd.DataFrame([{**point, "seed": seed, **one_energy(k, 1e-3*k), "rolls": 2, "converged": True}
                          for seed, k in enumerate(ke, 1)])
    fields = pd.concat([kept(cells, flow(0.0), 48.0), kept(point, flow(**changes), 50.0)])
    tables = means(mean, {**cells, "ke": 0.005, "ke_err": 0.0})
    tables |= {"fields": fields, "kinetic_energy": seeds}
    [row] = snapshots.field_errors(Tables(tables), tables["means"])
    return Measured(row["velocity"], row["velocity_err"])


def test_fields_are_compared_wherever_their_rolls_lie():
    # few harmonics: exact but for round-off
    assert error(shift=0.123) == pytest.approx((0.0, 0.0), abs=1e-12)
    assert error(shift=0.123, share=0.8) == pytest.approx((0.2, 0.0), abs=1e-12)
    size = math.sqrt(np.mean(flow(0)["vx"]**2 + flow(0)["vy"]**2))
    for part in error(shift=0.3, noise=0.01):       # noise of two components is half even, half odd
        assert part == pytest.approx(0.01/size, rel=0.08)       # 3600 samples: 2 % each
    # three seeds, 10 % apart: t(2) = 4.303 times 10 % of K, half of that in velocity; K's own error is 2 %
    wide = math.hypot(4.3027*0.1, 0.02)/2
    assert error(ke=(0.0045, 0.005, 0.0055), shift=0.1).err == pytest.approx(wide, rel=1e-4)
    assert math.isnan(error(ke=(0.005,), shift=0.1).err), "one seed has no error"


def crystal(per_site: int, height: float = 30.0) -> pd.DataFrame:
    """Rows of `particles`: hexagonal sites of density 1, particles of a site 0.05 apart, images."""
    x, y = lattice("hexagonal", per_site, reach=3*height)
    inside = (np.abs(x) < height + 3) & (np.abs(y) < height/2 + 3)
    x, y = (np.concatenate([q[inside] + 0.05*n*(q is x) for n in range(per_site)]) for q in (x, y))
    fluid = (np.abs(x) < height) & (np.abs(y) < height/2)
    return pd.DataFrame({**particles(1e4), "seed": 1, "number": np.arange(len(x)), "x": x/50, "y": y/50,
                         "vx": 0.1, "vy": 0.0, "T": 1.0, "kind": np.where(fluid, "fluid", "image")})


@pytest.mark.parametrize(("per_site", "said"), [(1, "holds"), (2, "fails")])
def test_particles_are_counted_and_pairs_are_seen(per_site, said):
    [row] = snapshots.snapshots(Tables({"particles": crystal(per_site)}))
    assert judged("khp95-lucy-no-pairs", Tables(snapshots=pd.DataFrame([row])))["verdict"] == said
    assert row["occupancy"] == per_site
    if per_site == 1:
        assert row["neighbours"] == 30
        assert row["spacing"] == pytest.approx(math.sqrt(2/math.sqrt(3)), abs=0.05)   # half a bin


def test_what_bears_the_weight_is_no_correlation():
    a, b = np.random.default_rng(1).standard_normal((2, 4000, 2))
    weight = np.array([0.0, 5.0])
    assert snapshots.correlation(a + weight, a - weight) == pytest.approx(1.0)
    assert abs(snapshots.correlation(a + weight, b + weight)) < 4/math.sqrt(8000)
    assert snapshots.correlation(a + b, a) == pytest.approx(math.sqrt(0.5), abs=4/math.sqrt(8000))


def test_a_run_that_diverged_has_no_energy():
    """Its row is in kinetic_energy, without numbers; means leaves it out."""
    lost = pd.DataFrame([{**particles(ra), "seed": 1, "ke": math.nan, "t_end": 12.0, "rolls": 0}
                         for ra in (1e4, 1e5)])
    tables = Tables({**means(GRID, {**particles(1e4), "ke": K, "ke_err": 1e-7}), "kinetic_energy": lost})
    assert "diverged" in judged("khp95-energy-error-10000", tables)["reason"]
    assert judged("khp95-robust", tables)["verdict"] == "fails"
    assert "not run yet" in judged("khp95-robust", Tables({**tables, "kinetic_energy": lost[:0]}))["reason"]
    paper = lost.assign(**grid(1e4, 48, "paper-form"), mass_drift=math.nan)
    assert "grid diverged" in judged("khp95-ghost-density-mass", Tables({"kinetic_energy": paper}))["reason"]


@pytest.mark.parametrize(("rolls", "steady", "ke", "said"), [
    (1, False, 1e-3, "holds"), (2, True, 1e-3, "fails"), (2, False, 1e-3, "undecidable"),
    (2, True, 1e-13, "undecidable"), (1, True, 1e-13, "undecidable")])
def test_two_rolls_that_still_change_or_have_died_are_no_answer(rolls, steady, ke, said):
    row = {**grid(7e3, 32, "two-rolls", sides="walls"), "ke": ke, "rolls": rolls, "converged": steady,
           "t_end": 9000.0}
    found = judged("khp95-one-roll-square", Tables({"kinetic_energy": pd.DataFrame([row])}))
    assert found["verdict"] == said and ("died" in found["reason"]) == (ke < 1e-6)
