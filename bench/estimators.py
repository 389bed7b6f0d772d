"""`forcerig bench estimators`: how right the estimators of the frequency response are, and how often.

Each is held against a system whose response is a closed form, over many draws of its noise, and on the
virtual rig against its linearisation. Told are the bias of the mean of all draws, and how many of the 95 %
intervals hold the truth.
"""

from collections.abc import Callable, Iterator
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from scipy import signal

from app.analysis.evidence import Kind, Sine, Stretch
from app.analysis.response.bla import BestLinear, fast, robust
from app.analysis.response.curve import Curve
from app.analysis.response.periods import Periods, Realisation
from app.analysis.response.spectral import Against, spectral_response
from app.analysis.response.stepped import SteppedSine
from app.analysis.response.swept import swept_response
from app.analysis.response.transfers import TRANSFERS
from app.analysis.walk import Part
from app.conducting.sweeps import REST_TICKS
from bench.draws import SEEDS, Draws, Said, draws_of, figures_of
from bench.estimators_on_the_rig import cases as on_the_rig
from bench.known_systems import LEAD_TICKS, PERIOD_S, RESONANT, WHITE, Cubic, Floats, Loop
from bench.report import Figure, progress, show

NOISE_N = 20.0
AMPLITUDE_N = 1000.0


def stepped(frequency_hz: float, cycles: int, colour: str, transfer: str = "force") -> Draws:
    """The stepped sine in the closed loop."""
    loop, ticks = Loop.typical(), round(cycles / frequency_hz / PERIOD_S)
    at = np.arange(-LEAD_TICKS, ticks)
    setpoint = AMPLITUDE_N * np.sin(2 * np.pi * frequency_hz * PERIOD_S * at)
    truth = {"force": loop.response, "plant": loop.plant}[transfer]([frequency_hz])
    sine = Sine(frequency_hz, AMPLITUDE_N, 0.0)
    stretch = Stretch(0, ticks, Kind.CYCLES, sine=sine, cycles=cycles)
    asked = {transfer: TRANSFERS[transfer]}
    found = []
    noise = {"white": WHITE, "resonant": RESONANT}[colour]
    for output, valve in loop.run(setpoint, SEEDS, NOISE_N, noise):
        columns = {
            "tick": np.arange(ticks),
            "force_command_n": setpoint[LEAD_TICKS:].astype(np.float32),
            "force_n": output.astype(np.float32),
            "valve_command": valve.astype(np.float32),
        }
        estimator = SteppedSine(PERIOD_S, asked)
        whole = np.ones(ticks, np.bool_)
        estimator.take(Part(stretch, True, np.arange(ticks), columns, whole))
        [point] = estimator.points()
        found.append(Said.at(point))
    return draws_of(found, truth)


def averaged(against: Against) -> Draws:
    """Averaged periods: open, noise on the side that the estimator takes it for; or closed, by the setpoint."""
    loop, size, segments = Loop.typical(), 2000, 16
    lines = slice(1, 60, 4)  # 4 to 120 Hz, wide apart
    spectrum = np.zeros(size // 2 + 1, np.complex128)
    turned = np.random.default_rng(99).uniform(0, 2 * np.pi, 240)
    spectrum[1:241] = 0.1 * AMPLITUDE_N * size / 2 * np.exp(1j * turned)
    period = np.fft.irfft(spectrum, size)
    setpoint = np.tile(period, LEAD_TICKS // size + segments)
    settled = setpoint[LEAD_TICKS:]
    clean = signal.lfilter(*loop.closed, setpoint)[LEAD_TICKS:]

    def respond(u: Floats, y: Floats, reference: Floats | None = None) -> Curve:
        periodic: Any = {"reference": reference, "window": "boxcar", "overlap": 0.0}
        return spectral_response(u, y, PERIOD_S, size, against, **periodic)

    def curves() -> Iterator[Said]:
        closed = loop.run(setpoint, SEEDS, NOISE_N, RESONANT)
        for seed in range(SEEDS):
            noise = np.random.default_rng(seed).normal(0, NOISE_N, len(settled))
            if against is Against.REFERENCE:
                output, valve = next(closed)
                c = respond(valve, output, settled)
            elif against is Against.OUTPUT:
                c = respond(settled + noise, clean)
            else:
                c = respond(settled, clean + noise)
            yield Said.by(c, lines)

    frequencies_hz = np.arange(1, size // 2)[lines] / (size * PERIOD_S)
    true = loop.plant if against is Against.REFERENCE else loop.response
    return draws_of(curves(), true(frequencies_hz))


def swept(low_hz: float, high_hz: float) -> Draws:
    """A sweep of 4 s in the closed loop, 2 to 150 Hz, blended in and out, and a rest, as a test has it.

    With half the noise of the others, which would hide the bias in the mean of all draws.
    """
    frequencies_hz = np.geomspace(low_hz, high_hz, 10)
    loop = Loop.typical()
    into, of_sweep, out = (round(seconds / PERIOD_S) for seconds in (2 / 2.0, 4.0, 2 / 150.0))
    hz = np.concatenate([np.full(into, 2.0), np.geomspace(2, 150, of_sweep), np.full(out, 150.0)])
    rise, fall = (0.5 - 0.5 * np.cos(np.pi * np.arange(n) / n) for n in (into, out))
    blend = np.concatenate([rise, np.ones(of_sweep), 1 - fall])
    sweep = AMPLITUDE_N * blend * np.sin(2 * np.pi * PERIOD_S * np.cumsum(hz))
    setpoint = np.concatenate([np.zeros(LEAD_TICKS), sweep, np.zeros(REST_TICKS)])

    def curves() -> Iterator[Said]:
        for output, _ in loop.run(setpoint, SEEDS, NOISE_N / 2, RESONANT):
            given = setpoint[LEAD_TICKS:]
            yield Said.by(swept_response(given, output, PERIOD_S, frequencies_hz, at_rest=True))

    return draws_of(curves(), loop.response(frequencies_hz))


LINES = np.arange(1, 60, 2)
LEFT_OUT = LINES[3::4]


def cubic() -> Cubic:
    """A system whose gain has 1 to 3 % of distortion, at 1 to 60 Hz; an odd multisine, each fourth line left out."""
    excited = np.setdiff1d(LINES, LEFT_OUT)
    b, a = signal.butter(2, 60.0, fs=1 / PERIOD_S)
    return Cubic(0.01, excited, 0.4, 4000, (b, a))


def best_linear(
    realisations: int, seeds: int, quick: bool = False
) -> tuple[Draws, list[BestLinear]]:
    """Robust or fast method, four periods each, noise of 0.01 a tick."""
    system = cubic()
    found = []
    for seed in range(seeds):
        rng = np.random.default_rng(seed)
        drawn = [_realisation(system, rng) for _ in range(realisations)]
        period_s = system.period_ticks * PERIOD_S
        if quick:
            found.append(fast(drawn, "u", "y", system.lines, LEFT_OUT, period_s))
        else:
            found.append(robust(drawn, "u", "y", system.lines, period_s))
    return draws_of(map(Said.by, found), system.best_linear()), found


def _realisation(system: Cubic, rng: np.random.Generator) -> Realisation:
    periods = Periods(("u", "y"), system.period_ticks, LINES.tolist())
    u, y = system.period(rng)
    for k in range(4):
        at = np.arange(k * system.period_ticks, (k + 1) * system.period_ticks)
        periods.take(at, {"u": u, "y": y + rng.normal(0, 0.01, len(y))})
    made = periods.realisation()
    assert made is not None, "four periods are at least one"
    return made


def rival_coverage(cycles: int = 20, frequency_hz: float = 85.0) -> Iterator[Figure]:
    """What other intervals would have held, in the noise of a resonance: for information."""
    loop, ticks = Loop.typical(), round(cycles / frequency_hz / PERIOD_S)
    at = np.arange(-LEAD_TICKS, ticks)
    setpoint = AMPLITUDE_N * np.sin(2 * np.pi * frequency_hz * PERIOD_S * at)
    truth = loop.response([frequency_hz])[0]
    held = np.zeros((SEEDS, 2))
    edges = np.linspace(0, ticks, cycles + 1).round().astype(np.int64)
    turns = np.exp(-2j * np.pi * frequency_hz * PERIOD_S * np.arange(ticks))
    for k, (output, _) in enumerate(loop.run(setpoint, SEEDS, NOISE_N, RESONANT)):
        given = setpoint[LEAD_TICKS:]
        gain = np.sum(output * turns) / np.sum(given * turns)
        parts = [
            np.sum((output * turns)[a:b]) / np.sum((given * turns)[a:b]) for a, b in pairwise(edges)
        ]
        single = np.std(parts, ddof=1) / np.sqrt(2 * cycles) * 2.02  # t of 38
        left = output - (gain * given * turns.conj()).real
        design = np.stack([turns.real, turns.imag, np.ones(ticks)], 1)
        left = output - design @ np.linalg.lstsq(design, output, rcond=None)[0]
        white = 1.96 * np.std(left) * np.sqrt(2 / ticks) / AMPLITUDE_N
        held[k] = np.abs(abs(gain) - abs(truth)) <= np.array([white, single])
    for share, name, what in zip(
        held.mean(axis=0),
        ("residual", "cycles"),
        ("the residual, as if white", "the scatter of single cycles"),
        strict=True,
    ):
        yield Figure(f"rival_{name}_held", f"intervals from {what} that hold", float(share), "-")


def _cases() -> Iterator[tuple[str, str, Callable[[], Draws]]]:
    for hz, cycles, colour in (
        (17.3, 2, "white"),
        (17.3, 5, "resonant"),
        (35.0, 20, "white"),
        (85.0, 20, "resonant"),
        (14.0, 40, "resonant"),
    ):
        name = f"stepped_{hz:g}_hz_{cycles}_{colour}"
        what = f"stepped sine, {hz:g} Hz, {cycles} cycles, {colour} noise"
        yield name, what, partial(stepped, hz, cycles, colour)
    yield (
        "stepped_plant",
        "stepped sine, plant in the loop",
        partial(stepped, 35.0, 20, "resonant", "plant"),
    )
    for against in (Against.INPUT, Against.OUTPUT, Against.REFERENCE):
        what = {"h1": "H1", "h2": "H2", "reference": "plant in the loop by the setpoint"}[
            against.value
        ]
        yield f"averaged_{against.value}", what, partial(averaged, against)
    yield "swept", "sweep, local polynomials", partial(swept, 3.0, 120.0)
    yield "swept_end", "sweep, its last half second", partial(swept, 80.0, 150.0)
    yield "bla_robust", "best linear, 6 realisations", lambda: best_linear(6, SEEDS)[0]
    yield "bla_fast", "best linear, lines left out", lambda: best_linear(2, SEEDS, quick=True)[0]


def nonlinear_figures() -> Iterator[Figure]:
    """The variance of the distortion, of both methods, against that which was counted out."""
    truth = cubic().nonlinear_variance()
    for name, quick in (("robust", False), ("fast", True)):
        _, found = best_linear(6 if not quick else 2, SEEDS, quick=quick)
        seen = np.mean([c.nonlinear_variance for c in found], axis=0)
        inner = slice(3, -3)
        ratio_db = 10 * np.log10(seen / truth)
        worst = float(np.max(np.abs(ratio_db[inner if quick else slice(None)])))
        what = f"distortion by the {name} method against the truth, worst line"
        yield Figure(f"nonlinear_{name}_db", what, worst, "dB", at_most=1.0)


def figures() -> Iterator[Figure]:
    """Every estimator against closed forms, then on the virtual rig."""
    for name, what, draw in (*_cases(), *on_the_rig()):
        progress(what)
        yield from figures_of(name, what, draw())
    yield from nonlinear_figures()
    yield from rival_coverage()


def main(as_json: bool) -> int:
    """Measure and print."""
    found = list(figures())
    notes = [
        f"{SEEDS} draws of the noise each; several frequencies count together where there are any"
    ]
    show("estimators", found, notes, as_json)
    return int(any(figure.met is False for figure in found))
