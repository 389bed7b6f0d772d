"""The sheets against python-control, the rig's data sheet and closed forms."""

import control
import numpy as np
import pytest

from app.controller.settings import ControllerSettings
from app.definitions.limits import RIG
from app.errors import Refusal
from app.sheets.asked import CompensatorAsked, LinearAsked, StaticAsked
from app.sheets.compensator import compensator_sheet
from app.sheets.linear import linear_sheet, linearised
from app.sheets.schemas import CompensatorSheet, LinearSheet
from app.sheets.static import static_sheet, with_orifice
from rtcore.rig.constants import bypass_flow_gain, valve_flow_gain
from rtcore.rig.linear import FORCE_READ, StateSpace
from rtcore.rig.parameters import load_rig
from rtcore.rig.plant import U_VALVE

RIG_AS_SHIPPED = load_rig()
AS_SHIPPED = ControllerSettings()


def linear(**asked: object) -> LinearSheet:
    found = linear_sheet(RIG_AS_SHIPPED, AS_SHIPPED, LinearAsked.model_validate(asked))
    assert isinstance(found, LinearSheet)
    return found


def compensator(**asked: object) -> CompensatorSheet:
    found = compensator_sheet(RIG_AS_SHIPPED, AS_SHIPPED, CompensatorAsked.model_validate(asked))
    assert isinstance(found, CompensatorSheet)
    return found


def _loop(amplitude_n: float) -> control.TransferFunction | control.StateSpace:
    """L = C P z⁻¹ by python-control: its own discretisation, its own blocks, nothing of the app's."""
    rig = linearised(RIG_AS_SHIPPED, amplitude_n, 0.0)
    assert isinstance(rig, StateSpace)
    c = AS_SHIPPED
    t = RIG.period_s
    plant = control.ss(rig.a, rig.b[:, [U_VALVE]], rig.c[[FORCE_READ]], 0.0).sample(t, "zoh")
    a = float(np.exp(-2 * np.pi * c.derivative_hz * t))
    pid = (
        control.tf([c.k_p], [1.0], t)
        + control.tf([c.k_i * t, 0.0], [1.0, -1.0], t)
        + control.tf(np.array([1.0, -1.0]) * c.k_d * (1 - a) / t, [1.0, -a], t)
    )
    return control.ss(pid) * plant * control.ss(control.tf([1.0], [1.0, 0.0], t))


@pytest.mark.parametrize("amplitude_n", [1e3, 10e3])
def test_the_loop_is_the_one_that_python_control_makes(amplitude_n: float) -> None:
    sheet = linear(amplitude_n=[amplitude_n], from_hz=2.0, to_hz=300.0, points=40)
    omega = 2 * np.pi * np.array(sheet.frequencies_hz, np.float64)
    expected = control.frequency_response(_loop(amplitude_n), omega).frdata[0, 0]
    found = sheet.loops[0].open_loop
    assert found.gain_db == pytest.approx(20 * np.log10(np.abs(expected)), abs=1e-4)
    turned = np.degrees(np.unwrap(np.angle(expected)))
    assert np.array(found.phase_deg) - turned == pytest.approx(
        np.full(40, found.phase_deg[0] - turned[0]), abs=1e-3
    )
    dense = control.frd(_loop(amplitude_n), 2 * np.pi * np.geomspace(10.0, 300.0, 2000))
    gain, phase, _, turnover, crossover, _ = control.stability_margins(dense)
    margins = sheet.loops[0].margins
    assert margins.phase_margin_deg == pytest.approx(phase, abs=0.02)
    assert margins.gain_margin_db == pytest.approx(20 * np.log10(gain), abs=0.005)
    assert margins.crossover_hz == pytest.approx(crossover / (2 * np.pi), rel=1e-4)
    assert margins.turnover_hz == pytest.approx(turnover / (2 * np.pi), rel=1e-4)


def test_the_table_is_that_of_the_data_sheet() -> None:
    rows = [
        (1e3, 138e3, 199e3, 1.20e-3, 43.7, 62, 10.1, 1.56),
        (2e3, 193e3, 279e3, 1.68e-3, 45.6, 57, 10.0, 1.58),
        (5e3, 300e3, 432e3, 2.60e-3, 46.9, 51, 9.9, 1.59),
        (10e3, 416e3, 599e3, 3.61e-3, 47.4, 48, 9.8, 1.60),
    ]
    for loop, row in zip(linear().loops, rows, strict=True):
        m = loop.margins
        assert loop.amplitude_n == row[0]
        assert loop.k_1_n == pytest.approx(row[1], rel=4e-3)
        assert (loop.k_2_n_s_m, loop.tau_s) == pytest.approx(row[2:4], rel=5e-3)
        assert m.crossover_hz == pytest.approx(row[4], abs=0.15)
        assert m.phase_margin_deg == pytest.approx(row[5], abs=0.6)
        assert m.gain_margin_db == pytest.approx(row[6], abs=0.06)
        assert m.worst_sensitivity == pytest.approx(row[7], abs=0.01)


def test_a_mean_takes_damping_away_as_the_data_sheet_says() -> None:
    """2 kN about 20 kN peaked at +5.03 dB with all that is not linear; at the mean of 0 at +2.46."""
    there, about_zero = linear(amplitude_n=[2e3], mean_n=20e3), linear(amplitude_n=[2e3])
    for sheet, peak_db, tolerance in ((there, 5.03, 0.2), (about_zero, 2.46, 0.3)):
        peak = sheet.loops[0].peak
        assert peak is not None
        assert peak.gain_db == pytest.approx(peak_db, abs=tolerance)
    assert there.loops[0].dip is None
    nearly = linear(amplitude_n=[2e3], mean_n=1e-3)
    assert nearly.loops[0].k_1_n == pytest.approx(about_zero.loops[0].k_1_n, rel=1e-3)


@pytest.mark.parametrize("to_hz", [110.0, 400.0, 1000.0])
def test_peak_and_dip_are_the_loops_however_far_it_is_looked(to_hz: float) -> None:
    """The structure lets nothing through at 317 Hz, -29 dB, and rises by 23 dB to 590 Hz: neither counts."""
    loop = linear(amplitude_n=[10e3], from_hz=1.0, to_hz=to_hz, points=400).loops[0]
    assert loop.peak is not None
    assert loop.dip is not None
    assert (loop.peak.frequency_hz, loop.dip.frequency_hz) == pytest.approx((35.3, 86.4), abs=0.5)
    assert (loop.peak.gain_db, loop.dip.gain_db) == pytest.approx((3.74, -1.77), abs=0.01)


def test_a_mean_that_the_rig_cannot_hold_is_refused() -> None:
    weak = RIG_AS_SHIPPED.model_copy(
        update={"supply": RIG_AS_SHIPPED.supply.model_copy(update={"high_pa": 10e6})}
    )
    found = linear_sheet(weak, AS_SHIPPED, LinearAsked(mean_n=40e3))
    assert isinstance(found, Refusal)
    assert [fault.path for fault in found.faults] == ["mean_n"]


def test_the_branch_is_made_of_its_filters() -> None:
    """Figure 11 at 40 Hz: the notch there, the lead 1 far above its pole, the low-pass -3 dB at its corner."""
    sheet = compensator(load_hz=40.0, from_hz=0.5, to_hz=400.0, points=600)
    frequencies = np.array(sheet.frequencies_hz, np.float64)

    def gain_db(name: str, hz: float) -> float:
        return float(np.interp(hz, frequencies, getattr(sheet, name).gain_db))

    assert gain_db("notch", 40.0) < -25.0
    assert gain_db("notch", 400.0) == pytest.approx(0.0, abs=0.05)
    assert gain_db("low_pass", AS_SHIPPED.compensator.low_pass_hz) == pytest.approx(-3.01, abs=0.02)
    assert gain_db("lead", 399.0) == pytest.approx(0.0, abs=0.01)
    at_1 = 20 * np.log10(abs((1 + 1j) / (1 + 1j / 3) / 3))
    assert gain_db("lead", 1.0) == pytest.approx(at_1, abs=0.01)
    parts = sum(np.array(getattr(sheet, n).gain_db) for n in ("lead", "low_pass", "notch"))
    assert np.array(sheet.whole.gain_db) == pytest.approx(parts, abs=1e-6)


def test_the_exact_tuning_is_the_shipped_one_and_takes_the_motion_out() -> None:
    sheet = compensator(load_hz=50.0, tune_hz=4.0, from_hz=4.0, to_hz=100.0, points=50)
    assert sheet.tuning is not None
    shipped = AS_SHIPPED.compensator
    assert (sheet.tuning.ff_v, sheet.tuning.ff_a) == pytest.approx(
        (shipped.ff_v, shipped.ff_a), rel=5e-5
    )
    left = sheet.disturbance_db
    assert left[0] is not None
    assert left[0] < -60.0  # tuned there
    assert max(x for x in left if x is not None) < 10.0


def test_the_static_sheet_is_equation_3_for_each_orifice() -> None:
    sheet = static_sheet(RIG_AS_SHIPPED, StaticAsked(orifice_diameter_m=(0.5e-3, 1.2e-3), points=5))
    assert sheet.in_force_diameter_m == RIG_AS_SHIPPED.load_actuator.bypass_diameter_m
    for orifice, diameter in zip(sheet.orifices, (0.5e-3, 1.2e-3), strict=True):
        rig = with_orifice(RIG_AS_SHIPPED, diameter)
        ratio = (valve_flow_gain(rig) / bypass_flow_gain(rig)) ** 2
        at_half = sheet.pressure_pa * 0.25 * ratio / (1 + 0.25 * ratio)
        assert orifice.load_pressure_pa[3] == pytest.approx(at_half)
        assert orifice.force_n[1] == pytest.approx(-at_half * rig.load_actuator.area_m2)
    assert sheet.valve_command == [-1.0, -0.5, 0.0, 0.5, 1.0]
