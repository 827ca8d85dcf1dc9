"""What the cases of the study compute."""
from typing import Any

import pandas as pd


def table_rows(key: dict[str, Any], **columns: Any) -> list[dict[str, Any]]:
    """Rows of a table that have one key, from columns of the same length."""
    frame = pd.DataFrame(columns)
    values = frame.itertuples(index=False, name=None)
    return [{**key, **dict(zip(columns, row, strict=True))} for row in values]
