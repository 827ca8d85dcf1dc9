"""Words and numbers that studies of convection share, those that KHP95 prints among them."""
from typing import Any

from continuum.published import published
from continuum.scene import ROLL_ENERGY

START_ENERGY = ROLL_ENERGY
START_JITTER = 0.2     # of points at the start, in spacings: a perfect lattice stays frozen in places
HALVES = 0.3           # of K: if halves of the averaging time differ by more, the flow is not steady
EOS_NAMES = {"IdealGas": "ideal", "VanDerWaals": "vdw", "DenseFluid": "dense"}
TRANSPORT_NAMES = {"ConstEta": "const-eta", "ConstNu": "const-nu"}
#: what a row of `kinetic_energy` is there for; not finite where a run diverged
VALUES = ("ke", "ke_err", "ke_field", "ke_field_err", "ke_mean", "ke_mean_err", "ke_fluctuation",
          "nu", "nu_err")


def one_energy(ke: float, err: float) -> dict[str, float]:
    """Energies where points do not fluctuate: particles, field and mean flow have the same one."""
    columns = {"ke_fluctuation": 0.0}
    for name in ("ke", "ke_field", "ke_mean"):
        columns |= {name: ke, f"{name}_err": err}
    return columns


def scene_columns(scene: Any) -> dict[str, Any]:
    """The columns of a row that name the scene."""
    eos, transport = type(scene.eos).__name__, scene.transport.__name__
    return {"eos": EOS_NAMES.get(eos, eos), "transport": TRANSPORT_NAMES.get(transport, transport),
            "sides": type(scene.sides).__name__.lower(), "ra": float(scene.ra), "pr": float(scene.pr)}


def number(key: str) -> float:
    """A number printed in KHP95."""
    return published(f"khp95-{key}").value


def as_printed(key: str) -> dict[str, Any]:
    """Accepted range of a printed number: its value and what its last digit, or its words, leave open."""
    value = published(f"khp95-{key}")
    return {"expect": value.value, "within": value.uncertainty}
