"""Pictures as addresses that hold them: figures as WebP without loss, in as many colours as tell series apart."""
import base64
import io
from pathlib import Path
from typing import Any

import numpy as np
from imageio_ffmpeg import read_frames
from PIL import Image, UnidentifiedImageError

from studies.report.found import NoReport

#: distances in RGB (441 from black to white) below which two colours are one, in turn until the page is light enough; colours
#: of series are 60 apart and more, blends along edges of lines and letters are what is nearer
NEAR = (16, 20, 24)


def opened(path: Path) -> Image.Image:
    """A picture.

    Raises
    ------
    NoReport
        The file is none.
    """
    try:
        return Image.open(path)
    except (UnidentifiedImageError, OSError) as error:
        raise NoReport(f"{path} is no picture ({error}): make figures-{path.parent.name} draws it again") from error


def webp(path: Path, near: float = 0.0) -> str:
    """A PNG as an address; with ``near`` its colours are fewer and it is a third smaller."""
    packed, full = io.BytesIO(), opened(path)
    (fewer(full, near) if near else full).convert("RGB").save(packed, "webp", lossless=True, method=4)
    return address("image/webp", packed.getvalue())


def fewer(picture: Image.Image, near: float) -> Image.Image:
    """Each colour is the nearest of those kept; a colour is kept that lies ``near`` no more frequent one: none moves further."""
    if picture.mode != "P":
        picture = picture.convert("RGB").quantize(256, kmeans=1, dither=Image.Dither.NONE)       # as kit.figure does
    colours = np.reshape(picture.getpalette("RGB") or [], (-1, 3)).astype(float)
    kept: list[int] = []
    for one in np.argsort(-np.array(picture.histogram()[:len(colours)]), kind="stable"):
        if not kept or np.linalg.norm(colours[kept] - colours[one], axis=1).min() > near:
            kept.append(int(one))
    nearest = np.linalg.norm(colours[:, None] - colours[kept], axis=2).argmin(1)
    picture = picture.copy()
    picture.putpalette(colours[kept][nearest].astype(np.uint8).tobytes())
    return picture


def address(kind: str, content: bytes) -> str:
    """An address that holds its content."""
    return f"data:{kind};base64,{base64.b64encode(content).decode()}"


def still(path: Path) -> dict[str, Any]:
    """The last picture of a film, and its size.

    Raises
    ------
    NoReport
        The file is no film.
    """
    try:
        about, *_, last = read_frames(path)
    except (OSError, RuntimeError, ValueError) as error:
        raise NoReport(f"{path} is no film ({str(error).splitlines()[0]}): make films makes it again") from error
    packed = io.BytesIO()
    Image.frombytes("RGB", about["size"], last).save(packed, "webp", quality=60, method=4)
    return {"still": address("image/webp", packed.getvalue()), "size": about["size"]}
