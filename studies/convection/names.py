"""Words and numbers that all cases share; apart from the tables, so that a new column does not run every case again."""
from typing import Any

START_ENERGY = 9/5000  # kinetic energy per mass of the initial rolls [KHP95, Fig. 9]
EOS_NAMES = {"IdealGas": "ideal", "VanDerWaals": "vdw", "DenseFluid": "dense"}
TRANSPORT_NAMES = {"ConstEta": "const-eta", "ConstNu": "const-nu"}



def scene_columns(scene: Any) -> dict[str, Any]:
    """The columns of a row that name the scene."""
    return {"eos": EOS_NAMES[type(scene.eos).__name__], "transport": TRANSPORT_NAMES[scene.transport.__name__],
            "sides": type(scene.sides).__name__.lower(), "ra": float(scene.ra), "pr": float(scene.pr)}
