"""The table of the cavity."""
from studies.kit.table import Table

CAVITY = Table.of(
    "cavity", "method ra resolution quantity", "value err",
    about="A number of the square cavity of de Vahl Davis, Boussinesq fluid, Pr 0.71; velocities in kappa/L, "
          "places in L from the lower left corner.",
    means={"quantity": ("as in continuum/published/devahldavis.csv: nu of the mean, nu-max of the hot side, "
                        "u-max on the upright, v-max on the level middle line, psi-middle", ""),
           "err": ("of the spectral method what more functions change, the most of those before; of limits "
                   "half of the 95 % interval", "")})
