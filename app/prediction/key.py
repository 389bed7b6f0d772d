"""What a prediction depends on, as a hash: the same key is the same prediction."""

import hashlib
import json
from collections.abc import Iterator, Sequence
from typing import Any

from app.documents.writing import to_data
from app.histories.history import History
from app.prediction.setup import Setup
from app.settings import VERSION


def key_of(setup: Setup) -> str:
    """SHA-256 of the test with what its files hold, of all settings, the seed and the software's version."""
    definition = setup.definition
    parts = {
        "definition": to_data(definition),
        "histories": [*_histories(definition.blocks), *_histories(definition.motion)],
        "controller": to_data(setup.controller),
        "interlocks": to_data(setup.interlocks),
        "rig": setup.rig.model_dump(mode="json"),
        "seed": setup.seed,
        "version": VERSION,
    }
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()


def _histories(items: Sequence[Any]) -> Iterator[str]:
    for item in items:
        history = getattr(item, "history", None)
        if isinstance(history, History):
            yield history.sha256
        yield from _histories(getattr(item, "blocks", ()))
