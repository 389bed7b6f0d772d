"""What exceeds the rig, or means nothing, is refused with path, value, limit and unit."""

import math

import pytest

from app.definitions.reading import definition_from
from app.documents.refusal import Problem
from app.errors import Code, Refusal
from tests.unit.app.definitions.bad import (
    Bad,
    history,
    hold,
    layers,
    moving,
    moving_history,
    nested,
    ramp,
    repeat,
    response,
    sine,
    sweep,
    with_blocks,
)

NAN, INFINITE = float("nan"), float("inf")
STEEPEST = math.pi / 2  # of half a cosine, over its mean
YEAR_S = 366 * 86_400


def near(value: float) -> object:
    """A value that was computed."""
    return pytest.approx(value, rel=1e-9)


# fmt: off
LIMITS = [
    Bad(with_blocks(hold(force_n=60e3)), "blocks[0].force_n", 60e3, 50e3, "N",
        "60,000 N must be at most 50,000 N"),
    Bad(with_blocks(ramp(to_n=-50001)), "blocks[0].to_n", -50001, -50e3, "N",
        "-50,001 N must be at least -50,000 N"),
    Bad(with_blocks(hold(), sine(amplitude_n=60e3)), "blocks[1].amplitude_n", 60e3, 50e3, "N",
        "60,000 N must be at most 50,000 N"),
    Bad(with_blocks(sine(mean_n=-30e3, amplitude_n=25e3)), "blocks[0].amplitude_n", 55e3, 50e3, "N",
        "mean and amplitude reach 55,000 N"),
    Bad(with_blocks(layers(mean_n=49.5e3)), "blocks[0].layers[0].amplitude_n", 50.5e3, 50e3, "N",
        "mean and amplitude reach 50,500 N"),
    Bad(with_blocks(sine(frequency_hz=3000)), "blocks[0].frequency_hz", 3000, 2000, "Hz",
        "3,000 Hz must be below 2,000 Hz"),
    Bad(with_blocks(sine(frequency_hz=2000)), "blocks[0].frequency_hz", 2000, 2000, "Hz",
        "2,000 Hz must be below 2,000 Hz"),
    Bad(with_blocks(sine(frequency_hz=0)), "blocks[0].frequency_hz", 0, 0, "Hz",
        "0 Hz must be above 0 Hz"),
    Bad(with_blocks(hold(duration_s=-1)), "blocks[0].duration_s", -1, 0, "s",
        "-1 s must be above 0 s"),
    Bad(with_blocks(sine(cycles=0)), "blocks[0].cycles", 0, 1, None, "0 must be at least 1"),
    Bad(with_blocks(ramp(rate_n_s=3e6)), "blocks[0].rate_n_s", 3e6, 2e6, "N/s",
        "3,000,000 N/s must be at most 2,000,000 N/s"),
    Bad(with_blocks(repeat(2e7, hold())), "blocks[0].times", 2e7, 1e7, None,
        "20,000,000 must be at most 10,000,000"),
    Bad(with_blocks(repeat(2, hold(), hold(duration_s=0))), "blocks[0].blocks[1].duration_s",
        0, 0, "s", "0 s must be above 0 s"),
    Bad(with_blocks(sine(frequency_hz=1e-300)), "blocks[0].cycles", near(2e302), YEAR_S, "s",
        "200 cycles last"),
    Bad(moving(amplitude_m=0.04, frequency_hz=0.1), "motion[0].amplitude_m", 0.04, 0.03, "m",
        "0.04 m must be at most 0.03 m"),
    Bad(moving(mean_m=0.025, amplitude_m=0.01, frequency_hz=1), "motion[0].amplitude_m",
        near(0.035), 0.03, "m", "mean and amplitude reach 0.035 m"),
    Bad(moving(amplitude_m=0.01), "motion[0].amplitude_m", near(2 * math.pi * 0.01 * 4), 0.2, "m/s",
        "0.01 m at 4 Hz reaches 0.251327 m/s, must be at most 0.2 m/s"),
    Bad(with_blocks(hold(), motion=[{"kind": "ramp", "to_m": 0.02, "rate_m_s": 0.3}]),
        "motion[0].rate_m_s", 0.3, 0.2, "m/s", "0.3 m/s must be at most 0.2 m/s"),
]
MEANINGS = [
    Bad(with_blocks(sine(cycles=1.5)), "blocks[0].cycles", 1.5, None, None, "a whole number"),
    Bad(with_blocks(hold(force_n=NAN)), "blocks[0].force_n", "nan", None, "N",
        "must be finite, is not a number"),
    Bad(with_blocks(sine(amplitude_n=INFINITE)), "blocks[0].amplitude_n", "inf", None, "N",
        "must be finite, is inf"),
    Bad(with_blocks(hold(duration_s="1")), "blocks[0].duration_s", "1", None, "s",
        "must be a number, is the text '1'"),
    Bad(with_blocks(sine(cycles=True)), "blocks[0].cycles", True, None, None,
        "must be a whole number, is the truth value true"),
    Bad(with_blocks({"kind": "hold", "duration_s": None}), "blocks[0].duration_s", None, None, "s",
        "must be a number, is empty"),
    Bad(with_blocks(sine(amplitud_n=1)), "blocks[0].amplitud_n", 1, None, "N",
        "unknown key; did you mean amplitude_n?"),
    Bad(with_blocks(layers(freqency_hz=1)), "blocks[0].layers[0].freqency_hz", 1, None, "Hz",
        "unknown key; did you mean frequency_hz?"),
    Bad(with_blocks(hold(), acceptence=1), "acceptence", 1, None, None, "did you mean acceptance?"),
    Bad(with_blocks(hold(), zzz=1), "zzz", 1, None, None, "known here: schema, name"),
    Bad(with_blocks(sine(amplitude_n=None)), "blocks[0].amplitude_n", None, None, "N",
        "amplitude_n is missing"),
    Bad(with_blocks(sine(cycles=None)), "blocks[0].duration_s", None, None, "s",
        "one of cycles and duration_s is needed"),
    Bad(with_blocks(ramp(duration_s=1)), "blocks[0].duration_s", 1, None, "s",
        "give rate_n_s or duration_s, not both"),
    Bad(with_blocks({"kind": "harmonics"}), "blocks[0].kind", "harmonics", None, None,
        "unknown kind 'harmonics'; did you mean harmonic?"),
    Bad(with_blocks({"duration_s": 1}), "blocks[0].kind", None, None, None,
        "kind is missing; known: hold, ramp, step, harmonic, layers, sweep, frequency_response, "
        "time_history, repeat"),
    Bad(with_blocks(3), "blocks[0]", 3, None, None, "must be a mapping"),
    Bad(with_blocks(), "blocks", "a list of 0", None, None, "needs at least 1 entry"),
    Bad(with_blocks(hold(), name=""), "name", "", None, None, "must not be empty"),
    Bad(with_blocks(hold(), schema=2), "schema", 2, None, None, "must be 1"),
    Bad(with_blocks(hold(), controller={"compensation": "of"}), "controller.compensation", "of",
        None, None, "must be auto, on or off; did you mean off?"),
    Bad(with_blocks(hold(), record={"channels": ["forc_n"]}), "record.channels[0]", "forc_n",
        None, None, "did you mean force_n?"),
    Bad(with_blocks(hold(), acceptance=[{"measurement": "goodness", "at_least": 1}]),
        "acceptance[0].measurement", "goodness", None, None, "did you mean goodness_of_fit?"),
    Bad(with_blocks(hold(), acceptance=[{"measurement": "peak_force_n"}]),
        "acceptance[0].at_most", None, None, None, "at_least or at_most is needed"),
    Bad(with_blocks(hold(), acceptance=[{"measurement": "peak_force_n", "at_least": 2,
        "at_most": 1}]), "acceptance[0].at_most", 1, 2, None, "1 must not be below at_least, 2"),
]
SWEEPS = [
    Bad(with_blocks(sweep(to_hz=2000)), "blocks[0].to_hz", 2000, 2000, "Hz", "below 2,000 Hz"),
    Bad(with_blocks(sweep(to_hz=1)), "blocks[0].to_hz", 1, None, "Hz", "use harmonic"),
    Bad(with_blocks(sweep(from_hz=0)), "blocks[0].from_hz", 0, 1e-6, "Hz", "0 Hz must be at least"),
    Bad(with_blocks(sweep(rate_octaves_s=1)), "blocks[0].duration_s", 5, None, "s",
        "give rate_octaves_s or duration_s, not both"),
    Bad(with_blocks(sweep(duration_s=None)), "blocks[0].duration_s", None, None, "s",
        "one of rate_octaves_s and duration_s is needed"),
    Bad(with_blocks(sweep(rate_octaves_s=0, duration_s=None)), "blocks[0].rate_octaves_s", 0, 1e-6,
        "octaves/s", "0 octaves/s must be at least"),
    Bad(with_blocks(sweep(mean_n=49.5e3)), "blocks[0].amplitude_n", 50.5e3, 50e3, "N",
        "mean and amplitude reach 50,500 N"),
    Bad(with_blocks(sweep(law="cubic")), "blocks[0].law", "cubic", None, None,
        "must be log or linear"),
    Bad(with_blocks(sweep(amplitude_n=30e3, from_hz=2, to_hz=1, taper_cycles=0.01)), "blocks[0]",
        near(STEEPEST * 30e3 / 0.005), 2e6, "N/s", "has to move at 9,424,778 N/s"),
]
RESPONSES = [
    Bad(with_blocks(response(amplitudes_n=[])), "blocks[0].amplitudes_n", "a list of 0", None,
        "N", "needs at least 1 entry"),
    Bad(with_blocks(response(amplitudes_n=[1000, 0])), "blocks[0].amplitudes_n[1]", 0, 0, "N",
        "0 N must be above 0 N"),
    Bad(with_blocks(response(mean_n=30e3, amplitudes_n=[1e3, 25e3])), "blocks[0].amplitudes_n",
        55e3, 50e3, "N", "mean and amplitude reach 55,000 N"),
    Bad(with_blocks(response(frequencies_hz=[10, 2000])), "blocks[0].frequencies_hz[1]", 2000,
        2000, "Hz", "2,000 Hz must be below 2,000 Hz"),
    Bad(with_blocks(response(frequencies_hz={"from_hz": 1, "to_hz": 10})),
        "blocks[0].frequencies_hz.points", None, None, None, "points is missing"),
    Bad(with_blocks(response(frequencies_hz={"from_hz": 1, "to_hz": 10, "point": 3, "points": 3})),
        "blocks[0].frequencies_hz.point", 3, None, None, "did you mean points?"),
    Bad(with_blocks(response(frequencies_hz={"from_hz": 5, "to_hz": 5, "points": 3})),
        "blocks[0].frequencies_hz.to_hz", 5, None, "Hz", "must differ from from_hz"),
    Bad(with_blocks(response(frequencies_hz=7)), "blocks[0].frequencies_hz", 7, None, "Hz",
        "must be a list"),
    Bad(with_blocks(response(amplitudes_n=[1] * 3, frequencies_hz={"from_hz": 1, "to_hz": 9,
        "points": 1000})), "blocks[0].frequencies_hz", 3000, 2000, "Hz", "3,000 points in all"),
    Bad(with_blocks(response(method="multisine", frequencies_hz=[10, 10.001])),
        "blocks[0].frequencies_hz", near(1000), 100, "s", "common period of 1,000 s"),
    Bad(with_blocks(response(method="steped_sine")), "blocks[0].method", "steped_sine", None,
        None, "did you mean stepped_sine?"),
]
HISTORIES = [
    Bad(with_blocks(history(samples_n=[0, 60e3], rate_hz=1)), "blocks[0].samples_n", 60e3, 50e3,
        "N", "reaches 60,000 N, must be at most 50,000 N"),
    Bad(with_blocks(history(samples_n=[0, -51e3, 1], rate_hz=1)), "blocks[0].samples_n", 51e3,
        50e3, "N", "reaches 51,000 N"),
    Bad(with_blocks(history(gain=-200)), "blocks[0].samples_n", 100e3, 50e3, "N",
        "reaches 100,000 N"),
    Bad(with_blocks(history(samples_n=[0, 0, 0, 0, 9e3, 9e3], rate_hz=1000)),
        "blocks[0].samples_n", near(1.5 * 9e6), 2e6, "N/s",
        "has to move at 13,500,000 N/s at 0.003 s, must be at most 2,000,000 N/s"),
    Bad(with_blocks(history(samples_n=[0, 10] * 50, rate_hz=1000)), "blocks[0].samples_n",
        near(500), 150, "Hz", "holds frequencies up to 500 Hz (99.9 % of it)"),
    Bad(with_blocks(history(rate_hz=4001)), "blocks[0].rate_hz", 4001, 4000, "Hz",
        "4,001 Hz must be at most 4,000 Hz"),
    Bad(with_blocks(history(rate_hz=1e-9)), "blocks[0].samples_n", near(5e9), YEAR_S, "s",
        "lasts 5,000,000,000 s"),
    Bad(with_blocks(history(rate_hz=None)), "blocks[0].rate_hz", None, None, "Hz",
        "rate_hz is needed for samples without times"),
    Bad(with_blocks(history(samples_n=None)), "blocks[0].samples_n", None, None, "N",
        "one of file and samples_n is needed"),
    Bad(with_blocks(history(file="a.csv")), "blocks[0].samples_n", "a list of 6", None, "N",
        "give file or samples_n, not both"),
    Bad(with_blocks(history(file="a.csv", samples_n=None)), "blocks[0].file", "a.csv", None, None,
        "time histories in files cannot be read here"),
    Bad(with_blocks(history(samples_n=[1])), "blocks[0].samples_n", "a list of 1", None, "N",
        "needs at least 2 entries"),
    Bad(with_blocks(history(samples_n=[0, NAN, 1])), "blocks[0].samples_n[1]", "nan", None, "N",
        "must be finite"),
    Bad(with_blocks(history(samples_n=[0, 1e160])), "blocks[0].samples_n[1]", 1e160, 1e15, "N",
        "1e+160 N must be at most"),
    Bad(with_blocks(repeat(2, history(gain=1e10))), "blocks[0].blocks[0].gain", 1e10, 1e9, None,
        "must be at most"),
    Bad(moving_history(samples_m=[0, 0.04], rate_hz=1), "motion[0].samples_m", 0.04, 0.03, "m",
        "reaches 0.04 m"),
    Bad(moving_history(samples_m=[0, 0, 0.02, 0.02], rate_hz=15), "motion[0].samples_m",
        near(0.45), 0.2, "m/s", "has to move at 0.45 m/s at 0.0666667 s"),
]
CHOICES = [
    Bad(with_blocks(hold(), controller={"adaptive": "amplitude_phase"}), "controller.adaptive",
        "amplitude_phase", None, None, "amplitude_phase is not available yet"),
    Bad(with_blocks(hold(), acceptance=[{"measurement": "peak_force_n", "block": 1,
        "at_most": 1}]), "acceptance[0].block", 1, 0, None, "there is no block 1: the last is 0"),
    Bad(with_blocks(hold(), acceptance=[{"measurement": "peak_force_n", "block": -1,
        "at_most": 1}]), "acceptance[0].block", -1, 0, None, "-1 must be at least 0"),
    Bad(with_blocks(hold(), record={"also": [{"kind": "time", "rate_hz": 1}]}),
        "record.also[0].kind", "time", None, None, "did you mean timed?"),
    Bad(with_blocks(hold(), record={"also": [{"kind": "timed", "rate_hz": 5000}]}),
        "record.also[0].rate_hz", 5000, 4000, "Hz", "must be at most 4,000 Hz"),
    Bad(with_blocks(hold(), record={"also": [{"kind": "max_min"}]}),
        "record.also[0].every_s", None, None, "s", "every_s is missing"),
]
WHOLES = [
    Bad(with_blocks(nested(9)), "blocks[0]", 9, 8, None, "nested 9 deep, must be at most 8"),
    Bad(with_blocks(repeat(2, ramp(to_n=0))), "blocks[0].times", None, None, None,
        "a pass of this repeat takes no time"),
    Bad(with_blocks(hold(duration_s=3e7), hold(duration_s=3e7)), "blocks", 6e7, YEAR_S, "s",
        "lasts 60,000,000 s in all"),
    Bad(with_blocks(repeat(4e6, hold(duration_s=10))), "blocks", 4e7, YEAR_S, "s", "in all"),
    Bad(with_blocks(sine(frequency_hz=100, cycles=None, duration_s=3e7)), "blocks[0]",
        3_000_000_000, 2**31 - 1, None, "3,000,000,000 cycles"),
    Bad(with_blocks(sine(mean_n=40e3, frequency_hz=100, taper_cycles=0.5)), "blocks[0]",
        near(STEEPEST * 40e3 / 0.005), 2e6, "N/s", "has to move at 12,566,371 N/s"),
    Bad(with_blocks(sine(frequency_hz=1, amplitude_n=20e3, taper_cycles=0.01)), "blocks[0]",
        near(STEEPEST * 20e3 / 0.01), 2e6, "N/s", "has to move at 3,141,593 N/s"),
    Bad(with_blocks(ramp(rate_n_s=None, duration_s=0.0005, to_n=2000)), "blocks[0]",
        near(4e6), 2e6, "N/s", "at most 2,000,000 N/s: allow more time"),
    Bad(with_blocks(repeat(2, ramp(to_n=0, rate_n_s=None, duration_s=0.01), ramp(to_n=30e3))),
        "blocks[0].blocks[0]", near(3e6), 2e6, "N/s", "allow more time"),
    Bad(with_blocks(hold(), motion=[{"kind": "step", "to_m": 0.02, "hold_s": 1, "rise_s": 0.1}]),
        "motion[0]", near(STEEPEST * 0.02 / 0.1), 0.2, "m/s", "allow more time"),
]
# fmt: on


@pytest.mark.parametrize(
    "bad",
    LIMITS + MEANINGS + SWEEPS + RESPONSES + HISTORIES + CHOICES + WHOLES,
    ids=lambda b: f"{b.path} {b.says}",
)
def test_one_wrong_thing_is_found_alone_with_path_value_limit_and_unit(bad: Bad) -> None:
    refusal = definition_from(bad.definition)
    assert isinstance(refusal, Refusal)
    assert refusal.code is Code.INVALID_TEST
    (problem,) = refusal.faults
    assert isinstance(problem, Problem)
    found = (problem.path, problem.value, problem.limit, problem.unit)
    assert found == (bad.path, bad.value, bad.limit, bad.unit)
    assert bad.says in problem.expected
    assert problem.expected in refusal.detail


def test_a_number_beyond_every_float_is_refused() -> None:
    refusal = definition_from(with_blocks(hold(duration_s=10**400)))
    assert isinstance(refusal, Refusal)
    assert refusal.faults[0].path == "blocks[0].duration_s"


def test_everything_that_is_wrong_is_listed() -> None:
    wrong = with_blocks(hold(force_n=60e3), sine(cycles=0), {"kind": "swep"}, nam="x")
    refusal = definition_from(wrong)
    assert isinstance(refusal, Refusal)
    paths = {fault.path for fault in refusal.faults}
    assert paths == {"blocks[0].force_n", "blocks[1].cycles", "blocks[2].kind", "nam"}
