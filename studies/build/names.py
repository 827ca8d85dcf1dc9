"""Words and numbers that all cases share; apart from the tables, so that a new column does not run every case again."""
from typing import Any

from continuum.scene import ROLL_ENERGY

START_ENERGY = ROLL_ENERGY
START_JITTER = 0.2     # of the lattice at the start of moving points, in spacings: a perfect one stays frozen in places
HALVES = 0.3           # of K: if halves of the averaging time differ by more, the flow is not steady
EOS_NAMES = {"IdealGas": "ideal", "VanDerWaals": "vdw", "DenseFluid": "dense"}
TRANSPORT_NAMES = {"ConstEta": "const-eta", "ConstNu": "const-nu"}
#: what a row of `kinetic_energy` is there for; not finite where a run diverged
VALUES = ("ke", "ke_err", "ke_field", "ke_field_err", "ke_mean", "ke_mean_err", "ke_fluctuation", "nu", "nu_err")


def one_energy(ke: float, err: float) -> dict[str, float]:
    """The columns of energies where points do not fluctuate: particles, field and mean flow have the same one."""
    return {**dict.fromkeys(("ke", "ke_field", "ke_mean"), ke), **dict.fromkeys(("ke_err", "ke_field_err", "ke_mean_err"), err),
            "ke_fluctuation": 0.0}


def scene_columns(scene: Any) -> dict[str, Any]:
    """The columns of a row that name the scene."""
    return {"eos": EOS_NAMES[type(scene.eos).__name__], "transport": TRANSPORT_NAMES[scene.transport.__name__],
            "sides": type(scene.sides).__name__.lower(), "ra": float(scene.ra), "pr": float(scene.pr)}
