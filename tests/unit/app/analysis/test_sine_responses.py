"""What a test may ask of a frequency response, from made-up sines."""

import math

import pytest

from app.analysis.evidence import Sine
from app.analysis.findings import Findings
from app.analysis.measurements import Values, read_all
from app.analysis.sine_responses import Required
from app.analysis.sines import FoundSine

LOW_PASS_HZ = 30.0


def low_pass(hz: float, amplitude_n: float = 1000.0, block: int = 0) -> FoundSine:
    """1/(1 + jf/30): −3 dB at 30 Hz, and −45° there."""
    response = 1 / complex(1, hz / LOW_PASS_HZ)
    phase_deg = math.degrees(math.atan2(response.imag, response.real))
    return FoundSine(
        block, Sine(hz, amplitude_n, 0.0), amplitude_n * abs(response), 0.0, phase_deg, 0.0
    )


def values(sines: list[FoundSine], *required: Required) -> Values:
    return read_all(Findings(sines=sines, required=required))


def band(high_db: float | None = None, low_deg: float | None = None, block: int = 0) -> Required:
    return Required(block, 10.0, 50.0, None, high_db, low_deg, None)


SINES = [low_pass(hz) for hz in (5.0, 10.0, 20.0, 25.0, 35.0, 50.0, 80.0)]


def test_peak_least_and_corner() -> None:
    found = values(SINES)
    assert found["response_peak_db"] == pytest.approx(-10 * math.log10(1 + (5 / 30) ** 2))
    assert found["response_least_db"] == pytest.approx(-10 * math.log10(1 + (80 / 30) ** 2))
    assert found["bandwidth_minus_3_db_hz"] == pytest.approx(30.0, rel=0.02)
    assert found["phase_minus_90_deg_hz"] is None
    assert found["bands_met"] is None


def test_of_one_sine_there_is_no_response() -> None:
    found = values([low_pass(20.0)])
    assert found["response_peak_db"] is None
    assert found["bandwidth_minus_3_db_hz"] is None


def test_amplitudes_are_responses_of_their_own_and_the_worst_counts() -> None:
    slower = [
        low_pass(hz)._replace(
            asked=Sine(hz / 2, 500.0, 0.0), amplitude_n=0.5 * low_pass(hz).amplitude_n
        )
        for hz in (5.0, 20.0, 50.0, 80.0)
    ]
    assert values([*SINES, *slower])["bandwidth_minus_3_db_hz"] == pytest.approx(15.0, rel=0.1)


def test_a_sine_that_was_backed_off_stays_in_the_response_that_it_was_played_for() -> None:
    whole = [low_pass(hz, 2000.0) for hz in (5.0, 20.0)]
    backed_off = low_pass(40.0)._replace(asked=Sine(40.0, 1000.0, 0.0, asked_n=2000.0))
    assert values(whole)["bandwidth_minus_3_db_hz"] is None
    found = values([*whole, backed_off])
    assert found["bandwidth_minus_3_db_hz"] == pytest.approx(30.0, rel=0.1)
    planned = backed_off._replace(asked=Sine(40.0, 1000.0, 0.0))
    assert values([*whole, planned])["bandwidth_minus_3_db_hz"] is None


def test_bands_are_met_by_a_share_of_their_sines() -> None:
    assert values(SINES, band(high_db=0.0))["bands_met"] == 1.0
    assert values(SINES, band(high_db=-3.0))["bands_met"] == pytest.approx(2 / 5)
    assert values(SINES, band(low_deg=-46.0))["bands_met"] == pytest.approx(3 / 5)
    assert values(SINES, band(high_db=0.0), band(low_deg=-46.0))["bands_met"] == pytest.approx(
        3 / 5
    )
    assert values(SINES, band(high_db=0.0, block=1))["bands_met"] is None


def test_what_is_no_number_meets_nothing() -> None:
    broken = low_pass(20.0)._replace(amplitude_n=math.nan)
    assert values([broken, low_pass(30.0)], band(high_db=100.0))["bands_met"] == 0.5
