"""Makes tests with one thing wrong."""

from typing import Any, NamedTuple

Data = dict[str, Any]


class Bad(NamedTuple):
    """A definition with one thing wrong: where, what stands there, the limit, and words of it."""

    definition: Data
    path: str
    value: Any
    limit: Any
    unit: str | None
    says: str


def with_blocks(*blocks: Any, **others: Any) -> Data:
    """A test of these blocks; other keys of the test as given."""
    return {"schema": 1, "name": "bad", "blocks": list(blocks), **others}


def hold(**changed: Any) -> Data:
    """A hold; None leaves a key out."""
    return _changed({"kind": "hold", "duration_s": 1.0}, changed)


def ramp(**changed: Any) -> Data:
    """A ramp; None leaves a key out."""
    return _changed({"kind": "ramp", "to_n": 1000, "rate_n_s": 20000}, changed)


def sine(**changed: Any) -> Data:
    """A harmonic block; None leaves a key out."""
    block = {"kind": "harmonic", "amplitude_n": 2000, "frequency_hz": 50, "cycles": 200}
    return _changed(block, changed)


def layers(**changed: Any) -> Data:
    """A load spectrum of one layer, which is changed."""
    layer = {"mean_n": 0, "amplitude_n": 1000, "frequency_hz": 100, "cycles": 10}
    return {"kind": "layers", "layers": [_changed(layer, changed)], "transition_s": 0.1}


def sweep(**changed: Any) -> Data:
    """A sweep; None leaves a key out."""
    block = {"kind": "sweep", "amplitude_n": 1000, "from_hz": 1, "to_hz": 100, "duration_s": 5}
    return _changed(block, changed)


def response(**changed: Any) -> Data:
    """A frequency response; None leaves a key out."""
    block = {
        "kind": "frequency_response",
        "amplitudes_n": [1000],
        "frequencies_hz": [10, 20],
    }
    return _changed(block, changed)


def history(**changed: Any) -> Data:
    """A time history of forces; None leaves a key out."""
    block = {"kind": "time_history", "samples_n": [0, 400, 500, 400, 0, -100], "rate_hz": 100}
    return _changed(block, changed)


def moving_history(**changed: Any) -> Data:
    """A test whose unit moves along samples."""
    motion = {"kind": "time_history", "samples_m": [0, 0.001, 0.002, 0.001, 0], "rate_hz": 20}
    return with_blocks(hold(), motion=[_changed(motion, changed)])


def repeat(times: Any, *blocks: Any) -> Data:
    """Blocks repeated."""
    return {"kind": "repeat", "times": times, "blocks": list(blocks)}


def nested(depth: int) -> Data:
    """A hold within so many repeats."""
    return hold() if depth == 0 else repeat(2, nested(depth - 1))


def moving(**changed: Any) -> Data:
    """A test whose unit moves; None leaves a key out."""
    motion = {"kind": "harmonic", "amplitude_m": 0.002, "frequency_hz": 4, "cycles": 2}
    return with_blocks(hold(), motion=[_changed(motion, changed)])


def _changed(data: Data, changed: Data) -> Data:
    return {key: value for key, value in (data | changed).items() if value is not None}
