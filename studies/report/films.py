"""Films of convection at Ra 10 000, particles or points beside the grid at the same times, from weak rolls on.

Each takes about 20 s of CPU and some 170 KB; results/films/films.csv says what is seen, with commit, seed and parameters.
"""
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from continuum.scene import RayleighBenard
from studies.kit.table import merge
from studies.report import draw, frames, tables

RA, GRID_ROWS, SEED = 1e4, 48, 1
#: free-fall times: the first rolls shoot over at 10 and settle at 30
TIMES = np.linspace(0, 32, 41)


class Film(NamedTuple):
    """Points on the left: title and caption, rows of them, and how they are made."""

    name: str
    title: str
    caption: str
    rows: int
    dots: Callable[[RayleighBenard, int, np.ndarray], Iterator[frames.Dots]]


FILMS = {film.name: film for film in (
    Film("particles", "smooth particles [KHP95]", "Smooth particles as Kum, Hoover & Posch print them, mirror images behind the "
         "plates. All of them tremble: their K holds that besides the flow.", 25, frames.smooth_particles),
    Film("closed_faces", "moving points, closed faces", "Points that move and exchange mass, momentum and energy over closed "
         "faces, our own repair of Romero-Rochin & Rubi's moving points.", 25, frames.closed_faces),
    Film("as_printed", "moving points as printed [RR98]", "Points that move with the flow under Romero-Rochin & Rubi's balances "
         "as printed (Eqs 34-36, 39-41), which convect it twice.", 25, frames.printed_motion),
)}


@cache
def beside() -> list[frames.Image]:
    """The grid at all times."""
    return list(frames.grid(RayleighBenard(ra=RA), GRID_ROWS, TIMES))


def make(film: Film, folder: Path) -> dict[str, Any]:
    """Run, draw and write one film; its row of films.csv."""
    scene = RayleighBenard(ra=RA, L=float(film.rows))
    dots, images = list(film.dots(scene, SEED, TIMES)), beside()
    titles = f"{len(dots[0].x)} {film.title}", f"compressible grid, {GRID_ROWS} rows"
    draw.write(folder/f"{film.name}.mp4", list(draw.pages(dots, images, TIMES, titles)))
    return {"film": film.name, "title": film.title, "caption": film.caption, "ra": RA, "rows": film.rows, "seed": SEED,
            "points": len(dots[0].x), "grid_rows": GRID_ROWS, "t_end": TIMES[-1], "frames": len(TIMES),
            "last_ke": dots[-1].ke, "last_ke_grid": images[-1].ke}


def make_all(out: Path, only: str = "") -> list[Path]:
    """The films with this text in their name.

    Raises
    ------
    ValueError
        There are none.
    """
    chosen = [film for name, film in FILMS.items() if only in name]
    if not chosen:
        raise ValueError(f"no film has {only!r} in its name: there are {', '.join(FILMS)}")
    folder = out/"films"
    for film in chosen:
        merge(folder/"films.csv", tables.FILMS, [make(film, folder)], size="fine", command="make films")
    return [folder/f"{film.name}.mp4" for film in chosen]
