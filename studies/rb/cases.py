"""Which cases: spacing, mass, kB are 1, L = particle rows, g = dT/L, eta from Ra: K does not depend on L.

`paper` (half an hour on two cores) has the main figure and the printed numbers at Ra 10 000, `quick` (a
minute) the same path small, `fine` (hours) all variants, walls, resolutions, and more seeds.
"""
from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from typing import Any

from continuum.fluid import ConstNu, DenseFluid, VanDerWaals
from continuum.scene import RayleighBenard, Walls
from particles.weights import Lucy, Monaghan, WendlandC2, WendlandC4, WendlandC6
from studies.build.grid import FORMS
from studies.build.measure import Smoothing
from studies.build.spam import PRINTED, STEPS, TODAY, VARIANTS, Variant, variant_of
from studies.kit.case import Case
from studies.rb.points import in_space, points
from studies.rb.runs import grid as truth
from studies.rb.runs.arithmetic import SUBJECTS, WithoutFlow
from studies.rb.runs.grid import BoussinesqSteady, CompressibleApproach, CompressibleSteady, PypdeSteady
from studies.rb.runs.spam import MakerRun, SpamRun

BOX: dict[str, Any] = {"aspect": 1.0, "sides": Walls()}     # Fig. 6; a scene's own is the layer of Fig. 5
NU: dict[str, Any] = {"transport": ConstNu}
VDW: dict[str, Any] = {"eos": VanDerWaals()}
DENSE: dict[str, Any] = {"eos": DenseFluid(), "pr": 1.5}    # C_V = 1.5: pr = 1.5 is the printed eta = k
SEEDS = (1, 2, 3)
MANY = (*SEEDS, 4, 5, 6, 7, 8)      # in fine: of 5000 particles at Ra 10 000, which most statements are about
KEPT = {1e4: "all", 5e3: "fields", 2.5e3: "fields"}
RA = (1500.0, 2500.0, 5000.0, 10000.0, 20000.0)  # of the particles
LINE = (1500.0, 1750.0, 2000.0, 2500.0, 3000.0, 3500.0, 4200.0, 5000.0, 6000.0, 6830.0, 10000.0, 20000.0,
        50000.0)  # of the grids
#: weights and ranges through which the grid's flow is seen, too; one more runs these grids again
SEEN: tuple[tuple[type, float], ...] = (
    (Lucy, 4.0), (Lucy, 6.0), (Monaghan, 3.0), (WendlandC2, 3.0), (WendlandC4, 3.0), (WendlandC6, 3.0))
#: ranges that grow, and up to which rows: Lucy's weight makes noise
GROWING = {"wendland-c2-joint": 100, "wendland-c2-walls-odd-joint": 70, "printed-joint": 50}
GRIDS, COARSE = (24, 32, 48), (12, 16, 24)


def spam(ra: float, rows: int, seeds=SEEDS, variant: Variant = PRINTED, keep="", t_end=90.0, mean_from=40.0,
         kind=SpamRun, **scene) -> Iterator[SpamRun]:
    """One point with several seeds. The first seed keeps fields or particles, the others keep K(t)."""
    where = RayleighBenard(ra=ra, L=float(rows), **scene)
    for seed in seeds:
        yield kind(scene=where, variant=variant, seed=seed, t_end=t_end, mean_from=mean_from,
                   keep=keep if seed == seeds[0] else keep and "history")


def gas(ra: float, sizes: tuple[int, ...], keep="", form="flux-form", longest=60.0,
        **scene) -> CompressibleSteady:
    """Steady states on grids, smoothed with the weights of the particles that are compared with them."""
    where = RayleighBenard(ra=ra, **scene)
    smooth = tuple(seen_by(where)) if form == "flux-form" else ()
    return CompressibleSteady(scene=where, sizes=sizes, keep=keep, form=FORMS[form], longest=longest,
                              smooth=smooth)


def seen_by(scene: RayleighBenard) -> Iterator[Smoothing]:
    """The printed weight with all rows that are run; weights of variants at the Ra where these are run."""
    in_box = isinstance(scene.sides, Walls)
    for rows in (20, 28, 40) if in_box else (16, 25, 35, 50, 70, 100):
        yield Smoothing(Lucy, 3.0, rows)
    if scene.ra in (3e3, 5e3, 1e4) and not in_box:
        for (weight, h), rows in product(SEEN, (16, 25, 50)):
            yield Smoothing(weight, h, rows)
        for rows in (35, 70):
            yield Smoothing(WendlandC2, 3.0, rows)
    if scene == RayleighBenard(ra=1e4):
        for name, rows in product(("wendland-c2-joint", "printed-joint"), (35, 50, 70, 100)):
            view = variant_of(name, rows)
            yield Smoothing(view.weight, view.h, rows)


def cases(size: str) -> list[Case]:
    """All cases of a size; `fine` has those of `paper` besides its own."""
    parts = {"quick": (quick,), "paper": (paper,), "fine": (paper, fine, points)}[size]
    numbers = (WithoutFlow(numbers=subject) for subject in SUBJECTS)
    return [*(case for part in parts for case in part()), *numbers]


def quick() -> Iterator[Case]:
    for ra in (1500.0, 5000.0, 10000.0):
        yield replace(gas(ra, COARSE), smooth=(Smoothing(Lucy, 3.0, 16),))
        yield BoussinesqSteady(ra=ra, pr=2.0, sizes=COARSE)
        yield from spam(ra, 16, SEEDS[:2], t_end=60.0, mean_from=25.0, keep="all" if ra == 10000 else "")
    yield CompressibleApproach(scene=RayleighBenard(ra=1e4), rows=16)
    yield PypdeSteady(scene=RayleighBenard(ra=5000.0), sizes=COARSE)


def paper() -> Iterator[Case]:
    """What the main figure and the verdicts on printed numbers need."""
    yield from grids()
    yield from layers()
    yield from squares()
    yield from others()


def grids() -> Iterator[Case]:
    """References of the layer: the lines of Fig. 5, Boussinesq, py-pde, the approach of Fig. 8."""
    for ra in LINE:
        yield gas(ra, GRIDS, keep="fields" if ra in (3e3, 5e3, 1e4) else "")
        more: dict[str, Any] = {"sizes": (24, 28, 32, 36)} if ra > 2e4 else {}     # for eight digits
        yield truth.SpectralGas(scene=RayleighBenard(ra=ra), **more)
        for pr in (0.71, 1.0, 2.0, 7.0):
            yield BoussinesqSteady(ra=ra, pr=pr)
            yield truth.SpectralBoussinesq(scene=RayleighBenard(ra=ra, pr=pr), **more)
    for ra, fluid in product((2000.0, 2500.0, 3000.0, 3500.0, 5000.0, 6830.0, 10000.0), (NU, VDW)):
        yield gas(ra, GRIDS, **fluid)
        yield truth.SpectralGas(scene=RayleighBenard(ra=ra, **fluid))
    for ra in (5000.0, 10000.0):
        yield PypdeSteady(scene=RayleighBenard(ra=ra), sizes=(16, 24, 32, 48))
    yield CompressibleApproach(scene=RayleighBenard(ra=1e4))
    yield gas(1e4, (16, 24, 32, 48), form="paper-form", longest=3.0)    # it loses mass and never settles


def layers() -> Iterator[Case]:
    """Particles in the layer (Figs 2, 3, 5, 8, 9, 12), by Ra, rows, fluid, walls, and half of the step."""
    for ra in RA:
        yield from spam(ra, 50, keep=KEPT.get(ra, ""))
    for ra in (5000.0, 10000.0):
        yield from spam(ra, 35)
        yield from spam(ra, 25)
    yield from changed(1e4)
    for rows in (16, 25):
        yield from spam(1e4, rows, variant=VARIANTS["printed-half-step"])


def changed(ra: float) -> Iterator[Case]:
    """5000 particles of other fluids and between other walls. At Ra 10 000 the first seed keeps fields."""
    seen = ra == 1e4
    yield from spam(ra, 50, **NU)
    yield from spam(ra, 50, keep="fields" if seen else "", **VDW)
    yield from spam(ra, 50, variant=VARIANTS["printed-fixed-rows"], keep="all" if seen else "")


def checks() -> Iterator[Case]:
    """Runs that test the choice of the start, and of the time step in other fluids and boxes."""
    flow, half = VARIANTS["printed-from-flow"], VARIANTS["printed-half-step"]
    for rows in (25, 35, 50):
        yield from spam(2500.0, rows, variant=flow, keep="history", t_end=150.0, mean_from=100.0)
    yield from spam(7000.0, 40, variant=flow, keep="history", t_end=150.0, mean_from=100.0, **BOX)
    for variant in (half, *STEPS.values()):
        yield from spam(3000.0, 16, variant=variant, **DENSE)
    yield from spam(3000.0, 16, variant=half, **VDW)
    yield from spam(1e4, 50, MANY, variant=half)
    yield from spam(1e4, 50, variant=half, **VDW)
    yield from spam(1e4, 40, variant=half, **BOX)


def squares() -> Iterator[Case]:
    """The square box of Fig. 6. Onset is at 5012; far above it the flow takes longer to settle."""
    for ra in (3500.0, 6000.0, 7000.0, 8000.0, 10000.0, 14000.0, 20000.0):
        yield gas(ra, GRIDS, **BOX)
    for ra in (3500.0, 7000.0, 10000.0, 20000.0):
        start = 80.0 if ra == 20000 else 40.0
        for rows in (40, 28, 20):
            yield from spam(ra, rows, t_end=2.25*start, mean_from=start, **BOX)
    yield gas(7000.0, (24, 32), form="two-rolls", **BOX)


def others() -> Iterator[Case]:
    """512 particles: of Fig. 7, of the frozen fluid of Fig. 4, and of gases that should not freeze there."""
    for ra in (1e4, 3e3):
        yield from spam(ra, 16, keep="all")
        yield from spam(ra, 16, keep="all", **VDW)
    yield gas(3000.0, (16, 24, 32), **DENSE)
    for name in ("printed", "printed-monaghan"):
        yield from spam(3000.0, 16, variant=VARIANTS[name], keep="all", **DENSE)


def more() -> Iterator[Case]:
    """More seeds, steps and readings of images, for statements that three seeds or one reading left open."""
    rest = MANY[len(SEEDS):]
    yield from spam(1e4, 50, rest, keep="history")
    for ra in (1e4, 3e3):
        yield from spam(ra, 16, rest, keep="history")
    yield from spam(1e4, 16, variant=VARIANTS["printed-half-step"], **VDW)
    yield from spam(3e3, 16, rest, variant=STEPS["printed-eighth-step"], **DENSE)
    for name in ("walls-own-pressure", "walls-odd"):
        yield from spam(5e3, 50, variant=VARIANTS[name])


def upto(most: int) -> list[int]:
    """Numbers of rows in a series, up to the finest that is run."""
    return [rows for rows in (25, 35, 50, 70, 100) if rows <= most]


def joint() -> Iterator[Case]:
    """Ranges that grow as rows^(1/2); 200 rows would take ten times the seconds of 100."""
    for name, most in GROWING.items():
        for rows in upto(most):
            seeds = SEEDS[:2] if rows < 100 else SEEDS[:1]
            yield from spam(1e4, rows, seeds, variant=variant_of(name, rows), keep="history")


#: smooth particles as people use them -> most rows; fewer of readings that only compare
CORRECTED = {"sph": 70, "sph-less-static": 70, "RKGC": 70, "bonet-lok": 35, "sumB": 70, "corrected": 100,
             "corrected-half-step": 35}
MAKERS = {"CRKSPH": 70, "MFM": 70, "MFM-adiabatic": 70, "riemann": 70, "delta-plus": 70,
          "transport-velocity-hydrostatic": 70, "transport-velocity": 35, "transport-velocity-whole": 25,
          "delta-plus-own-pressure": 25}


def today() -> Iterator[Case]:
    """All of these. Means are taken later than usual, when the ringing of the start has faded."""
    for name, most in (CORRECTED | MAKERS).items():
        kind = MakerRun if name in MAKERS else SpamRun
        for rows in upto(most):
            yield from spam(1e4, rows, variant=TODAY[name], mean_from=60.0, kind=kind)


def fine() -> Iterator[Case]:
    """Every variant at two sizes (of pressure at two Ra), finer particles, higher Ra, long grids."""
    elsewhere = {"printed", "printed-half-step", "printed-from-flow", "wendland-c2-walls-odd"}
    for name in sorted(set(VARIANTS) - elsewhere):
        variant = VARIANTS[name]
        yield from spam(1e4, 25, variant=variant)
        if name != "printed-fixed-rows":
            yield from spam(1e4, 50, variant=variant, keep="all" if name == "printed-monaghan" else "")
        if variant.fraction:
            yield from spam(5e3, 50, variant=variant)
    yield from checks()
    yield from changed(5e3)
    yield from more()
    yield from joint()
    yield from today()
    yield from in_space()
    for ra, rows in product((1500.0, 2500.0, 20000.0), (25, 35)):
        yield from spam(ra, rows)
    for ra in (2500.0, 10000.0):
        yield from spam(ra, 70)
    yield from spam(1e4, 100, seeds=(1, 2))
    yield from spam(3000.0, 16, variant=VARIANTS["range-6"], keep="all", **DENSE)
    for ra in (5e4, 1e5):
        yield from spam(ra, 50, t_end=180.0, mean_from=90.0)
    for ra, sizes in ((1e5, (32, 48, 64)), (1e6, (48, 64, 96))):
        yield gas(ra, sizes, longest=4.0)        # the flow itself oscillates: means over its last half
    hot: dict[str, Any] = {"form": "fig10", "longest": 6.0, "T_hot": 10.0, "T_cold": 0.5} | BOX
    yield gas(1e4, GRIDS, form="edge-heat")
    yield gas(67150.0, (32, 48), **hot)
    yield gas(67150.0, (32, 48), **hot, **DENSE)
    for ra, rows in product((5e4, 2e5), (50, 100)):
        yield CompressibleApproach(scene=RayleighBenard(ra=ra), rows=rows, t_end=2.1*ra**0.5)    # 2.1 L^2/eta
    yield gas(3000.0, (16, 24, 32), form="paper-form", longest=20.0, **DENSE)
    yield CompressibleApproach(scene=RayleighBenard(ra=3e3, **DENSE), rows=24, t_end=22*(3000/1.5)**0.5)
