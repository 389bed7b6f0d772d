"""Short tests drawn from a seed, every kind of block among them, and detectors that only indicate beside them."""

from collections.abc import Callable
from typing import Any

import numpy as np

from app.interlocks.defaults import IN_A_TEST, default_interlocks
from app.interlocks.table import Detector, Interlocks
from rtcore.interlocks import Action, Comparison, Quantity

Item = dict[str, Any]
Rng = np.random.Generator


def _sine(rng: Rng) -> Item:
    amplitude_n, hz = float(rng.uniform(3e3, 18e3)), float(rng.uniform(2, 90))
    mean_n = float(rng.uniform(-5e3, 5e3))
    shape = {"mean_n": mean_n, "amplitude_n": amplitude_n, "frequency_hz": hz}
    return {"kind": "harmonic", "taper_cycles": 4, **shape, "cycles": int(rng.integers(4, 20))}


def _step(rng: Rng) -> Item:
    return {"kind": "step", "to_n": float(rng.uniform(-15e3, 15e3)), "hold_s": 0.2}


def _ramp(rng: Rng) -> Item:
    return {"kind": "ramp", "to_n": float(rng.uniform(-30e3, 30e3)), "rate_n_s": 100e3}


def _hold(rng: Rng) -> Item:
    return {"kind": "hold", "force_n": float(rng.uniform(-20e3, 20e3)), "duration_s": 0.2}


def _sweep(rng: Rng) -> Item:
    low, high = sorted(float(hz) for hz in rng.uniform(5, 90, 2))
    ends = {"from_hz": low, "to_hz": high + 5}
    return {"kind": "sweep", "amplitude_n": float(rng.uniform(3e3, 8e3)), **ends, "duration_s": 1.0}


def _history(rng: Rng) -> Item:
    t = np.arange(200) / 400
    waves = [rng.uniform(1e3, 4e3) * np.sin(2 * np.pi * hz * t) for hz in rng.uniform(1, 15, 3)]
    samples = np.sin(np.pi * t / t[-1]) ** 2 * np.sum(waves, axis=0)
    return {"kind": "time_history", "samples_n": samples.tolist(), "rate_hz": 400}


def _layers(rng: Rng) -> Item:
    layers = [
        {
            "mean_n": float(rng.uniform(-5e3, 5e3)),
            "amplitude_n": float(rng.uniform(2e3, 8e3)),
            "frequency_hz": float(rng.uniform(10, 60)),
            "cycles": 8,
        }
        for _ in range(2)
    ]
    return {"kind": "layers", "layers": layers, "repeats": 2, "transition_s": 0.2}


KINDS: tuple[Callable[[Rng], Item], ...] = (
    *(_sine, _sine, _step, _ramp, _hold),
    *(_sweep, _history, _layers),
)


def drawn(seed: int) -> Item:
    """A definition as plain data, some seconds long."""
    rng = np.random.default_rng(seed)
    # The load by which a peak is told to 1 % from the sensor's noise.
    first = {"kind": "hold", "force_n": float(rng.choice([-6e3, 6e3])), "duration_s": 0.1}
    chosen = [KINDS[int(rng.integers(len(KINDS)))] for _ in range(int(rng.integers(1, 4)))]
    motion = []
    if rng.uniform() < 0.5:
        hz = float(rng.uniform(1, 6))
        amplitude_m = float(rng.uniform(0.2, 0.9)) * 0.1 / (2 * np.pi * hz)
        motion = [
            {
                "kind": "harmonic",
                "amplitude_m": min(amplitude_m, 0.02),
                "frequency_hz": hz,
                "duration_s": 1.0,
            }
        ]
    blocks = [first, *(kind(rng) for kind in chosen)]
    return {"schema": 1, "name": f"Drawn {seed}", "blocks": blocks, "motion": motion}


def indicating() -> Interlocks:
    """The shipped detectors, and many that only indicate: now below their thresholds, now above."""
    rows = (
        *((Quantity.FORCE_N, t, s) for t in (5e3, 8e3, 12e3, 18e3, 25e3) for s in (0.0, 0.01)),
        *((Quantity.FORCE_ERROR_N, t, s) for t in (2e3, 6e3, 12e3) for s in (0.0, 0.004)),
        *((Quantity.VELOCITY_M_S, t, 0.0) for t in (0.05, 0.1, 0.2)),
        *((Quantity.DISPLACEMENT_M, t, 0.0) for t in (0.002, 0.008)),
    )
    more = tuple(
        Detector(
            name=f"shown_{i}",
            quantity=quantity,
            comparison=Comparison.MAGNITUDE_ABOVE,
            threshold=threshold,
            persistence_s=persistence_s,
            action=Action.INDICATE,
            armed=IN_A_TEST,
        )
        for i, (quantity, threshold, persistence_s) in enumerate(rows)
    )
    return Interlocks(detectors=(*default_interlocks().detectors, *more))


def has_a_sign(quantity: str, margin: float) -> bool:
    """Whether a margin is more than what the sensors' noise makes of it (5 sigma, two steps of the LVDT)."""
    noise = {"force_n": 40.0, "force_error_n": 40.0, "velocity_m_s": 1e-3, "displacement_m": 2.2e-6}
    return abs(margin) > noise.get(quantity, 0.0)
