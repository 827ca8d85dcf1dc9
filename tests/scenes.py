"""Small scenes that tests share."""
import numpy as np

from continuum.scene import RayleighBenard
from particles.smooth.spam import Spam
from studies.build.spam import PRINTED, Variant, method, start


def rows_of(case, table: str) -> list[dict]:
    """Rows of a case that is run here."""
    return case.run(lambda done: None, None).rows[table]
