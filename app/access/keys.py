"""The random keys that let somebody in: made here, given out once, kept as their SHA-256."""

import hashlib
import secrets

_BYTES = 32  # 256 bits: nobody guesses one, so a fast hash is enough
TOKEN_PREFIX = "forcerig_"  # what looks for secrets in files knows it by that


def new_key() -> str:
    """A new random key, as text for an address or a header."""
    return secrets.token_urlsafe(_BYTES)


def digest(key: str) -> str:
    """What is kept of a key: its SHA-256 in hex."""
    return hashlib.sha256(key.encode()).hexdigest()


def same(given: str, expected: str) -> bool:
    """Whether two keys are the same, in a time that does not tell how far."""
    return secrets.compare_digest(given.encode(), expected.encode())
