"""What the cases of the study compute."""
from typing import Any

import pandas as pd


def table_rows(key: dict[str, Any], **columns: Any) -> list[dict]:
    """Rows of a table that have one key, from columns of the same length."""
    return pd.DataFrame(key | columns).to_dict("records")
