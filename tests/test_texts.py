"""Numbers of README.md and results/findings.md are those of the tables, from which sentences are made."""
import re
from collections.abc import Iterator

import numpy as np
import pytest

from bench.lammps_flows import STYLES
from studies.kit.ask import one, per_seed
from studies.kit.csvfile import read
from studies.kit.key import ROOT
from studies.kit.stats import Measured
from studies.kit.store import RESULTS
from studies.kit.table import Tables
from studies.rb.claims.grid import SPECTRAL
from studies.rb.tables import Point, grid, particles, points
from studies.report.equations import with_error

CLAIMS = read(RESULTS/"claims.csv").set_index("id")
ROWS, FEW = (16, 35, 50, 70, 100), (25, 40, 50)


class Folder(Tables):
    """Tables of a study, read where they are asked for."""

    def __init__(self, study: str):
        super().__init__()
        self.study = study

    def __contains__(self, name: object) -> bool:
        return True

    def __missing__(self, name: str):
        path, = (RESULTS/self.study).glob(f"{name}.csv*")
        self[name] = read(path)
        return self[name]


RB, LATTICES = Folder("rb"), Folder("lattices")


def said(number: Measured, scale: float = 100, sign: str = "") -> str:
    """As texts have it, in per cent, with the signs of a keyboard; `sign` "+" has a plus, too."""
    text = with_error(scale*number.value, scale*number.err).replace("\N{MINUS SIGN}", "-")
    return sign*bool(number.value > 0) + text


def all_of(numbers, scale: float = 100) -> str:
    """Several in a row."""
    return ", ".join(said(number, scale) for number in numbers)


def of(name: str, scale: float = 1, form: str = "") -> str:
    """What a claim measured, with its error or to some digits."""
    claim = CLAIMS.loc[name]
    return f"{scale*claim.measured:{form}}" if form else said(Measured(claim.measured, claim.err), scale)


def percent(name: str, form: str = "") -> str:
    """The same in per cent."""
    return of(name, 100, form)


def error(point: Point, energy: str = "Kp") -> Measured:
    """Relative, of a row of `errors`."""
    return one("errors", "error", energy=energy, **point)(RB)


def of_rows(variant: str, rows, energy: str = "Kp") -> list[Measured]:
    return [error(particles(1e4, n, variant), energy) for n in rows]


def digits(variant: str, rows, form: str = ".1f") -> str:
    """Errors of points in K, in per cent, without their own."""
    return ", ".join(f"{100*error(points(1e4, variant, n)).value:{form}}" for n in rows)


def limit(variant: str, column: str = "ke") -> Measured:
    """Of points without end, over the grid's, less 1."""
    ends = [one("means", column, **point)(RB) for point in (points(1e4, variant), grid(1e4))]
    return ends[0]/ends[1] - 1


def seconds(method: str, scene: str, quantity: str) -> Measured:
    """To 1 %; the mean half width."""
    where = {"scene": scene, "quantity": quantity, "method": method, "level": 0.01}
    return one("needed", "cpu_s", err="(high - low)/2", **where)(Folder("cost"))


def evaluation(what: str) -> float:
    """Nanoseconds a particle."""
    return one("points_speed", "ns_per_particle_evaluation", what=what)(Folder("bench")).value


def on_map(case: str, method: str, variant: str) -> Measured:
    """Of the map of hard cases."""
    return one("map", "measured", case=case, method=method, variant=variant)(Folder("hardcases"))


def cheaper(scene: str, quantity: str) -> str:
    """The stream from which on points that move are, beside the grid."""
    return said(one("crossings", "stream", err="high - stream", scene=scene, quantity=quantity,
                    rival="grid")(Folder("streams")), 1)


def frozen(weight: str) -> str:
    """P at which it freezes."""
    P = one("freezing_limits", "measured", weight=weight, step=1.0)
    halves = CLAIMS.loc[f"khp95-hard-freezing-melting-{weight.lower()}"]
    return said(Measured(per_seed(P)(Folder("lattices")).value, 0) + Measured(0, halves.err*rule(weight)), 1)


def rule(weight: str) -> float:
    """P of KHP95's rule."""
    return per_seed(one("freezing_limits", "melting", weight=weight, step=1.0))(Folder("lattices")).value


def smooth() -> Iterator[str]:
    kg, kp = (of_rows("printed", (*ROWS[:1], 25, *ROWS[1:]), energy) for energy in ("Kg", "Kp"))
    nu = of_rows("printed", (25, *ROWS[1:]), "Nu")
    yield f"the error of Kg is {said(kg[0])} % with 16 rows and {said(kg[2])} % with 35"
    yield f"{all_of(kg[3:])} % with 50, 70, 100"
    yield f"is {all_of(kp[1:])} % off with 25, 35, 50, 70, 100 rows"
    yield f"Nu is {all_of(-number for number in nu)} % low with 25, 35, 50, 70, 100 rows"
    law, foretold = (one("laws", name, variant="printed")(LATTICES) for name in "Cq"), "own-loss-printed"
    yield "{} P^(1-q) (eta gamma)^q with q = {}".format(*(said(number, 1) for number in law))
    layer = one("foretold", "x - 1", err="0", variant="printed", ra=10_000, rows=50)(LATTICES)
    yield f"{100*layer.value:.0f} % of the viscous dissipation at Ra 10 000"
    yield f"slip of {of('own-yield-slip', form='.1f')} spacings"
    yield f"within {100*(1 - CLAIMS.loc[foretold].measured):.0f} % with 25 to 100 rows"
    joint = CLAIMS.loc["own-joint-limit"]
    yield f"{said(Measured(joint.measured - 1, joint.err))} % off with 200 rows"
    grown = of_rows("wendland-c2-joint", (25, *ROWS[1:]), "Kg")
    odd = of_rows("wendland-c2-walls-odd-joint", (50, 70), "Kg")
    yield f"Kg is {all_of(grown)} % off with 25, 35, 50, 70, 100 rows"
    yield f"slips by {of('own-joint-slip')} of its range"
    yield f"it is {all_of(odd)} % off with 50 and 70 rows"
    yield f"noise has {of('own-joint-noise', form='.2f')} of the energy of the flow with 50 rows"


def as_used_today() -> Iterator[str]:
    today = {name: all_of(of_rows(name, rows)) for name, rows in (
        ("sph", (25, 35, 50)), ("sumB", (25, 35, 50)), ("corrected", (25, 35, 50, 70)))}
    yield f"Kp is {today['sph']} % off with 25, 35, 50 rows"
    yield f"it is {today['sumB']} % off, {percent('own-today-sumb-limit')} % in the limit"
    yield (f"it is {today['corrected']} % off with 25, 35, 50, 70 rows, "
           f"{percent('own-today-corrected-limit')} % in the limit")
    yield f"of order {of('own-today-corrected-order')}"
    others = {name: all_of(of_rows(name, rows)) for name, rows in (
        ("CRKSPH", (25, 35, 50, 70)), ("MFM", (25, 35)), ("MFM-adiabatic", (25, 35, 50)), ("riemann", (35,)),
        ("delta-plus", (35,)), ("transport-velocity-whole", (25,)))}
    yield (f"CRKSPH is {others['CRKSPH']} % off in Kp with 25, 35, 50, 70 rows, "
           f"{percent('own-today-crksph-limit')} % in the limit. MFM is {others['MFM']} % off")
    yield f"(`spam-MFM-adiabatic`) it is {others['MFM-adiabatic']} % off"
    yield (f"is {others['riemann']} %, delta-plus {others['delta-plus']} % off; a transport velocity is "
           f"{others['transport-velocity-whole']} % off")
    heat = [one("means", "nu", **point)(RB) for point in (particles(1e4, np.inf, "corrected"), grid(1e4))]
    yield f"Nu ends {said(1 - heat[0]/heat[1])} % low"
    grows = one("critical_ra", "value", err="err", method="compressible", way="run")(Folder("onset"))
    onsets = all_of((one("critical_ra", "value", err="err", resolution=n, method="spam", variant="printed",
                         way="run")(Folder("onset")) for n in (16, 25, 35, 50)), 1)
    yield f"above Ra {onsets} with 16, 25, 35, 50 rows; on the grid they grow above {said(grows, 1)}"
    rows = [error(particles(1e4, n, "printed-fixed-rows"), "Kg") for n in (50, 25)]
    kg = error(particles(1e4, 50), "Kg")
    yield f"the error of Kg from {100*kg.value:.0f} to {said(rows[0])} % with 5000 particles"
    yield f"Kg is then {said(rows[1])} % too high"
    means = [one("means", "ke", **particles(ra, variant=name))(RB) for ra, name in (
        (5e3, "printed"), (1e4, "printed"), (1e4, "walls-own-pressure"), (1e4, "walls-odd"))]
    yield f"Kp is {said(means[0], 1)} at Ra 5000 and {said(means[1], 1)} at Ra 10 000"
    yield f"it is {said(means[2], 1)}, with odd ones {said(means[3], 1)}"


def grids() -> Iterator[str]:
    yield f"is {of('khp95-ke-5000', form='.7f')} at Ra 5000"
    yield f"it is {of('khp95-ke-10000', form='.6f')} (printed 0.00481"
    truth = [one("means", "ke", **SPECTRAL | {"ra": ra})(RB).value for ra in (5e3, 1e4)]
    yield f"spectral method has {truth[0]:.11f} and {truth[1]:.11f}"
    yield f"of the grids' limits in {percent('own-rb-limits-gas-ke', '.1f')} % of the flows"
    yield f"its Nu of the Boussinesq fluid in {percent('own-rb-limits-boussinesq-nu', '.1f')} %"
    yield f"reads {of('own-ke-10000-line')} at Ra 10 000"
    yield f"to {percent('khp95-ke-line', '.1f')} % of its largest value"
    yield f"by {percent('khp95-ra-figures')} %; the paper has it"
    yield f"Linear theory gives {of('khp95-chandrasekhar', form='.2f')}"
    yield (f"{percent('khp95-ra-close', '.2f')} % away from that with constant eta and "
           f"{percent('khp95-ra-close-const-nu', '.1f')} % with constant nu")


def edges() -> Iterator[str]:
    yield (f"leave {percent('own-vortex-closed-error')} % error in a vortex and "
           f"{percent('own-convection-closed-error')} % in convection")
    kinds = ("jittered", "random", "relaxed")
    yield ", ".join(of(f"own-vortex-triangles-{kind}") for kind in kinds) + " in the vortex"
    yield "1 % of K takes " + ", ".join(of(f"own-convection-triangles-cost-{kind}") for kind in kinds)
    yield f"sound grows by {of('own-eq34-35-sound', form='.2f')} c/a"
    beside = read(RESULTS/"conservation/beside.csv").query("a == 1").iloc[0]
    yield f"velocities differ by {100*beside['end']:.1f} % after a time of 5"
    yield f"seven spacings, volumes by {100*beside['volumes']:.1f} %"
    total = read(RESULTS/"operators/entropy.csv").query("transport == 'along edges' and cells == 64")["total"]
    yield f"its sum is {100*(total.mean() - 1):.1f} % too large in a smooth flow"
    yield (f"{percent('rr98-transport-eq51-long-h2', '.0f')} % off on a lattice at h = 2 a, "
           f"{percent('rr98-transport-eq51-long-h3', '.0f')} % at 3 a and "
           f"{percent('own-transport-eq51-delaunay')} % on Delaunay edges")


def convection() -> Iterator[str]:
    for name, rows, form in (("fixed-lattice", (25, 40, 50, 64, 80), ".1f"),
                             ("fixed-jittered-plates", (25, 40, 50, 64), ".1f"),
                             ("fixed-random-plates", FEW, ".1f"), ("moving-delaunay", FEW, ".2f"),
                             ("moving", (25, 40, 50, 64, 80), ".1f")):
        numbers = ", ".join(map(str, rows))
        yield f"| {digits(name, rows, form)} | {numbers} | {said(limit(name))} |"
    yield f"| `fixed-lattice-printed-heat` | | | {said(limit('fixed-lattice-printed-heat'))} |"
    printed = ("rr98-eq39-rb-literal", "rr98-eq46-48-rb-convective", "rr98-eq49-rb-constant-mass")
    yield ", ".join(f"-{percent(name)}" for name in printed)
    yield f"{digits('moving-delaunay', (12, 16, 20, 25, 32, 40, 50), '.2f').replace('-', '')} % low"
    yield (f"falls with order {of('own-rb-carried-lattice')}. A fit of both powers ends "
           f"{said(limit('moving-delaunay'))} % too high")
    ends = [said(one("means", "nu", **point)(RB), 1) for point in (points(1e4, "moving-delaunay"), grid(1e4))]
    yield f"that of Nu ends at {ends[0]}, the grid has {ends[1]}"
    off = [said(one("field_errors", "velocity", **points(1e4, "moving-delaunay", n))(RB)) for n in (25, 40)]
    yield f"Velocities are off by {off[0]} and {off[1]} % with 25 and 40 rows"
    yield f"or {percent('rr98-rb-nested-only')} % low with 40 rows"
    yield f"A tenth along edges gives {percent('own-rb-nested-tenth')} %"


def cavity() -> Iterator[str]:
    nu = [one("cavity", "value", method="spectral-boussinesq", quantity="nu", resolution=48, ra=ra)
          (Folder("cavity")).value for ra in (1e3, 1e4, 1e5)]
    yield f"Pr 0.71 is {', '.join(f'{one:.8f}' for one in nu)}, "
    yield f"too narrow by {of('own-cavity-limits', form='.1f')} at Ra 1e6"
    made = CLAIMS[CLAIMS.index.str.match("ethersph-(read|heat)-")]
    off = 100*(1 - made["measured"]/made["printed"].astype(float))
    read, heat = (off[off.index.str.contains(name)] for name in ("read", "heat"))
    yield f"reads all four printed Nu within {read.abs().max():.1f} %"
    yield f"while {', '.join(f'{part:.0f}' for part in heat)} % of the heat do not pass its sides"


def space() -> Iterator[str]:
    rolls, crossed, squares = (percent(f"own-rb-space-{start}") for start in ("rolls", "crossed", "squares"))
    yield f"ends {rolls} % from that of the plane. Crossed rolls end as rolls, {crossed} % from it"
    yield f"K ends {squares} % from that of a spectral gas"


def costs() -> Iterator[str]:
    names = "grid", "moving"
    k, flow = ([said(seconds(name, "convection", what), 1) for name in names] for what in ("K", "velocity"))
    yield (f"| {k[0]} s | {of('own-speed-fixed-points')} grids | {of('own-speed-carried-k')} grids "
           f"| {k[1]} s |")
    lattice, cells = (seconds(name, "convection", "velocity") for name in ("fixed-lattice-h1.2", "grid"))
    yield (f"| {flow[0]} s | {said(lattice/cells, 1)} grids | {of('own-speed-carried-velocity')} grids "
           f"| {flow[1]} s |")
    rest = [said(seconds(name, "taylor-green", "velocity"), 1)
            for name in ("grid", "py-pde", "fixed-lattice-h1.2", "moving-delaunay", "moving")]
    yield (f"| {rest[0]} s (KHP95's cells), {rest[1]} s (staggered, py-pde) | {rest[2]} s | {rest[3]} s "
           f"| {rest[4]} s |")
    spam, lammps = (one("spam_speed", "ns_per_particle_evaluation", what=what, particles=20_000)
                    (Folder("bench")).value for what in ("spam", "lammps"))
    yield (f"takes {spam:.0f} ns an evaluation with all that belongs to it, LAMMPS' three sums "
           f"{lammps:.0f} ns, a staying point {evaluation('fixed points, h = 2 a'):.0f} ns at h = 2 a")
    yield (f"takes {evaluation('moving points, a step'):.0f} ns over closed faces, "
           f"{evaluation('moving delaunay, a step'):.0f} ns with its triangulation")
    cells = seconds("grid", "sound", "velocity")
    yield (f"| {said(cells, 1)} s | {of('own-speed-fixed-points-sound')} grids | "
           + " | ".join(f"{said(seconds(name, 'sound', 'velocity')/cells, 1)} grids"
                        for name in ("moving-delaunay", "moving")) + " |")
    yield (f"{seconds('spectral-gas', 'convection', 'K').value:.2f} s for 1 % of K at Ra 10 000, "
           f"{of('own-speed-spectral', form='.1f')} s for an error of 1e-6")
    yield f"with corrected sums they take {seconds('spam-corrected', 'convection', 'K').value:.1f} s"
    yield f"it takes {of('own-speed-fixed-points-5000')} of the grid's time"
    yield f"In velocity it takes {of('own-speed-fixed-points-5000-velocity')} times as long"
    yield (f"grows as N^{of('khp95-speed-growth-spam')} (smooth particles), "
           f"N^{of('own-speed-growth-carried')} (`moving-delaunay`) and "
           f"N^{of('own-speed-growth-fixed')} (lattice)")
    yield f"costs {of('own-streams-vortex-still')} times the grid's seconds at rest"
    yield f"from {of('own-streams-vortex-crossing')} times the flow's speed on"
    yield f"costs {of('own-streams-vortex-fast')} of the seconds of the cheapest"
    yield (f"a vortex of even density at {cheaper('gresho', 'velocity')}, a hot spot at "
           f"{cheaper('spot', 'temperature')}, a contact at {cheaper('contact', 'density')}, a stripe that "
           f"is wound up at {cheaper('mixing', 'stripe')}, "
           f"a wave in shear at {cheaper('shear', 'wave')} times")
    yield f"{percent('own-streams-closed-faces', '.0f')} % of their runs in streams"


def noises() -> Iterator[str]:
    yield f"with the power {of('own-fluct-eq25-onset')} of 1 - Ra/Ra_c"
    yield f"the kinetic kT is {percent('groot-warren-dpd-long-kinetic-grootwarren')} % off"
    yield f"at most {percent('own-dpd-long-kinetic-shardlow')} % with"
    yield f"the kinetic one is {percent('own-two-step-dpd-percent')} % off"
    yield f"The pressure is {of('allen-tildesley-dpd-pressure-asked')}, printed 23.64"


def energies() -> Iterator[str]:
    temperature = CLAIMS.loc["own-edpd-temperature"]
    yield f"{said(Measured(temperature.measured - 1, temperature.err))} % apart"
    yield f"{of('li-edpd-conduction')} times the printed one"
    yield f"with 3 it is {percent('bonet-avalos-edpd-few')} % less"


def breaks() -> Iterator[str]:
    yield f"freezes at P = {frozen('Lucy')} (Lucy) and {frozen('Monaghan')} (Monaghan)"
    rule = "khp95-hard-freezing-melting"
    yield f"with a sixteenth of the step it is {of(rule + '-shortest')} times the rule"
    fastest, apart = "khp95-hard-freezing-fastest", "khp95-hard-freezing-lindemann"
    yield f"it is {of(fastest + '-lucy')} times the rule"
    yield f"with a sixteenth of the step {of(fastest + '-shortest')} times"
    yield f"neighbours fluctuate by {percent(apart)} %"
    yield f"With a sixteenth they fluctuate by {percent(apart + '-shortest')} %"
    yield f"moving points within {percent('own-sod-moving-grid')} %"
    growth = [one("ripple_growth", "growth", scale=n, steep=0.25)(Folder("hardcases")) for n in (1, 2, 4)]
    yield f"grows at {all_of(growth, 1)} of the impulsive rate"
    low = on_map("Ra 1e6", "moving-delaunay", "L 32")
    yield f"With 32 rows K is {said(1 - low)} % low at Ra 1e6"
    kept = 100*on_map("zero viscosity", "moving-delaunay", "L 16").value
    yield f"A vortex without viscosity keeps {kept:.0f} % of its flow in five turns"
    vacuum = [on_map("vacuum", f"spam{name}", "L 8").value for name in ("", "-wendland-c2", "-corrected")]
    yield "with {:.2f} (printed), {:.2f} (Wendland C2), {:.2f} (corrected) of the exact".format(*vacuum)
    yield f"K is {percent('khp95-freeze-static')} % of the grid's in the limit of no step"
    flux = {name: CLAIMS.measured[f"own-stable-{name}"] for name in (
        "convection", "sod-rings", "turns-lattice", "turns-jittered", "turns-moving", "plateau", "sedov",
        "noh")}
    yield f"K is {100*(1 - flux['convection']):.2f} % lower than without"
    yield f"v rings by {100*flux['sod-rings']:.0f} %"
    yield (f"are {max(flux['sedov'], flux['noh']):.2f} spacings off at most, the state behind a shock of "
           f"Mach 10 by {100*flux['plateau']:.3f} %")
    sod = [one("trials", value, case="Sod", rows=100, step=1.0, method="fixed-lattice-entropy-stable")
           (Folder("hardcases")) for value in ("rho_exact", "v_exact", "P_exact")]
    yield "errors of {:.1f}, {:.1f} and {:.1f} % in density, velocity and pressure".format(
        *(100*part.value for part in sod))
    for words, where in (("{:.1f} times as much as without it on a lattice, {:.1f} times on", ""),
                         ("and {:.1f}, {:.1f} times in Sod's tube", ", Sod's tube")):
        yield words.format(*(
            evaluation(f"{kind}, entropy-stable{where}")/evaluation(f"fixed points, {plain}, edge by edge")
            for kind, plain in (("lattice", "h = 2 a"), ("Delaunay", "Delaunay"))))
    kept = [100*flux[f"turns-{points}"] for points in ("lattice", "jittered", "moving")]
    yield (f"keeps {kept[0]:.0f} % of K over a hundred turns on a lattice, {kept[1]:.0f} % on shifted "
           f"points, {kept[2]:.0f} % on moving ones")
    bare = one("trials", "measured", case="100 turns", method="moving-delaunay")(Folder("hardcases"))
    yield f"points keep {100*bare.value:.0f} % without the flux"
    debye = read(RESULTS/"lattices/debye.csv").query("lattice == 'hexagonal' and h == 2.5")
    debye = debye[debye["weight"] == "Lucy"]
    sound, shear = debye[["sound", "shear"]].iloc[0]
    yield f"within {100*(CLAIMS.measured['khp95-debye-density'] - 1):.1f} %, as the paper says"
    yield f"has {100*(1 - sound):.0f} % fewer of them, and {shear:.0f} times as many shear waves"


def choice() -> Iterator[str]:
    where = particles(1e4)
    for words, name, *energies in (("none", "printed", "Kg", "Kp", "Nu"),
                                   ("two errors that cancel", "less-static-50", "Kg", "Kp", "Nu"),
                                   ("held rows behind the plates", "printed-fixed-rows", "Kg", "", "Nu"),
                                   ("a quarter of the noise", "wendland-c2", "Kg", "", ""),
                                   ("range of 4 spacings", "range-4", "Kg", "Kp", "")):
        cells = [said(error({**where, "variant": name}, energy), sign="+") if energy else ""
                 for energy in energies]
        yield re.sub(" +", " ", f"{words} | {' | '.join(cells)} |")


def front() -> Iterator[str]:
    """Of README.md."""
    kg = of_rows("printed", (35, 100), "Kg")
    yield f"is {-100*kg[0].value:.1f} % too low with 35 rows and {-100*kg[1].value:.0f} % too low with 100"
    most = abs(limit("fixed-lattice"))
    within = f"{100*(most.value + most.err):.3f}"
    yield f"K is {digits('fixed-lattice', [50])} % too high with 50 rows, right within {within} %"
    yield f"converge, {digits('moving-delaunay', [50], '.2f').strip('-')} % too low with 50 rows"
    yield (f"lattice points take {of('own-speed-fixed-points', form='.1f')} times as long, moving ones "
           f"{of('own-speed-carried-k')} times")
    yield f"| {seconds('spam-corrected', 'convection', 'K').value:.0f} s (`spam`: never) |"
    for name in ("grid", "fixed-lattice-h1.2", "moving-delaunay"):
        yield f"| {seconds(name, 'convection', 'K').value:.2f} s |"
    vortex = [seconds(name, "taylor-green", "velocity").value for name in ("fixed-lattice-h1.2", "grid")]
    yield f"`grid` takes {vortex[1]/vortex[0]:.1f} times as long | {vortex[0]:.3f} s"
    yield f"| {digits('fixed-jittered-plates', [50]).strip('-')} % low"
    right = [error(particles(1e4, n, "corrected")).value for n in (50, 70)]
    yield f"K is {', '.join(f'{100*off:.1f}' for off in right)} % too high with 50, 70 rows"
    yield f"{100*right[0]:.1f} % high (`spam`: {-100*error(particles(1e4, 50), 'Kg').value:.0f} % low)"
    classic = -100*error(particles(1e4, 50, "sph")).value
    yield (f"K is then {100*right[0]:.1f} % high with 50 rows, where classic SPH (`spam-sph`) is "
           f"{classic:.0f} % low, and {percent('own-today-corrected-limit')} % off")
    classic, corrected = (evaluation(name) for name in ("spam-sph", "spam-corrected"))
    yield f"An evaluation costs {corrected/classic:.1f} times a classic one"


def counts() -> Iterator[str]:
    after = (CLAIMS["fixed"] == "after").sum()
    yield f"Of {len(CLAIMS)} claims {after} were fixed after a look"
    yield f"K of the field is {percent('own-window')} % higher from 60 on"


def outside() -> Iterator[str]:
    bench, ours = Folder("bench"), ("spam-corrected", "spam", "moving-delaunay", "grid")

    def by_rows(style, quantity, scene, *rows):
        return [said(one("lammps", "value", scene=scene, style=style, quantity=quantity, rows=n, err="err")
                     (bench), 1) for n in rows]
    for scene, quantity in (("rayleigh-benard", "K"), ("rayleigh-benard", "Nu"), ("time", "seconds")):
        yield " | ".join("{} ({})".format(*by_rows(style, quantity, scene, 16, 25)) for style in STYLES)
    for style in ("sph", "rheo", *ours):
        cells = " | ".join(by_rows(style, "seconds", "time", 16, 25, 35, 50))
        yield f"| {'our' if style in ours else 'LAMMPS'} `{style}` | {cells} |"
    ns = {name: one(table, "ns_per_particle_evaluation", what=name, particles=points)(bench).value
          for table, points, names in (("spam_speed", 20_000, ("spam", "lammps")),
                                       ("dpd_speed", 24_000, ("dpd", "lammps dpd"))) for name in names}
    yield f"SPAM {ns['spam']:.0f} ns a particle and evaluation, DPD {ns['dpd']:.0f} ns a step"
    yield f"three SPH sums {ns['lammps']:.0f} ns, DPD {ns['lammps dpd']:.0f} ns a step"


TEXTS = {"README.md": (front,), "results/README.md": (counts,), "bench/README.md": (outside,),
         "results/findings.md": (smooth, as_used_today, grids, cavity, edges, convection, space, costs,
                                 noises, energies, breaks, choice)}
#: a number with its error, as in 17.5(15)
ERROR = r"[-+]?\d[\d.]*\(\d+\)"
#: that no row has: the example of how they are written, an error that misses its level, ranges of variants
OTHERS = {"17.5(15)", "44(8)", "5(3)", "8(5)", "1.02(12)"}


def words(path: str) -> str:
    return re.sub(r"\s+", " ", (ROOT/path).read_text())


@pytest.mark.parametrize("part", [(path, part) for path, parts in TEXTS.items() for part in parts],
                         ids=lambda one: one[1].__name__)
def test_sentences_have_the_numbers_of_the_tables(part):
    path, sentences = part
    missing = [sentence for sentence in sentences() if sentence not in words(path)]
    assert not missing


@pytest.mark.parametrize("path", TEXTS)
def test_no_number_with_an_error_is_left_unchecked(path):
    text = words(path)
    for sentence in [made for parts in TEXTS.values() for part in parts for made in part()]:
        text = text.replace(sentence, "")
    assert {*re.findall(ERROR, text)} <= OTHERS
