"""Traces of the friction of dissipative particles, against the whole matrix; what long runs judge."""
import numpy as np
import pandas as pd
import pytest

from particles.dissipative.dpd import Dpd
from particles.run import Run
from particles.threads import Team
from studies.noise.dpd.friction import over, traces
from studies.noise.dpd.long import asked, off, over_verlet
from studies.noise.fluctuations.special import blocks, neighbours


def test_traces_are_those_of_the_matrix():
    method = Dpd(box=(3.0, 3.0, 3.5))
    state, w, e = neighbours(method)
    n, Lambda = state.shape[1], method.gamma*blocks(w**2, e)
    sums = method.start(n, Team(1))
    sums.resume(Run(state=state, ids=np.arange(n), step=0))
    assert traces(sums, state) == pytest.approx([np.trace(Lambda)/(3*n), np.trace(Lambda@Lambda)/(3*n)], rel=1e-12)


def test_readings_of_the_tables():
    key = {"a": 25.0, "rho": 3.0, "d": 3, "kT": 1.0}
    tables = {"errors": pd.DataFrame([{**key, "integrator": "TwoStep", "temperature": "kinetic", "linear": 1.2,
                                       "linear_err": 0.1}]),
              "friction": pd.DataFrame([{**key, "n": 192, "still": 0.6, "mixed": 1.2}]),
              "long": pd.DataFrame([{**key, "integrator": "KickDriftFrictionDriftKick", "dt": 0.02, "kinetic": 0.99,
                                     "kinetic_err": 0.002, "P": 23.65, "P_err": 0.01}]),
              "states": pd.DataFrame([{**key, "integrator": name, "dt": 0.06, "configurational": 1 + off_by,
                                       "configurational_err": 0.003}
                                      for name, off_by in (("KickDriftFrictionDriftKick", -0.03), ("Shardlow", 0.12))])}
    assert over("still")(tables) == pytest.approx((2, 1/6))
    assert over("mixed")(tables) == pytest.approx((1, 1/12))
    assert asked(tables) == (23.65, 0.01)

    class KickDriftFrictionDriftKick:
        """Only its name counts."""
    assert off("kinetic", KickDriftFrictionDriftKick)(tables) == pytest.approx((0.01, 0.002))
    assert over_verlet(tables) == pytest.approx((0.25, np.hypot(0.003, 0.25*0.003)/0.12))
