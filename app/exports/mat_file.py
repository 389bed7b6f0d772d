"""The MATLAB file format, level 5: headers and elements as bytes, so that data of any length can follow.

Source: "MAT-File Format" (MathWorks), chapter 1. All little-endian; every element is padded to 8 bytes.
"""

import struct
from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

MOST_BYTES = 2**31 - 1  # of one variable

_MATRIX = 14
_INT8, _INT32, _UINT16, _UINT32 = 1, 5, 4, 6
_STRUCT_CLASS, _CHAR_CLASS = 2, 4
_FIELD_NAME = 32  # with the zero at its end

# numpy's kind and size: class of the array, type of its data
_TYPES = {
    "f8": (6, 9),
    "f4": (7, 7),
    "i1": (8, 1),
    "u1": (9, 2),
    "i2": (10, 3),
    "u2": (11, 4),
    "i4": (12, 5),
    "u4": (13, 6),
    "i8": (14, 12),
    "u8": (15, 13),
}


def file_header(text: str) -> bytes:
    """What every file begins with: a sentence, the version, and in which order bytes are."""
    line = f"MATLAB 5.0 MAT-file, {text}"
    return line[:116].ljust(116).encode("ascii") + bytes(8) + struct.pack("<HH", 0x0100, 0x4D49)


def column_header(name: str, dtype: npt.DTypeLike, rows: int) -> bytes:
    """Before the `rows` values of a column vector, which follow as they are in memory."""
    found = np.dtype(dtype)
    array_class, data_type = _TYPES[found.str[1:]]
    size = rows * found.itemsize
    inside = _head(name, array_class, (rows, 1))
    total = len(inside) + 8 + size + len(padding(size))
    return struct.pack("<II", _MATRIX, total) + inside + struct.pack("<II", data_type, size)


def padding(size: int) -> bytes:
    """What follows so many bytes."""
    return bytes(-size % 8)


def text(name: str, value: str) -> bytes:
    """A row of characters; what is not ASCII is replaced."""
    units = value.encode("ascii", "replace").decode().encode("utf-16-le")
    return _matrix(_head(name, _CHAR_CLASS, (1, len(units) // 2)) + _element(_UINT16, units))


def texts(name: str, fields: Mapping[str, str]) -> bytes:
    """A structure with a text in each field; names of fields have at most 31 characters."""
    names = b"".join(field.encode("ascii").ljust(_FIELD_NAME, b"\0") for field in fields)
    inside = _head(name, _STRUCT_CLASS, (1, 1))
    inside += struct.pack("<HHI", _INT32, 4, _FIELD_NAME) + _element(_INT8, names)
    return _matrix(inside + b"".join(text("", value) for value in fields.values()))


def _head(name: str, array_class: int, shape: tuple[int, int]) -> bytes:
    flags = _element(_UINT32, struct.pack("<II", array_class, 0))
    dimensions = _element(_INT32, struct.pack("<ii", *shape))
    return flags + dimensions + _element(_INT8, name.encode("ascii"))


def _element(kind: int, data: bytes) -> bytes:
    return struct.pack("<II", kind, len(data)) + data + padding(len(data))


def _matrix(inside: bytes) -> bytes:
    return struct.pack("<II", _MATRIX, len(inside)) + inside
