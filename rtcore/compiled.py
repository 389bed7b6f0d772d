"""How kernels are compiled: the decorators, views of raw memory, and ordered stores.

A kernel is handed an *address*, an int, and sees a record of a declared dtype there. A call then
costs 0.2 µs and allocates nothing, where four structured arrays as arguments cost 0.7 µs and four
reference counts (docs/decisions/0001).
"""

from collections.abc import Callable
from typing import Any, TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt
from llvmlite import ir
from numba import carray, njit, types
from numba.extending import intrinsic

F = TypeVar("F", bound=Callable[..., Any])

# What kernels are handed, as far as a type checker can see.
Record: TypeAlias = Any  # one record of a structured dtype, which the argument's name tells
Array: TypeAlias = npt.NDArray[np.float64]
Four: TypeAlias = tuple[float, float, float, float]

__all__ = [
    "Array",
    "Four",
    "Record",
    "address_of",
    "carray",
    "entry",
    "fence",
    "inlined",
    "kernel",
    "load_acquire",
    "offset_of",
    "pointer",
    "read_index",
    "store_release",
    "write_index",
]


def kernel(function: F) -> F:
    """Compile a pure kernel. Never fastmath: it deletes NaN checks. Division by zero gives inf, as in C."""
    compiled: F = njit(cache=True, error_model="numpy")(function)
    return compiled


def inlined(function: F) -> F:
    """Compile a small kernel into its callers: in the plant's equations calls would cost as much as the work."""
    compiled: F = njit(cache=True, error_model="numpy", forceinline=True, fastmath={"contract"})(
        function
    )
    return compiled


def entry(function: F) -> F:
    """Compile a kernel that is called from Python and runs long: it lets other threads run meanwhile."""
    compiled: F = njit(cache=True, error_model="numpy", nogil=True)(function)
    return compiled


def address_of(array: npt.NDArray[Any]) -> int:
    """Address of an array's first byte. The caller keeps the array alive."""
    return int(array.ctypes.data)


@intrinsic
def pointer(typingctx: Any, address: Any) -> Any:
    """An int64 address as a pointer that `carray` accepts."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return builder.inttoptr(args[0], ir.IntType(8).as_pointer())

    return types.voidptr(types.int64), generate


@intrinsic
def load_acquire(typingctx: Any, address: Any) -> Any:
    """The int64 at an 8-byte aligned address; no later load moves before it."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        place = builder.inttoptr(args[0], ir.IntType(64).as_pointer())
        return builder.load_atomic(place, ordering="acquire", align=8)

    return types.int64(types.int64), generate


@intrinsic
def store_release(typingctx: Any, address: Any, value: Any) -> Any:
    """Store an int64 at an 8-byte aligned address; no earlier store moves behind it."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        place = builder.inttoptr(args[0], ir.IntType(64).as_pointer())
        builder.store_atomic(args[1], place, ordering="release", align=8)
        return context.get_dummy_value()

    return types.void(types.int64, types.int64), generate


@intrinsic
def fence(typingctx: Any) -> Any:
    """A full fence: nothing moves across it, in the compiler or the processor."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        builder.fence("seq_cst")
        return context.get_dummy_value()

    return types.void(), generate


@kernel
def read_index(address: int) -> int:
    """`load_acquire` for callers in Python."""
    return int(load_acquire(address))


@kernel
def write_index(address: int, value: int) -> None:
    """`store_release` for callers in Python."""
    store_release(address, value)


def offset_of(dtype: np.dtype[Any], *path: str) -> int:
    """Byte offset of a (nested) field of a structured dtype."""
    total = 0
    for name in path:
        fields = dtype.fields
        assert fields is not None, f"{name} is looked for in a plain dtype"
        inner, offset = fields[name][:2]
        total += offset
        dtype = inner
    return total
