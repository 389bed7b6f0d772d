"""The estimators on the virtual rig, with its noise and its converters, against its own linearisation.

The very tick on the non-linear plant, at a mean load at which valve and bypass are nearly linear. Coulomb's
friction is left out: about a rest it has no slope that a linear model could have.
"""

from collections.abc import Callable, Iterator
from functools import lru_cache
from itertools import starmap
from typing import Any, NamedTuple

import numpy as np

from app.analysis.evidence import Kind, Sine, Stretch
from app.analysis.force_loop import ForceLoop
from app.analysis.response.bla import robust
from app.analysis.response.periods import Periods
from app.analysis.response.spectral import Against, spectral_response
from app.analysis.response.stepped import SteppedSine
from app.analysis.response.swept import swept_response
from app.analysis.response.transfers import TRANSFERS
from app.analysis.walk import Part
from app.controller.record import to_record as gains_record
from app.controller.settings import ControllerSettings
from app.definitions.outline import outline
from bench.draws import SEEDS, Draws, Said, draws_of, together
from bench.known_systems import Complex, Floats
from bench.recorded import begin, make_test, ready_rig
from rtcore.rig.constants import plant_constants
from rtcore.rig.linear import FORCE, FORCE_READ, linearise
from rtcore.rig.noise import seed_noise
from rtcore.rig.parameters import rig_from
from rtcore.rig.plant import U_VALVE
from rtcore.virtual import PERIOD_S, Virtual

MEAN_N, AMPLITUDE_N = 10_000.0, 100.0
MULTISINE_N = 150.0  # at its greatest
LEAD_S = 3.0  # to the mean, and until what began has died away
STEPPED = ((10.0, 20), (20.0, 20), (35.0, 20), (60.0, 40), (85.0, 40))  # Hz, cycles
PERIODS = 4
SWEEP_S, REST_S = 4.0, 0.5
FROM_HZ, TO_HZ = 5.0, 150.0
SWEPT_HZ = np.geomspace(8.0, 100.0, 10)


class Bench(NamedTuple):
    """A rig that holds the mean, and its linear loop there."""

    loop: ForceLoop

    def force(self, frequencies_hz: Floats) -> Complex:
        """What the load cell reads to the setpoint, (n,), both of the same tick."""
        seen = [self.loop.rig.sampled(PERIOD_S).response(f)[:, U_VALVE] for f in frequencies_hz]
        read = np.array([s[FORCE_READ] / s[FORCE] for s in seen])
        return np.asarray(self.loop.closed_loops(frequencies_hz) * read)


def _at_the_mean(blocks: list[dict[str, Any]]) -> Virtual:
    """A rig under noise that has begun with these blocks, after the way to the mean."""
    virtual = ready_rig(rig_from({"load_actuator": {"coulomb_n": 0.0}}))
    lead = [{"kind": "ramp", "to_n": MEAN_N, "duration_s": 1.0}]
    hold = [{"kind": "hold", "duration_s": LEAD_S - 1.0}]
    begin(virtual, make_test([*lead, *hold, *blocks], compensation="off"))
    virtual.advance(round(LEAD_S / PERIOD_S))
    return virtual


@lru_cache(maxsize=1)
def _linear() -> Bench:
    virtual = _at_the_mean([{"kind": "hold", "duration_s": 1.0}])
    world, plant = (
        virtual.io.world,
        plant_constants(rig_from({"load_actuator": {"coulomb_n": 0.0}})),
    )
    space = linearise(plant, world["y"].copy(), world["u"].copy())
    return Bench(ForceLoop(space, gains_record(ControllerSettings()), PERIOD_S))


def _draw(virtual: Virtual, ticks: int, seed: int) -> Any:
    """The next ticks, (n,) TELEMETRY, under noise of a seed of its own."""
    seed_noise(virtual.io.world["noise"], seed)
    return virtual.advance(ticks)


def stepped(frequency_hz: float, cycles: int) -> Draws:
    """Stretches of one long sine, setpoint to load cell."""
    sine = {"kind": "harmonic", "mean_n": MEAN_N, "amplitude_n": AMPLITUDE_N}
    lasts_s = (SEEDS + 1) * cycles / frequency_hz + 1.0
    virtual = _at_the_mean([sine | {"frequency_hz": frequency_hz, "duration_s": lasts_s}])
    virtual.advance(round(1.0 / PERIOD_S))
    ticks = round(cycles / frequency_hz / PERIOD_S)
    played = Sine(frequency_hz, AMPLITUDE_N, MEAN_N)
    stretch = Stretch(0, ticks, Kind.CYCLES, sine=played, cycles=cycles)
    names = TRANSFERS["force"].input, TRANSFERS["force"].output

    def said() -> Iterator[Said]:
        for seed in range(SEEDS):
            records = _draw(virtual, ticks, seed)
            estimator = SteppedSine(PERIOD_S, {"force": TRANSFERS["force"]})
            columns = {name: records[name] for name in ("tick", *names)}
            whole = np.ones(ticks, np.bool_)
            estimator.take(Part(stretch, True, np.arange(ticks), columns, whole))
            [point] = estimator.points()
            yield Said.at(point)

    return draws_of(said(), _linear().force(np.array([frequency_hz])))


def periodic(method: str) -> Draws:
    """Periods of one long multisine: averaged spectra, or the best linear approximation's noise alone."""
    lines = np.array([4, 7, 10, 14, 20, 28, 35, 42, 50, 60, 72, 85, 100])
    ticks = round(1.0 / PERIOD_S)
    block = {"kind": "frequency_response", "method": "multisine", "mean_n": MEAN_N}
    block |= {"amplitudes_n": [MULTISINE_N], "frequencies_hz": [float(k) for k in lines]}
    virtual = _at_the_mean([block | {"settle_cycles": 2, "measure_cycles": (SEEDS + 1) * PERIODS}])
    virtual.advance(2 * ticks)

    def said() -> Iterator[Said]:
        for seed in range(SEEDS):
            records = _draw(virtual, PERIODS * ticks, seed)
            given, read = records["force_command_n"] - MEAN_N, records["force_n"] - MEAN_N
            if method == "averaged":
                flat: Any = {"window": "boxcar", "overlap": 0.0}
                found = spectral_response(given, read, PERIOD_S, ticks, Against.INPUT, **flat)
                yield Said(*(a[lines - 1] for a in (found.gain, found.gain_95, found.phase_95_deg)))
            else:
                periods = Periods(("u", "y"), ticks, lines.tolist())
                periods.take(np.arange(PERIODS * ticks), {"u": given, "y": read})
                made = periods.realisation()
                assert made is not None, "each draw is of whole periods"
                yield Said.by(robust([made], "u", "y", lines, 1.0))

    return draws_of(said(), _linear().force(lines.astype(np.float64)))


def swept() -> Draws:
    """One sweep after another, each with the rest after it."""
    sweep = {"kind": "sweep", "mean_n": MEAN_N, "amplitude_n": AMPLITUDE_N}
    sweep |= {"from_hz": FROM_HZ, "to_hz": TO_HZ, "duration_s": SWEEP_S, "taper_cycles": 2}
    rest = {"kind": "hold", "duration_s": REST_S}
    block = {"kind": "repeat", "times": SEEDS + 1, "blocks": [sweep, rest]}
    virtual = _at_the_mean([block])
    ticks = round(outline(make_test([sweep, rest])).duration_s / PERIOD_S)  # with what blends it in

    def said() -> Iterator[Said]:
        for seed in range(SEEDS):
            records = _draw(virtual, ticks, seed)
            given, read = records["force_command_n"] - MEAN_N, records["force_n"] - MEAN_N
            yield Said.by(swept_response(given, read, PERIOD_S, SWEPT_HZ, at_rest=True))

    return draws_of(said(), _linear().force(SWEPT_HZ))


def cases() -> Iterator[tuple[str, str, Callable[[], Draws]]]:
    """Name, what it is, and how to draw it."""
    yield "rig_stepped", "virtual rig, stepped sines", lambda: together(starmap(stepped, STEPPED))
    yield "rig_averaged", "virtual rig, H1 of a multisine", lambda: periodic("averaged")
    yield "rig_multisine", "virtual rig, best linear, 1 realisation", lambda: periodic("robust")
    yield "rig_swept", "virtual rig, sweep", swept
