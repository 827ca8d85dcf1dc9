"""The compressible gas, solved with py-pde."""
import continuum.jit  # noqa: F401  (before everything that loads numba)
