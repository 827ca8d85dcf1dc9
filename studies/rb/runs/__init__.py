"""What the cases of the study compute."""
from typing import Any

import pandas as pd


def table_rows(key: dict[str, Any], **columns: Any) -> list[dict[str, Any]]:
    """Rows of a table that have one key, from columns of the same length."""
    return [{**key, **row} for row in pd.DataFrame(columns).to_dict("records")]
