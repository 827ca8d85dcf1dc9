"""numba's settings in one place, and generic functions whose formula depends on the type of an argument.

The folder of the disk cache is named after a hash of all sources: numba itself notices a change only in the
file of the compiled function, and would keep stale code of functions in other files.
"""
import hashlib
import os
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from time import thread_time
from typing import Any

ROOT = Path(__file__).resolve().parent.parent


@cache      # taken below, when the sources are imported: a run is of these, whatever is edited meanwhile
def source_hash() -> str:
    """Hash of the sources of all packages that hold compiled code."""
    digest = hashlib.sha256()
    for path in sorted([*ROOT.glob("continuum/**/*.py"), *ROOT.glob("particles/**/*.py")]):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


os.environ.setdefault("NUMBA_CACHE_DIR", str(ROOT / ".numba_cache" / source_hash()))

import llvmlite.binding  # noqa: E402  (numba reads the cache folder when it is imported)
import numba  # noqa: E402
from numba.core import caching, codegen, cpu, event  # noqa: E402
from numba.extending import overload, register_jitable  # noqa: E402

# another module may have imported numba before
numba.config.CACHE_DIR = os.environ["NUMBA_CACHE_DIR"]  # type: ignore[attr-defined]

_load_index = caching.IndexDataCacheFile._load_index


def _load_index_if_known(file: Any) -> dict:
    """numba's index of compiled code; empty if it names types that cannot be imported, where numba stops."""
    try:
        return _load_index(file)
    except (ImportError, AttributeError):
        return {}


setattr(caching.IndexDataCacheFile, "_load_index", _load_index_if_known)  # noqa: B010  (mypy allows it so)

_finalize = codegen.CPUCodeLibrary._finalize_final_module


def _finalize_with_own_copies(library: Any) -> None:
    """numba's last step, to machine code, with copies of callees as internal symbols; callers get them as
    they were. Results are those of a filled cache, independent of what was compiled before.

    numba copies the optimised code of a function into each of its callers and optimises it once more there. A
    copy that is not inlined keeps the old name. A caller loaded from disk alone calls its own copy. In a
    process that compiled both, LLVM would call the copy that came first, whose sums may have another order.
    """
    linkage = llvmlite.binding.Linkage
    copies = [function for function in library._final_module.functions
              if not function.is_declaration and function.linkage == linkage.linkonce_odr]
    for function in copies:
        function.linkage = "internal"
    _finalize(library)
    for function in copies:
        function.linkage = "linkonce_odr"


setattr(codegen.CPUCodeLibrary, "_finalize_final_module", _finalize_with_own_copies)  # noqa: B010

_set_flags = cpu.CPUTargetOptions.finalize


def _set_flags_without_caller(options: Any, flags: Any, given: Any) -> None:
    """numba's flags of a function: what it leaves open has a default, not the value of its first caller."""
    for name in ("fastmath", "error_model", "forceinline"):
        if not flags.is_set(name):
            setattr(flags, name, getattr(flags, name))
    _set_flags(options, flags, given)


setattr(cpu.CPUTargetOptions, "finalize", _set_flags_without_caller)  # noqa: B010

# not all of fastmath: NaN must stay NaN, since divergence is checked for
FASTMATH = {"contract", "reassoc", "arcp", "nsz"}
OPTIONS: Any = {"error_model": "numpy", "fastmath": FASTMATH}
#: sums in the written order
ORDERED: Any = {"error_model": "numpy", "fastmath": FASTMATH - {"reassoc"}}
INLINED: Any = {"forceinline": True}

#: compile, cache on disk, release Python's lock so that threads can share the rows of one loop
jit = numba.njit(cache=True, nogil=True, **OPTIONS)
#: four float64 a vector: with eight, code of `jit_records` loses more on packing vectors than it saves
llvmlite.binding.set_option("fluidized-grid", "-slp-max-reg-size=256")
#: names of loops over records
RECORD_LOOPS: set[str] = set()

_optimize = codegen.CPUCodeLibrary._optimize_final_module


def _optimize_with_slp(library: Any) -> None:
    """numba's optimisation, with SLP in loops over records alone: their callees have other callers, too."""
    config: Any = numba.config
    before = config.SLP_VECTORIZE, config.LOOP_VECTORIZE
    if library.name in RECORD_LOOPS:
        # vectors over several rows would need gather and scatter
        config.SLP_VECTORIZE, config.LOOP_VECTORIZE = 1, 0
    try:
        _optimize(library)
    finally:
        config.SLP_VECTORIZE, config.LOOP_VECTORIZE = before


setattr(codegen.CPUCodeLibrary, "_optimize_final_module", _optimize_with_slp)  # noqa: B010


def jit_records(function: Callable) -> Any:
    """Compile a loop over records: with LLVM's SLP vectoriser, sums in the written order.

    SLP puts equal operations on neighbouring fields into one vector instruction. LLVM 14 miscompiled with it:
    use it only for loops that tests compare with a slow twin. Reassociation gathers fields, twice as slow.
    """
    RECORD_LOOPS.add(function.__qualname__)
    return numba.njit(cache=True, nogil=True, **ORDERED)(function)


def jit_apart(function: Callable) -> Any:
    """Compile for arrays that do not overlap each other, so that loops that read scattered entries of one and
    write to another are vectorised. Both sides of each branch in them must be computable."""
    compiled: Any = numba.njit(cache=True, nogil=True, **OPTIONS, **INLINED)(function)

    def customize(flags):
        flags.noalias = True
        return flags

    compiled._compiler._customize_flags = customize
    return compiled


#: plain arithmetic, for numbers, arrays and compiled code alike
formula = register_jitable(**OPTIONS, **INLINED)


def place(frame: Any) -> str:
    """File and line of a statement at module level; empty in a function or a notebook."""
    code = frame.f_code
    return (f"{code.co_filename}:{frame.f_lineno}"
            if code.co_name == "<module>" and Path(code.co_filename).is_file() else "")


def generic(stub: Callable) -> Any:
    """Generic function: the type of the first argument, or its nearest parent class, chooses the formula.

    ``@pressure.of(IdealGas)`` adds a formula; Python and compiled code can call the function. TypeError: no
    formula for that type, or a class in place of an object. ValueError: two formulas for one type.
    """
    table: dict[type, Callable] = {}
    places: dict[type, str] = {}

    def formula_of(kind: type | None) -> Callable | None:
        return next((table[one] for one in getattr(kind, "__mro__", ()) if one in table), None)

    def call(first, *rest):
        chosen = formula_of(type(first))
        if chosen is None:
            known = ", ".join(kind.__name__ for kind in table)
            if isinstance(first, type):
                raise TypeError(f"{stub.__name__} needs an object, got the class {first.__name__} itself: "
                                f"give {first.__name__}(...) or {first.__name__}.of(...)")
            raise TypeError(f"{stub.__name__}({type(first).__name__}, ...) is not defined: it knows {known}; "
                            f"add a formula with @{stub.__name__}.of({type(first).__name__})")
        return chosen(first, *rest)

    @overload(call, strict=False, jit_options=OPTIONS | INLINED)  # type: ignore[arg-type]
    def _(first, *rest):
        return formula_of(getattr(first, "instance_class", None))

    def of(kind: type) -> Callable:
        def register(function: Callable) -> Callable:
            here, before = place(sys._getframe(1)), places.get(kind, "")
            if here and before and here != before:
                raise ValueError(f"{stub.__name__} of {kind.__name__} is defined in {before} and again in "
                                 f"{here}: delete one, or give the second kind a class of its own")
            table[kind], places[kind] = function, here
            return function
        return register

    call.__doc__, call.__name__ = stub.__doc__, stub.__name__
    call.of, call.kinds = of, table  # type: ignore[attr-defined]
    return call


def check_formulas(value: Any, *functions: Any) -> None:
    """Check that each of these generic functions has a formula for the value. Raises TypeError."""
    kind = type(value)
    if lacking := [one.__name__ for one in functions if not any(base in one.kinds for base in kind.__mro__)]:
        lines = ", ".join(f"@{name}.of({kind.__name__})" for name in lacking)
        raise TypeError(f"{kind.__name__} has no formula for {' and '.join(lacking)}: add {lines}, as for "
                        "the others of its kind in continuum/fluid.py")


class Compiling(event.Listener):
    """CPU seconds that this thread spends in numba's compiler; nested calls count once."""

    def __init__(self) -> None:
        self.depth, self.started, self.seconds = 0, 0.0, 0.0

    def on_start(self, event: Any) -> None:
        if self.depth == 0:
            self.started = thread_time()
        self.depth += 1

    def on_end(self, event: Any) -> None:
        self.depth -= 1
        if self.depth == 0:
            self.seconds += thread_time() - self.started


def compiling() -> Any:
    """Context that counts the `seconds` of what is compiled within it."""
    return event.install_listener("numba:compile", Compiling())
