"""Compensation: exact where it is tuned, gone without a bump where it is excluded."""

import numpy as np
import numpy.typing as npt
import pytest

from rtcore.control.compensation import compensation_step
from rtcore.control.law import closed_loop
from rtcore.control.response import (
    branch_response,
    compensation_response,
    quadrature_gains,
    shift,
)
from rtcore.program.segments import Branch
from tests.unit.rtcore.control.laws import NO_FEEDBACK, PERIOD_S, gains, law

T = PERIOD_S
GAINS = gains()
LOAD_HZ = 50.0
FADE_TICKS = 400  # 0.1 s
Floats = npt.NDArray[np.float64]


def terms(velocity: Floats, branches: list[Branch], load_hz: float = LOAD_HZ) -> Floats:
    """(n, 2) velocity and acceleration term, for (n,) velocities and what is asked of the branch."""
    record = law(GAINS)
    parts, found = record["compensation"], np.empty((len(velocity), 2))
    for k, (v, branch) in enumerate(zip(velocity, branches, strict=True)):
        total = compensation_step(GAINS, parts, v, load_hz, int(branch), T)
        found[k] = parts["velocity_term"], parts["acceleration_term"]
        assert total == pytest.approx(sum(found[k]))
    return found


def compensated(velocity: Floats, branch: Branch, load_hz: float = LOAD_HZ) -> Floats:
    """(n,) valve commands of the branch alone."""
    return np.asarray(terms(velocity, [branch] * len(velocity), load_hz).sum(axis=1))


def sine(frequency_hz: float, seconds: float) -> Floats:
    return np.asarray(np.sin(2 * np.pi * frequency_hz * T * np.arange(round(seconds / T))))


def last_second(values: Floats, frequency_hz: float) -> complex:
    """What a sine from tick 0 has become, by its last 4000 samples of whole cycles."""
    ticks = np.arange(len(values) - 4000, len(values))
    return complex(2j * np.mean(values[-4000:] * np.exp(-2j * np.pi * frequency_hz * T * ticks)))


@pytest.mark.parametrize("frequency_hz", [1.0, 4.0, 20.0, 45.0, 130.0])
@pytest.mark.parametrize("branch", [Branch.WITH_NOTCH, Branch.WITHOUT_NOTCH])
def test_a_sine_passes_as_the_response_says(frequency_hz: float, branch: Branch) -> None:
    """The kernels through time against the product of their transfer functions."""
    measured = last_second(compensated(sine(frequency_hz, 4.0), branch), frequency_hz)
    notch = LOAD_HZ if branch is Branch.WITH_NOTCH else None
    wanted = compensation_response(GAINS, notch, shift(frequency_hz, T), T)
    assert measured == pytest.approx(wanted, rel=1e-4)


def test_the_load_itself_does_not_come_through_the_notch() -> None:
    velocity = sine(LOAD_HZ, 4.0)
    through = compensated(velocity, Branch.WITH_NOTCH)[-4000:]
    beside = compensated(velocity, Branch.WITHOUT_NOTCH)[-4000:]
    assert np.max(np.abs(through)) < 1e-6 * np.max(np.abs(beside))


def test_the_notch_follows_the_load() -> None:
    velocity = sine(35.0, 4.0)
    assert np.max(np.abs(compensated(velocity, Branch.WITH_NOTCH, 35.0)[-4000:])) < 1e-6
    assert np.max(np.abs(compensated(velocity, Branch.WITH_NOTCH, 50.0)[-4000:])) > 1e-2


def test_the_notch_moves_when_the_load_does() -> None:
    """A run of three seconds at 35 Hz, then four at 50 Hz."""
    record, branch = law(GAINS), int(Branch.WITH_NOTCH)
    parts, valve = record["compensation"], []
    for load_hz, seconds in ((35.0, 3.0), (50.0, 4.0)):
        for v in sine(load_hz, seconds):
            valve.append(compensation_step(GAINS, parts, v, load_hz, branch, T))
    assert np.max(np.abs(valve[8000:12_000])) < 1e-6
    assert np.max(np.abs(valve[-4000:])) < 1e-6


def test_velocity_and_its_derivative_are_a_quarter_of_a_turn_apart() -> None:
    velocity = sine(4.0, 4.0)
    found = terms(velocity, [Branch.WITH_NOTCH] * len(velocity))
    by_velocity, by_acceleration = (last_second(found[:, i], 4.0) for i in (0, 1))
    half_a_tick = 360 * 4.0 * T / 2
    turn = np.angle(by_acceleration / by_velocity, deg=True)
    assert turn == pytest.approx(90.0 - half_a_tick, abs=1e-3)


@pytest.mark.parametrize("wanted", [1.459 + 0.0717j, 0.3 - 2.0j, -1.0 + 0.1j])
@pytest.mark.parametrize("load_hz", [None, 50.0])
def test_quadrature_gains_make_the_branch_exact_at_one_frequency(
    wanted: complex, load_hz: float | None
) -> None:
    z = shift(4.0, T)
    ff_v, ff_a = quadrature_gains(GAINS, wanted, load_hz, z, T)
    tuned = gains(ff_v=ff_v, ff_a=ff_a)
    assert compensation_response(tuned, load_hz, z, T) == pytest.approx(wanted, rel=1e-9)


def test_the_branch_is_lead_times_low_pass_times_notch() -> None:
    """In continuous time, far below the sampling rate."""
    s, turn = 2j * np.pi * 4.0, 2 * np.pi
    lead = (1 + s / turn) / (1 + s / (3 * turn)) / 3
    low_pass = 1 / (1 + s / (8 * turn))
    omega = turn * LOAD_HZ
    notch = (s**2 + omega**2) / (s**2 + 2 * 0.15 * omega * s + omega**2)
    found = branch_response(GAINS, LOAD_HZ, shift(4.0, T), T)
    assert found == pytest.approx(lead * low_pass * notch, rel=1e-4)


# ---- joining and leaving ----


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (Branch.WITH_NOTCH, Branch.EXCLUDED),
        (Branch.EXCLUDED, Branch.WITH_NOTCH),
        (Branch.WITHOUT_NOTCH, Branch.EXCLUDED),
        (Branch.WITH_NOTCH, Branch.WITHOUT_NOTCH),
        (Branch.WITHOUT_NOTCH, Branch.WITH_NOTCH),
    ],
)
def test_a_branch_joins_and_leaves_without_a_bump(before: Branch, after: Branch) -> None:
    """A step of the valve exceeds the signal's own only by a tick's share of the fade.

    Blending two signals has a slope of its own, which the acceleration term sees: their distance in fade_s.
    """
    velocity = 0.05 * sine(4.0, 3.0) + 0.02 * sine(LOAD_HZ, 3.0)
    switch, rest = 8000, len(velocity) - 8000
    parts = [terms(velocity, [branch] * len(velocity)) for branch in (before, after)]
    first, last = (part.sum(axis=1) for part in parts)
    switched = terms(velocity, [before] * switch + [after] * rest).sum(axis=1)

    own = max(np.max(np.abs(np.diff(x[switch - 1000 :]))) for x in (first, last))
    apart = np.max(np.abs(first[switch:] - last[switch:]))
    filtered_apart = np.max(np.abs(parts[0][switch:, 0] - parts[1][switch:, 0])) / GAINS["ff_v"]
    blending = GAINS["ff_a"] * filtered_apart / (FADE_TICKS * T)
    assert apart > 0.01  # there is something to bump
    steps = np.abs(np.diff(switched[switch - 10 : switch + FADE_TICKS + 50]))
    assert np.max(steps) < own + apart / FADE_TICKS + blending
    assert switched[:switch] == pytest.approx(first[:switch])
    done = switch + FADE_TICKS + 2
    assert switched[done:] == pytest.approx(last[done:], abs=1e-9)


def test_an_excluded_branch_gives_nothing() -> None:
    assert not np.any(compensated(sine(4.0, 0.5), Branch.EXCLUDED))


def test_compensation_may_be_switched_off_altogether() -> None:
    off = gains(compensate=0)
    parts, branch = law(off)["compensation"], int(Branch.WITH_NOTCH)
    assert not any(compensation_step(off, parts, v, LOAD_HZ, branch, T) for v in sine(4.0, 0.5))


def test_the_law_adds_the_branch_to_the_valve_command() -> None:
    alone, branch = gains(**NO_FEEDBACK), Branch.WITH_NOTCH
    record, velocity = law(alone), 0.05 * sine(4.0, 0.5)
    found = [closed_loop(alone, record, 0.0, 0.0, v, LOAD_HZ, int(branch), T) for v in velocity]
    assert found == pytest.approx(compensated(velocity, branch))
    assert record["valve"] == found[-1]
