"""EtherSPH.jl's scheme in the cavity, made again from its sources: what heat passes, and what it would print.

    python -m bench.ethersph [--rows 50 100] [--ra 1e3 1e6] [--factor 1] [--until 30]

Weakly compressible smooth particles: Wendland C2 of range 3 spacings, density by continuity, P = c^2 (rho -
1) + 0.02 c^2, an artificial pressure of 1 % between near particles, Morris' friction, Brookshaw's heat, both
with 0.01 h^2 in the denominator; three rows of wall particles at rest, whose conductivity has a factor that
depends on Ra; a force that keeps particles off walls; Shepard's filter of the density every 30 steps.
`heat` is the heat that both heated sides exchange with the fluid, over conduction. `read` is Nu as the code
computes it: the slope between the first two columns of a lattice of smoothed temperatures. Both are means of
ten samples in the last fifth of the run; half widths of their intervals are 2.26 = t(9) times the scatter
over sqrt(10). Writes results/bench/ethersph.csv; takes half a minute a run with 50 rows, five with 100.

Source: github.com/EtherSPH/EtherSPH.jl, commit 29ebcf01, src/SPH/Library/*.jl and
example/natural_convection_cavity; the post-processing in natural_convection_cavity.py, commit 1c5b8f4e.
"""
import argparse
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from scipy.spatial import cKDTree

from continuum.jit import jit
from particles.neighbours import make_lists, sort_into_cells
from particles.threads import Threads
from studies.kit.csvfile import commit, cpu, now, read, versions, write
from studies.kit.key import ROOT
from studies.kit.stats import over_seeds

FILE, KEY = ROOT/"results"/"bench"/"ethersph.csv", ["ra", "rows", "factor"]
PR, RANGE, SOFT, REFILTER, BACKGROUND = 0.71, 3.0, 0.01, 30, 0.02
#: Ra -> speed of sound, factor of the walls' conductivity, time of the run
RUNS = {1e3: (3.0, 0.58, 50.0), 1e4: (3.5, 0.48, 50.0), 1e5: (4.0, 0.36, 50.0), 1e6: (4.5, 0.20, 60.0)}
SKIN = 0.6          # of the neighbour lists, in spacings
WALLS = 3           # rows of wall particles
SAMPLES = 10        # in the last fifth of the run
FLUID, HOT, COLD, CLOSED = range(4)


class Numbers(NamedTuple):
    """Spacing, range, speed of sound, viscosity, diffusivity of a run; factors of friction and heat at walls;
    buoyancy per temperature."""
    a: float
    reach: float
    c: float
    nu: float
    alpha: float
    drag: float
    warmth: float
    lift: float


def numbers(ra: float, rows: int, factor: float) -> Numbers:
    """Numbers of a run; at walls harmonic means with 1000 nu and with factor times the conductivity."""
    a, nu = 1/rows, PR/ra**0.5
    return Numbers(a, RANGE*a, RUNS[ra][0], nu, nu/PR, 2000/1001, 2*factor/(1 + factor), PR)


def placed(rows: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Places (n, 2), kinds (n,), wall normals (n, 2), the fluid first; corners belong to heated sides."""
    at = (np.arange(-WALLS, rows + WALLS) + 0.5)/rows
    x = np.stack(np.meshgrid(at, at, indexing="ij"), axis=-1).reshape(-1, 2)
    side = (x > 1).astype(int) - (x < 0)
    kind = np.select([(side == 0).all(axis=1), side[:, 0] < 0, side[:, 0] > 0], [FLUID, HOT, COLD], CLOSED)
    normal = -side/np.maximum(1.0, np.linalg.norm(side, axis=1))[:, None]
    order = np.argsort(kind, kind="stable")
    return x[order], kind[order], normal[order]


@jit
def value(r, h):
    """W(r) of Wendland's C2 weight of range h, in two dimensions."""
    q = min(r/h, 1.0)
    return 7/(np.pi*h*h)*(1 - q)**4*(1 + 4*q)


@jit
def slope(r, h):
    """dW/dr of the same weight."""
    q = min(r/h, 1.0)
    return -140/(np.pi*h**3)*q*(1 - q)**3


@jit
def continue_density(n, lists, x, v, rho, by, dt):
    """rho += dt m sum (v_i - v_j).grad W over fluid particles, in place."""
    start, length, listed = lists
    for i in range(n):
        total = 0.0
        for k in range(start[i], start[i] + length[i]):
            j = listed[k]
            if j < n:
                dx, dy = x[i, 0] - x[j, 0], x[i, 1] - x[j, 1]
                r = np.sqrt(dx*dx + dy*dy)
                total += ((v[i, 0] - v[j, 0])*dx + (v[i, 1] - v[j, 1])*dy)*slope(r, by.reach)/r
        rho[i] += dt*by.a**2*total


@jit
def filter_density(n, lists, x, rho, by):
    """Shepard's filter, rho = sum m W/sum (m/rho) W over fluid particles, in place."""
    start, length, listed = lists
    new = rho.copy()
    for i in range(n):
        above = value(0.0, by.reach)
        below = above/rho[i]
        for k in range(start[i], start[i] + length[i]):
            j = listed[k]
            if j < n:
                w = value(np.sqrt((x[i, 0] - x[j, 0])**2 + (x[i, 1] - x[j, 1])**2), by.reach)
                above, below = above + w, below + w/rho[j]
        new[i] = above/below
    rho[:] = new


@jit
def rate(n, lists, x, v, rho, T, kind, normal, by, dv, dT, heat):
    """Accelerations dv, rates dT, and the heat that each kind of wall gives to the fluid, over alpha."""
    start, length, listed = lists
    near, soft = value(by.a, by.reach), SOFT*(by.reach/2)**2
    heat[:] = 0.0
    for i in range(n):
        ax, ay, warms = 0.0, by.lift*(T[i] - 0.5), 0.0
        for k in range(start[i], start[i] + length[i]):
            j = listed[k]
            dx, dy = x[i, 0] - x[j, 0], x[i, 1] - x[j, 1]
            r = np.sqrt(dx*dx + dy*dy)
            if r >= by.reach:
                continue
            dw, fluid = slope(r, by.reach), j < n
            p = pressure(rho[i], by)/rho[i]**2 + pressure(rho[j], by)/rho[j]**2
            p += abs(p)*value(r, by.reach)/near*0.01
            push = -by.a**2*p*dw/r
            f = 2*by.a**2*r*dw/(rho[i]*rho[j]*(r*r + soft))
            rub = by.nu*f*(1.0 if fluid else by.drag)
            ax += push*dx + rub*(v[i, 0] - v[j, 0])
            ay += push*dy + rub*(v[i, 1] - v[j, 1])
            if kind[j] != CLOSED:
                gain = f*(1.0 if fluid else by.warmth)*(T[i] - T[j])
                warms += gain
                heat[kind[j]] += gain*by.a**2
            if not fluid:
                off = held_off(dx, dy, r, v[i], normal[j], by)
                ax, ay = ax + off*normal[j, 0], ay + off*normal[j, 1]
        dv[i, 0], dv[i, 1], dT[i] = ax, ay, by.alpha*warms


@jit
def pressure(rho, by):
    """Linear equation of state with a background pressure."""
    return by.c**2*(rho - 1) + BACKGROUND*by.c**2


@jit
def held_off(dx, dy, r, v, normal, by):
    """Repulsive acceleration along the normal of a wall particle    [Rogers & Dalrymple 2008]"""
    psi = abs(dx*normal[0] + dy*normal[1])
    xi, eta = np.sqrt(max(0.0, r*r - psi*psi)), psi/by.a
    if eta > 1 or xi > by.a or eta == 0:
        return 0.0
    along = v[0]*normal[0] + v[1]*normal[1]
    strength = 0.01*by.c**2 + (0.0 if along > 0 else by.c*abs(along))
    return strength*abs(1 - eta)/(np.sqrt(eta)*by.reach/2)*abs(1 + np.cos(np.pi*xi/by.a))/2


def as_read(x: np.ndarray, kind: np.ndarray, T: np.ndarray, rows: int) -> float:
    """Nu as the code has it: slope of T, smoothed by exp(-(2 r/range)^2), from x = 0 to one spacing."""
    y = np.linspace(0, 1, rows + 1)
    known, columns = kind != CLOSED, []
    tree, points, values = cKDTree(x[known]), x[known], T[known]
    for at in (0.0, 1/rows):
        near = tree.query_ball_point(np.stack([np.full_like(y, at), y], axis=1), RANGE/rows)
        weights = [np.exp(-4*((points[js] - [at, here])**2).sum(axis=1)*(rows/RANGE)**2)
                   for here, js in zip(y, near)]
        columns.append([np.average(values[js], weights=w) for js, w in zip(near, weights)])
    return float(np.trapezoid((np.array(columns[0]) - columns[1])*rows, y))


def run(ra: float, rows: int, factor: float, until: float | None = None) -> dict[str, Any]:
    """Run a case to the code's own time or another; return its row. Raises ValueError: Ra is not in RUNS."""
    if ra not in RUNS:
        raise ValueError(f"Ra must be one of {', '.join(f'{known:g}' for known in RUNS)}, got {ra:g}: "
                         "the code has no speed of sound for another")
    by, (x, kind, normal), threads = numbers(ra, rows, factor), placed(rows), Threads(1)
    n, dt = int((kind == FLUID).sum()), 0.1*by.reach/by.c
    v, rho, T = np.zeros_like(x), np.ones(len(x)), np.select([kind == HOT, kind == COLD], [1.0, 0.0], 0.5)
    dv, dT, heat, seen = np.zeros((n, 2)), np.zeros(n), np.zeros(4), list[tuple[float, float]]()
    steps, anchor, lists = round((until or RUNS[ra][2])/dt), np.full_like(x, np.inf), None
    marks = np.linspace(0.8*steps, steps - 1, SAMPLES).astype(int)
    for step in range(steps):
        if not np.abs(x - anchor).max() < SKIN*by.a/2/2**0.5:
            anchor, reach = x.copy(), by.reach + SKIN*by.a
            across, up = x.T.copy()
            lists = make_lists(threads, sort_into_cells(across, up, reach), across, up, reach, 0)
        continue_density(n, lists, x, v, rho, by, dt)
        rate(n, lists, x, v, rho, T, kind, normal, by, dv, dT, heat)
        x[:n] += dt*v[:n] + dt*dt/2*dv
        v[:n] += dt*dv
        T[:n] += dt*dT
        if (step + 1) % REFILTER == 0:
            filter_density(n, lists, x, rho, by)
        if step in marks:
            seen.append(((heat[HOT] - heat[COLD])/2, as_read(x, kind, T, rows)))
    (passed, passed_err), (read, read_err) = (over_seeds(column) for column in np.array(seen).T)
    inside = ((x[:n] > 0) & (x[:n] < 1)).all(axis=1).mean()
    return {"ra": ra, "rows": rows, "factor": factor, "heat": passed, "heat_err": passed_err, "read": read,
            "read_err": read_err, "inside": float(inside), "steps": steps}


def keep(row: pd.DataFrame) -> None:
    """Write a row to the table, in place of an older one of the same case."""
    table = pd.concat([read(FILE), row]) if FILE.exists() else row
    table = table.drop_duplicates(KEY, keep="last").sort_values(KEY)
    write(FILE, table, head=["python -m bench.ethersph", versions(), cpu()])


def main() -> None:
    """Run the cases of the command line, and write each row as it comes."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rows", type=int, nargs="+", default=[50, 100])
    parser.add_argument("--ra", type=float, nargs="+", default=list(RUNS))
    parser.add_argument("--factor", type=float, help="of the walls' conductivity, in place of the code's own")
    parser.add_argument("--until", type=float, help="time of the end, in place of the code's own")
    words = parser.parse_args()
    for rows in words.rows:
        for ra in words.ra:
            row = run(ra, rows, words.factor or RUNS.get(ra, (0, 1.0))[1], words.until)
            print(row, flush=True)
            keep(pd.DataFrame([row | {"commit": commit(), "date": now()}]))


if __name__ == "__main__":
    main()
