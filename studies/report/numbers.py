"""Numbers as people read them."""
import math


def with_error(value: float, err: float) -> str:
    """17.5(15) for 17.5 +- 1.5: the error in units of the last digit, two of its digits where the first is 1.

    Without an error four digits.
    """
    if not math.isfinite(value):
        return "none"
    if not 0 < err < math.inf:
        return signed(f"{value:.4g}")
    size = math.floor(math.log10(err))
    digits = 2 if err/10**size < 2 else 1
    places = max(0, digits - 1 - size)
    if places >= 8:
        return signed(f"{value:.3g} ± {err:.1g}")
    last = round(err*10**places)
    return signed(f"{value:.{places}f}({last})")


def signed(text: str) -> str:
    """With the sign that type has for minus."""
    return text.replace("-", "−")


def short(value: object) -> str:
    """A cell of a table."""
    if isinstance(value, bool) or not isinstance(value, float | int):
        return str(value)
    if math.isnan(value):
        return ""
    return signed(f"{value:.5g}").replace("inf", "∞")
