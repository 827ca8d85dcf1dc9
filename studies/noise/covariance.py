"""Steady covariances of linear fluctuations about a flow: Lyapunov solves, in time and of steps

    dx = J x dt + B dW, Q = B B^T            J C + C J^* + Q = 0                 [RR98 Eqs 20-25]
    x(t + dt) = A x(t) + noise of variance Q_dt       C = A C A^* + Q_dt                 [RR98 Eq. 40]

What is conserved (rows L with L J = 0, L Q = 0) keeps its value: covariances are those at fixed sums.
"""
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.linalg import null_space, solve_continuous_lyapunov, solve_discrete_lyapunov

from particles.integral.thermal import BETAS, OLD

#: of the size of J: rates above its negative belong to modes that do not decay; differences leave 1e-12
UNDAMPED = 1e-10


def waves(columns: np.ndarray, counts: tuple[int, int], k: float) -> np.ndarray:
    """The block (m ny, m ny) of waves exp(ikx), k per spacing, of a matrix on a lattice uniform along x.

    columns : its (m nx ny, m ny) columns of the points at x = 0, with point (x, y) numbered x ny + y, m
    fields. nx is odd and more than twice the reach of the matrix: then k may be any number.
    """
    nx, ny = counts
    fields = columns.shape[1]//ny
    parts = np.asarray(columns).reshape(fields, nx, ny, fields*ny)
    x = (np.arange(nx) + nx//2) % nx - nx//2
    return np.einsum("fxyc,x->fyc", parts, np.exp(-1j*k*x)).reshape(fields*ny, fields*ny)


def steady(J: np.ndarray, Q: np.ndarray, conserved: np.ndarray | None = None) -> np.ndarray:
    """C with J C + C J^* + Q = 0, at fixed rows `conserved` (q, N). ArithmeticError: no decay."""
    # columns of all that leaves these alone
    Z = np.eye(len(J)) if conserved is None else null_space(conserved)
    J, Q = Z.conj().T@J@Z, Z.conj().T@Q@Z
    check_decay(np.linalg.eigvals(J).real, UNDAMPED*np.abs(J).max())
    C = solve_continuous_lyapunov(J, -Q)
    # once more for what the first solve left
    C += solve_continuous_lyapunov(J, -(Q + J@C + C@J.conj().T))
    return Z@C@Z.conj().T


class Step(NamedTuple):
    """One time step: x becomes A x, and noise of covariance Q is added."""
    A: np.ndarray
    Q: np.ndarray


def steady_of_steps(step: Step, conserved: np.ndarray | None = None) -> np.ndarray:
    """C = A C A^* + Q, at fixed rows `conserved`. Raises ArithmeticError: a mode does not decay."""
    Z = np.eye(len(step.A)) if conserved is None else null_space(conserved)
    A, Q = Z.conj().T@step.A@Z, Z.conj().T@step.Q@Z
    check_decay(np.abs(np.linalg.eigvals(A)) - 1, UNDAMPED)
    C = solve_discrete_lyapunov(A, Q)
    C += solve_discrete_lyapunov(A, Q + A@C@A.conj().T - C)
    return Z@C@Z.conj().T


def check_decay(rates: np.ndarray, least: float) -> None:
    """Refuse modes that grow or stay."""
    if not (worst := rates.max()) < -least:
        raise ArithmeticError(f"{np.count_nonzero(rates >= -least)} modes do not decay, the fastest grows at "
                              f"{worst:.3g}: take a share of transport along edges or an odd number of "
                              "points, edges that close, a smaller step")


def forward_euler(J: np.ndarray, Q: np.ndarray, dt: float) -> Step:
    """x + dt J x + B dW    [RR98 Eq. 40]"""
    return Step(np.eye(len(J)) + dt*J, dt*Q)


def crank_nicolson(J: np.ndarray, Q: np.ndarray, dt: float) -> Step:
    """(1 - dt J/2) x' = (1 + dt J/2) x + B dW: the covariance of continuous time, whatever the step."""
    one = np.eye(len(J))
    inverse = np.linalg.inv(one - dt/2*J)
    return Step(inverse@(one + dt/2*J), dt*inverse@Q@inverse.conj().T)


def three_stage(J: np.ndarray, Q: np.ndarray, dt: float) -> Step:
    """Three Euler steps, averaged; each has the noise W_A + beta W_B of its own beta."""
    one = np.eye(len(J))
    euler, A, of_A, of_B = one + dt*J, one, 0*one, 0*one
    for old, beta in zip(OLD, BETAS, strict=True):
        A = old*one + (1 - old)*euler@A
        of_A, of_B = (1 - old)*(euler@of_A + one), (1 - old)*(euler@of_B + beta*one)
    return Step(A, dt*(of_A@Q@of_A.conj().T + of_B@Q@of_B.conj().T))


STEPS: dict[str, Callable[[np.ndarray, np.ndarray, float], Step]] = {
    "forward-euler": forward_euler, "crank-nicolson": crank_nicolson, "three-stage": three_stage}
