"""Where do smooth particles break, and was it to be expected?    [KHP95, Secs II-IV, Figs 4, 10, 11]

Spurious shear modulus, pairing and clumping of lattices against lattice sums; freezing against the printed criteria; the
isomorphism with molecular dynamics and its reversal; a shock tube and a shocked interface against exact and linear theory; the
same tube, and the highest Ra that 16 rows bear, by the grid, fixed and moving points.
Units: particles of unit mass at mean density 1, so lengths in spacings. Paper size takes half an hour. Writes
results/hardcases/*.csv and *.png and the rows of study hardcases in results/claims.csv. A group of cases is a `Part`.
"""
from studies.hardcases.high_ra import part as high_ra_part
from studies.hardcases.interface import grid as interface_grid
from studies.hardcases.limits import part as limits
from studies.hardcases.map import part as map_part
from studies.hardcases.tube import part as tube_part
from studies.kit.study import Study
from studies.lattices import cases as khp95
from studies.lattices import long_sound, ringing_part

#: the map comes last, it stands on what the others derive
STUDY = Study.of("hardcases", __doc__, (khp95.PART, limits.PART, ringing_part.PART, long_sound.PART, tube_part.PART, high_ra_part.PART, interface_grid.PART, map_part.PART,))
