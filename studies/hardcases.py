"""Where do smooth particles break, and was it to be expected?    [KHP95, Secs II-IV, Figs 4, 10, 11]

Spurious shear modulus, pairing and clumping of lattices against lattice sums; freezing against the printed criteria; the
isomorphism with molecular dynamics and its reversal; a shock tube and a shocked interface against exact and linear theory; the
same tube, and the highest Ra that 16 rows bear, by the grid, fixed and moving points.
Units: particles of unit mass at mean density 1, so lengths in spacings. Paper size takes half an hour. Writes
results/hardcases/*.csv and *.png and the rows of study hardcases in results/claims.csv. A group of cases is a `Part`.
"""
from studies.hard import high_ra_part, interface_grid, khp95, limits, long_sound, map_part, ringing_part, tube_part
from studies.kit.study import Study, main

#: the map comes last, it stands on what the others derive
PARTS = (khp95.PART, limits.PART, ringing_part.PART, long_sound.PART, tube_part.PART, high_ra_part.PART, interface_grid.PART,
         map_part.PART)
STUDY = Study.of("hardcases", "Where do smooth particles break, and was it to be expected?", PARTS)

if __name__ == "__main__":
    main(STUDY)
