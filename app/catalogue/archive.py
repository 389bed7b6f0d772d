"""A library of tests as one zip: a YAML a test, and an index with their tags.

What comes from outside is believed in nothing: names, sizes and counts are all checked.
"""

import struct
import zipfile
import zlib
from collections.abc import Mapping
from io import BytesIO

from app.documents.tree import MAX_BYTES
from app.errors import Code, Fault, Refusal

MOST_FILES = 5000
MOST_UNPACKED_BYTES = 20_000_000  # a YAML reader takes a minute for so much
_EARLIEST = (1980, 1, 1, 0, 0, 0)  # the same library is the same file


def pack(files: Mapping[str, str]) -> bytes:
    """Files as a zip, in their order."""
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in files.items():
            entry = zipfile.ZipInfo(name, _EARLIEST)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, text)
    return buffer.getvalue()


def unpack(packed: bytes) -> dict[str, str] | Refusal:
    """The texts in a zip by their names, in their order; nothing is written anywhere."""
    try:
        with zipfile.ZipFile(BytesIO(packed)) as archive:
            return _texts(archive)
    except (zipfile.BadZipFile, zlib.error, struct.error, EOFError, ValueError, OSError) as error:
        return _refuse("", f"this is no zip file that can be read: {error}")
    except (NotImplementedError, RuntimeError) as error:  # unknown compression, or encrypted
        return _refuse("", f"this zip file cannot be read: {error}")


def _texts(archive: zipfile.ZipFile) -> dict[str, str] | Refusal:
    entries = [entry for entry in archive.infolist() if not entry.filename.endswith("/")]
    if len(entries) > MOST_FILES:
        return _refuse("", f"{len(entries):,} files, must be at most {MOST_FILES:,}")
    texts: dict[str, str] = {}
    left = MOST_UNPACKED_BYTES
    for entry in entries:
        name = entry.filename
        if name in texts:
            return _refuse(name, "is in the zip file twice")
        with archive.open(entry) as file:
            # The size that the zip file tells is not to be relied on.
            content = file.read(min(MAX_BYTES, left) + 1)
        left -= len(content)
        if len(content) > MAX_BYTES or left < 0:
            return _refuse(
                name,
                f"a file must be at most {MAX_BYTES:,} bytes, all of them {MOST_UNPACKED_BYTES:,}",
            )
        try:
            texts[name] = content.decode("utf-8-sig")
        except UnicodeDecodeError:
            return _refuse(name, "is no text in UTF-8")
    return texts


def _refuse(name: str, message: str) -> Refusal:
    detail = f"{name}: {message}" if name else f"The library cannot be imported: {message}"
    return Refusal(Code.INVALID_REQUEST, detail, (Fault(name, None, message),))
