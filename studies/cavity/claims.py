"""Printed numbers of the cavity, of de Vahl Davis and of particles, judged by the spectral method and by what
`bench.ethersph` makes again."""
from collections.abc import Iterator
from itertools import product
from typing import Any

from continuum.published import published
from studies.cavity.cases import RAS
from studies.kit.ask import Value, bench, largest, largest_per, last, one
from studies.kit.claim import Claim

#: his own errors, relative: Table VII of de Vahl Davis 1983 as the notes on Datum Flow 0.1.3 quote it
HIS = dict(zip(RAS, (1e-3, 2e-3, 3e-3, 1e-2)))
OWN: dict[str, Any] = {"source": "de Vahl Davis 1983"}
LIMIT: dict[str, Any] = {"such": "resolution == inf", "err": "0", "method": "boussinesq"}
ETHERSPH: dict[str, Any] = {"source": "EtherSPH.jl 2024"}
ASIDE: dict[str, Any] = {"because": "1 %, the error at which methods are compared"}
VERSIONS = {"nu": ", walls fitted at each Ra", "before": ""}


def exact(**where: Any) -> Value:
    """By the most functions."""
    return last("cavity", "value", by="resolution", err="err", method="spectral-boussinesq", **where)


def printed_of(name: str, ra: float, quantity: str, share: float = 0.0, **words: Any) -> Claim:
    """A printed number, with a share of it for its error, else its uncertainty."""
    id = f"{name}-{ra:.0e}".replace("+0", "")
    number = published(id).value
    share = share or published(id).uncertainty/number
    return Claim(id=id, printed=f"{number:.9g}", value=exact(ra=ra, quantity=quantity), expect=number,
                 within=share*number, **words)


def printed() -> Iterator[Claim]:
    """All of them."""
    for ra, quantity in product(RAS, ("nu", "nu-max", "u-max", "v-max")):
        yield printed_of(f"devahldavis-{quantity}", ra, quantity, HIS[ra], source="de Vahl Davis 1983",
                         because="what his Table VII says of his errors",
                         after="five digits of another spectral solution stood beside the number",
                         statement=f"{quantity} of the cavity at Ra {ra:g}")
    for ra, (version, words) in product(RAS, VERSIONS.items()):
        yield printed_of(f"ethersph-{version}", ra, "nu", 0.01, **ETHERSPH, **ASIDE,
                         after="references of three digits stood beside the number",
                         statement=f"nu of the cavity at Ra {ra:g} by smooth particles{words}")


    for ra, column in product(RAS, (1, 3)):
        yield printed_of(f"ethersph-reference-{column}", ra, "nu", **ETHERSPH,
                         because="half of the last digit", after="the spectral number was known",
                         statement=f"nu of the cavity at Ra {ra:g} by reference {column}, from which errors "
                                   "of smooth particles are taken")


def errors() -> Iterator[Claim]:
    """What EtherSPH says of its errors."""
    for ra, (version, words) in product(RAS, VERSIONS.items()):
        name = f"{version}-{ra:.0e}".replace("+0", "")
        nu, error = published(f"ethersph-{name}").value, published(f"ethersph-error-{name}")
        yield Claim(id=f"ethersph-error-{name}", **ETHERSPH, printed=f"{error.value:.9g} %",
                    value=100*abs(nu/exact(ra=ra, quantity="nu") - 1), expect=error.value,
                    within=error.uncertainty, because="half of the last digit of the references there",
                    after="the printed and the spectral Nu were known",
                    statement=f"error of nu of the cavity at Ra {ra:g}, in %, by smooth particles{words}")


def again(name: str, ra: float) -> Value:
    """A number of the printed run, 100 rows with the code's own walls, made again."""
    return bench(one("ethersph", name, "factor < 1", ra=ra, rows=100))


def made_again() -> Iterator[Claim]:
    """What EtherSPH's scheme reads, and what heat its sides pass."""
    ways = {"read": "as the code reads it", "heat": "as the heat that the sides pass"}
    for ra, (name, words) in product(RAS, ways.items()):
        key = f"{ra:.0e}".replace("+0", "")
        number = published(f"ethersph-nu-{key}").value
        yield Claim(id=f"ethersph-{name}-{key}", **ETHERSPH, **ASIDE, printed=f"{number:.9g}",
                    value=again(name, ra), expect=number, within=0.01*number,
                    evidence="bench/ethersph.csv",
                    after="runs with 50 rows and those at Ra 1e3 and 1e6 had been seen",
                    statement=f"nu at Ra {ra:g} with 100 rows made again, {words}")


CLAIMS = (
    Claim(id="own-cavity-digits", **OWN, at_most=5e-9,
          value=largest("cavity", "err/value", err="0", method="spectral-boussinesq", quantity="nu",
                        resolution=48),
          because="half of the eighth digit of a number that begins with nine",
          statement="Nu of the cavity has eight digits: what the last eight functions change, relative, "
                    "largest of all Ra"),
    Claim(id="own-cavity-limits", **OWN, at_most=1, because="intervals are of 95 %",
          value=largest_per("ra", abs(one("cavity", "value", **LIMIT) - exact(quantity="nu"))
                            / one("cavity", "err", **LIMIT)),
          statement="Nu of the cavity lies in the intervals of the limits of staggered grids of 32 to 96 "
                    "rows: distance over half of the interval, largest of all Ra"),
    *printed(), *errors(), *made_again(),
)
