"""MFM whose pressures exchange no heat between particles, as in its public code for slow flows.

Printed MFM heats particle i of a pair by P* S.(v_i - v*) [Hopkins 2015, Sec. 2]. v* points down any jump of P
between reconstructed states and carries P* along as heat. Where images copy P, gravity kinks its slope, and
jumps stay: a conducting layer at rest, Ra 10 000, 25 rows, gains -0.78 of k dT/L per row at its hot plate.
GIZMO, hydro_core_meshless.h, therefore uses another work if |v*| is small beside c; here P* S.(v_i - v_j)/2.
"""
from particles.smooth.meshless import Meshless, Mfm, pressed


class Adiabatic(Meshless):
    """As `Meshless`, with the work P* S.(v_i - v_j)/2."""


@pressed.of(Adiabatic)
def _(term, a, b, x, y, Sx, Sy):
    P, _ = pressed(Meshless(term.weight, term.m), a, b, x, y, Sx, Sy)
    return P, P*(Sx*(a.vx - b.vx) + Sy*(a.vy - b.vy))


class AdiabaticMfm(Mfm):
    """Sums of MFM with the term `Adiabatic`."""
    kind = Adiabatic
