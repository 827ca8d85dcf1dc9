"""Films of convection at Ra 10 000: points beside the grid at equal times, from weak rolls on, K(t) below.

Each takes about 20 s of CPU and some 170 KB; results/films/films.csv says what is seen, with commit and seed.
"""
import io
import os
from collections.abc import Iterator, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image as Picture

from continuum.gas.fields import NodeFields, initial
from continuum.gas.solve import run as march
from continuum.scene import RayleighBenard
from continuum.steady import Time
from particles.fields import Fields, kinetic_energy
from particles.plan import Plan
from particles.run import run
from studies.build import ready
from studies.build.names import START_ENERGY
from studies.kit.figure import COLOURS
from studies.kit.table import merge
from studies.report.page import FILMS, ffmpeg

FFMPEG = ffmpeg()   # it is missed before minutes of computing
RA, GRID_ROWS, ROWS, SEED = 1e4, 48, 25, 1
#: free-fall times: the first rolls shoot over at 10 and settle at 30
TIMES = np.linspace(0, 32, 41)
OF_FIRST = 0.6      # of the limit of the step at the start: it falls as the flow grows
SIZE, DPI = (6.4, 3.2), 100     # inches
RATE = Fraction(100, 11)    # pictures a second
HOLD = 13               # times more that the last one is shown
#: of H.264, at which dots stay round: tuned for photographs it is a fifth larger; one thread and no versions:
#: the bytes are the same again; colours are named in full: browsers darken what is named by half
ENCODING = ("-f", "mp4", "-preset", "placebo", "-tune", "psnr", "-crf", "33", "-threads", "1", "-movflags",
            "+faststart", "-vf",
            "setparams=color_primaries=bt709:color_trc=bt709,scale=out_color_matrix=bt709",
            "-fflags", "+bitexact", "-flags:v", "+bitexact")
BOX: dict[str, Any] = {
    "xlim": (-1, 1), "ylim": (-0.5, 0.5), "xticks": [], "yticks": [], "aspect": "equal"}
HEAT: dict[str, Any] = {"cmap": "inferno", "vmin": 0.4, "vmax": 1.6}
#: a line that ends in a dot
TRACE: dict[str, Any] = {"linestyle": "-", "marker": "o", "markersize": 4, "markevery": [-1]}
#: fields of the grid and their K
Flow = tuple[NodeFields, float]


class Dots(NamedTuple):
    """Points at one time: places over L (n, 2), temperatures (n,), K per mass."""
    x: np.ndarray
    T: np.ndarray
    ke: float


def points(name: str, scene: RayleighBenard, times: np.ndarray) -> Iterator[Dots]:
    """A run of a method from each of `times` to the next, in free-fall times, in steps that divide these."""
    made = ready(scene, name, SEED)
    method = made.method
    state = made.start
    between = (times[1] - times[0])*scene.L/scene.free_fall
    steps = int(np.ceil(between/min(made.dt, OF_FIRST*made.limit)))
    plan = Plan(dt=between/steps, steps=steps)
    yield seen(method.fields(state), scene)
    for _ in times[1:]:
        state = run(method, state, plan).by_id()
        yield seen(method.fields(state), scene)


def seen(fields: Fields, scene: RayleighBenard) -> Dots:
    """What is drawn of the fields of points."""
    return Dots(fields.x/scene.L, fields.T, kinetic_energy(fields))


def grid(scene: RayleighBenard, rows: int, times: np.ndarray) -> Iterator[Flow]:
    """The compressible grid at `times`, equally far apart from 0 on, in free-fall times, and its K."""
    fields = initial(scene, rows, START_ENERGY)
    between = (times[1] - times[0])*scene.L/scene.free_fall
    yield fields, START_ENERGY
    for _ in times[1:]:
        solution = march(scene, rows, until=Time(between, 1), start=fields)
        fields = solution.fields
        yield fields, solution.ke


def pages(dots: Sequence[Dots], grids: Sequence[Flow], times: np.ndarray,
          titles: tuple[str, str]) -> Iterator[Picture.Image]:
    """One picture a time: points, the grid, and both K until then."""
    page = Figure(figsize=SIZE, dpi=DPI)
    left = page.add_axes((0.012, 0.38, 0.482, 0.54))
    right = page.add_axes((0.506, 0.38, 0.482, 0.54))
    below = page.add_axes((0.115, 0.155, 0.873, 0.19))
    ke = [one.ke for one in dots]
    grid_ke = [energy for _, energy in grids]
    top = 1.1*max(*grid_ke, *ke)
    for number in range(len(times)):
        for axes in page.axes:
            axes.clear()
        draw_points(left, dots[number], titles[0])
        draw_grid(right, grids[number][0], titles[1])
        now = slice(number + 1)
        below.set(xlim=(0, times[-1]), ylim=(0, top), ylabel="$K$", xlabel="time  [free-fall times]")
        below.plot(times[now], grid_ke[now], color="black", label="of the grid", **TRACE)
        below.plot(times[now], ke[now], color=COLOURS[1], label="of all points", **TRACE)
        below.legend(loc="upper right", ncols=2)
        yield picture(page)


def draw_points(axes: Axes, dots: Dots, title: str) -> None:
    """A dot for each, nine tenths of the spacing wide, coloured by temperature."""
    spacing = 72*SIZE[0]*0.482/2*np.sqrt(2/len(dots.x))
    area = (0.9*spacing)**2
    axes.scatter(dots.x[:, 0], dots.x[:, 1], s=area, c=dots.T, linewidths=0, marker="o", **HEAT)
    axes.set(title=title, **BOX)
    axes.set_facecolor("#30243a")


def draw_grid(axes: Axes, fields: NodeFields, title: str) -> None:
    """Temperature, and arrows along the velocity."""
    at = fields.at
    axes.imshow(at.T, origin="lower", extent=(-1, 1, -0.5, 0.5), interpolation="bilinear", **HEAT)
    every = slice(3, None, 6)
    nodes = every, every
    x, y = np.meshgrid(fields.x[every], fields.y[every])
    L = fields.scene.L
    axes.quiver(x/L, y/L, at.vx[nodes], at.vy[nodes], color="white", scale=5, width=0.004)
    axes.set(title=title, **BOX)


def picture(page: Figure) -> Picture.Image:
    """The page as pixels."""
    full = io.BytesIO()
    page.savefig(full, format="png", dpi=DPI)
    return Picture.open(full).convert("RGB")


def write(path: Path, frames: Sequence[Picture.Image]) -> None:
    """An MP4, all or nothing; the same frames give the same bytes.

    Raises ValueError: the encoder failed; an older film stays as it is.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        encode(part, [*frames, *[frames[-1]]*HOLD])
        os.replace(part, path)
    except (OSError, RuntimeError) as error:
        cause = str(error).splitlines()[0]
        raise ValueError(f"{path} could not be written ({cause}), ffmpeg says more above: make room on the "
                         "disk, or install ffmpeg anew by rm .venv/ready-films and make films") from error
    finally:
        part.unlink(missing_ok=True)


def encode(path: Path, frames: Sequence[Picture.Image]) -> None:
    """Pictures through ffmpeg, which does not say that it failed at the end: they are counted."""
    film = FFMPEG.write_frames(path, frames[0].size, fps=RATE, codec="libx264", quality=None,
                               output_params=list(ENCODING))
    film.send(None)
    for frame in frames:
        film.send(frame.tobytes())
    film.close()
    written = FFMPEG.count_frames_and_secs(path)[0]
    if written != len(frames):
        raise RuntimeError(f"it has {written} of {len(frames)} pictures")


#: method -> what is seen
CAPTIONS = {
    "spam": "Smooth particles as Kum, Hoover & Posch print them, mirror images behind the plates. All of "
            "them tremble: their K holds that besides the flow.",
    "moving": "Points that move and exchange mass, momentum and energy over closed faces, our own repair of "
              "Romero-Rochin & Rubi's moving points.",
    "moving-literal": "Points that move with the flow under Romero-Rochin & Rubi's balances as printed "
                      "(Eqs 34-36, 39-41), which convect it twice.",
}


def make(name: str, grids: Sequence[Flow], path: Path) -> dict[str, Any]:
    """Run, draw and write one film; its row of films.csv."""
    scene = RayleighBenard(ra=RA, L=float(ROWS))
    dots = list(points(name, scene, TIMES))
    titles = f"{name}, {ROWS} rows", f"grid, {GRID_ROWS} rows"
    write(path, list(pages(dots, grids, TIMES, titles)))
    return {"method": name, "caption": CAPTIONS[name], "ra": RA, "rows": ROWS, "seed": SEED,
            "grid_rows": GRID_ROWS, "t_end": TIMES[-1], "last_ke": dots[-1].ke, "last_ke_grid": grids[-1][1]}


def make_all(out: Path) -> list[Path]:
    """All films, each put into films.csv as soon as it is there."""
    folder = out/"films"
    grids = list(grid(RayleighBenard(ra=RA), GRID_ROWS, TIMES))
    paths = {name: folder/f"{name}.mp4" for name in CAPTIONS}
    for name, path in paths.items():
        row = make(name, grids, path)
        merge(folder/"films.csv", FILMS, [row], size="fine", command="make films")
    return list(paths.values())
