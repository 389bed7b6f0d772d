"""The fingerprint of plain data: the same for the same content, however it was written."""

import json
from hashlib import sha256
from typing import Any


def fingerprint(data: Any) -> str:
    """SHA-256, in hexadecimal, of data as JSON with its keys in order."""
    text = json.dumps(data, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    return sha256(text.encode("utf-8", "surrogatepass")).hexdigest()
