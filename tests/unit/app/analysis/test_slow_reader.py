"""The slow cycles of a run on the virtual rig have the stiffness of its parameters; what is too little has none."""

from typing import Any

import numpy as np
import pytest

from app.analysis.evidence import Sine
from app.analysis.slow_reader import LEAST_CYCLES, SlowReader, SlowSine
from app.analysis.walk import Walk
from app.definitions.definition import Definition
from app.definitions.library import library
from app.definitions.windows import stretches
from bench.recorded import make_test
from rtcore.rig.parameters import load_rig
from rtcore.virtual import PERIOD_S
from tests.unit.app.conducting.responses import play

RIG = load_rig()
SLOW = library()["unit-slow-cycles"]


def read(definition: Definition, records: Any, chunks: int = 7) -> tuple[SlowSine, ...]:
    walk, reader = Walk(stretches(definition), PERIOD_S), SlowReader(PERIOD_S, RIG)
    for chunk in np.array_split(records, chunks):
        for part in walk.take(chunk):
            reader.take(part)
    return reader.result()


def test_the_library_s_slow_cycles_have_the_rig_s_stiffness_and_no_free_play() -> None:
    (found,) = read(SLOW, play(SLOW).records)
    assert (found.block, found.sine, found.unit.cycles) == (1, Sine(1.0, 10_000.0, 0.0), 10)
    assert found.unit.stiffness_n_m == pytest.approx(RIG.unit.k_tra, rel=0.01)
    assert found.unit.stiffness_std_n_m < 0.03 * RIG.unit.k_tra
    damped_j = np.pi * RIG.unit.c_tra * 2 * np.pi * (10e3 / RIG.unit.k_tra) ** 2
    spread_j = found.unit.hysteresis_std_j / np.sqrt(found.unit.cycles)
    assert found.unit.hysteresis_j == pytest.approx(damped_j, abs=4 * spread_j)
    assert abs(found.unit.backlash_m) < 1e-6


def test_chunks_make_no_difference() -> None:
    records = play(SLOW).records
    (one,), (other,) = read(SLOW, records, 1), read(SLOW, records, 211)
    assert other.unit == pytest.approx(one.unit)


def test_where_ticks_are_missing_the_cycles_before_count() -> None:
    records = play(SLOW).records
    per_cycle = round(1 / PERIOD_S)
    at = round((0.5 + 1 + 5.5) / PERIOD_S)
    (found,) = read(SLOW, np.delete(records, slice(at, at + 100)))
    assert LEAST_CYCLES <= found.unit.cycles <= 5
    assert read(SLOW, records[: at - 4 * per_cycle]) == ()


@pytest.mark.parametrize(
    "changed", [{"frequency_hz": 3.0, "cycles": 30}, {"mean_n": 8000.0}, {"cycles": 2}]
)
def test_what_is_fast_or_only_pulls_or_too_short_tells_nothing(changed: dict[str, Any]) -> None:
    sine = {"kind": "harmonic", "amplitude_n": 10_000.0, "frequency_hz": 2.0, "cycles": 6}
    definition = make_test([sine | changed])
    assert read(definition, play(definition).records) == ()
    slow = make_test([sine])
    assert len(read(slow, play(slow).records)) == 1
