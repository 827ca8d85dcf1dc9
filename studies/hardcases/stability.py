"""Where each integrator begins to make small motions grow, from eigenvalues of their rates."""
from math import log

import numpy as np

from particles.integral.covariance import jacobian
from particles.run import Run
from particles.threads import Team

#: R(z) = sum of these times z^n multiplies a motion exp(lambda t) in a step, z = lambda dt
FACTORS = {"ThreeStage": (1, 1, 1/2, 1/6), "RK4": (1, 1, 1/2, 1/6, 1/24)}
NULL = 1e-3             # of the largest eigenvalue: below are motions that the sums do not see, split by round-off
ROUND_OFF = 1e-7        # growth in a step: rates by differences are good to 1e-9 of the fastest
STEPS = np.geomspace(1e-3, 10, 4001)        # times the fastest rate: the first that grows is found to 0.1 %, then refined
HALVINGS = 20


def eigenvalues(method, start: np.ndarray) -> np.ndarray:
    """Of the rates of a method about a state (fields, n), those of motions that its sums see."""
    sums, now = method.start(start.shape[1], Team(1)), Run(state=start.copy(), ids=np.arange(start.shape[1]))
    sums.make_ready(now, 0.0)
    return seen(np.linalg.eigvals(jacobian(sums.rates, now.state)))


def seen(rates: np.ndarray) -> np.ndarray:
    """Without those of motions that the sums do not see."""
    return rates[np.abs(rates) > NULL*np.abs(rates).max()]


def growth(rates: np.ndarray, factors: tuple[float, ...], dt: float) -> float:
    """Largest ln |R| of a step, less what the motion grows by itself."""
    z = rates*dt
    with np.errstate(divide="ignore"):
        size = np.log(np.abs(np.polynomial.polynomial.polyval(z, factors)))
    return float(np.max(size - np.maximum(z.real, 0)))


def largest_step(rates: np.ndarray, integrator: str, least: float = ROUND_OFF) -> float:
    """The step at which motions begin to grow by exp(least) a step; 0 if at all steps."""
    factors, unit = FACTORS[integrator], 1/np.abs(rates).max()
    grows = [growth(rates, factors, dt) > least for dt in STEPS*unit]
    first = int(np.argmax(grows))
    if not any(grows) or first == 0:
        return 0.0 if first == 0 and grows[0] else np.inf
    low, high = STEPS[first - 1]*unit, STEPS[first]*unit
    for _ in range(HALVINGS):
        middle = (low + high)/2
        low, high = (low, middle) if growth(rates, factors, middle) > least else (middle, high)
    return float((low + high)/2)


def visible(times: float, motions: int, steps: int) -> float:
    """ln of the growth a step that makes all noise so many times larger, begun as one of many motions."""
    return log(times*motions**0.5)/steps
