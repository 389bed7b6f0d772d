"""So long a shortened test is the whole one: the loop's own generator says so, tick for tick."""

from typing import Any

import numpy as np
import pytest

from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.reading import definition_from
from app.prediction.agreement import same_ticks
from app.prediction.shortening import shorten
from tests.unit.app.definitions.playing import play

LOOK_BEYOND = 8000
SINE = {"kind": "harmonic", "amplitude_n": 2000, "frequency_hz": 11, "cycles": 20_000}
HOLD = {"kind": "hold", "force_n": 500, "duration_s": 700.0}


@pytest.mark.parametrize(
    "blocks",
    [
        [SINE],
        [HOLD, SINE],
        [{"kind": "repeat", "times": 900, "blocks": [SINE | {"cycles": 60}]}],
        [{"kind": "ramp", "to_n": 9000, "rate_n_s": 20}, SINE],
    ],
)
def test_both_are_alike_up_to_there_and_not_beyond(blocks: list[dict[str, Any]]) -> None:
    whole = definition_from({"schema": 1, "name": "long", "blocks": blocks})
    assert isinstance(whole, Definition)
    shorter = shorten(whole).definition
    assert shorter is not whole
    same = same_ticks(whole, shorter, 10**6)
    first = play(expand(whole).force, same + LOOK_BEYOND).value
    second = play(expand(shorter).force, same + LOOK_BEYOND).value
    assert np.array_equal(first[:same], second[:same])
    assert not np.array_equal(first, second)
    assert same_ticks(whole, shorter, 100) == min(same, 100)
