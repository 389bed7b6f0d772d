"""Whatever numbers a test holds, it is a test or it is refused; nothing breaks on the way."""

from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from app.definitions.definition import Definition
from app.definitions.outline import outline
from app.definitions.preview import preview
from app.definitions.reading import definition_from
from app.errors import Refusal
from tests.unit.app.definitions import bad

SOME = settings(max_examples=200, deadline=None)
odd = st.sampled_from(
    [0, -1, 1, 2, 1e-6, 1e-3, 5e-324, 1e-308, 1e-15, 1e15, 1e308, 10**400, 49e3, 1999.9, 0.1]
)
numbers = st.one_of(odd, st.floats(), st.floats(0.001, 5000), st.integers(1, 5))
few = st.lists(numbers, max_size=4)
WHOLE = {"samples_n", "samples_m", "amplitudes_n", "frequencies_hz"}
KEYS = {
    "hold": ["force_n", "duration_s"],
    "ramp": ["to_n", "rate_n_s", "duration_s"],
    "step": ["to_n", "hold_s", "rise_s"],
    "harmonic": ["mean_n", "amplitude_n", "frequency_hz", "cycles", "taper_cycles", "phase_deg"],
    "sweep": ["mean_n", "amplitude_n", "from_hz", "to_hz", "rate_octaves_s", "taper_cycles"],
    "frequency_response": ["amplitudes_n", "frequencies_hz", "settle_cycles", "measure_cycles"],
    "time_history": ["samples_n", "rate_hz", "gain", "repeats"],
}
GOOD: dict[str, bad.Data] = {
    "hold": bad.hold(),
    "ramp": bad.ramp(),
    "step": {"kind": "step", "to_n": 1000, "hold_s": 0.1},
    "harmonic": bad.sine(),
    "sweep": bad.sweep(duration_s=None, rate_octaves_s=1),
    "frequency_response": bad.response(),
    "time_history": bad.history(),
}
band = st.fixed_dictionaries({"from_hz": numbers, "to_hz": numbers, "points": numbers})


@st.composite
def blocks(draw: st.DrawFn) -> Any:
    """A block that is right but for one or two of its keys."""
    kind = draw(st.sampled_from(sorted(KEYS)))
    block = dict(GOOD[kind])
    for key in draw(st.lists(st.sampled_from(KEYS[kind]), min_size=1, max_size=2)):
        block[key] = draw(few if key in WHOLE else numbers)
    if kind == "frequency_response":
        block["method"] = draw(st.sampled_from(["multisine", "stepped_sine"]))
        if draw(st.booleans()):
            block["frequencies_hz"] = draw(band)
    return block


@SOME
@given(st.lists(blocks(), min_size=1, max_size=2))
def test_any_numbers_make_a_test_or_a_refusal(some: list[Any]) -> None:
    definition = definition_from(bad.with_blocks(*some))
    if isinstance(definition, Refusal):
        assert definition.faults
        return
    assert isinstance(definition, Definition)
    found = outline(definition)
    shown = preview(definition, found.duration_s / 2, found.duration_s / 2 + 0.05, 50)
    most = max(map(abs, [*shown.force_min_n, *shown.force_max_n]))
    assert most <= found.peak_force_n + 1e-6 <= 50e3 + 1e-3
