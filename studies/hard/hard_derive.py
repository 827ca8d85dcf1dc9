"""Rows that follow from whole tables of KHP95's hard cases."""
from collections.abc import Iterator
from math import pi, sqrt
from typing import Any

import numpy as np
import pandas as pd

from studies.integral.ordering_derive import line
from studies.kit.table import Tables

#: of moduli over h: 2 pi over the shortest vector of the reciprocal lattice, density 1
PERIODS = {"square": 1.0, "diagonal": 1.0, "hexagonal": sqrt(sqrt(3)/2)}
NARROWEST = 3.0         # range from which on an order is taken
assert abs(PERIODS["hexagonal"] - 2*pi/(4*pi/sqrt(3)/sqrt(2/sqrt(3)))) < 1e-12


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Derived rows of the study."""
    return {"modulus_orders": list(modulus_orders(tables["moduli"]))} if "moduli" in tables else {}


def modulus_orders(rows: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Moduli oscillate as h grows: the order is that of their rms over one period after the other."""
    for (kind, weight), group in rows[rows["h"] >= NARROWEST].groupby(["lattice", "weight"]):
        period = PERIODS[str(kind)]
        number = ((group["h"] - NARROWEST)/period).astype(int)
        whole = [part for _, part in group.groupby(number) if np.ptp(part["h"]) > 0.8*period]
        if len(whole) < 3:
            continue
        size = [float(np.sqrt(np.mean(part["exact"]**2))) for part in whole]
        order, err = line(-np.log([part["h"].mean() for part in whole]), np.log(size))
        yield {"lattice": kind, "weight": weight, "order": order, "order_err": err}
