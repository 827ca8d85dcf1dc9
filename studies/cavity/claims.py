"""Printed numbers of the cavity, of de Vahl Davis and of particles, judged by the spectral method."""
from collections.abc import Iterator
from itertools import product
from typing import Any

from continuum.published import published
from studies.cavity.cases import RAS
from studies.kit.ask import Value, largest, last, largest_per, one
from studies.kit.claim import Claim

#: what de Vahl Davis says that his errors are at these Ra, relative (his Table VII)
HIS = dict(zip(RAS, (1e-3, 2e-3, 3e-3, 1e-2)))
OWN: dict[str, Any] = {"source": "de Vahl Davis 1983"}


def exact(ra: float, quantity: str = "nu") -> Value:
    """By the most functions."""
    return last("cavity", "value", by="resolution", method="spectral-boussinesq", ra=ra, quantity=quantity)


def printed_of(id: str, value: Value, share: float, **words: Any) -> Claim:
    """A printed number, with a share of it for its error."""
    number = published(id)
    return Claim(id=id, printed=f"{number.value:.9g}", value=value, expect=number.value,
                 within=share*number.value, **words)


def printed() -> Iterator[Claim]:
    """All of them."""
    for ra, quantity in product(RAS, ("nu", "nu-max", "u-max", "v-max")):
        word = f"{ra:.0e}".replace("+0", "")
        yield printed_of(f"devahldavis-{quantity}-{word}", exact(ra, quantity), HIS[ra],
                         source="de Vahl Davis 1983", because="what his Table VII says of his errors",
                         after="five digits of another spectral solution stood beside the number",
                         statement=f"{quantity} of the cavity at Ra {word}")
    for ra, version in product(RAS, ("nu", "before")):
        word = f"{ra:.0e}".replace("+0", "")
        fit = {"nu": ", walls fitted at each Ra", "before": ", its earlier version"}[version]
        yield printed_of(f"ethersph-{version}-{word}", exact(ra), 0.01, source="EtherSPH.jl 2024",
                         because="1 %, the error at which methods are compared",
                         after="references of three digits stood beside the number",
                         statement=f"Nu of the cavity at Ra {word} by smooth particles{fit}")


CLAIMS = (
    Claim(id="own-cavity-digits", **OWN, at_most=5e-9,
          value=largest("cavity", "err/value", err="0", method="spectral-boussinesq", quantity="nu",
                        resolution=48),
          because="half of the eighth digit of a number that begins with nine",
          statement="Nu of the cavity has eight digits: what the last eight functions change, relative, "
                    "largest of all Ra"),
    Claim(id="own-cavity-limits", **OWN, at_most=1, because="intervals are of 95 %",
          value=largest_per("ra", abs(one("cavity", "value", "resolution == inf", err="0", method="boussinesq")
                                      - last("cavity", "value", by="resolution", err="0", quantity="nu",
                                             method="spectral-boussinesq"))
                            / one("cavity", "err", "resolution == inf", err="0", method="boussinesq")),
          statement="Nu of the cavity lies in the intervals of the staggered grid's limits: distance over "
                    "half of the interval, largest of all Ra"),
    *printed(),
)
