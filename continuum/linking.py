"""One result whatever was compiled before: compiled code calls its own copies of what it calls.

numba puts the optimised code of a function into each function that calls it, and optimises it once more there.
What is not inlined stays as a copy under the old name. Loaded from disk alone a function finds its own copy; in
the process that compiled both, LLVM takes whichever came first, and sums in another order have other last digits.
`continuum.jit` imports this module. No case reaches it: results are those of a filled cache, as before.
"""
from typing import Any

from llvmlite.binding import Linkage
from numba.core.codegen import CPUCodeLibrary

_finalize = CPUCodeLibrary._finalize_final_module


def _finalize_with_own_copies(library: Any) -> None:
    """numba's last step before machine code, with a name of its own for each copy."""
    copies = [function for function in library._final_module.functions
              if not function.is_declaration and function.linkage == Linkage.linkonce_odr]
    if copies:
        library._finalized = True           # its optimised code is
        library._get_module_for_linking()   # kept for callers, which optimise it as ever
        for function in copies:
            function.linkage = "internal"
    _finalize(library)


setattr(CPUCodeLibrary, "_finalize_final_module", _finalize_with_own_copies)  # noqa: B010  (mypy allows it so)
