"""Margins of loops that cross more than once, against python-control's list of every crossing."""

import control
import numpy as np
import numpy.typing as npt
import pytest

from app.analysis.force_loop import ForceLoop
from app.analysis.linear import linear_rig
from app.analysis.response.margins import Margins, followed, margins_of
from app.controller.record import to_record
from app.controller.settings import ControllerSettings
from rtcore.rig.parameters import rig_from

FROM_HZ, TO_HZ = 0.05, 400.0
S = control.tf("s")


def _pair(hz: float, damping: float) -> control.TransferFunction:
    return (S / (2 * np.pi * hz)) ** 2 + 2 * damping * S / (2 * np.pi * hz) + 1


SEVERAL = {
    "a resonance turns over again, above the first turn": (
        5 / (S * (1 + S / 50) ** 2) * _pair(20, 0.02) / _pair(60, 0.005)
    ),
    "a resonance comes above 1 again": (
        20 / S / (1 + S / 200) ** 2 * _pair(60, 0.02) / _pair(90, 0.002)
    ),
    "stable with its gain alone": 8000 * (1 + S / 10) ** 2 / (S**3 * (1 + S / 400) ** 2),
    "above 1 at the last frequency": 3 * S * _pair(30, 0.1) / _pair(25, 0.02) / (S + 20),
    "a resonance below the notch": 30 / S / _pair(30, 0.02) * _pair(40, 0.02) / _pair(150, 0.02),
}


def _theirs(loop: control.TransferFunction) -> tuple[float, float]:
    """Gain and phase margin nearest to 0, of the crossings between the two frequencies."""
    gain, phase_deg, _, turnover, crossover, _ = control.stability_margins(loop, returnall=True)
    within = [(f > 2 * np.pi * FROM_HZ) & (f < 2 * np.pi * TO_HZ) for f in (turnover, crossover)]
    gain_db = 20 * np.log10(gain[within[0]])
    return (
        min(gain_db, key=abs, default=np.nan),
        min(phase_deg[within[1]], key=abs, default=np.nan),
    )


def _ours(loop: control.TransferFunction) -> Margins:
    def at(hz: npt.NDArray[np.float64]) -> npt.NDArray[np.complex128]:
        return np.asarray(loop(2j * np.pi * hz))

    grid = np.geomspace(FROM_HZ, TO_HZ, 300)
    return margins_of(*followed(at, grid), lambda hz: complex(loop(2j * np.pi * hz)))


@pytest.mark.parametrize("loop", SEVERAL.values(), ids=SEVERAL)
def test_the_nearest_of_every_crossing_is_told(loop: control.TransferFunction) -> None:
    gain_db, phase_deg = _theirs(loop)
    found = _ours(loop)
    assert found.gain_db == pytest.approx(gain_db, abs=1e-4, nan_ok=True)
    assert found.phase_deg == pytest.approx(phase_deg, abs=1e-3, nan_ok=True)
    for hz in (found.crossover_hz, found.turnover_hz):
        if np.isfinite(hz):
            assert found.worst_sensitivity >= 0.999 / abs(1 + loop(2j * np.pi * hz))
    points_hz = np.geomspace(FROM_HZ, TO_HZ, 100_000)
    of_points = margins_of(points_hz, loop(2j * np.pi * points_hz))
    assert of_points.gain_db == pytest.approx(gain_db, abs=0.02, nan_ok=True)
    assert of_points.phase_deg == pytest.approx(phase_deg, abs=0.1, nan_ok=True)


def test_it_is_so_of_drawn_loops() -> None:
    rng = np.random.default_rng(5)
    several = 0
    for _ in range(150):
        hz, damping = np.exp(rng.uniform(np.log(3), np.log(150), 3)), rng.uniform(0.005, 0.3, 3)
        loop = rng.uniform(5, 200) / S * _pair(hz[2], damping[2])
        loop = loop / _pair(hz[0], damping[0]) / _pair(hz[1], damping[1])
        found, (gain_db, phase_deg) = _ours(loop), _theirs(loop)
        assert found.gain_db == pytest.approx(gain_db, abs=1e-3, nan_ok=True)
        assert found.phase_deg == pytest.approx(phase_deg, abs=1e-2, nan_ok=True)
        several += len(control.stability_margins(loop, returnall=True)[4]) > 1
    assert several > 30  # or they say nothing of a second crossing


STRUCTURE = {"k_pl": 1.99, "k_lc": 0.47, "k_2": 0.69, "m_1_kg": 1.98, "m_2_kg": 0.65}


def test_a_rig_is_told_by_its_resonance_where_that_is_nearest() -> None:
    """With another unit and load cell its phase turns over three times, the third time nearly at a gain of 1."""
    shipped = rig_from({}).structure.model_dump()
    other = rig_from({"structure": {name: shipped[name] * by for name, by in STRUCTURE.items()}})
    loop = ForceLoop(linear_rig(other, 5000.0), to_record(ControllerSettings()), 250e-6)
    found = loop.margins()
    hz = np.linspace(200, 400, 8000)
    values = loop.open_loops(hz)
    turns = np.flatnonzero((values.imag[1:] * values.imag[:-1] < 0) & (values.real[1:] < 0))
    assert len(turns) > 1
    least = turns[np.argmin(np.abs(np.log(np.abs(values[turns]))))]
    assert found.turnover_hz == pytest.approx(hz[least], abs=0.02)
    assert found.gain_db == pytest.approx(-20 * np.log10(abs(values[least])), abs=0.05)
    assert turns[0] != least


def test_what_was_not_measured_is_left_out() -> None:
    hz = np.geomspace(FROM_HZ, TO_HZ, 2000)
    loop = 20 / (2j * np.pi * hz) / (1 + 2j * np.pi * hz / 200) ** 2
    gaps = loop.copy()
    gaps[5::50] = np.nan
    assert margins_of(hz, gaps).gain_db == pytest.approx(margins_of(hz, loop).gain_db, abs=0.01)
    nothing = margins_of(hz, np.zeros(len(hz), complex))
    assert np.isnan([nothing.crossover_hz, nothing.gain_db, nothing.turnover_hz]).all()
    assert nothing.worst_sensitivity == 1.0
