"""viser's page, as its package brings it: one file that unpacks itself; and what it may do in a browser.

The app serves it, so that the scene's process needs to serve no file to anybody.
"""

import base64
import hashlib
import re
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import pyarrow as pa

_LOADER = re.compile(
    r'<script data-p="(?P<packed>[^"]+)" data-ss="(?P<style>\d+)" data-cs="(?P<code>\d+)">'
    r"(?P<loader>.*?)</script>",
    re.DOTALL,
)
_DIGITS = "".join(chr(c) for c in range(0x21, 0x7F) if chr(c) not in "\"&<>'`")
# viser's own panel and notices: what they would offer, the console's page has.
_OWN_STYLE = (
    "<style>.mantine-Paper-root, .mantine-Notifications-root { display: none !important }</style>"
)


class ScenePage(NamedTuple):
    """The page, and the Content-Security-Policy under which it works."""

    html: str
    policy: str


class UnknownPage(Exception):
    """The page of this version of viser is not packed as expected."""


@cache
def scene_page() -> ScenePage:
    """The page of the installed viser, which is not imported. Raises `UnknownPage`, OSError."""
    found = find_spec("viser")
    if found is None or found.origin is None:
        raise UnknownPage("viser is not installed")
    file = Path(found.origin).parent / "client" / "build" / "index.html"
    html = file.read_text(encoding="utf-8")
    packed = _LOADER.search(html)
    if packed is None:
        raise UnknownPage(f"{file} is not packed as expected")
    style, code = int(packed["style"]), int(packed["code"])
    unpacked = pa.decompress(_bytes_of(packed["packed"]), style + code, codec="zstd", asbytes=True)
    scripts = _hash(packed["loader"].encode()), _hash(unpacked[style:])
    return ScenePage(html.replace("</head>", f"{_OWN_STYLE}</head>", 1), _policy(scripts))


def _policy(scripts: tuple[str, ...]) -> str:
    """These two scripts and no other; nothing from and to elsewhere; in the console's own pages alone."""
    return "; ".join(
        (
            "default-src 'none'",
            f"script-src {' '.join(scripts)} 'wasm-unsafe-eval'",
            "worker-src blob:",
            "style-src 'unsafe-inline'",  # its toolkit writes style elements as it goes
            "img-src data: blob:",
            "font-src data:",
            "connect-src 'self' data: blob:",
            "base-uri 'none'",
            "form-action 'none'",
            "frame-ancestors 'self'",
        )
    )


def _hash(script: bytes) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(script).digest()).decode()}'"


def _bytes_of(text: str) -> bytes:
    """What is written with five digits to the base 88 for four bytes; a last group of k digits is k - 1."""
    place = {digit: number for number, digit in enumerate(_DIGITS)}
    found = bytearray()
    for start in range(0, len(text), 5):
        group, value = text[start : start + 5], 0
        for digit in group:
            value = value * len(_DIGITS) + place[digit]
        found += value.to_bytes(len(group) - 1, "big")
    return bytes(found)
