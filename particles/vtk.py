"""Files that ParaView opens: particles as points, fields as an image."""
from pathlib import Path
from xml.etree import ElementTree as Xml

import numpy as np


def _array(parent: Xml.Element, name: str, values: np.ndarray, kind: str = "Float64") -> None:
    components = "1" if values.ndim == 1 else str(values.shape[1])
    element = Xml.SubElement(parent, "DataArray", type=kind, Name=name, NumberOfComponents=components,
                             format="ascii")
    element.text = " ".join(f"{v:.9g}" for v in values.ravel())


def _vectors(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)


def write_particles(path: Path, state: np.ndarray, **fields: np.ndarray) -> None:
    """State (5, n) = x, y, vx, vy, e and further fields (n,) as PolyData (.vtp)."""
    n = state.shape[1]
    root = Xml.Element("VTKFile", type="PolyData", version="1.0", byte_order="LittleEndian")
    piece = Xml.SubElement(Xml.SubElement(root, "PolyData"), "Piece", NumberOfPoints=str(n),
                           NumberOfVerts=str(n))
    data = Xml.SubElement(piece, "PointData")
    _array(data, "v", _vectors(state[2], state[3]))
    for name, values in {"e": state[4], **fields}.items():
        _array(data, name, values)
    _array(Xml.SubElement(piece, "Points"), "Points", _vectors(state[0], state[1]))
    vertices = Xml.SubElement(piece, "Verts")
    _array(vertices, "connectivity", np.arange(n), "Int64")
    _array(vertices, "offsets", np.arange(1, n + 1), "Int64")
    Xml.ElementTree(root).write(path)


def write_grid(path: Path, x: np.ndarray, y: np.ndarray, fields: dict[str, np.ndarray]) -> None:
    """Fields (rows, columns) on a regular grid x, y as ImageData (.vti); v from vx and vy."""
    rows, columns = x.shape
    extent = f"0 {columns - 1} 0 {rows - 1} 0 0"
    root = Xml.Element("VTKFile", type="ImageData", version="1.0", byte_order="LittleEndian")
    image = Xml.SubElement(root, "ImageData", WholeExtent=extent, Origin=f"{x[0, 0]} {y[0, 0]} 0",
                           Spacing=f"{x[0, 1] - x[0, 0]} {y[1, 0] - y[0, 0]} 1")
    data = Xml.SubElement(Xml.SubElement(image, "Piece", Extent=extent), "PointData")
    _array(data, "v", _vectors(fields["vx"], fields["vy"]))
    for name, values in fields.items():
        if name not in ("vx", "vy"):
            _array(data, name, values.ravel())
    Xml.ElementTree(root).write(path)
