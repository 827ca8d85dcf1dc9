"""What the cases of the study `speed` are expected to take:    python -m studies.cost.plan [quick|paper]"""
import sys
from collections.abc import Iterable

import pandas as pd

from studies.kit.case import Case


def planned(cases: Iterable[Case]) -> pd.DataFrame:
    """Label and CPU seconds of each, the dearest first."""
    rows = [{"label": case.label, "seconds": case.cost} for case in cases]
    return pd.DataFrame(rows).sort_values("seconds", ascending=False, ignore_index=True)


if __name__ == "__main__":
    from studies.cost.cases import cases
    plan = planned(cases((*sys.argv[1:], "paper")[0]))
    print(plan.to_string(float_format="%.1f"))
    print(f"{len(plan)} cases, {plan['seconds'].sum()/60:.1f} minutes")
