"""Tables of KHP95's hard cases. Lengths in spacings, masses of particles, T = 1 or as said; `_err` 95 % half widths."""
from studies.kit.table import Table

#: shear over bulk modulus: by lattice sums, and by the compiled sums of particles (ranges to 6); lattice "diagonal": sheared at
#: 45 degrees
MODULI = Table("moduli", key=["lattice", "weight", "h"], columns=["lattice", "weight", "h", "exact", "measured"])
#: order: -d ln(rms modulus over one period)/d ln h
MODULUS_ORDERS = Table("modulus_orders", key=["lattice", "weight"], columns=["lattice", "weight", "order", "order_err"])

CRYSTAL = ["lattice", "weight", "h", "eos", "T", "rho"]
#: rate of the fastest growing motion: by lattice sums, and measured
GROWTH = Table("growth", key=CRYSTAL, columns=[*CRYSTAL, "predicted", "measured", "measured_err"])
#: value of a parameter (h or T, its own column is then 0) at which motions begin to grow
ONSETS = Table("onsets", key=[*CRYSTAL, "parameter", "seed"],
               columns=[*CRYSTAL, "parameter", "seed", "predicted", "measured", "measured_err"])
#: particles a site: of least energy, and the median of runs; shared: part of the particles that share a site, chance: the part of
#: particles at random that would; ratio: median of second over first neighbour distance
FATES = Table("fates", key=["weight", "h", "seed"],
              columns=["weight", "h", "seed", "predicted", "sites", "shared", "ratio", "chance"])

ALL = (MODULI, MODULUS_ORDERS, GROWTH, ONSETS, FATES)
