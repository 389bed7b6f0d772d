"""A test as somebody wrote it: checked, as data and as text."""

import json
import re
from dataclasses import dataclass
from typing import Any
from unicodedata import normalize

from app.definitions.definition import Definition
from app.definitions.outline import Outline, outline
from app.definitions.reading import definition_from, parse_definition
from app.documents.canonical import fingerprint
from app.documents.refusal import Problem, refuse
from app.documents.writing import to_data, to_yaml
from app.errors import Code, Refusal
from app.histories.history import Histories

_LONGEST_SLUG = 80  # a number may follow


@dataclass(frozen=True)
class Written:
    """A valid test: as it was understood, and as it was written."""

    definition: Definition
    data: dict[str, Any]
    yaml: str
    outline: Outline
    as_data: bool  # it came as data, and the YAML was made from them

    @property
    def content_hash(self) -> str:
        """The fingerprint of the YAML."""
        return fingerprint(self.yaml)


class Reader:
    """Reads tests; `histories` is where the files of their time histories are looked up."""

    def __init__(self, histories: Histories) -> None:
        self._histories = histories

    def yaml(self, text: str, source: str = "test", *, is_json: bool = False) -> Written | Refusal:
        """A test from its text; JSON becomes YAML, for YAML is what is kept."""
        read = parse_definition(text, source, json=is_json, histories=self._histories)
        return (
            read if isinstance(read, Refusal) else _written(read, None if is_json else text, source)
        )

    def data(self, data: Any, source: str = "test") -> Written | Refusal:
        """A test from plain data; its YAML is made from it."""
        read = definition_from(data, source, histories=self._histories)
        return read if isinstance(read, Refusal) else _written(read, None, source)

    def renamed(self, written: Written, name: str) -> Written | Refusal:
        """A test under another name. In the YAML only that line changes, so that comments stay."""
        line = f"name: {json.dumps(name, ensure_ascii=False)}"
        text, changes = re.subn(r"(?m)^name:(?=\s).*$", lambda _: line, written.yaml, count=1)
        changed = self.yaml(text)
        want = written.data | {"name": name}
        if changes and isinstance(changed, Written) and changed.data == want:
            return changed
        return self.data(want)


def slug(name: str) -> str:
    """A name as an id: small letters, digits and hyphens. Never empty."""
    plain = normalize("NFKD", name.casefold()).encode("ascii", "ignore").decode()
    return re.sub(r"[^a-z0-9]+", "-", plain)[:_LONGEST_SLUG].strip("-") or "test"


def _written(definition: Definition, text: str | None, source: str) -> Written | Refusal:
    for key in ("name", "description"):
        if "\0" in getattr(definition, key):  # PostgreSQL keeps every character but this
            problem = Problem(key, None, "must not contain the character NUL")
            return refuse(Code.INVALID_TEST, source, [problem])
    yaml = to_yaml(definition) if text is None else text
    return Written(definition, to_data(definition), yaml, outline(definition), text is None)
