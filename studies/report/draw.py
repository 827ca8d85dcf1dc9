"""Films: particles beside the grid and K(t) below, drawn from frames and written as an animated AVIF."""
import io
import os
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image as Picture

from studies.kit.figure import COLOURS
from studies.report.frames import Dots, Image

SIZE = (6.4, 3.2)       # inches
DPI = 100
MILLISECONDS = 110      # a frame
HOLD = 1500             # the last one
QUALITY = 35            # of AVIF: dots stay round; a third of WebP that looks alike
BOX = {"xlim": (-1, 1), "ylim": (-0.5, 0.5), "xticks": [], "yticks": [], "aspect": "equal"}


def pages(dots: Sequence[Dots], images: Sequence[Image], times: np.ndarray, titles: tuple[str, str]) -> Iterator[Picture.Image]:
    """One picture a time: particles, the grid, and both K until then."""
    page = Figure(figsize=SIZE, dpi=DPI)
    left, right = page.add_axes((0.012, 0.38, 0.482, 0.54)), page.add_axes((0.506, 0.38, 0.482, 0.54))
    below = page.add_axes((0.115, 0.155, 0.873, 0.19))
    curves = [("of the grid", "black", [one.ke for one in images]), ("of all points", COLOURS[1], [one.ke for one in dots])]
    top = 1.1*max(max(ke) for _, _, ke in curves)
    for number, t in enumerate(times):
        for axes in (left, right, below):
            axes.clear()
        particles(left, dots[number], titles[0])
        flow(right, images[number], titles[1])
        below.set(xlim=(0, times[-1]), ylim=(0, top), ylabel="$K$", xlabel="time  [free-fall times]")
        for label, colour, ke in curves:
            below.plot(times[:number + 1], ke[:number + 1], color=colour, linestyle="-", marker="", label=label)
            below.plot(t, ke[number], color=colour, marker="o", markersize=4)
        below.legend(loc="upper right", ncols=2)
        yield picture(page)


def particles(axes: Axes, dots: Dots, title: str) -> None:
    """A dot for each, by temperature."""
    size = (0.9*72*SIZE[0]*0.482/2)**2*2/len(dots.x)     # nine tenths of the spacing wide
    axes.scatter(dots.x, dots.y, size, dots.T, cmap="inferno", vmin=0.4, vmax=1.6, linewidths=0, marker="o")
    axes.set(title=title, **BOX)
    axes.set_facecolor("#30243a")


def flow(axes: Axes, image: Image, title: str) -> None:
    """Temperature, and arrows along the velocity."""
    axes.imshow(image.T, origin="lower", extent=(-1, 1, -0.5, 0.5), cmap="inferno", vmin=0.4, vmax=1.6, interpolation="bilinear")
    every = (slice(3, None, 6), slice(3, None, 6))
    axes.quiver(*np.meshgrid(image.x[every[1]], image.y[every[0]]), image.vx[every], image.vy[every], color="white", scale=5,
                width=0.004)
    axes.set(title=title, **BOX)


def picture(page: Figure) -> Picture.Image:
    """The page as pixels."""
    full = io.BytesIO()
    page.savefig(full, format="png", dpi=DPI)
    return Picture.open(full).convert("RGB")


def write(path: Path, frames: Sequence[Picture.Image]) -> None:
    """An animated AVIF, all or nothing; the same frames give the same bytes."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name}.{os.getpid()}")
    long = [MILLISECONDS]*(len(frames) - 1) + [HOLD]
    try:
        frames[0].save(part, "avif", save_all=True, append_images=frames[1:], duration=long, quality=QUALITY, speed=6,
                       subsampling="4:2:0", max_threads=1)
        part.write_bytes(undated(part.read_bytes()))
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def undated(film: bytes) -> bytes:
    """Without the times of writing, two of 8 bytes, that heads of a film and its track begin with    [ISO 14496-12, 8.2, 8.3]"""
    head, data = film.split(b"mdat", 1)
    for box in (b"mvhd", b"tkhd", b"mdhd"):
        head = re.sub(rb"(?s)(" + box + rb"\x01...).{16}", rb"\g<1>" + bytes(16), head)
    return head + b"mdat" + data
