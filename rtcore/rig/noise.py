"""White noise that is the same for the same seed, bit for bit, on every machine.

xoroshiro128+ (Blackman and Vigna, 2018) with Box-Muller: the state is 16 bytes in the rig's own
record, where NumPy's generators would be objects that a compiled tick cannot own.
"""

import math
from typing import Any

import numpy as np

from rtcore.compiled import Record, kernel

NOISE = np.dtype([("s0", "u8"), ("s1", "u8")], align=True)

_MASK = (1 << 64) - 1
_ROTATE_A, _SHIFT_B, _ROTATE_C, _SIZE, _FLOAT = (np.uint64(n) for n in (24, 16, 37, 64, 11))


def seed_noise(noise: Any, seed: int) -> None:
    """Start the generator from any integer, through two steps of splitmix64."""
    state = seed & _MASK
    for name in ("s0", "s1"):
        state = (state + 0x9E3779B97F4A7C15) & _MASK
        z = ((state ^ (state >> 30)) * 0xBF58476D1CE4E5B9) & _MASK
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & _MASK
        noise[name] = z ^ (z >> 31)


@kernel
def _rotated(x: np.uint64, n: np.uint64) -> np.uint64:
    return (x << n) | (x >> (_SIZE - n))


@kernel
def _uniform(noise: Record) -> float:
    """In (0, 1]."""
    s0, s1 = noise.s0, noise.s1
    total = s0 + s1
    s1 ^= s0
    noise.s0 = _rotated(s0, _ROTATE_A) ^ s1 ^ (s1 << _SHIFT_B)
    noise.s1 = _rotated(s1, _ROTATE_C)
    return (np.float64(total >> _FLOAT) + 1.0) * 2.0**-53


@kernel
def two_normals(noise: Record) -> tuple[float, float]:
    """Two independent samples of the standard normal distribution."""
    radius = math.sqrt(-2.0 * math.log(_uniform(noise)))
    angle = 2.0 * math.pi * _uniform(noise)
    return radius * math.cos(angle), radius * math.sin(angle)
