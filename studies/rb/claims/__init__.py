"""Every number and statement of KHP95 on convection, and RR98's equations there, judged by the tables of study `rb`.

One module a theme, each with its CLAIMS; `read`, `lines`, `histories`, `snapshots`, `lattices`, `sums` and `newton`
are what their values are made of. Claims on critical Rayleigh numbers are judged by the study `onset`.
"""
from studies.rb.claims import (
    flow,
    fluids,
    freedoms,
    freezing,
    grid,
    ingredients,
    motions,
    open,
    own,
    points,
    printed,
    spam,
    square,
    starts,
    weights,
)

THEMES = (weights, fluids, printed, grid, square, spam, starts, freedoms, flow, freezing, own, points, ingredients, motions, open)
RB_CLAIMS = tuple(claim for theme in THEMES for claim in theme.CLAIMS)
