"""What an estimator says over many draws of its noise, against the truth."""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from app.analysis.response.curve import Curve
from app.analysis.response.point import ResponsePoint
from bench.known_systems import Complex, Floats
from bench.report import Figure

SEEDS = 1000
BIAS_DB, BIAS_DEG = 0.02, 0.1
HELD = (0.93, 0.97)


class Draws(NamedTuple):
    """(draws, frequencies) gains, whether their 95 % intervals held the truth, and the truth, (frequencies,)."""

    gain: Complex
    gain_held: npt.NDArray[np.bool_]
    phase_held: npt.NDArray[np.bool_]
    truth: Complex


class Said(NamedTuple):
    """One draw: (frequencies,) gains and (frequencies, 2) intervals, the phase's in degrees."""

    gain: Complex
    gain_95: Floats
    phase_95_deg: Floats

    @staticmethod
    def by(curve: Curve, lines: slice = slice(None)) -> "Said":
        """A curve, or some of its lines."""
        return Said(curve.gain[lines], curve.gain_95[lines], curve.phase_95_deg[lines])

    @staticmethod
    def at(point: ResponsePoint) -> "Said":
        """A point."""
        gain = point.gain * np.exp(1j * np.radians(point.phase_deg))
        return Said(np.array([gain]), np.array([point.gain_95]), np.array([point.phase_95_deg]))


def draws_of(said: Iterable[Said], truth: Complex) -> Draws:
    """Of all that was said; the phase is compared by how far it is turned, so that 180° is no edge."""
    gains, held_gain, held_phase = [], [], []
    size = np.abs(truth)
    for gain, gain_95, phase_95 in said:
        gains.append(gain)
        held_gain.append((gain_95[:, 0] <= size) & (size <= gain_95[:, 1]))
        turned = np.degrees(np.angle(truth / gain))
        half = (phase_95[:, 1] - phase_95[:, 0]) / 2
        held_phase.append(np.abs(turned) <= half)
    return Draws(np.array(gains), np.array(held_gain), np.array(held_phase), truth)


def together(draws: Iterable[Draws]) -> Draws:
    """Those of several frequencies, which were drawn one after another."""
    found = list(draws)
    return Draws(
        np.hstack([d.gain for d in found]),
        np.hstack([d.gain_held for d in found]),
        np.hstack([d.phase_held for d in found]),
        np.concatenate([d.truth for d in found]),
    )


def figures_of(name: str, what: str, draws: Draws) -> Iterator[Figure]:
    """Bias of the mean of all draws at the worst frequency, and how many intervals held the truth."""
    apart = draws.gain.mean(axis=0) / draws.truth
    bias_db = float(np.max(np.abs(20 * np.log10(np.abs(apart)))))
    bias_deg = float(np.max(np.abs(np.degrees(np.angle(apart)))))
    yield Figure(f"{name}_bias_db", f"{what}: bias", bias_db, "dB", at_most=BIAS_DB)
    yield Figure(f"{name}_bias_deg", f"{what}: bias", bias_deg, "°", at_most=BIAS_DEG)
    for kind, held in (("gain", draws.gain_held), ("phase", draws.phase_held)):
        share = float(held.mean())
        worst = 100 * np.array([held.mean(axis=0).min(), held.mean(axis=0).max()])
        alone = f", {worst[0]:.1f} to {worst[1]:.1f} % by frequency" if held.shape[1] > 1 else ""
        note = f"{100 * share:.1f} % of {held.size:,}{alone}"
        asked = HELD[1], HELD[0]
        yield Figure(f"{name}_{kind}_held", f"{what}: {kind} held", share, "-", *asked, note)
