"""Small scenes that tests share."""



def rows_of(case, table: str) -> list[dict]:
    """Rows of a case that is run here."""
    return case.run(lambda done: None, None).rows[table]
