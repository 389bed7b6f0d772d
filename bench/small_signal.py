"""The non-linear plant under a tiny sine, against its linearisation: two ways to the same response."""

from collections.abc import Iterable, Iterator

import numpy as np

from app.analysis.force_loop import ForceLoop
from app.analysis.linear import bypass_conductance
from app.controller.record import to_record as gains_record
from app.controller.settings import ControllerSettings
from bench.recorded import Floats, begin, make_test, quiet_rig, ready_rig, states_of, true_force
from bench.references import PERIOD_S, own_states
from bench.report import Figure
from bench.sines import decibels, fundamental
from rtcore.rig.constants import plant_constants
from rtcore.rig.linear import FORCE, linearise, settle
from rtcore.rig.parameters import RigParameters
from rtcore.rig.plant import SUBSTEPS, U_VALVE

FREQUENCIES_HZ = (1.0, 4.0, 10.0, 20.0, 35.0, 50.0, 70.0, 85.0, 100.0, 125.0, 150.0)
SETTLE_S, MEASURE_S = 2.0, 2.0
FINE_BITS = 32  # converters whose steps drown no small signal


# Valve commands about which the plant is linearised, and amplitudes: at null the bypass is laminar only
# below some 500 Pa, and friction only below 1e-3 m/s.
OPEN_LOOP = ((0.0, 1e-8), (0.05, 1e-6), (-0.1, 1e-6), (0.3, 1e-6))
CLOSED_LOOP_MEANS_N = (10_000.0, -20_000.0)


def open_loop_error_db(
    rig: RigParameters,
    at_rest: tuple[Floats, Floats],
    bias: float,
    amplitude: float,
    frequencies_hz: Iterable[float] = FREQUENCIES_HZ,
) -> float:
    """Worst |dB| between plant and linearisation, valve command to true force, about a valve command.

    `at_rest` is any state of the pressurised plant and the inputs held in it.
    """
    plant = plant_constants(rig)
    held = at_rest[1].copy()
    held[U_VALVE] = bias
    y = settle(plant, at_rest[0], held)
    linear = linearise(plant, y, held).sampled(PERIOD_S)
    return max(
        abs(decibels(_response(rig, y, held, amplitude, f) / linear.response(f)[FORCE, U_VALVE]))
        for f in frequencies_hz
    )


def _response(
    rig: RigParameters, y: Floats, held: Floats, amplitude: float, frequency_hz: float
) -> complex:
    """Of the true force to a held sine at the valve, by the loop's own integrator."""
    ticks = round((SETTLE_S + MEASURE_S) / PERIOD_S)
    inputs = np.tile(held, (ticks, 1))
    wave = amplitude * np.sin(2.0 * np.pi * frequency_hz * PERIOD_S * np.arange(ticks))
    inputs[:, U_VALVE] += wave
    force = true_force(rig, own_states(plant_constants(rig), y, inputs, SUBSTEPS))
    measured = slice(round(SETTLE_S / PERIOD_S), None)
    # A state is that after its tick: what was held from k on shows at k + 1, which is where z⁻¹ begins.
    later = np.exp(2j * np.pi * frequency_hz * PERIOD_S)
    at = [fundamental(x[measured], frequency_hz, PERIOD_S) for x in (force, wave)]
    return complex(at[0] / at[1] / later)


def closed_loop_error_db(
    mean_n: float, amplitude_n: float = 0.5, frequencies_hz: Iterable[float] = FREQUENCIES_HZ
) -> float:
    """Worst |dB| between the very tick, with fine converters, and the linear loop, setpoint to true force."""
    rig = quiet_rig({"sensors": {"bits": FINE_BITS}})
    virtual = ready_rig(rig)
    hold = make_test([{"kind": "ramp", "to_n": mean_n, "duration_s": 0.5}, _hold(8.0)])
    begin(virtual, hold)
    virtual.advance(round(4.0 / PERIOD_S))
    y, u = virtual.io.world["y"].copy(), virtual.io.world["u"].copy()
    space = linearise(plant_constants(rig), y, u)
    loop = ForceLoop(space, gains_record(ControllerSettings()), PERIOD_S)
    worst = 0.0
    for f in frequencies_hz:
        virtual = ready_rig(rig)
        sine = {"kind": "harmonic", "mean_n": mean_n, "amplitude_n": amplitude_n, "frequency_hz": f}
        lead_in = {"kind": "ramp", "to_n": mean_n, "duration_s": 0.5}
        settling = 0.5 + SETTLE_S + 2.0 / f
        test = make_test([lead_in, _hold(0.5), sine | {"duration_s": 30.0}], compensation="off")
        begin(virtual, test)
        virtual.advance(round((settling + 1.0) / PERIOD_S))
        records, states = states_of(virtual, round(MEASURE_S / PERIOD_S))
        force = fundamental(true_force(rig, states), f, PERIOD_S)
        setpoint = fundamental(records["force_command_n"].astype(np.float64) - mean_n, f, PERIOD_S)
        worst = max(worst, abs(decibels(force / setpoint / loop.closed_loop(f))))
    return worst


def _hold(duration_s: float) -> dict[str, object]:
    return {"kind": "hold", "duration_s": duration_s}


def linear_bypass_error_db(at_rest: tuple[Floats, Floats], amplitude_n: float = 2000.0) -> float:
    """As `open_loop_error_db` at null, the orifice replaced by a linear bypass."""
    rig = quiet_rig()
    linear = {
        "bypass_diameter_m": 1e-4,
        "bypass_linear_m3_s_pa": bypass_conductance(rig, amplitude_n),
    }
    return open_loop_error_db(quiet_rig({"load_actuator": linear}), at_rest, 0.0, 1e-7)


def figures() -> Iterator[Figure]:
    """Plant alone about several openings, then the closed loop of the very tick."""
    world = ready_rig(quiet_rig()).io.world
    at_rest = world["y"].copy(), world["u"].copy()
    for bias, amplitude in OPEN_LOOP:
        error = open_loop_error_db(quiet_rig(), at_rest, bias, amplitude)
        yield _figure(f"plant_at_{bias:g}", f"plant, valve at {bias:g}", error)
    error = linear_bypass_error_db(at_rest)
    yield _figure("plant_linear_bypass", "plant, valve at 0, linear bypass", error)
    for mean_n in CLOSED_LOOP_MEANS_N:
        error = closed_loop_error_db(mean_n)
        what = f"closed loop of the tick, mean {mean_n / 1e3:g} kN"
        yield _figure(f"closed_loop_at_{mean_n:.0f}_n", what, error)


def _figure(name: str, what: str, error_db: float) -> Figure:
    low, high = FREQUENCIES_HZ[0], FREQUENCIES_HZ[-1]
    note = f"{error_db:.5f} dB at worst, {low:g} to {high:g} Hz"
    return Figure(f"small_signal_{name}_db", what, error_db, "dB", at_most=0.02, note=note)
