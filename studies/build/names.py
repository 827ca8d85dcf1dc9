"""Constants, column values, numbers printed in KHP95, and a plot axis that studies of convection share."""
from typing import Any

from continuum.published import published
from continuum.scene import ROLL_ENERGY
from studies.kit.figure import width

START_ENERGY = ROLL_ENERGY
START_JITTER = 0.2     # displacement at the start, in spacings: parts of a perfect lattice stay frozen
HALVES = 0.3           # a flow is not steady if K of both halves of the average differs by more, relative
EOS_NAMES = {"IdealGas": "ideal", "VanDerWaals": "vdw", "DenseFluid": "dense"}
TRANSPORT_NAMES = {"ConstEta": "const-eta", "ConstNu": "const-nu"}
#: result columns of `kinetic_energy`, not finite where a run diverged
VALUES = ("ke", "ke_err", "ke_field", "ke_field_err", "ke_mean", "ke_mean_err", "ke_fluctuation",
          "nu", "nu_err")
ENERGY = r"kinetic energy per mass $K$  [$\varepsilon/m$]"
#: least distance of two numbers above an axis  [inches]
LABEL = 0.42
#: Rayleigh numbers to label on an axis, the rounder ones first
NAMED = (10000, 5000, 2500, 20000, 1500, 3500, 1e5, 2000, 7000, 50000)


def one_energy(ke: float, err: float) -> dict[str, float]:
    """Energy columns of a method without noise: particles, field and mean flow have the same K."""
    columns = {"ke_fluctuation": 0.0}
    for name in ("ke", "ke_field", "ke_mean"):
        columns |= {name: ke, f"{name}_err": err}
    return columns


def scene_columns(scene: Any) -> dict[str, Any]:
    """Columns that identify the scene."""
    eos, transport = type(scene.eos).__name__, scene.transport.__name__
    return {"eos": EOS_NAMES.get(eos, eos), "transport": TRANSPORT_NAMES.get(transport, transport),
            "sides": type(scene.sides).__name__.lower(), "ra": float(scene.ra), "pr": float(scene.pr)}


def number(key: str) -> float:
    """A number printed in KHP95."""
    return published(f"khp95-{key}").value


def as_printed(key: str) -> dict[str, Any]:
    """Accepted range of a printed number: its value, and the uncertainty of its last digit or wording."""
    value = published(f"khp95-{key}")
    return {"expect": value.value, "within": value.uncertainty}


def ra_axis(axes: Any) -> None:
    """Label an axis by Ra^-1/2 below and Ra above: the rounder ones first, others where there is room."""
    low, high = axes.get_xlim()
    scale = width(axes)/(high - low)
    shown: list[float] = []
    for ra in NAMED:
        inches = [scale*abs(ra**-0.5 - other**-0.5) for other in shown]
        if low < ra**-0.5 < high and all(gap > LABEL for gap in inches):
            shown.append(ra)
    top = axes.secondary_xaxis("top")
    top.set_xticks([ra**-0.5 for ra in shown], labels=[f"{ra:g}" for ra in shown])
    top.tick_params(labelsize=8)
    top.set_xlabel("Rayleigh number Ra")
    axes.set_xlabel(r"$\mathrm{Ra}^{-1/2}$")
