"""What a run is found by: words and facets in letters and digits that both databases index alike.

A text becomes its words, folded, so that case does not count. A facet (`tag`, `outcome` …) becomes
one word that holds the exact value and that no text can make. Every other character than 0-9 and
a-y is written as z and five hexadecimal digits: a prefix stays a prefix, and no database's own idea
of letters, accents or case matters.
"""

import re
from collections.abc import Iterable
from unicodedata import normalize

LONGEST_WORD = 40
MOST_WORDS = 20  # of a question
_PLAIN = frozenset("0123456789abcdefghijklmnopqrstuvwxy")
_WORD = re.compile(r"[^\W_]+")
_FACETS = {
    "test_id": "zzt",
    "tag": "zzg",
    "outcome": "zzo",
    "verdict": "zzv",
    "operator": "zzp",
}


def words_of(texts: Iterable[str]) -> list[str]:
    """The different words of some texts, encoded, in the order in which they come."""
    found = (word for text in texts for word in _WORD.findall(normalize("NFKC", text).casefold()))
    return list(dict.fromkeys(_encoded(word[:LONGEST_WORD]) for word in found))


def facet(name: str, value: str) -> str:
    """The word of a facet. Raises KeyError where there is no such facet."""
    return _FACETS[name] + _encoded(value)


def _encoded(text: str) -> str:
    return "".join(c if c in _PLAIN else f"z{ord(c):05x}" for c in text)
