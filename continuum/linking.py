"""Make results independent of what was compiled before: compiled code calls its own copies of callees.

numba copies the optimised code of a function into each of its callers and optimises it once more there. A
copy that is not inlined keeps the old name. A caller loaded from disk alone calls its own copy. In a process
that compiled both, LLVM calls the copy that came first, whose sums may have another order and so other last
digits. `continuum.jit` imports this module. Results are those of a filled cache.
"""
from typing import Any

from llvmlite.binding import Linkage
from numba.core.codegen import CPUCodeLibrary

_finalize = CPUCodeLibrary._finalize_final_module


def _finalize_with_own_copies(library: Any) -> None:
    """numba's last step, to machine code, with copies as internal symbols; callers get them as they were."""
    copies = [function for function in library._final_module.functions
              if not function.is_declaration and function.linkage == Linkage.linkonce_odr]
    for function in copies:
        function.linkage = "internal"
    _finalize(library)
    for function in copies:
        function.linkage = "linkonce_odr"


setattr(CPUCodeLibrary, "_finalize_final_module", _finalize_with_own_copies)  # noqa: B010  (mypy allows it so)
