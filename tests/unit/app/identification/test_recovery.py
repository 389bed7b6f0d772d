"""A rig is told from its sensors: exactly where they are ideal, within its intervals where they are not."""

import numpy as np
import pytest

from app.errors import Refusal
from app.identification.fitting import Problem, Search
from app.identification.identify import identify
from app.identification.noise import deviations
from app.identification.parameters import PARAMETER, PARAMETERS, changed, coordinates, read
from app.identification.schemas import Fit, Identified
from app.identification.windows import Source
from rtcore.rig.parameters import RigParameters, load_rig
from tests.unit.app.identification.made_up import PERIOD_S, SHORT, Kept, noise_free, recorded

OFF = {
    "structure.k_pl": 0.85,
    "unit.k_tra": 1.15,
    "load_actuator.bypass_diameter_m": 1.12,
    "servovalve.omega_f_rad_s": 0.88,
    "servovalve.spool_gain_rad_s": 1.15,
    "load_actuator.coulomb_n": 0.85,
    "load_actuator.viscous_n_s_m": 1.18,
}
SERVO = ("unit.omega_t_rad_s", "unit.zeta_t")


def off(shares: dict[str, float]) -> RigParameters:
    shipped = load_rig()
    return changed(shipped, {path: read(shipped, path) * x for path, x in shares.items()})


def told(kept: Kept, fit: Fit) -> Identified:
    sources = [Source(1, kept, 16)]
    found = identify(sources, load_rig(), fit, PERIOD_S, lambda _: None)
    assert isinstance(found, Identified), found
    return found


def test_ideal_sensors_give_a_rig_back_to_a_ten_thousandth() -> None:
    shipped = load_rig()
    wanted = [PARAMETER[path] for path in OFF]
    noise = deviations(shipped.sensors)
    problem = Problem(shipped, wanted, noise_free(off(OFF), 4), 1, noise, PERIOD_S)
    fitted = Search(problem).run(lambda _: None)
    assert fitted.settled
    assert fitted.at[: len(wanted)] == pytest.approx(coordinates(off(OFF), wanted), abs=1e-4)


@pytest.mark.slow
def test_a_rig_is_told_from_half_a_minute_of_a_loop_with_noise_and_converters() -> None:
    rig = off(OFF)
    found = told(recorded(rig, SHORT), Fit(parameters=tuple(OFF), windows=10, candidates=40))
    assert found.settled
    assert found.notes == []
    for p in found.parameters:
        assert p.determined
        assert not p.at_bound
        true, half = read(rig, p.path), 0.5 * (p.high - p.low)
        assert abs(p.after - true) < 2.0 * half, p  # of seven, one may be outside its interval
        assert abs(p.after / true - 1.0) < 0.03, p
    for channel in found.residuals:  # nothing is left but what the sensors add
        assert channel.after_rms < 1.05 * channel.noise
    assert found.goodness.before_percent is not None
    assert found.goodness.after_percent is not None
    assert found.goodness.before_percent < 98 < 99.8 < found.goodness.after_percent


@pytest.mark.slow
def test_what_a_run_does_not_tell_is_said_and_kept_out_of_the_model() -> None:
    still = {**SHORT, "motion": []}
    asked = Fit(parameters=("unit.k_tra", *SERVO), windows=4, candidates=10)
    found = told(recorded(load_rig(), still), asked)
    assert [p.determined for p in found.parameters] == [True, False, False]
    assert [note.split(":")[0] for note in found.notes] == [*SERVO]
    assert set(found.values()) == {"unit.k_tra"}


def test_a_run_that_is_too_short_is_refused() -> None:
    short = {**SHORT, "blocks": [{"kind": "hold", "force_n": 0, "duration_s": 1}], "motion": []}
    sources = [Source(1, recorded(load_rig(), short), 16)]
    found = identify(sources, load_rig(), Fit(), PERIOD_S, lambda _: None)
    assert isinstance(found, Refusal)
    assert "0.4 s" in found.detail


def test_parameters_are_where_the_table_says() -> None:
    rig = load_rig()
    for p in PARAMETERS:
        at = p.coordinate(read(rig, p.path))
        assert p.value(at) == pytest.approx(read(rig, p.path), rel=1e-12)
        low, high = p.bounds(read(rig, p.path))
        assert low < at < high
        for end in (low, high):
            if p.path != "structure.k_lc":  # stiffer, it would be too fast for the integrator
                changed(rig, {p.path: p.value(end)})
        assert p.slope(at) == pytest.approx((p.value(at + 1e-6) - p.value(at - 1e-6)) / 2e-6)
    assert np.unique([p.path for p in PARAMETERS]).size == len(PARAMETERS)
