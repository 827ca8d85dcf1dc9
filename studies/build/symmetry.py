"""The symmetric part of a flow seen on a regular grid of places: what flows, told from noise."""
import numpy as np

from studies.kit.stats import Measured

Fields = dict[str, np.ndarray]


def upright(at: Fields) -> Fields:
    """The same periodic flow with the crest of the first harmonic of vy at column 0: rolls may lie anywhere along x."""
    columns = at["vy"].shape[1]
    shift = np.angle(np.fft.rfft(at["vy"].mean(axis=0))[1])
    turn = np.exp(-1j*shift*np.arange(columns//2 + 1))
    return {name: np.fft.irfft(np.fft.rfft(f, axis=1)*turn, columns, axis=1) for name, f in at.items()}


def mirrored(at: Fields) -> Fields:
    """The flow seen in a mirror at column 0, which does not change two equal rolls."""
    return {name: (-1 if name == "vx" else 1)*np.roll(f[:, ::-1], 1, axis=1) for name, f in at.items()}


def turned(at: Fields) -> Fields:
    """The flow turned by half a circle, which does not change one roll in a box; density is left where it is."""
    return {name: -f[::-1, ::-1] if name in ("vx", "vy") else f for name, f in at.items()}


def flowing(at: Fields, periodic: bool) -> Measured:
    """Kinetic energy per mass of mean velocities (rows, columns), fields rho, vx, vy: what flows, noise averaged out.

    The part that two rolls between periodic sides, or one roll in a box, have by symmetry. All that is not symmetric is in the
    error: noise, of which the symmetric part holds as much, and in a box what compressibility does. If rolls wander while
    velocities are averaged, it is a lower bound.
    """
    at = upright(at) if periodic else at
    other = mirrored(at) if periodic else turned(at)
    even, odd = (0.5*float(np.mean(at["rho"]*sum(((at[name] + sign*other[name])/2)**2 for name in ("vx", "vy"))))
                 /float(np.mean(at["rho"])) for sign in (1, -1))
    return Measured(even, odd)
