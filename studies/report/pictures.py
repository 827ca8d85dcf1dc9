"""Pictures as addresses that hold them: figures in as many colours as tell series apart, films."""
import base64
import io
from pathlib import Path
from typing import Any

import numpy as np
from imageio_ffmpeg import read_frames
from PIL import Image, UnidentifiedImageError

from studies.kit.table import Table
from studies.report.inventory import NoReport, rows_of

#: distance in RGB (441 from black to white) below which two colours are one: those of series are 60 apart and
#: more, nearer are blends along edges of lines and letters
NEAR = 24
#: films.csv says what is seen; films in the order of the page, others follow
FILMS = Table("films", key=["film"], columns=[
    "film", "title", "caption", "ra", "rows", "points", "grid_rows", "t_end", "frames", "last_ke",
    "last_ke_grid"])
ORDER = ("particles", "closed_faces", "as_printed")


def opened(path: Path) -> Image.Image:
    """A picture; NoReport where the file is none."""
    try:
        return Image.open(path)
    except (UnidentifiedImageError, OSError) as error:
        again = f"make figures-{path.parent.name} draws it again"
        raise NoReport(f"{path} is no picture ({error}): {again}") from error


def webp(path: Path) -> str:
    """A PNG as an address, a third smaller by having fewer colours."""
    packed = io.BytesIO()
    fewer(opened(path)).convert("RGB").save(packed, "webp", lossless=True, method=4)
    return address("image/webp", packed.getvalue())


def fewer(picture: Image.Image) -> Image.Image:
    """Each colour becomes the nearest one kept; kept are those that are NEAR no more frequent one."""
    if picture.mode != "P":     # as kit.figure does
        picture = picture.convert("RGB").quantize(256, kmeans=1, dither=Image.Dither.NONE)
    colours = np.reshape(picture.getpalette("RGB") or [], (-1, 3)).astype(float)
    frequent = np.argsort(-np.array(picture.histogram()[:len(colours)]), kind="stable")
    kept: list[int] = []
    for one in frequent:
        if not kept or np.linalg.norm(colours[kept] - colours[one], axis=1).min() > NEAR:
            kept.append(int(one))
    nearest = np.linalg.norm(colours[:, None] - colours[kept], axis=2).argmin(1)
    picture = picture.copy()
    picture.putpalette(colours[kept][nearest].astype(np.uint8).tobytes())
    return picture


def address(kind: str, content: bytes) -> str:
    """An address that holds its content."""
    return f"data:{kind};base64,{base64.b64encode(content).decode()}"


def films(out: Path) -> list[dict[str, Any]]:
    """Films with their last picture and what films.csv says of them; NoReport where one is missing."""
    rows = rows_of(out/"films/films.csv", (*FILMS.columns, "seed", "commit")).to_dict("records")
    made = []
    for row in sorted(rows, key=lambda row: ORDER.index(row["film"]) if row["film"] in ORDER else len(ORDER)):
        path = out/"films"/f"{row['film']}.mp4"
        if not path.exists():
            raise NoReport(f"{path} is missing: make films makes it again")
        content = base64.b64encode(path.read_bytes()).decode()
        made.append({**{str(name): value for name, value in row.items()}, **still(path), "content": content})
    return made


def still(path: Path) -> dict[str, Any]:
    """The last picture of a film, and its size; NoReport where the file is no film."""
    try:
        about, *_, last = read_frames(path)
    except (OSError, RuntimeError, ValueError) as error:
        cause = str(error).splitlines()[0]
        raise NoReport(f"{path} is no film ({cause}): make films makes it again") from error
    packed = io.BytesIO()
    Image.frombytes("RGB", about["size"], last).save(packed, "webp", quality=60, method=4)
    return {"still": address("image/webp", packed.getvalue()), "size": about["size"]}
