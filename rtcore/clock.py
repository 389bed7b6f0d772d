"""The monotonic clock, compiled: read it, and wait for a point on it.

Both call the C library on a timespec that lives on the stack, so neither allocates, and both can be
cached on disk. Neither lets go of the interpreter: the loop process has one thread.
"""

from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from rtcore.compiled import kernel

_MONOTONIC = 1  # CLOCK_MONOTONIC of Linux
_ABSOLUTE = 1  # TIMER_ABSTIME
_INTERRUPTED = 4  # EINTR: clock_nanosleep returns it, it does not set errno
_SECOND_NS = 1_000_000_000

_I32, _I64 = ir.IntType(32), ir.IntType(64)
_TIMESPEC = ir.LiteralStructType([_I64, _I64])


def _libc(builder: Any, name: str, *arguments: Any) -> Any:
    """Call a function of the C library that returns an int."""
    signature = ir.FunctionType(_I32, [a.type for a in arguments])
    function = cgutils.get_or_insert_function(builder.module, signature, name)
    return builder.call(function, arguments)


@intrinsic
def _monotonic_ns(typingctx: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        time = cgutils.alloca_once(builder, _TIMESPEC)
        _libc(builder, "clock_gettime", _I32(_MONOTONIC), time)
        seconds = builder.load(cgutils.gep_inbounds(builder, time, 0, 0))
        rest_ns = builder.load(cgutils.gep_inbounds(builder, time, 0, 1))
        return builder.add(builder.mul(seconds, _I64(_SECOND_NS)), rest_ns)

    return types.int64(), generate


@intrinsic
def _sleep_until(typingctx: Any, until_ns: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        time = cgutils.alloca_once(builder, _TIMESPEC)
        seconds = builder.sdiv(args[0], _I64(_SECOND_NS))
        rest_ns = builder.srem(args[0], _I64(_SECOND_NS))
        builder.store(seconds, cgutils.gep_inbounds(builder, time, 0, 0))
        builder.store(rest_ns, cgutils.gep_inbounds(builder, time, 0, 1))
        nowhere = ir.Constant(time.type, None)  # an absolute sleep has no remainder to return
        return _libc(builder, "clock_nanosleep", _I32(_MONOTONIC), _I32(_ABSOLUTE), time, nowhere)

    return types.int32(types.int64), generate


@kernel
def now_ns() -> int:
    """The monotonic clock, in ns: the clock of `time.monotonic_ns`."""
    return int(_monotonic_ns())


@kernel
def wait_until(deadline_ns: int, margin_ns: int) -> int:
    """Sleep until `margin_ns` before the deadline, then watch the clock until it is there.

    Returns the time at which the wait ended, in ns, never before the deadline; at once where the
    deadline has passed. A margin of 0 sleeps only. Signals do not shorten the wait: Python sees
    them after it.
    """
    now = _monotonic_ns()
    wake_ns = deadline_ns - margin_ns
    if now < wake_ns:
        while _sleep_until(wake_ns) == _INTERRUPTED:
            pass
        now = _monotonic_ns()
    while now < deadline_ns:
        now = _monotonic_ns()
    return int(now)
