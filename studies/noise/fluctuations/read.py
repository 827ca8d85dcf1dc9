"""Deviations of sampled modes, in standard errors; kinds of noise that are exact."""
import numpy as np
from scipy.special import stdtrit

from studies.kit.ask import Value, of, rows
from studies.kit.stats import Measured
from studies.kit.table import Tables
from studies.noise.fluctuations.sampling import BATCHES

MOMENTA = ("stress", "friction", "stress+friction")
ENERGIES = ("heat", "conduction", "heat+conduction")
EXACT = (*MOMENTA, *ENERGIES)


def z(tables: Tables, table: str) -> np.ndarray:
    """(ratio - 1) of each mode in standard errors."""
    modes = rows(tables, table, "field != 'all'")
    return ((modes["ratio"] - 1)/(modes["ratio_err"]/stdtrit(BATCHES - 1, 0.975))).to_numpy()


def bound(n: int) -> float:
    """Standard errors that n means over batches keep together in 95 % of all cases [Bonferroni]."""
    return float(stdtrit(BATCHES - 1, 1 - 0.025/n))


def largest_deviation(table: str) -> Value:
    """The largest |z| of a table of modes over the bound for as many."""
    def deviation(tables: Tables) -> Measured:
        modes = z(tables, table)
        return Measured(float(np.abs(modes).max()/bound(len(modes))))
    deviation.__doc__ = f"largest |ratio - 1| in standard errors, over the bound for as many modes, in {table}"
    return of(deviation)
