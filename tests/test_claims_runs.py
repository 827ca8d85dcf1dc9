"""Claims on what happens to runs: divergence, time step, plates and walls, fluctuations, freezing; tables by hand."""
import math

import numpy as np
import pandas as pd
import pytest

from studies.convection.claims.read import grid, particles
from studies.kit.table import Tables
from tests.claim_tables import crystal, grids, judged, means, verdict


def test_a_run_that_diverged_has_no_energy():
    """Its row is in kinetic_energy, without numbers; means leaves it out."""
    rows = grids() + [{**particles(1e4), "ke": 0.0048, "ke_err": 1e-7}]
    lost = pd.DataFrame([{**particles(ra), "seed": 1, "ke": math.nan, "t_end": 12.0, "rolls": 0} for ra in (1e4, 5e4)])
    tables = Tables({**means(rows), "kinetic_energy": lost})
    assert "diverged" in judged("khp95-energy-error-10000", tables)["reason"]
    assert verdict("khp95-robust", tables) == "fails"
    none = Tables({**tables, "kinetic_energy": lost[:0]})
    assert "kinetic_energy has no row" in judged("khp95-robust", none)["reason"]
    paper = lost.assign(**grid(1e4, 48, "paper-form"), mass_drift=math.nan)
    assert "grid diverged" in judged("khp95-ghost-density-mass", Tables({"kinetic_energy": paper}))["reason"]


@pytest.mark.parametrize(("change", "said"), [(0.01, "holds"), (0.1, "fails")])
def test_half_of_the_step_is_compared_at_all_rayleigh_numbers_that_flow(change, said):
    both = [{**particles(ra, 25, name), "ke": ke, "ke_err": 0.001*ke}
            for name, changed in (("printed", 0), ("printed-half-step", change))
            for ra, ke in ((2500.0, 1e-6*(1 + 9*changed)), (5e3, 0.003), (1e4, 0.0045*(1 - changed)))]
    tables = with_runs(both)
    assert verdict("own-half-step-25", tables) == said
    assert judged("own-half-step-25", tables)["err"] == pytest.approx(0.001*math.sqrt(2/3), rel=0.02)     # three seeds
    assert verdict("own-half-step-50", tables) == "undecidable"
    assert "where little flows" in judged("own-half-step-25", with_runs(both[3:4]))["reason"]


def with_runs(points: list[dict]) -> Tables:
    """Three seeds of each point with its K, one more that diverged, one in another flow; in `means` a larger error."""
    seeds = [{"seed": seed} for seed in (1, 2, 3)] + [{"seed": 4, "ke": math.nan}, {"seed": 5, "rolls": 4, "ke": 1.0}]
    runs = pd.DataFrame([{**point, "rolls": 2, "ke_field": 0.9*point["ke"], "ke_field_err": 0.9*point["ke_err"], **seed}
                         for point in points for seed in seeds])
    return Tables({**means([{**point, "ke_err": point["ke"]} for point in points]), "kinetic_energy": runs})


@pytest.mark.parametrize(("rolls", "steady", "said"), [(1, False, "holds"), (2, True, "fails"), (2, False, "undecidable")])
def test_two_rolls_that_still_change_are_no_answer(rolls, steady, said):
    row = {**grid(7e3, 32, "two-rolls", sides="walls"), "ke": 0.001, "rolls": rolls, "converged": steady, "t_end": 9000.0}
    assert verdict("khp95-one-roll-square", Tables({"kinetic_energy": pd.DataFrame([row])})) == said


def test_what_smoothing_takes_is_told_from_what_is_lost():
    """The weight leaves 0.9 of K, the particles' field has 0.8: half of the loss is smoothing, 1/9 is left."""
    rows = grids() + [{**particles(ra), "ke": 0.8*0.0034, "ke_err": 1e-8} for ra in (5e3, 1e4)]
    smoothed = [{**grid(5e3, 48), "weight": weight, "h": 3.0, "rows": height, "ke": 0.0036, "ke_smoothed": share*0.0036}
                for weight, height, share in (("Lucy", 50, 0.9), ("Lucy", 25, 0.5), ("WendlandC2", 50, 0.4))]
    tables = Tables({**means(rows), "smoothed": pd.DataFrame(smoothed)})
    assert judged("own-smoothed-5000", tables)["measured"] == pytest.approx(1/9)
    assert judged("own-smoothing-share-5000", tables)["measured"] == pytest.approx(0.5)
    assert "not smoothed at Ra 10000" in judged("own-smoothed-10000", tables)["reason"]


@pytest.mark.parametrize(("lower", "said"), [(1.801, "holds"), (1.9, "fails")])
def test_plates_must_exchange_what_the_layer_carries(lower, said):
    runs = [{**particles(1e4), "seed": seed, "ke": 0.0045, "nu": 1.8 + 0.01*seed} for seed in (1, 2, 3)]
    walls = [{**particles(1e4), "seed": seed, "plate": plate, "nu_plate": nu + 0.01*seed}
             for seed in (1, 2, 3) for plate, nu in (("lower", lower), ("upper", 1.8))]
    tables = Tables({"kinetic_energy": pd.DataFrame(runs), "walls": pd.DataFrame(walls)})
    assert verdict("own-nusselt-plates-10000", tables) == said
    old = Tables({**tables, "walls": tables["walls"].drop(columns="nu_plate")})
    assert "without its column nu_plate" in judged("own-nusselt-plates-10000", old)["reason"]


def walled(reflections: int, variant: str = "printed-fixed-rows", fast: float = 0.5) -> Tables:
    """Two seeds, 1000 units of time, density 1 and T = 1 at both plates; the fastest particle has speed `fast`."""
    point = particles(1e4, variant=variant)
    layers = [{**point, "seed": seed, "plate": plate, "rho_layer": 1.0, "T_layer": 1.0, "reflections": reflections}
              for seed in (1, 2) for plate in ("lower", "upper")]
    runs = [{**point, "seed": seed, "ke": 0.004, "t_end": 1000.0} for seed in (1, 2)]
    return Tables({"walls": pd.DataFrame(layers), "kinetic_energy": pd.DataFrame(runs),
                   "particles": crystal(1).assign(**point, vx=0.0, vy=fast)})


def test_walls_are_needed_where_particles_reach_them():
    assert verdict("khp95-walls-leakproof", walled(3000)) == "holds"
    assert verdict("khp95-walls-leakproof", walled(0)) == "fails"
    assert verdict("khp95-images-instead", walled(3000, "printed")) == "fails"
    assert verdict("khp95-images-instead", walled(0, "printed")) == "holds"


def test_what_rows_carry_is_the_pressure_less_the_impacts():
    """2 m v of 4000 impacts in 1000 units of time on two plates 100 long: 0.02 of P = 1."""
    found = judged("khp95-rows-repel", walled(4000))
    assert found["measured"] == pytest.approx(1 - 2*0.5*4000/(1000*200)) and found["verdict"] == "holds"
    assert verdict("khp95-rows-repel", walled(4000, fast=20.0)) == "fails"


def wild(rows: int, size: float, ends: float = 3.0) -> pd.DataFrame:
    """K(t) of the grid at Ra 50 000 that oscillates by `size` of K until `ends` L^2/eta."""
    t = np.linspace(0, 1, 300)
    return pd.DataFrame({**grid(5e4, rows), "seed": 0, "t": t, "t_viscous": ends*t, "ke": 1 + size*np.sin(200*t),
                         "ke_field": 1.0})


def test_fluctuations_of_the_grid_are_told_from_those_of_the_flow():
    def said(*histories: pd.DataFrame, name: str = "khp95-fluctuate-physical") -> dict:
        return judged(name, Tables({"history": pd.concat(histories)}))
    assert said(wild(50, 0.1), wild(100, 0.01))["verdict"] == "holds"
    assert said(wild(50, 0.1), wild(100, 0.1))["verdict"] == "fails"
    assert "nothing fluctuates" in said(wild(50, 1e-6), wild(100, 1e-6))["reason"]
    assert said(wild(50, 1e-6), name="khp95-grid-fluctuates")["verdict"] == "fails"
    assert said(wild(50, 0.1), name="khp95-grid-fluctuates")["verdict"] == "holds"
    assert "ends at Ra 50000 and 1 L^2/eta" in said(wild(50, 0.1, ends=1.0), name="khp95-grid-fluctuates")["reason"]


@pytest.mark.parametrize(("shares", "said"), [((0.8, 0.7, 0.1), "holds"), ((0.8, 0.3, 0.1), "holds"), ((0.8, 0.3, 0.6), "")])
def test_the_pressure_that_freezes_is_found_between_two(shares, said):
    """K left at P = 1, 2, 5: the criterion's ratio is 2K/(2 P 0.01045)."""
    names = ("printed", "more-static-100", "more-static-400")
    rows = grids() + [{**particles(5e3, 25, name), "ke": share*0.0034, "ke_err": 1e-7}
                      for name, share in zip(names, shares, strict=True)]
    found = judged("khp95-melting-threshold", means(rows))
    if not said:
        assert "more than once" in found["reason"]
    else:
        ends = [0.0034/0.0104525/P for P in ((2, 5) if shares[1] > 0.5 else (1, 2))]
        assert min(ends) < found["measured"] < max(ends)
