"""Nested transport (RR98 Eqs 37, 38) on a lattice between adjoint plates: what share along edges (Eq. 51) makes it stable?

Growth rates of small disturbances of the motionless layer, by the eigenvalues of its linearised rates, far below the onset of
convection: whatever grows there is no flow but the scheme. The same for plates whose images do not keep gradient and divergence
adjoint, and the mass that these lose. No number here has chance in it: errors are those of differences. Writes
results/operators/*.csv and *.png and the rows of study operators in results/claims.csv; a minute.
"""
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from continuum.scene import RayleighBenard
from particles.threads import Team
from studies.build.fixed import SCHEMES
from studies.kit.case import Case, Outcome, Report
from studies.kit.claim import CannotTell, Claim
from studies.kit.figure import figure, look
from studies.kit.stats import Measured
from studies.kit.study import Part
from studies.kit.table import Table, Tables
from studies.operators.nested import images as mixed_images
from studies.operators.stability import jacobian

SHARES = (0.0, 0.003, 0.01, 0.03, 0.05, 0.07, 0.1, 0.3, 1.0)
#: rates below are zero: those of modes that stay come out at 1e-15, of those that grow at 5e-6 and more
ROUND_OFF = 1e-9
POINT = ["h", "rows", "ra", "share"]
#: largest growth rate and its frequency in c/a, share of its square in waves shorter than three spacings, rate of conduction
#: over the height; by eigenvalues, without chance
GROWTH = Table("nested_growth", key=POINT, columns=[*POINT, "growth", "frequency", "nyquist", "diffusion"])


@dataclass(frozen=True, kw_only=True)
class Growth(Case):
    """The fastest growing disturbance of the motionless layer; `h` in spacings; rate and frequency in units of c/a."""
    h: float
    rows: int
    ra: float
    share: float

    @property
    def cost(self) -> float:
        return 1e-9*(8*self.rows**2)**3 + 1

    def run(self, report: Report, folder: Path) -> Outcome:
        scene = RayleighBenard(ra=self.ra, L=float(self.rows), aspect=1.0)
        fluid, state, _ = SCHEMES["fixed-lattice"]._replace(h=self.h, share=self.share).ready(scene)
        state[1:3] = 0
        state[3] = fluid.state(1.0, np.zeros((state.shape[1], 2)), scene.T(fluid.x[:, 1]))[3]
        values, vectors = np.linalg.eig(jacobian(fluid.start(state.shape[1], Team(1)), state))
        worst = int(np.argmax(values.real))
        sound, L = np.sqrt(2*scene.T_mean), scene.L
        return Outcome({"nested_growth": [{"h": self.h, "rows": self.rows, "ra": self.ra, "share": self.share,
                                    "growth": values[worst].real/sound, "frequency": abs(values[worst].imag)/sound,
                                    "nyquist": zigzag(vectors[:, worst], self.rows),
                                    "diffusion": scene.k/L**2/sound}]})


def zigzag(vector: np.ndarray, rows: int) -> float:
    """Share of a disturbance's square that is in waves shorter than three spacings along x or y."""
    fields = vector.reshape(4, rows, rows)
    power = np.abs(np.fft.fft2(fields))**2
    k = np.abs(np.fft.fftfreq(rows))
    short = (k[:, None] > 1/3) | (k[None] > 1/3)
    return float(power[:, short].sum()/power.sum())


def cases(size: str) -> list[Case]:
    """Two ranges of the weight, two Rayleigh numbers below onset, two sizes."""
    sizes = (8,) if size == "quick" else (8, 12, 16)
    return [*grid(sizes), *mixed_images.cases(sizes)]


def grid(sizes: tuple[int, ...]) -> Iterator[Case]:
    for h, rows, ra, share in product((2.0, 3.0), sizes, (200.0, 1500.0), SHARES):
        yield Growth(h=h, rows=rows, ra=ra, share=share)


def figures(tables: Tables) -> dict[str, Figure]:
    """Growth over the share."""
    frame = tables.get("nested_growth")
    if frame is None or frame.empty:
        return {}
    panels = list(frame.groupby(["h", "ra"]))
    shares = sorted(set(frame["share"]))
    page, all_axes = figure(1, len(panels), width=3.6, height=4.2, sharey=True, squeeze=False)
    for axes, ((h, ra), group) in zip(all_axes[0], panels, strict=True):
        for number, (rows, line) in enumerate(group.groupby("rows")):
            axes.plot([shares.index(share) for share in line["share"]], line["growth"], label=f"{rows} rows", **look(number))
        axes.axhline(0, color="black", lw=0.8, linestyle="-", marker="")
        axes.set_yscale("symlog", linthresh=1e-5)
        axes.set_xticks(range(len(shares)), labels=[f"{share:g}" for share in shares], rotation=60)
        axes.set(title=f"range $h = {h:g}a$, Ra = {ra:g}", xlabel="share of transport along edges")
        axes.legend(fontsize=7)
    all_axes[0, 0].set_ylabel("largest growth rate  [$c/a$]")
    all_axes[0, 0].set_ylim(-2e-6, 2*frame["growth"].max())
    page.suptitle("Nested viscosity and conduction: does the motionless layer stay at rest?\n"
                  "$a$: spacing of the points, $c$: speed of sound; 0: nothing grows", fontsize=10)
    return {"nested_growth": page}


def rates(tables: Tables, **where: float) -> np.ndarray:
    """Growth rates of all rows with these columns."""
    frame = tables.get("nested_growth")
    if frame is None:
        raise CannotTell("not run yet: make study-nested")
    for name, value in where.items():
        frame = frame[frame[name] == value]
    if frame.empty:
        raise CannotTell(f"no row has {where}: make study-nested runs more")
    return frame["growth"].to_numpy(float)


def worst(**where: float):
    """Value function: the largest growth rate; differences over 1e-4 to 1e-6 give the same four figures."""
    return lambda tables: Measured(float(rates(tables, **where).max()), 1e-4*float(np.abs(rates(tables, **where)).max()))


def smallest_share(tables: Tables) -> Measured:
    """The smallest share of those run from which on nothing grows at h = 2 a; its error is the distance to the next one."""
    stable = [share for share in SHARES if rates(tables, h=2.0, share=share).max() < ROUND_OFF]
    unstable = [share for share in SHARES if share not in stable]
    if not stable or (unstable and min(stable) < max(unstable)):
        raise CannotTell("no share from which on the layer is stable")
    return Measured(min(stable), min(stable) - max(unstable) if unstable else 0.0)


QUIET = "rates of what stays are 1e-15, of what grows 1e-5 and more"
REST = "a motionless layer between adjoint plates stays at rest: largest growth rate in c/a, Ra 200 and 1500, 8 to 16 rows, "
CLAIMS = (
    Claim(id="rr98-eq37-layer-stable", source="RR98 Eqs 37, 38", value=worst(share=0.0), at_most=ROUND_OFF, because=QUIET,
          statement=f"with nested stress and heat current {REST}h = 2 a and 3 a"),
    Claim(id="rr98-eq51-layer-stable", source="RR98 Eq. 51", value=worst(share=1.0, h=2.0), at_most=ROUND_OFF, because=QUIET,
          statement=f"with transport along edges {REST}h = 2 a"),
    Claim(id="rr98-eq51-layer-stable-wide", source="RR98 Eq. 51", value=worst(share=1.0, h=3.0), at_most=ROUND_OFF,
          because=QUIET,
          statement=f"with transport along edges {REST}h = 3 a, where nothing damps the density from point to point"),
    Claim(id="own-nested-tenth", source="RR98 Eqs 37, 38, 51", value=worst(share=0.1, h=2.0), at_most=ROUND_OFF,
          because=QUIET, statement=f"with a tenth of the transport along edges, the rest nested, {REST}h = 2 a"),
    Claim(id="own-nested-share", source="RR98 Eqs 37, 38, 51", value=smallest_share, at_most=0.1,
          statement="a tenth of the transport along edges keeps the layer at rest at h = 2 a: the smallest share that "
                    "was run and is stable", because="a tenth; the error is the distance to the next smaller share run"),
)
PART = Part(cases=cases, tables=(GROWTH, *mixed_images.TABLES), figures=figures,
              claims=(*CLAIMS, *mixed_images.CLAIMS))
