"""One result whatever was compiled before: compiled code calls its own copies of what it calls.

numba puts the optimised code of a function into each function that calls it, and optimises it once more
there. What is not inlined stays as a copy under the old name. Loaded from disk alone a function finds its own
copy. In the process that compiled both, LLVM takes the one that came first, whose sums may have another order
and so other last digits. `continuum.jit` imports this module. Results are those of a filled cache, as before.
"""
from typing import Any

from llvmlite.binding import Linkage
from numba.core.codegen import CPUCodeLibrary

_finalize = CPUCodeLibrary._finalize_final_module


def _finalize_with_own_copies(library: Any) -> None:
    """numba's last step, to machine code; for callers, which optimise them once more, copies stay open."""
    copies = [function for function in library._final_module.functions
              if not function.is_declaration and function.linkage == Linkage.linkonce_odr]
    for function in copies:
        function.linkage = "internal"
    _finalize(library)
    for function in copies:
        function.linkage = "linkonce_odr"


setattr(CPUCodeLibrary, "_finalize_final_module", _finalize_with_own_copies)  # noqa: B010  (mypy allows it so)
