"""Films: particles beside the grid and K(t) below, drawn from frames and written as MP4."""
import io
import os
from collections.abc import Iterator, Sequence
from fractions import Fraction
from pathlib import Path

import numpy as np
from imageio_ffmpeg import count_frames_and_secs, write_frames
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image as Picture

from studies.kit.figure import COLOURS
from studies.report.frames import Dots, Image

SIZE = (6.4, 3.2)       # inches
DPI = 100
RATE = Fraction(100, 11)    # pictures a second
HOLD = 13               # times more that the last one is shown
#: of H.264, at which dots stay round: tuned for photographs it is a fifth larger; one thread and no versions, so that the
#: bytes are the same again; colours are named in full: browsers darken what is named by half
ENCODING = ("-f", "mp4", "-preset", "placebo", "-tune", "psnr", "-crf", "33", "-threads", "1", "-movflags", "+faststart",
            "-vf", "setparams=color_primaries=bt709:color_trc=bt709,scale=out_color_matrix=bt709",
            "-fflags", "+bitexact", "-flags:v", "+bitexact")
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
    """An MP4, all or nothing; the same frames give the same bytes.

    Raises
    ------
    ValueError
        The encoder failed; an older film stays as it is.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        encode(part, [*frames, *[frames[-1]]*HOLD])
        os.replace(part, path)
    except (OSError, RuntimeError) as error:
        raise ValueError(f"{path} could not be written ({str(error).splitlines()[0]}), ffmpeg tells more above: make room on the "
                         "disk, or set up .venv anew by rm .venv/ready and make env") from error
    finally:
        part.unlink(missing_ok=True)


def encode(path: Path, frames: Sequence[Picture.Image]) -> None:
    """Pictures through ffmpeg, which does not tell that it failed at the end: they are counted."""
    film = write_frames(path, frames[0].size, fps=RATE, codec="libx264", quality=None, output_params=list(ENCODING))
    film.send(None)
    for frame in frames:
        film.send(frame.tobytes())
    film.close()
    if (found := count_frames_and_secs(path)[0]) != len(frames):
        raise RuntimeError(f"it has {found} of {len(frames)} pictures")
