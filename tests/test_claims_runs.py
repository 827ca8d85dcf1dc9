"""Claims on what happens to runs: divergence, time step, plates and walls, fluctuations, freezing; tables by hand."""
import math

import numpy as np
import pandas as pd
import pytest

from studies.kit.table import Tables
from studies.rb import snapshots
from studies.rb.tables import grid, particles
from tests.claim_tables import crystal, grids, judged, means, seeds, straight, verdict


def test_a_run_that_diverged_has_no_energy():
    """Its row is in kinetic_energy, without numbers; means leaves it out."""
    rows = grids() + [{**particles(1e4), "ke": 0.0048, "ke_err": 1e-7}]
    lost = pd.DataFrame([{**particles(ra), "seed": 1, "ke": math.nan, "t_end": 12.0, "rolls": 0} for ra in (1e4, 1e5)])
    tables = Tables({**means(rows), "kinetic_energy": lost})
    assert "diverged" in judged("khp95-energy-error-10000", tables)["reason"]
    assert verdict("khp95-robust", tables) == "fails"
    none = Tables({**tables, "kinetic_energy": lost[:0]})
    assert "not run yet" in judged("khp95-robust", none)["reason"]
    paper = lost.assign(**grid(1e4, 48, "paper-form"), mass_drift=math.nan)
    assert "grid diverged" in judged("khp95-ghost-density-mass", Tables({"kinetic_energy": paper}))["reason"]


@pytest.mark.parametrize(("change", "said"), [(0.01, "holds"), (0.1, "fails")])
def test_half_of_the_step_is_compared_over_seeds_of_the_same_flow(change, said):
    both = [{**particles(1e4, 25, name), "ke": ke, "ke_err": 0.001*ke}
            for name, ke in (("printed", 0.0045), ("printed-half-step", 0.0045*(1 - change)))]
    found = judged("own-half-step-25", with_runs(both))
    assert found["verdict"] == said and found["measured"] == pytest.approx(2*change)            # of first order
    assert found["err"] == pytest.approx(2*0.001*math.sqrt(2/3), rel=0.2)       # three seeds, both steps
    assert verdict("own-half-step-50", with_runs(both)) == "undecidable"


def with_runs(points: list[dict]) -> Tables:
    """Three seeds of each point with its K, one more that diverged, one in another flow; in `means` a larger error."""
    seeds = [{"seed": seed} for seed in (1, 2, 3)] + [{"seed": 4, "ke": math.nan}, {"seed": 5, "rolls": 4, "ke": 1.0}]
    runs = pd.DataFrame([{**point, "rolls": 2, "ke_field": 0.9*point["ke"], "ke_field_err": 0.9*point["ke_err"], **seed}
                         for point in points for seed in seeds])
    return Tables({**means([{**point, "ke_err": point["ke"]} for point in points]), "kinetic_energy": runs})


@pytest.mark.parametrize(("rolls", "steady", "ke", "said"), [
    (1, False, 1e-3, "holds"), (2, True, 1e-3, "fails"), (2, False, 1e-3, "undecidable"), (2, True, 1e-13, "undecidable"),
    (1, True, 1e-13, "undecidable")])
def test_two_rolls_that_still_change_or_have_died_are_no_answer(rolls, steady, ke, said):
    row = {**grid(7e3, 32, "two-rolls", sides="walls"), "ke": ke, "rolls": rolls, "converged": steady, "t_end": 9000.0}
    found = judged("khp95-one-roll-square", Tables({"kinetic_energy": pd.DataFrame([row])}))
    assert found["verdict"] == said and ("died" in found["reason"]) == (ke < 1e-6)


def test_what_smoothing_takes_is_told_from_what_is_lost():
    """The weight leaves 0.9 of K, the particles' field has 0.8: half of the loss is smoothing, 1/9 is left."""
    tables = means(grids() + [{**particles(5e3), "ke": 0.8*0.0034, "ke_err": 1e-8}], kept=0.9)
    assert judged("own-smoothed-5000", tables)["measured"] == pytest.approx(1/9)
    assert judged("own-smoothing-share-5000", tables)["measured"] == pytest.approx(0.5)


@pytest.mark.parametrize(("lower", "said"), [(1.801, "holds"), (1.9, "fails")])
def test_plates_must_exchange_what_the_layer_carries(lower, said):
    """At the worst of all points: 50 rows are right here."""
    points = [(rows, seed) for rows in (16, 50) for seed in (1, 2, 3)]
    runs = [{**particles(1e4, rows), "seed": seed, "ke": 0.0045, "nu": 1.8 + 0.01*seed} for rows, seed in points]
    walls = [{**particles(1e4, rows), "seed": seed, "plate": plate, "nu_plate": nu + 0.01*seed}
             for rows, seed in points for plate, nu in (("lower", lower if rows == 16 else 1.8), ("upper", 1.8))]
    tables = Tables({"kinetic_energy": pd.DataFrame(runs), "walls": pd.DataFrame(walls)})
    assert verdict("own-nusselt-plates", tables) == said


def walled(reflections: int, variant: str = "printed-fixed-rows", fast: float = 0.5) -> Tables:
    """Two seeds, 1000 units of time, density 1 and T = 1 at both plates; the fastest particle has speed `fast`."""
    point = particles(1e4, variant=variant)
    layers = [{**point, "seed": seed, "plate": plate, "rho_layer": 1.0, "T_layer": 1.0, "reflections": reflections}
              for seed in (1, 2) for plate in ("lower", "upper")]
    runs = [{**point, "seed": seed, "ke": 0.004, "t_end": 1000.0} for seed in (1, 2)]
    ends = Tables(particles=crystal(1).assign(**point, vx=0.0, vy=fast, T=1.0))
    return Tables({"walls": pd.DataFrame(layers), "kinetic_energy": pd.DataFrame(runs),
                   "snapshots": pd.DataFrame(snapshots.snapshots(ends))})


def test_walls_are_needed_where_particles_reach_them():
    """Where none was turned back none would be lost; one that was may come back by itself."""
    assert verdict("khp95-walls-leakproof", walled(0)) == "fails"
    assert verdict("khp95-images-instead", walled(0, "printed")) == "holds"
    for name, variant in (("khp95-walls-leakproof", "printed-fixed-rows"), ("khp95-images-instead", "printed")):
        found = judged(name, walled(3000, variant))
        assert found["verdict"] == "undecidable" and "0.6 times a particle and run; but a turn is no loss" in found["reason"]


def test_what_rows_carry_is_the_pressure_less_the_impacts():
    """2 m v of 4000 impacts in 1000 units of time on two plates 100 long: 0.02 of P = 1."""
    found = judged("khp95-rows-repel", walled(4000))
    assert found["measured"] == pytest.approx(1 - 2*0.5*4000/(1000*200)) and found["verdict"] == "holds"
    assert verdict("khp95-rows-repel", walled(4000, fast=20.0)) == "fails"


def wild(rows: int, size: float, ends: float = 3.0) -> pd.DataFrame:
    """K(t) of the grid at two high Ra that oscillates by `size` of K until `ends` L^2/eta."""
    t = np.linspace(0, 1, 300)
    runs = [pd.DataFrame({**grid(ra, rows), "seed": 0, "t": t, "t_viscous": ends*t, "ke": 1 + size*np.sin(200*t)})
            for ra in (5e4, 2e5)]
    return pd.concat(runs)


def test_fluctuations_of_the_grid_are_told_from_those_of_the_flow():
    def said(*histories: pd.DataFrame, name: str = "khp95-fluctuate-physical") -> dict:
        return judged(name, Tables({"history": pd.concat(histories)}))
    assert said(wild(50, 0.1), wild(100, 0.01))["verdict"] == "holds"
    assert said(wild(50, 0.1), wild(100, 0.1))["verdict"] == "fails"
    assert "nothing fluctuates" in said(wild(50, 1e-6), wild(100, 1e-6))["reason"]
    assert said(wild(50, 1e-6), name="khp95-grid-fluctuates")["verdict"] == "fails"
    assert said(wild(50, 0.1), name="khp95-grid-fluctuates")["verdict"] == "holds"
    assert "ends at 1 L^2/eta" in said(wild(50, 0.1, ends=1.0), name="khp95-grid-fluctuates")["reason"]


@pytest.mark.parametrize(("shares", "said"), [((0.8, 0.7, 0.1), "holds"), ((0.8, 0.3, 0.1), "holds"), ((0.8, 0.3, 0.6), "")])
def test_the_pressure_that_freezes_is_found_between_two(shares, said):
    """K left at P = 1, 2, 5: the criterion's ratio is 2K/(2 P 0.01045)."""
    names = ("printed", "more-static-100", "more-static-400")
    rows = grids() + [{**particles(5e3, 50, name), "ke": share*0.0034, "ke_err": 1e-7}
                      for name, share in zip(names, shares, strict=True)]
    found = judged("khp95-melting-threshold", means(rows))
    if not said:
        assert "more than once" in found["reason"]
    else:
        ends = [0.0034/0.0104525/P for P in ((2, 5) if shares[1] > 0.5 else (1, 2))]
        assert min(ends) < found["measured"] < max(ends)


# --- what the start and the step decide ---------------------------------------------------------------------------


def started(weak: float, developed: float | None = None, settled: bool = True) -> Tables:
    """5000 particles at Ra 2500 that are left with these shares of the grid's K, from weak rolls and from its flow."""
    shares = {"printed": weak} | ({} if developed is None else {"printed-from-flow": developed})
    points = [({**particles(2500, variant=name), "rolls": 2*(share > 0.1)}, share*straight(2500))
              for name, share in shares.items()] + [({**particles(1e4), "rolls": 2}, 0.8*straight(1e4))]
    runs = pd.concat([seeds(point, (0.99*ke, ke, 1.01*ke), rolls=point["rolls"],
                            converged=settled or point["variant"] == "printed") for point, ke in points])
    return Tables({**means(grids() + [{**point, "ke": ke, "ke_err": 0.01*ke} for point, ke in points]), "kinetic_energy": runs})


@pytest.mark.parametrize(("weak", "developed", "said"), [
    (1e-4, None, "undecidable"), (1e-4, 0.8, "holds"), (0.8, 1e-4, "holds"), (1e-4, 1e-4, "fails"), (1e-4, 0.35, "fails")])
def test_flow_at_2500_is_judged_by_the_start_that_leaves_more(weak, developed, said):
    assert verdict("khp95-ra2500-flows", started(weak, developed)) == said


def test_flow_that_still_changes_may_die():
    half = judged("khp95-ra2500-flows", started(1e-4, 0.8, settled=False))
    assert half["verdict"] == "undecidable" and half["measured"] == half["err"] == pytest.approx(0.8*1.01/2)
    assert verdict("khp95-ra2500-flows", started(1e-4, 0.3, settled=False)) == "fails"
    assert "drifts" in judged("khp95-ra2500-usable", started(1e-4, 0.8, settled=False))["reason"]


def test_fluctuations_are_those_of_the_flowing_state():
    """The same noise, 1e-4, over 0.2 of K at Ra 2500 and over 0.8 of it at Ra 10 000."""
    found = judged("khp95-ra2500-fluctuations", started(1e-4, 0.2))
    assert found["measured"] == pytest.approx(4*straight(1e4)/straight(2500), rel=1e-6) and found["verdict"] == "holds"
    assert verdict("khp95-ra2500-usable", started(1e-4, 0.2)) == "fails"
    assert "variant = printed-from-flow" in judged("khp95-ra2500-fluctuations", started(1e-4))["reason"]


@pytest.mark.parametrize(("whole", "half", "said"), [(0.2, 0.105, "undecidable"), (0.052, 0.05, "holds"), (0.55, 0.5, "fails")])
def test_rattling_is_extrapolated_to_no_step(whole, half, said):
    """Shares of the grid's K that a step and half of it leave; what is extrapolated is the error, too."""
    K = straight(3000)
    rows = [{**particles(3000, 16, name, eos="dense"), "ke": share*K, "ke_err": 0.0, "rolls": 0}
            for name, share in (("printed", whole), ("printed-half-step", half))]
    runs = pd.concat([seeds(row, (row["ke"], row["ke"]), rolls=0) for row in rows])
    tables = Tables({**means([{**grid(3000, eos="dense"), "ke": K, "ke_err": 0.0}, *rows]), "kinetic_energy": runs})
    found = judged("khp95-freeze-static", tables)
    assert found["measured"] == pytest.approx(2*half - whole) and found["verdict"] == said
    assert found["err"] == pytest.approx(math.hypot(whole - half, 1e-3*half*math.sqrt(2), 1e-3*whole/math.sqrt(2)))
    whole_only = Tables({**tables, "kinetic_energy": seeds(rows[0], (K, K), rolls=0)})
    assert "printed-half-step" in judged("khp95-freeze-static", whole_only)["reason"]


# --- trajectories ---------------------------------------------------------------------------------------------------


def test_what_bears_the_weight_is_no_correlation():
    rng = np.random.default_rng(1)
    a, b = rng.standard_normal((2, 4000, 2))
    weight = np.array([0.0, 5.0])
    assert snapshots.correlation(a + weight, a - weight) == pytest.approx(1.0)
    assert abs(snapshots.correlation(a + weight, b + weight)) < 4/math.sqrt(8000)
    assert snapshots.correlation(a + b, a) == pytest.approx(math.sqrt(0.5), abs=4/math.sqrt(8000))
