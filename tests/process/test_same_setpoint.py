"""Every kind of block and motion, live and on the virtual clock: the same setpoint, tick for tick."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow.parquet as pq
import pytest

from app.controller.record import to_record as gains_record
from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.reading import definition_from
from app.interlocks.defaults import default_interlocks
from app.interlocks.record import to_record as interlocks_record
from rtcore.codes import Reply
from rtcore.virtual import PERIOD_S, Virtual
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow, pytest.mark.timeout(600)]

Block = dict[str, Any]
SETPOINT = ("force_command_n", "displacement_command_m", "block", "cycle")


def bumps(count: int, peak: float) -> list[float]:
    """Something irregular that begins and ends at zero."""
    t = np.linspace(0.0, 1.0, count)
    shape = np.sin(2 * np.pi * 3 * t) * np.sin(np.pi * t) + 0.4 * np.sin(2 * np.pi * 11 * t)
    return [float(value) for value in np.round(peak * shape / 1.4, 9)]


SHORT: Block = {"kind": "harmonic", "amplitude_n": 1000, "frequency_hz": 50, "cycles": 10}
BLOCKS: dict[str, list[Block]] = {
    "hold": [{"kind": "hold", "force_n": 800, "duration_s": 0.2}],
    "ramp": [
        {"kind": "ramp", "to_n": 1500, "rate_n_s": 7000},
        {"kind": "ramp", "to_n": -200, "duration_s": 0.2},
    ],
    "step": [
        {"kind": "step", "to_n": 900, "hold_s": 0.1},
        {"kind": "step", "to_n": -900, "hold_s": 0.1, "rise_s": 0.05},
    ],
    "harmonic": [
        SHORT | {"mean_n": 300, "taper_cycles": 2.5},
        SHORT | {"cycles": None, "duration_s": 0.313, "phase_deg": 70, "taper_cycles": 0},
    ],
    "layers": [
        {
            "kind": "layers",
            "layers": [
                {"mean_n": 200, "amplitude_n": 700, "frequency_hz": 40, "cycles": 5},
                {"mean_n": -100, "amplitude_n": 1200, "frequency_hz": 25, "cycles": 4},
            ],
            "repeats": 2,
            "transition_s": 0.1,
        }
    ],
    "sweep": [
        {"kind": "sweep", "amplitude_n": 500, "from_hz": 5, "to_hz": 80, "rate_octaves_s": 4},
        {
            "kind": "sweep",
            "amplitude_n": 400,
            "mean_n": 100,
            "from_hz": 60,
            "to_hz": 10,
            "duration_s": 0.8,
            "law": "linear",
        },
    ],
    "stepped_sine": [
        {
            "kind": "frequency_response",
            "method": "stepped_sine",
            "amplitudes_n": [300, 600],
            "frequencies_hz": [20, 45, 80],
            "settle_cycles": 2,
            "measure_cycles": 3,
        }
    ],
    "multisine": [
        {
            "kind": "frequency_response",
            "method": "multisine",
            "amplitudes_n": [600],
            "frequencies_hz": [10, 20, 50, 90],
            "settle_cycles": 1,
            "measure_cycles": 3,
        }
    ],
    "time_history": [
        {
            "kind": "time_history",
            "samples_n": bumps(300, 1500.0),
            "rate_hz": 333.3,
            "gain": 0.8,
            "repeats": 2,
        }
    ],
    "repeat": [
        {
            "kind": "repeat",
            "times": 3,
            "blocks": [
                SHORT | {"cycles": 3},
                {
                    "kind": "repeat",
                    "times": 2,
                    "blocks": [
                        {"kind": "time_history", "samples_n": bumps(60, 500.0), "rate_hz": 400}
                    ],
                },
            ],
        }
    ],
    # More segments than the bank holds: unrolled, and streamed while it runs.
    "streamed_segments": [
        {"kind": "ramp", "to_n": 40.0 * (i % 2), "duration_s": 0.0005} for i in range(900)
    ]
    + [
        {
            "kind": "layers",
            "layers": [
                {"amplitude_n": 100 + i, "frequency_hz": 500, "cycles": 1} for i in range(900)
            ],
            "transition_s": 0.002,
        },
        {
            "kind": "layers",
            "layers": [
                {"amplitude_n": 100 - i / 20, "frequency_hz": 500, "cycles": 1} for i in range(900)
            ],
            "transition_s": 0.002,
        },
    ],
    # More samples than the ring holds.
    "streamed_samples": [
        {"kind": "time_history", "samples_n": bumps(7_100, 3000.0), "rate_hz": 4000, "repeats": 10}
    ],
}
MOTIONS: dict[str, list[Block]] = {
    "hold": [{"kind": "hold", "displacement_m": 0.001, "duration_s": 0.3}],
    "ramp": [{"kind": "ramp", "to_m": -0.002, "rate_m_s": 0.01}],
    "step": [{"kind": "step", "to_m": 0.0005, "hold_s": 0.4}],
    "harmonic": [{"kind": "harmonic", "amplitude_m": 0.002, "frequency_hz": 4, "duration_s": 0.6}],
    "time_history": [{"kind": "time_history", "samples_m": bumps(80, 0.001), "rate_hz": 80}],
}


def definition_of(name: str, blocks: list[Block], motion: list[Block]) -> Definition:
    data = {"schema": 1, "name": name, "blocks": blocks, "motion": motion}
    definition = definition_from(data)
    assert isinstance(definition, Definition), definition.detail
    return definition


CASES = {
    **{name: definition_of(name, blocks, []) for name, blocks in BLOCKS.items()},
    **{
        f"motion_{name}": definition_of(f"motion_{name}", [SHORT | {"cycles": 60}], motion)
        for name, motion in MOTIONS.items()
    },
}


@pytest.fixture(scope="module")
def live(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ConsoleProcess]:
    console = ConsoleProcess(tmp_path_factory.mktemp("same_setpoint"))
    try:
        yield console.start()
    finally:
        console.clean_up()


def on_the_virtual_clock(definition: Definition) -> npt.NDArray[Any]:
    gains = gains_record(ControllerSettings())
    virtual = Virtual(gains, interlocks_record(default_interlocks(), PERIOD_S))
    virtual.bring_to_ready()
    assert virtual.load_program(expand(definition)) == Reply.ACCEPTED
    return virtual.run()


def run_live(console: ConsoleProcess, definition: Definition) -> Any:
    console.make_ready()
    wait_for(
        lambda: abs(console.status()["readings"]["displacement_command_m"]) < 1e-9,
        "the unit in its middle",
    )
    data = definition.model_dump(mode="json", by_alias=True, exclude_none=True)
    saved = console.http.post("/tests", json={"definition": data})
    assert saved.status_code == 201, saved.text
    asked = {"test_id": saved.json()["id"], "override_reason": "comparing setpoints"}
    started = console.http.post("/runs", json=asked)
    assert started.status_code == 201, started.text
    run = console.ended_run(int(started.json()["id"]))
    assert run["outcome"] == "completed", run["reason"]
    assert run["missing_ticks"] == 0
    return pq.read_table(console.data / "runs" / str(run["id"]) / "run.parquet")


@pytest.mark.parametrize("name", CASES)
def test_the_setpoint_is_the_same_tick_for_tick(live: ConsoleProcess, name: str) -> None:
    virtual = on_the_virtual_clock(CASES[name])
    recorded = run_live(live, CASES[name])
    assert recorded.num_rows == len(virtual)
    for channel in SETPOINT:
        same = recorded[channel].to_numpy() == virtual[channel]
        assert same.all(), f"{channel} differs first at tick {int(np.argmin(same))}"
    print(f"\n{name}: {len(virtual):,} ticks, the same setpoint at each")
