"""Frequency responses that adapt: what is in the program beforehand, and what is refused."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from app.conducting.score import Role, scores_of
from app.definitions.blocks import Repeat
from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.outline import outline
from app.definitions.reading import definition_from
from app.definitions.response_points import planned_points
from app.definitions.responses import FrequencyResponse
from app.definitions.windows import stretches
from app.errors import Refusal
from rtcore.program.segments import Segment


def response(**keys: Any) -> FrequencyResponse:
    return FrequencyResponse.model_validate(
        {"amplitudes_n": [1000.0], "frequencies_hz": [10.0, 20.0, 40.0, 80.0], **keys}
    )


def definition(*blocks: Any) -> Definition:
    return Definition.model_validate({"schema": 1, "name": "x", "blocks": list(blocks)})


ADAPTIVE: dict[str, Any] = {
    "kind": "frequency_response",
    "amplitudes_n": [1000.0],
    "frequencies_hz": [10.0, 20.0, 40.0, 80.0],
    "settle": {"at_most_cycles": 8},
    "confidence": {},
    "auto_level": {"least_share": 0.5},
    "auto_resolution": {"points": 2},
}
HOLD = {"kind": "hold", "duration_s": 1.0}
LOOP = {
    "kind": "repeat",
    "times": 3,
    "blocks": [HOLD, {"kind": "ramp", "to_n": 0, "duration_s": 1}],
}


def test_means_amplitudes_and_frequencies_follow_one_another() -> None:
    points = planned_points(response(means_n=[0.0, 500.0], amplitudes_n=[1000.0, 2000.0]))
    loads = list(dict.fromkeys((p.series, p.sine.mean, p.sine.amplitude) for p in points))
    assert loads == [(0, 0.0, 1000.0), (1, 0.0, 2000.0), (2, 500.0, 1000.0), (3, 500.0, 2000.0)]
    assert [p.sine.frequency_hz for p in points] == [10.0, 20.0, 40.0, 80.0] * 4


def test_frequencies_between_two_come_when_those_beside_them_are_known() -> None:
    points = planned_points(response(auto_resolution={"points": 1}))
    order = [(p.place, p.rank) for p in points]
    assert order == [(0, 0), (1, 0), (2, 0), (0, 1), (3, 0), (1, 1), (2, 1)]
    assert points[3].sine.frequency_hz == pytest.approx(np.sqrt(10.0 * 20.0))


def test_levels_are_halves_down_to_the_least_share() -> None:
    points = planned_points(response(auto_level={"least_share": 0.25}))
    assert [p.sine.amplitude for p in points[:3]] == [1000.0, 500.0, 250.0]
    assert [p.level for p in points[:4]] == [0, 1, 2, 0]


def test_blends_take_as_long_as_the_slowest_that_may_be_before_them() -> None:
    points = planned_points(response(auto_resolution={"points": 1}))
    slower = [p.slower_hz for p in points]
    assert slower[3] == pytest.approx(np.sqrt(200.0))  # itself
    assert slower[4] == pytest.approx(np.sqrt(200.0))  # or, if that is skipped, 40 Hz


def test_without_anything_adaptive_the_test_is_as_ever() -> None:
    plain = {"kind": "frequency_response", "amplitudes_n": [1000.0], "frequencies_hz": [10.0, 20.0]}
    (course,) = expand(definition(plain)).force.segments
    # 2 cycles to blend, 2 to settle, 5 to measure, and the taper
    assert list(course["ticks"]) == [800, 800, 2000, 800, 400, 1000, 400, 0]
    assert scores_of(definition(plain)) == []


def test_the_conductors_score_is_the_program_that_the_loop_plays() -> None:
    test = definition(HOLD, LOOP, ADAPTIVE, HOLD)
    (score,) = scores_of(test)
    (table,) = expand(test).force.segments
    ticks = {s.first: s for s in stretches(test) if s.block == 2}
    for turn in score.turns:
        segment = table[turn.segment]
        assert segment["block"] == 2
        assert segment["kind"] == Segment.HARMONIC
        assert segment["ticks"] == turn.last - turn.first
        assert segment["counts"] == (turn.role is Role.MEASURE)
        assert ticks[turn.first].last == turn.last
        if turn.role is not Role.OUT:
            assert segment["frequency_to_hz"] == score.points[turn.point].sine.frequency_hz
            assert segment["amplitude_to"] == score.points[turn.point].sine.amplitude
    assert all(b.first == a.last for a, b in pairwise(score.turns))
    assert len(score.turns) == 3 * len(score.points) + 1
    last = len(score.points)
    assert table[score.segment_of(last, Role.BLEND)]["amplitude_to"] == 0.0


def test_in_a_long_test_each_pass_of_a_repeat_has_segments_of_its_own() -> None:
    many = {
        "kind": "layers",
        "repeats": 3,
        "transition_s": 0.5,
        "layers": [{"mean_n": 0, "amplitude_n": 500, "frequency_hz": 5, "cycles": 1}] * 900,
    }
    test = definition(many, many, many, LOOP, ADAPTIVE)
    (score,) = scores_of(test)
    table = np.concatenate(list(expand(test).force.segments))
    assert table[score.turns[0].segment]["frequency_to_hz"] == 10.0
    assert table[score.turns[0].segment]["block"] == 4
    assert table[score.turns[0].segment - 1]["block"] == 3


def test_what_is_shown_is_the_longest_that_it_may_take() -> None:
    longest = outline(definition(ADAPTIVE)).duration_s
    assert (
        longest
        > outline(
            definition({k: ADAPTIVE[k] for k in ("kind", "amplitudes_n", "frequencies_hz")})
        ).duration_s
    )


@pytest.mark.parametrize("lines", ["all", "odd", "odd_random"])
def test_lines_of_a_multisine(lines: str) -> None:
    grid = response(
        method="multisine", frequencies_hz=[float(f) for f in range(1, 41)], lines=lines
    ).grid()
    odd = tuple(range(1, 41, 2))
    if lines == "all":
        assert grid.lines == tuple(range(1, 41))
    elif lines == "odd":
        assert grid.lines == odd
    else:
        assert set(grid.lines) < set(odd)
        assert len(grid.lines) == 15  # one in four is left out


def test_realisations_differ_in_nothing_but_their_phases() -> None:
    several = {
        "kind": "frequency_response",
        "method": "multisine",
        "amplitudes_n": [1000.0],
        "realisations": 3,
        "frequencies_hz": [10.0, 20.0, 30.0, 40.0],
        "settle_cycles": 1,
        "measure_cycles": 2,
    }
    knots = np.concatenate(list(expand(definition(several)).force.knots))["value"]
    period = 401
    starts = [knots[i * period : i * period + period - 1] for i in (0, 3, 6)]
    spectra = [np.fft.rfft(start) for start in starts]
    for a, b in pairwise(spectra):
        powers = np.abs(a[[1, 2, 3, 4]]) / np.abs(b[[1, 2, 3, 4]])
        assert powers == pytest.approx(powers[0])
        assert np.angle(a[1] * np.conj(b[1])) != pytest.approx(0.0, abs=0.01)


REFUSED: dict[str, tuple[dict[str, Any], str]] = {
    "both means": ({"mean_n": 5, "means_n": [1]}, "give mean_n or means_n, not both"),
    "too much": ({"means_n": [0, 49_500]}, "must be at most 50,000 N"),
    "settling shorter than it must": ({"settle": {"at_most_cycles": 2}}, "above settle_cycles, 2"),
    "two frequencies": ({"frequencies_hz": [1, 2], "auto_resolution": {"points": 1}}, "at least 3"),
    "of the multisine": ({"realisations": 2}, "only for the method multisine"),
    "of the stepped sine": (
        {"method": "multisine", "confidence": {}},
        "only for the method stepped_sine",
    ),
    "an upside-down band": (
        {"bands": [{"from_hz": 1, "to_hz": 2, "low_db": 3, "high_db": 1}]},
        "above low_db",
    ),
    "a band of nothing": ({"bands": [{"from_hz": 1, "to_hz": 2}]}, "is needed"),
    "too many": (
        {
            "frequencies_hz": {"from_hz": 1, "to_hz": 100, "points": 900},
            "auto_resolution": {"points": 20},
        },
        "must be at most 8,000",
    ),
    "an unknown key": ({"confidence": {"gain": 1}}, "unknown"),
}


@pytest.mark.parametrize(("keys", "expected"), REFUSED.values(), ids=REFUSED)
def test_what_makes_no_sense_is_refused(keys: dict[str, Any], expected: str) -> None:
    block = {
        "kind": "frequency_response",
        "amplitudes_n": [1000],
        "frequencies_hz": [5, 10, 20, 40],
        **keys,
    }
    found = definition_from({"schema": 1, "name": "x", "blocks": [block]})
    assert isinstance(found, Refusal)
    assert expected in found.detail or any(expected in fault.expected for fault in found.faults)


def test_what_adapts_is_not_repeated() -> None:
    with pytest.raises(ValueError, match="cannot be repeated"):
        Repeat.model_validate({"times": 2, "blocks": [ADAPTIVE]})
    plain = {key: ADAPTIVE[key] for key in ("kind", "amplitudes_n", "frequencies_hz")}
    assert Repeat.model_validate({"times": 2, "blocks": [plain]}).times == 2
