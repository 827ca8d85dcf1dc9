"""Fields of both ends of a block of edges, stored field by field for vector instructions.

Points are records; their first cache lines, of eight numbers each, hold the fields that edges read. To read
one line of each of eight points and transpose them is faster than to gather field by field.
"""
from typing import Any, NamedTuple

import numpy as np
from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

from continuum.jit import formula, jit
from particles.neighbours import u64

BLOCK, EIGHT = u64(64), u64(8)
SLOPES = ("rho_x", "u_x", "v_x", "P_x", "rho_y", "u_y", "v_y", "P_y")
#: fields of the first three cache lines of a point; r = w - v
FIELDS = ("rho", "vx", "vy", "P", "T", "hydro", "rx", "ry", "eta", "k", "ux", "uy", "Td", "Fx", "Fy", "c",
          *SLOPES)
COLUMNS = u64(len(FIELDS))
#: density, momentum and energy by Rusanov's flux; time step over volume, times the number of edges
LOW = ("low_rho", "low_px", "low_py", "low_eps", "room")
#: few terms read the rest of a record; g is that of images, e that of points that move
Point = np.dtype([(name, "f8") for name in (*FIELDS, "eps", "g", "e", *LOW)])
End: Any = NamedTuple("End", [(name, float) for name in (*FIELDS, "eps", "g")])     # type: ignore[misc]


def vector_at(builder: Any, array: Any, row: Any, column: Any) -> Any:
    """Pointer to eight numbers of an array of two axes."""
    width = builder.extract_value(array.shape, 1)
    at = builder.gep(array.data, [builder.add(builder.mul(row, width), column)])
    return builder.bitcast(at, ir.VectorType(ir.DoubleType(), 8).as_pointer())


def turned(builder: Any, rows: list) -> list:
    """Transpose eight rows of eight numbers: pairs of rows swap blocks of 1, then 2, then 4 numbers."""
    mask = ir.VectorType(ir.IntType(32), 8)
    for d in (1, 2, 4):
        low = [j + 8 - d if j & d else j for j in range(8)]
        parts = [ir.Constant(mask, [j + more for j in low]) for more in (0, d)]
        for k in (k for k in range(8) if not k & d):
            pair = rows[k], rows[k + d]
            rows[k], rows[k + d] = (builder.shuffle_vector(*pair, part) for part in parts)
    return rows


@intrinsic
def _turn(typing: Any, lines: Any, which: Any, first: Any, c: Any, lanes: Any, h: Any) -> Any:
    """lanes[c:c + 8, h:h + 8] = lines[which[first:first + 8], c:c + 8].T"""
    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        lines, which, lanes = (context.make_array(signature.args[k])(context, builder, arguments[k])
                               for k in (0, 1, 4))
        first, c, h = (arguments[k] for k in (2, 3, 5))
        steps = [ir.Constant(first.type, k) for k in range(8)]
        entries = (builder.gep(which.data, [builder.add(first, k)]) for k in steps)
        points = [builder.zext(builder.load(entry), first.type) for entry in entries]
        rows = [builder.load(vector_at(builder, lines, point, c), align=8) for point in points]
        for k, column in zip(steps, turned(builder, rows)):
            builder.store(column, vector_at(builder, lanes, builder.add(c, k), h), align=8)
        return context.get_dummy_value()
    return types.void(lines, which, types.uint64, types.uint64, lanes, types.uint64), build


@jit
def read_lanes(lines, which, first, lanes):
    """Fill lanes (COLUMNS, BLOCK) with FIELDS of the points `which` of a block of edges."""
    for h in range(u64(0), BLOCK, EIGHT):
        for c in range(u64(0), COLUMNS, EIGHT):
            _turn(lines, which, first + h, c, lanes, h)


@formula
def end_at(q, h, point):
    """A point as terms read it: FIELDS from column h of the lanes q, the rest from its record."""
    return End(q[0, h], q[1, h], q[2, h], q[3, h], q[4, h], q[5, h], q[6, h], q[7, h], q[8, h], q[9, h],
               q[10, h], q[11, h], q[12, h], q[13, h], q[14, h], q[15, h], q[16, h], q[17, h], q[18, h],
               q[19, h], q[20, h], q[21, h], q[22, h], q[23, h], point.eps, point.g)
