"""Results of one study, made up, from which the page is made."""
import math
from functools import cache
from pathlib import Path

import pandas as pd
from PIL import Image

from studies.kit.claim import COLUMNS
from studies.kit.csvfile import write
from studies.kit.store import RESULTS
from studies.report.inventory import Folder, folders

LAYER = {"eos": "ideal", "transport": "const-eta", "sides": "periodic", "pr": 1}


def errors() -> pd.DataFrame:
    """Made-up errors: a grid and a lattice of second order, particles that get worse."""
    rows = []
    for n in (16, 25, 50):
        for method, variant, energy, error, cpu in (("compressible", "flux-form", "Kp", 7/n**2, 1e-4*n**3),
                                                    ("spam", "printed", "Kg", -0.1 - 0.002*n, 1e-2*n**3),
                                                    ("spam", "printed", "Kp", 0.3 - 0.01*n, 1e-2*n**3),
                                                    ("dih", "fixed-lattice", "Kp", 12/n**2, 1e-3*n**3)):
            rows.append({"method": method, "variant": variant, **LAYER, "ra": 1e4, "resolution": n,
                         "energy": energy, "particles": 2*n**2, "ke": 0.005*(1 + error), "ke_err": 5e-7,
                         "reference": 0.005, "reference_err": 0.0, "error": error, "error_err": 1e-4,
                         "cpu_s": cpu, "size": "fine", "commit": "abc1234567"})
    return pd.DataFrame(rows)


def claims() -> pd.DataFrame:
    rows = [("toy-one", "KHP95 Sec. V", "one is one", "paper", "1", 1.0, 0.01, 0.9, 1.1, "holds", "why",
             "rb"),
            ("toy-two", "RR98 Eq. 42", "two is one", "paper", "1", 2.0, 0.0, 0.9, 1.1, "fails", "why", "rb"),
            ("toy-three", "RR98 Eq. 42", "three <b>& more", "own", "", math.nan, math.nan, math.nan, math.nan,
             "undecidable", "not run", "rb")]
    return pd.DataFrame(rows, columns=[name for name in COLUMNS[:-4] if name != "fixed"]).assign(
        fixed="before", formula="one(y) in rows", equation="", headline="", evidence="")


@cache
def committed() -> list[Folder]:
    """Studies with the committed tables, read once."""
    return folders(RESULTS)


def one_study(out: Path) -> Path:
    """Results of one study: a table, a figure, three claims."""
    write(out/"rb/errors.csv", errors(), head=["commit abc1234567"])
    write(out/"claims.csv", claims(), head=["commit abc1234567"])
    Image.new("RGB", (200, 100), "white").save(out/"rb/toy.png")
    return out
