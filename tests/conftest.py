"""Before any test: numba's cache folder must be set before numba is loaded."""
import continuum.jit  # noqa: F401
