"""Printed numbers of the cavity, of de Vahl Davis and of particles, judged by the spectral method and by what
`bench.ethersph` makes again."""
from collections.abc import Iterator
from typing import Any

from continuum.published import published
from studies.cavity.cases import RAS
from studies.kit.ask import Value, bench, largest, largest_per, last, one
from studies.kit.claim import Claim

#: Ra in names of claims
NAMES = dict(zip(RAS, ("1e3", "1e4", "1e5", "1e6")))
#: his own errors, relative: Table VII of de Vahl Davis 1983 as the notes on Datum Flow 0.1.3 quote it
HIS = dict(zip(RAS, (1e-3, 2e-3, 3e-3, 1e-2)))
HIS_PAPER: dict[str, Any] = {"source": "de Vahl Davis 1983"}
LIMIT: dict[str, Any] = {"such": "resolution == inf", "err": "0", "method": "boussinesq"}
ETHERSPH: dict[str, Any] = {"source": "EtherSPH.jl 2024"}
ASIDE: dict[str, Any] = {**ETHERSPH, "share": 0.01, "because": "1 %, the error at which methods are compared"}
VERSIONS = {"nu": ", walls fitted at each Ra", "before": ""}
#: what is read of runs made again
AGAIN = {"read": "as the code reads it", "heat": "as the heat that the sides pass"}


def exact(**where: Any) -> Value:
    """By the most functions."""
    return last("cavity", "value", by="resolution", err="err", method="spectral-boussinesq", **where)


def printed(key: str, value: Value, share: float = 0.0, unit: str = "", id: str = "", **words: Any) -> Claim:
    """A printed number, with a share of it for its error, else its uncertainty."""
    number = published(key)
    return Claim(id=id or key, printed=f"{number.value:.9g}{unit}", value=value, expect=number.value,
                 within=share*number.value or number.uncertainty, **words)


def at(ra: float, name: str) -> Iterator[Claim]:
    """All printed numbers of one Ra, and EtherSPH's runs made again: 100 rows, the code's own walls."""
    nu, cavity = exact(ra=ra, quantity="nu"), f"nu of the cavity at Ra {ra:g}"
    for quantity in ("nu", "nu-max", "u-max", "v-max"):
        yield printed(f"devahldavis-{quantity}-{name}", exact(ra=ra, quantity=quantity), HIS[ra], **HIS_PAPER,
                      because="what his Table VII says of his errors",
                      after="five digits of another spectral solution stood beside the number",
                      statement=f"{quantity} of the cavity at Ra {ra:g}")
    for version, words in VERSIONS.items():
        yield printed(f"ethersph-{version}-{name}", nu, **ASIDE,
                      after="references of three digits stood beside the number",
                      statement=f"{cavity} by smooth particles{words}")
        theirs = published(f"ethersph-{version}-{name}").value
        yield printed(f"ethersph-error-{version}-{name}", 100*abs(theirs/nu - 1), **ETHERSPH, unit=" %",
                      because="half of the last digit of the references there",
                      after="the printed and the spectral Nu were known",
                      statement=f"error of {cavity}, in %, by smooth particles{words}")
    for column in (1, 3):
        yield printed(f"ethersph-reference-{column}-{name}", nu, **ETHERSPH,
                      because="half of the last digit", after="the spectral number was known",
                      statement=f"{cavity} by reference {column}, from which errors of smooth particles are "
                                "taken")
    for way, words in AGAIN.items():
        yield printed(f"ethersph-nu-{name}", bench(one("ethersph", way, "factor < 1", ra=ra, rows=100)),
                      **ASIDE, id=f"ethersph-{way}-{name}", evidence="bench/ethersph.csv",
                      after="runs with 50 rows and those at Ra 1e3 and 1e6 had been seen",
                      statement=f"nu at Ra {ra:g} with 100 rows made again, {words}")


CLAIMS = (
    Claim(id="own-cavity-digits", **HIS_PAPER, at_most=5e-9,
          value=largest("cavity", "err/value", err="0", method="spectral-boussinesq", quantity="nu",
                        resolution=48),
          because="half of the eighth digit of a number that begins with nine",
          statement="Nu of the cavity has eight digits: what the last eight functions change, relative, "
                    "largest of all Ra"),
    Claim(id="own-cavity-limits", **HIS_PAPER, at_most=1, because="intervals are of 95 %",
          value=largest_per("ra", abs(one("cavity", "value", **LIMIT) - exact(quantity="nu"))
                            / one("cavity", "err", **LIMIT)),
          statement="Nu of the cavity lies in the intervals of the limits of staggered grids of 32 to 96 "
                    "rows: distance over half of the interval, largest of all Ra"),
    *(claim for ra, name in NAMES.items() for claim in at(ra, name)),
)
