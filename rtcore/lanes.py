"""Four numbers at once in one vector register: the divider is the bottleneck of the plant's equations.

A vector root or quotient of four takes as long as a scalar one. LLVM does not find these by itself,
because the operands meet only here.
"""

from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

_DOUBLE = ir.DoubleType()
_VECTOR = ir.VectorType(_DOUBLE, 4)
_FOUR = types.UniTuple(types.float64, 4)


def _pack(builder: Any, values: Any) -> Any:
    vector = ir.Constant(_VECTOR, ir.Undefined)
    for i, value in enumerate(values):
        vector = builder.insert_element(vector, value, ir.Constant(ir.IntType(32), i))
    return vector


def _unpack(context: Any, builder: Any, vector: Any) -> Any:
    values = [builder.extract_element(vector, ir.Constant(ir.IntType(32), i)) for i in range(4)]
    return context.make_tuple(builder, _FOUR, values)


@intrinsic
def sqrt4(typingctx: Any, a: Any, b: Any, c: Any, d: Any) -> Any:
    """The square roots of four float64."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        root = cgutils.get_or_insert_function(
            builder.module, ir.FunctionType(_VECTOR, [_VECTOR]), "llvm.sqrt.v4f64"
        )
        return _unpack(context, builder, builder.call(root, [_pack(builder, args)]))

    return _FOUR(*[types.float64] * 4), generate


@intrinsic
def divide4(typingctx: Any, a: Any, b: Any, c: Any, d: Any, p: Any, q: Any, r: Any, s: Any) -> Any:
    """(a/p, b/q, c/r, d/s), float64."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        quotient = builder.fdiv(_pack(builder, args[:4]), _pack(builder, args[4:]))
        return _unpack(context, builder, quotient)

    return _FOUR(*[types.float64] * 8), generate
