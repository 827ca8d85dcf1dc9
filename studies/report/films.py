"""Films of convection at Ra 10 000, from weak rolls on: points beside the grid at equal times, K(t) below.

A film takes about 20 s of CPU and has 170 KB; results/films/films.csv has its caption, commit and seed.
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
from matplotlib.tri import Triangulation
from PIL import Image as Picture

from continuum.gas.fields import NodeFields, initial, interpolate
from continuum.gas.solve import run as march
from continuum.scene import RayleighBenard
from continuum.steady import Time
from particles.fields import kinetic_energy
from particles.integral.points import lattice
from particles.plan import Plan
from particles.run import run
from particles.threads import Threads
from studies.build import ready
from studies.build.names import START_ENERGY
from studies.kit.figure import COLOURS
from studies.kit.table import merge
from studies.report.page import ffmpeg
from studies.report.tables import FILMS

FFMPEG = ffmpeg()   # here, so that it fails before minutes of computing
RA, GRID_ROWS, ROWS, SEED = 1e4, 48, 25, 1
#: times of pictures [free-fall times]: the first rolls overshoot at 10 and settle at 30
TIMES = np.linspace(0, 32, 41)
OF_FIRST = 0.6      # time step over its limit at the start, which falls as the flow grows
SIZE, DPI = (6.4, 3.2), 100     # SIZE in inches
RATE = Fraction(100, 11)    # pictures per second
HOLD = 13               # how often the last picture is repeated
#: H.264 at which dots stay round (tuned for photographs, files are a fifth larger). One thread and no version
#: strings give the same bytes each time; all colour tags are set, as browsers darken films that lack some
ENCODING = ("-f", "mp4", "-preset", "placebo", "-tune", "psnr", "-crf", "33", "-threads", "1", "-movflags",
            "+faststart", "-vf",
            "setparams=color_primaries=bt709:color_trc=bt709,scale=out_color_matrix=bt709",
            "-fflags", "+bitexact", "-flags:v", "+bitexact")
BOX: dict[str, Any] = {
    "xlim": (-1, 1), "ylim": (-0.5, 0.5), "xticks": [], "yticks": [], "aspect": "equal"}
HEAT: dict[str, Any] = {"cmap": "inferno", "vmin": 0.4, "vmax": 1.6}
#: style of a line that ends in a dot
TRACE: dict[str, Any] = {"linestyle": "-", "marker": "o", "markersize": 4, "markevery": [-1]}
NONE = np.empty(0, int)
BLOB = -0.25, 0.2, 0.15     # centre and radius of the disc that is marked at the start, over L
MARK: dict[str, Any] = {"s": 6, "color": "#40e0ff", "edgecolors": "black", "linewidths": 0.4}


class Flow(NamedTuple):
    """Fields of the grid, their K, and marks (m, 2) over L that move with the flow."""
    fields: NodeFields
    ke: float
    blob: np.ndarray


class Dots(NamedTuple):
    """Points at one time: positions over L (n, 2), temperatures (n,), K, and ids (n,), which may be empty."""
    x: np.ndarray
    T: np.ndarray
    ke: float
    ids: np.ndarray


def points(name: str, scene: RayleighBenard, times: np.ndarray) -> list[Dots]:
    """Points of a run at equidistant `times` [free-fall times], with time steps that divide the intervals."""
    made = ready(scene, name, SEED)
    method, start, _ = made
    between = (times[1] - times[0])*scene.L/scene.free_fall
    steps = int(np.ceil(between/min(made.dt, OF_FIRST*made.limit)))
    frames = []

    def look(sums: Any, state: np.ndarray) -> float:
        at = method.fields(state)
        frames.append(Dots(at.x/scene.L, at.T, kinetic_energy(at), getattr(sums, "ids", NONE)))
        return frames[-1].ke

    sums = method.start(start.shape[1], Threads(1))
    look(sums, start)
    run(method, start, Plan(dt=between/steps, steps=steps*(len(times) - 1), every=steps, series={"ke": look}))
    return frames


def grid(scene: RayleighBenard, rows: int, times: np.ndarray) -> Iterator[Flow]:
    """The compressible grid at equidistant `times` from 0 on [free-fall times]: fields, K, marks."""
    fields, marks = initial(scene, rows, START_ENERGY), lattice((2*ROWS, ROWS)).x/ROWS
    blob = marks[in_disc(marks)]
    between = (times[1] - times[0])*scene.L/scene.free_fall
    yield Flow(fields, START_ENERGY, blob)
    for _ in times[1:]:
        solution = march(scene, rows, until=Time(between, 1), start=fields)
        blob = taken_along(blob, fields, solution.fields, between)
        fields = solution.fields
        yield Flow(fields, solution.ke, blob)


def in_disc(x: np.ndarray) -> np.ndarray:
    """Whether positions over L (n, 2) are in the disc that is marked at the start, (n,)."""
    return np.hypot(x[:, 0] - BLOB[0], x[:, 1] - BLOB[1]) < BLOB[2]


def taken_along(blob: np.ndarray, one: NodeFields, other: NodeFields, time: float, parts=16) -> np.ndarray:
    """Marks after a time, by the midpoint rule, in a flow that changes linearly between two fields."""
    def velocity(x: np.ndarray, part: float) -> np.ndarray:
        both = [interpolate(at, *(x*at.scene.L).T) for at in (one, other)]
        first, last = (np.stack([at.vx, at.vy], axis=1)/one.scene.L for at in both)
        return (1 - part)*first + part*last
    for step in range(parts):
        middle = blob + time/parts/2*velocity(blob, step/parts)
        blob = blob + time/parts*velocity(middle, (step + 0.5)/parts)
    return blob - [2, 0]*np.rint(blob/[2, 1])


def pages(dots: Sequence[Dots], grids: Sequence[Flow], times: np.ndarray,
          titles: tuple[str, str]) -> Iterator[Picture.Image]:
    """One picture per time: points, the grid, and K of both up to then."""
    page = Figure(figsize=SIZE, dpi=DPI)
    left = page.add_axes((0.012, 0.38, 0.482, 0.54))
    right = page.add_axes((0.506, 0.38, 0.482, 0.54))
    below = page.add_axes((0.115, 0.155, 0.873, 0.19))
    ke = [one.ke for one in dots]
    grid_ke = [flow.ke for flow in grids]
    top = 1.1*max(*grid_ke, *ke)
    for number in range(len(times)):
        for axes in page.axes:
            axes.clear()
        marked = len(dots[0].ids) > 0
        (draw_triangles if marked else draw_points)(left, dots[number], titles[0])
        draw_grid(right, grids[number].fields, titles[1])
        if marked:
            tagged = np.isin(dots[number].ids, dots[0].ids[in_disc(dots[0].x)])
            left.scatter(*dots[number].x[tagged].T, **MARK)
            right.scatter(*grids[number].blob.T, **MARK)
        now = slice(number + 1)
        below.set(xlim=(0, times[-1]), ylim=(0, top), ylabel="$K$", xlabel="time  [free-fall times]")
        below.plot(times[now], grid_ke[now], color="black", label="of the grid", **TRACE)
        below.plot(times[now], ke[now], color=COLOURS[1], label="of all points", **TRACE)
        below.legend(loc="upper right", ncols=2)
        yield picture(page)


def draw_points(axes: Axes, dots: Dots, title: str) -> None:
    """Draw each point as a dot, nine tenths of the spacing wide, coloured by temperature."""
    spacing = 72*SIZE[0]*0.482/2*np.sqrt(2/len(dots.x))
    area = (0.9*spacing)**2
    axes.scatter(dots.x[:, 0], dots.x[:, 1], s=area, c=dots.T, linewidths=0, marker="o", **HEAT)
    axes.set(title=title, **BOX)
    axes.set_facecolor("#30243a")


def draw_triangles(axes: Axes, dots: Dots, title: str) -> None:
    """Draw temperature on a triangulation of the points, without triangles across periodic sides."""
    triangles = Triangulation(*dots.x.T)
    axes.tripcolor(triangles, dots.T, shading="gouraud", **HEAT)
    axes.triplot(triangles, color="white", linewidth=0.25, alpha=0.5)
    axes.set(title=title, **BOX)


def draw_grid(axes: Axes, fields: NodeFields, title: str) -> None:
    """Draw temperature, and velocity as arrows."""
    at = fields.at
    axes.imshow(at.T, origin="lower", extent=(-1, 1, -0.5, 0.5), interpolation="bilinear", **HEAT)
    every = slice(3, None, 6)
    nodes = every, every
    x, y = np.meshgrid(fields.x[every], fields.y[every])
    L = fields.scene.L
    axes.quiver(x/L, y/L, at.vx[nodes], at.vy[nodes], color="white", scale=5, width=0.004)
    axes.set(title=title, **BOX)


def picture(page: Figure) -> Picture.Image:
    """The figure as an RGB image."""
    full = io.BytesIO()
    page.savefig(full, format="png", dpi=DPI)
    return Picture.open(full).convert("RGB")


def write(path: Path, frames: Sequence[Picture.Image]) -> None:
    """Write an MP4, all or nothing; the same frames give the same bytes.

    Raises ValueError: the encoder failed; an older film stays as it is.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        film = FFMPEG.write_frames(part, frames[0].size, fps=RATE, codec="libx264", quality=None,
                                   output_params=list(ENCODING))
        film.send(None)
        for frame in [*frames, *[frames[-1]]*HOLD]:
            film.send(frame.tobytes())
        film.close()
        written = FFMPEG.count_frames_and_secs(part)[0]
        if written != len(frames) + HOLD:       # ffmpeg reports no failure at the end, such as a full disk
            raise RuntimeError(f"it has {written} of {len(frames) + HOLD} pictures")
        os.replace(part, path)
    except (OSError, RuntimeError) as error:
        cause = str(error).splitlines()[0]
        raise ValueError(f"{path} could not be written ({cause}), ffmpeg says more above: make room on the "
                         "disk, or install ffmpeg anew by rm .venv/ready-films and make films") from error
    finally:
        part.unlink(missing_ok=True)


#: method -> caption
CAPTIONS = {
    "moving-delaunay": "Points that move with their Delaunay triangulation. What was a disc at the start is "
                       "marked: the same points on the left, marks in the flow of the grid on the right.",
    "spam": "Smooth particles as Kum, Hoover & Posch print them, mirror images behind the plates. All of "
            "them tremble: their K holds that besides the flow.",
    "moving": "Points that move and exchange mass, momentum and energy over closed faces, our own repair of "
              "Romero-Rochin & Rubi's moving points.",
    "moving-literal": "Points that move with the flow under Romero-Rochin & Rubi's balances as printed "
                      "(Eqs 34-36, 39-41), which convect it twice.",
}


def make(name: str, grids: Sequence[Flow], path: Path) -> dict[str, Any]:
    """Run, draw and write one film; return its row of films.csv."""
    scene = RayleighBenard(ra=RA, L=float(ROWS))
    dots = points(name, scene, TIMES)
    titles = f"{name}, {ROWS} rows", f"grid, {GRID_ROWS} rows"
    write(path, list(pages(dots, grids, TIMES, titles)))
    return {"method": name, "caption": CAPTIONS[name], "ra": RA, "rows": ROWS, "seed": SEED,
            "grid_rows": GRID_ROWS, "t_end": TIMES[-1], "last_ke": dots[-1].ke, "last_ke_grid": grids[-1].ke}


def make_all(out: Path) -> list[Path]:
    """Make all films, entering each into films.csv as soon as it is written; return their files."""
    folder = out/"films"
    grids = list(grid(RayleighBenard(ra=RA), GRID_ROWS, TIMES))
    paths = {name: folder/f"{name}.mp4" for name in CAPTIONS}
    for name, path in paths.items():
        row = make(name, grids, path)
        merge(folder/"films.csv", FILMS, [row], size="fine", command="make films")
    return list(paths.values())
