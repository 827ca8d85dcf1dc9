"""Every number and statement of KHP95 on convection, and RR98's equations there, judged by the tables of study `rb`.

One module a theme, each with its CLAIMS. Claims on critical Rayleigh numbers are judged by the study `onset`.
"""
from studies.rb.claims import arithmetic, energies, flow, freezing, grid, points, undecided

THEMES = (arithmetic, grid, energies, flow, freezing, points, undecided)
RB_CLAIMS = tuple(claim for theme in THEMES for claim in theme.CLAIMS)
