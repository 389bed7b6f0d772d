"""Any test that the rig can do, as plain data, short enough to be played tick by tick."""

from typing import Any

from hypothesis import strategies as st

Data = dict[str, Any]

forces = st.floats(-2000, 2000).map(lambda f: round(f, 3))
durations = st.floats(0.02, 0.2).map(lambda s: round(s, 5))
frequencies = st.floats(5, 150).map(lambda f: round(f, 3))
cycles = st.integers(1, 4)
tapers = st.sampled_from([0, 0.5, 1, 1.5, 2.0, 3])
phases = st.floats(-360, 360).map(lambda p: round(p, 2))
positions = st.floats(-0.005, 0.005).map(lambda x: round(x, 6))


def _kind(kind: str, **fields: st.SearchStrategy[Any]) -> st.SearchStrategy[Data]:
    return st.fixed_dictionaries({"kind": st.just(kind), **fields})


def _either(one: st.SearchStrategy[Data], other: st.SearchStrategy[Data]) -> Any:
    """One of two keys that exclude each other."""
    return st.one_of(one, other)


def _merged(parts: tuple[Data, ...]) -> Data:
    return {key: value for part in parts for key, value in part.items()}


_lasting = _either(
    st.fixed_dictionaries({"cycles": cycles}), st.fixed_dictionaries({"duration_s": durations})
)
_sine = st.fixed_dictionaries(
    {
        "mean_n": forces,
        "amplitude_n": st.floats(0, 3000).map(lambda a: round(a, 2)),
        "frequency_hz": frequencies,
    }
)
hold = st.one_of(
    _kind("hold", duration_s=durations, force_n=forces), _kind("hold", duration_s=durations)
)
ramp = st.one_of(
    _kind("ramp", to_n=forces, rate_n_s=st.sampled_from([2e4, 1e5, 333_333.0])),
    _kind("ramp", to_n=forces, duration_s=durations),
)
step = _kind("step", to_n=forces, hold_s=durations, rise_s=st.sampled_from([0.0, 0.0, 0.003]))
harmonic = st.tuples(_kind("harmonic", taper_cycles=tapers, phase_deg=phases), _sine, _lasting).map(
    _merged
)
_layer = st.tuples(_sine, st.fixed_dictionaries({"cycles": cycles})).map(_merged)
layers = _kind(
    "layers",
    layers=st.lists(_layer, min_size=1, max_size=3),
    repeats=st.integers(1, 3),
    transition_s=durations,
)
_swings = {
    "mean_n": forces,
    "amplitude_n": st.floats(0, 3000).map(lambda a: round(a, 2)),
    "from_hz": frequencies,
    "to_hz": frequencies,
    "law": st.sampled_from(["log", "linear"]),
    "taper_cycles": tapers,
}
sweep = st.one_of(
    _kind("sweep", **_swings, duration_s=durations),
    _kind("sweep", **_swings, rate_octaves_s=st.sampled_from([5.0, 20.0, 64.5])),
).filter(lambda b: b["from_hz"] != b["to_hz"])
_swung = st.lists(st.floats(1, 3000).map(lambda a: round(a, 2)), min_size=1, max_size=2)
_band = st.fixed_dictionaries(
    {"from_hz": st.just(20.0), "to_hz": st.sampled_from([40.0, 101.5]), "points": st.integers(2, 4)}
)
_response = {
    "mean_n": forces,
    "amplitudes_n": _swung,
    "settle_cycles": st.integers(0, 2),
    "measure_cycles": st.integers(1, 3),
}
stepped_sine = _kind(
    "frequency_response",
    **_response,
    method=st.just("stepped_sine"),
    frequencies_hz=st.one_of(_band, st.lists(frequencies, min_size=1, max_size=3)),
)
multisine = _kind(
    "frequency_response",
    **_response,
    method=st.just("multisine"),
    frequencies_hz=st.one_of(_band, st.sampled_from([[10.0, 20.0, 50.0], [12.5], [30.0, 40.0]])),
)
time_history = _kind(
    "time_history",
    samples_n=st.lists(forces, min_size=2, max_size=12),
    rate_hz=st.sampled_from([40.0, 100.0, 133.3]),
    gain=st.sampled_from([1.0, -0.5]),
    repeats=st.integers(1, 3),
)
smooth_blocks = st.one_of(
    hold, ramp, harmonic, layers, sweep, stepped_sine, multisine, time_history
)
every_block = st.one_of(smooth_blocks, step)


def repeated(blocks: st.SearchStrategy[Data]) -> st.SearchStrategy[Data]:
    """Blocks within a repeat; the hold makes sure that a pass takes time."""
    body = st.tuples(st.lists(blocks, max_size=2), hold).map(lambda some: [*some[0], some[1]])
    return _kind("repeat", times=st.integers(1, 3), blocks=body)


def trees(blocks: st.SearchStrategy[Data]) -> st.SearchStrategy[Data]:
    """Blocks, repeats of them, and repeats of those."""
    return st.one_of(blocks, repeated(blocks), repeated(st.one_of(blocks, repeated(blocks))))


motions = st.one_of(
    _kind("hold", duration_s=durations, displacement_m=positions),
    _kind("ramp", to_m=positions, rate_m_s=st.sampled_from([0.05, 0.1])),
    _kind("step", to_m=positions, hold_s=durations),
    _kind(
        "harmonic",
        amplitude_m=st.sampled_from([0.0, 0.001, 0.002]),
        frequency_hz=st.floats(2, 10).map(lambda f: round(f, 2)),
        cycles=st.integers(1, 2),
        taper_cycles=st.sampled_from([0, 1, 2]),
    ),
    _kind(
        "multisine",
        amplitude_m=st.sampled_from([1e-5, 2e-4]),
        mean_m=positions,
        frequencies_hz=st.sampled_from([[20.0, 50.0, 80.0], [40.0, 100.0]]),
        settle_cycles=st.integers(0, 1),
        measure_cycles=st.integers(1, 2),
        realisations=st.just(2),
    ),
    _kind(
        "time_history",
        samples_m=st.lists(positions.map(lambda x: x / 2), min_size=2, max_size=8),
        rate_hz=st.sampled_from([5.0, 12.0]),
        repeats=st.integers(1, 2),
    ),
)
RECORDS: list[Data] = [
    {"channels": "all", "also": []},
    {"channels": ["force_n", "valve_command"], "also": [{"kind": "timed", "rate_hz": 10.0}]},
    {
        "channels": "all",
        "also": [
            {"kind": "peak_valley"},
            {"kind": "max_min", "every_s": 0.5},
            {"kind": "logarithmic_cycles"},
        ],
    },
]
criteria = st.one_of(
    st.just({"measurement": "peak_force_n", "block": 0, "at_most": 1e5}),
    st.fixed_dictionaries({"measurement": st.just("peak_force_n"), "at_most": st.floats(0, 1e5)}),
    st.fixed_dictionaries(
        {"measurement": st.just("goodness_of_fit"), "at_least": st.floats(-1e300, 1e300)}
    ),
)


def definitions(blocks: st.SearchStrategy[Data]) -> st.SearchStrategy[Data]:
    """Whole tests of such blocks."""
    return st.fixed_dictionaries(
        {
            "schema": st.just(1),
            "name": st.text(min_size=1, max_size=30),
            "description": st.text(max_size=60),
            "controller": st.fixed_dictionaries(
                {"compensation": st.sampled_from(["auto", "on", "off"])}
            ),
            "blocks": st.lists(trees(blocks), min_size=1, max_size=3),
            "motion": st.lists(motions, max_size=2),
            "record": st.sampled_from(RECORDS),
            "acceptance": st.lists(criteria, max_size=2),
        }
    )
