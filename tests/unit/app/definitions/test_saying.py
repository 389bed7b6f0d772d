"""What a table of blocks does not show is said in words."""

import pytest

from app.definitions.definition import Definition
from app.definitions.reading import definition_from
from app.definitions.saying import in_words
from tests.unit.app.definitions import bad


@pytest.mark.parametrize(
    ("block", "words"),
    [
        (bad.hold(), ""),
        (bad.sweep(law="linear"), "1 Hz to 100 Hz in 5 s, linear"),
        (bad.response(), "stepped sine, 2 frequencies, 10 Hz to 20 Hz, at 1,000 N"),
        (
            bad.response(method="multisine", amplitudes_n=[5, 9]),
            "multisine, 2 frequencies, 10 Hz to 20 Hz, at 5 N, 9 N, period 0.1 s",
        ),
        (bad.history(repeats=2, rate_hz=10), "samples: 6 at 10 Hz, up to 5 Hz, 2 times"),
        (bad.repeat(1000, bad.hold(), bad.sine()), "hold, harmonic, 1,000 times"),
    ],
)
def test_a_block_in_words(block: bad.Data, words: str) -> None:
    definition = definition_from(bad.with_blocks(block))
    assert isinstance(definition, Definition)
    assert in_words(definition.blocks[0]) == words
