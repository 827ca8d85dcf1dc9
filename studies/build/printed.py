"""Numbers that KHP95 prints, for claims."""
from continuum.published import published


def number(key: str) -> float:
    """A number printed in KHP95."""
    return published(f"khp95-{key}").value


def as_printed(key: str) -> dict[str, float]:
    """Accepted range of a printed number: its value and what its last digit, or its words, leave open."""
    value = published(f"khp95-{key}")
    return {"expect": value.value, "within": value.uncertainty}
