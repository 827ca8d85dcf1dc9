"""Every statement of KHP95 on convection, and RR98's equations there, judged by the tables of `rb`.

Each module is a theme. Here are statements that nothing decides. Critical Rayleigh numbers are in `onset`.
"""
from dataclasses import replace
from typing import Any

from studies.kit.ask import bench, largest
from studies.kit.claim import Claim
from studies.rb.claims import arithmetic, beyond, energies, fields, freezing, grid, points
from studies.rb.tables import particles


def undecided(name: str, place: str, statement: str, reason: str, printed: str = "", **more: Any) -> Claim:
    """A statement without a value."""
    return Claim(id=f"khp95-{name}", source=f"KHP95 {place}", statement=statement, printed=printed,
                 undecidable=reason, **more)


OPEN = (
    Claim(id="khp95-million", source="KHP95 Sec. VI", printed="a million", at_least=0.95e6,
          value=bench(largest("spam_speed", "particles")), evidence="bench/spam_speed.csv",
          statement="a million particles could be used: most particles of a run here",
          because="a million to two digits; machines have grown since"),
    undecided("ra-extrapolated", "Sec. V",
              "the converged critical Rayleigh numbers of both transport choices",
              "the numbers are not printed; what the procedure gives is judged in the study onset",
              "five significant figures"),
    undecided("fig11-growth", "Sec. VI, Fig. 11",
              "a shocked interface grows as linear theory says, within 2 %",
              "amplitude, wavelength and strength of the shock are not printed; no convection", "2%",
              headline=True),
    undecided("fig12-views", "Fig. 12",
              "velocities of particles and averaged velocities are equivalent views of a flow",
              '"equivalent" has no number, and averaging is to take the noise away: how much of it there '
              "is, is another claim", "two equivalent views", headline=True, evidence="rb/fig12.png"),
    undecided("list-cost", "Sec. II", "finding neighbours takes a time proportional to N ln N",
              "from 10 000 to a million particles ln N adds 0.09 to the exponent of N, less than caches do; "
              "linked cells take N for a given density", "N ln N"),
)
MORE_SEEDS = "three seeds of {} had left K open, and five more were run"
#: what has more seeds
POINTS = {"5000 particles at Ra 10 000": particles(1e4), "512 particles at Ra 10 000": particles(1e4, 16),
          "512 particles at Ra 3000": particles(3e3, 16)}


def looked(claim: Claim) -> Claim:
    """The claim, marked as fixed after a look if it asks for particles that have more than three seeds."""
    asked = [one.where.items() for one in getattr(claim.value, "asks", ())
             if one.table != "snapshots"]       # which has the first seed alone
    seen = (MORE_SEEDS.format(words) for words, point in POINTS.items()
            if any(point.items() <= where for where in asked))
    return replace(claim, after=claim.after or "; ".join(seen))


THEMES = (arithmetic, grid, energies, fields, freezing, points, beyond)
RB_CLAIMS = (*(looked(claim) for theme in THEMES for claim in theme.CLAIMS), *OPEN)
