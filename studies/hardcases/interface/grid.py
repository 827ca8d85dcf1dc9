"""The shocked interface on the compressible grid: what is its growth without particles?    [KHP95, Sec. VI, Fig. 11]

The scene of `interface` at the printed size beside its mirror image, so that the resting mirror lies inside of a box without
plates. A centred grid takes a shock only with viscosity that spreads it over some cells: eta = k, ever less of it, and what it
takes from the growth falls like its square root, as a layer's of diffusing vorticity does. The interface is a row of markers that
go with the flow.
"""
from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil, pi
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from scipy.ndimage import map_coordinates

from continuum.fluid import ConstEta, IdealGas
from continuum.gas.fields import block, placed
from continuum.gas.loop import VX, VY, FluxForm
from continuum.gas.solve import March, limits
from continuum.scene import Tile
from studies.build.read import select
from studies.hardcases.interface.runs import BELOW, HEAVY, HEIGHT, LIGHT, WIDTH, impulse
from studies.kit.case import Case, Outcome, Report
from studies.kit.claim import CannotTell, Claim
from studies.kit.stats import Measured
from studies.kit.study import Part
from studies.kit.table import Table, Tables
from studies.lattices.claims import finest
from studies.lattices.derive import ripple

K = 2*pi/WIDTH
SOFT = 1.5          # cells over which the gases pass into each other
MARKERS = 64
OF_LIMIT = 0.6      # the step: the gas behind the shock is hotter
LOOKS = 60
#: eta and cells in a spacing; the second pair tells what cells do
GRIDS = ((0.2, 4), (0.1, 4), (0.1, 8), (0.05, 8))
STEEP, GENTLE = 0.25, 0.05

KEY = ["steep", "eta", "cells"]
#: mean height and amplitude of the markers, in the units of the table `ripples` of scale 1
RIPPLES = Table("ripples_grid", key=[*KEY, "time"], columns=[*KEY, "time", "height", "amplitude"])
#: over those of impulsive theory, as in `ripple_growth`
GROWTH = Table("ripple_growth_grid", key=KEY, columns=[*KEY, "kick", "kick_err", "growth", "growth_err"])


@dataclass(frozen=True, kw_only=True)
class GridInterface(Case):
    """One run. steep : k a before the shock. eta : viscosity and conductivity. cells : in a spacing of the printed size."""
    eta: float
    cells: int
    steep: float = STEEP

    @property
    def cost(self) -> float:
        return 0.12*self.cells**3

    @property
    def label(self) -> str:
        return f"Interface on the grid, k a {self.steep:g}, eta {self.eta:g}, {self.cells} cells"

    def run(self, report: Report, folder: Path) -> Outcome:
        theory, tile = impulse(1.0, self.steep), Tile(width=WIDTH, L=2*HEIGHT, eos=IdealGas(), law=ConstEta(self.eta, self.eta))
        first = March(tile, block(placed(tile, round(tile.L*self.cells), self.start)), FluxForm(), 1.0).S    # fills the ghosts
        every = ceil(theory.back/(OF_LIMIT*limits(tile, first).both)/LOOKS)
        march = March(tile, first, FluxForm(), theory.back/LOOKS/every)
        x = ((np.arange(MARKERS) + 0.5)/MARKERS - 0.5)*WIDTH
        at, rows = np.array([BELOW + self.steep/K*np.cos(K*x), x]), []
        for look in range(LOOKS):
            for _ in range(every):
                before = self.velocity(march.S, at)
                march.go(1)
                at = at + march.dt*(before + self.velocity(march.S, at + march.dt*before))/2
            y, x = at
            rows.append({"steep": self.steep, "eta": self.eta, "cells": self.cells, "time": march.t, "height": float(y.mean()),
                         "amplitude": float(2*np.mean((y - y.mean())*np.cos(K*x)))})
            report((look + 1)/LOOKS)
        return Outcome({RIPPLES.name: rows})

    def start(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, ...]:
        """Both gases fall onto y = 0 and away from the far sides."""
        def step(s: np.ndarray) -> np.ndarray:
            return np.tanh(s*self.cells/SOFT)
        height, fall = np.abs(y), impulse(1.0, self.steep).fall
        rho = LIGHT.rho + (HEAVY.rho - LIGHT.rho)*(1 + step(height - BELOW - self.steep/K*np.cos(K*x)))/2
        return rho, 0*x, -fall*step(y)*step(HEIGHT - height), LIGHT.P/rho

    def velocity(self, S: np.ndarray, at: np.ndarray) -> np.ndarray:
        """(v_y, v_x) at places (y, x), linear between nodes."""
        places = (at + np.array([[HEIGHT], [WIDTH/2]]))*self.cells
        return np.array([map_coordinates(S[f, 1:-1, 1:-1], places, order=1, mode="grid-wrap") for f in (VY, VX)])


def cases(size: str) -> Iterator[Case]:
    """With ever less viscosity; a small ripple."""
    if size != "quick":
        yield from (GridInterface(eta=eta, cells=cells) for eta, cells in GRIDS)
        yield GridInterface(eta=GRIDS[1][0], cells=GRIDS[1][1], steep=GENTLE)


def derive(tables: Tables) -> dict[str, list[dict[str, Any]]]:
    """Kick and growth of each run."""
    found: list[dict[str, Any]] = []
    for _, one in tables.get(RIPPLES.name, pd.DataFrame(columns=KEY)).groupby(KEY):
        key = {name: one[name].iloc[0] for name in KEY}
        kick, _, growth = ripple(one.sort_values("time"), impulse(1.0, float(key["steep"])))
        found.append({**key, "kick": kick[0], "kick_err": kick[1], "growth": growth[0], "growth_err": growth[1]})
    return {GROWTH.name: found} if found else {}


def inviscid(tables: Tables) -> Measured:
    """Growth without viscosity over the impulsive one, linear in sqrt(eta) through the finest cells of each.

    Its error: what the two largest viscosities alone would say, and what half the cells change at one of them.
    """
    rows = select(tables, GROWTH.name, steep=STEEP).sort_values(["eta", "cells"])
    fine = rows.groupby("eta").tail(1)
    if len(fine) < 3:
        raise CannotTell("three viscosities tell a limit")
    root, growth = np.sqrt(fine["eta"].to_numpy(float)), fine["growth"].to_numpy(float)
    limit, large = (float(g[0] - r[0]*(g[1] - g[0])/(r[1] - r[0])) for r, g in ((root[:2], growth[:2]), (root[1:], growth[1:])))
    cells = rows.groupby("eta")["growth"].agg(np.ptp).max()
    return Measured(limit, float(np.hypot(limit - large, cells)))


def over_grid(tables: Tables) -> Measured:
    """Growth of the largest run of smooth particles over that."""
    particles, grid = finest("growth")(tables), inviscid(tables)
    value = particles.value/grid.value
    return Measured(value, float(np.hypot(particles.err/grid.value, value*grid.err/grid.value)))


def refined(tables: Tables) -> Measured:
    """The same of ever finer particles: linear in the square root of the spacing, as if this made a viscosity."""
    rows = select(tables, "ripple_growth", steep=STEEP).sort_values("scale")
    if len(rows) < 2:
        raise CannotTell("two sizes at least tell a limit")
    (_, a), (_, b) = rows.tail(2).iterrows()
    far = 1/(np.sqrt(b["scale"]/a["scale"]) - 1)        # of the limit from the finer size, in steps from the coarser one
    value, err = b["growth"] + far*(b["growth"] - a["growth"]), np.hypot((1 + far)*b["growth_err"], far*a["growth_err"])
    grid = inviscid(tables)
    return Measured(float(value/grid.value), float(np.hypot(err/grid.value, value*grid.err/grid.value**2)))


def gentle(tables: Tables) -> Measured:
    """Growth at k a = 0.25 over that at 0.05, alike in all else."""
    eta, cells = GRIDS[1]
    one, small = (select(tables, GROWTH.name, steep=steep, eta=eta, cells=cells).iloc[0] for steep in (STEEP, GENTLE))
    value = float(one["growth"]/small["growth"])
    return Measured(value, value*float(np.hypot(one["growth_err"]/one["growth"], small["growth_err"]/small["growth"])))


ASKED = "[asked after particles had been seen to grow at half of it]"
CLAIMS = (
    Claim(id="own-hard-ripple-impulsive", source="Richtmyer 1960", value=inviscid, expect=1, within=0.02,
          statement="until the reflected shock is back a ripple of k a = 0.25 grows as impulsive theory says in a fluid without "
                    f"viscosity: the grid's rate, extrapolated, over the impulsive one {ASKED}", because="the printed 2 %"),
    Claim(id="own-hard-ripple-linear", source="Richtmyer 1960", value=gentle, expect=1, within=0.02,
          because="the printed 2 %",
          statement="a ripple of k a = 0.25 grows linearly: the grid's rate over that of k a = 0.05, each over impulsive "
                    f"theory's {ASKED}"),
    Claim(id="own-hard-ripple-grid", source="KHP95 Sec. VI, Fig. 11", value=over_grid, expect=1, within=0.1,
          statement="a shocked ripple of smooth particles grows as it does on a grid without viscosity: rate of the largest run "
                    f"over the grid's, k a = 0.25 {ASKED}", because="a tenth: particles' rates scatter by as much"),
    Claim(id="own-hard-ripple-limit", source="KHP95 Sec. VI, Fig. 11", value=refined, expect=1, within=0.1,
          statement="a shocked ripple of ever finer smooth particles comes to grow as on a grid without viscosity: limit of the "
                    "rate in the square root of the spacing over the grid's, k a = 0.25 [asked after three sizes had been seen]",
          because="a tenth: particles' rates scatter by as much"),
)
PART = Part(cases=cases, tables=(RIPPLES, GROWTH), claims=CLAIMS, derive=derive)
