"""The facts as families of metrics: names end in their unit, counters in `total`, all SI."""

from collections.abc import Iterator, Mapping

import numpy as np
from prometheus_client.core import (
    CounterMetricFamily,
    GaugeMetricFamily,
    HistogramMetricFamily,
    Metric,
)

from app.metrics.facts import Facts
from app.recording.outcome import Outcome
from app.rigs.schemas import ModeWord
from rtcore.latency import BIN_S, Counts

_EDGES_US = (2, 5, 10, 20, 50, 100, 200, 500)
_READINGS = {
    "force_n": ("forcerig_force_newtons", "Load cell, compression positive"),
    "displacement_m": ("forcerig_displacement_meters", "Displacement of the unit under test"),
    "supply_pressure_pa": ("forcerig_supply_pressure_pascals", "Supply at the manifold"),
}


def families(facts: Facts) -> Iterator[Metric]:
    """All of them."""
    yield from _rig(facts)
    yield from _loop(facts)
    yield from _console(facts)


def _rig(facts: Facts) -> Iterator[Metric]:
    status = facts.status
    modes = {mode.value: float(mode == status.mode) for mode in ModeWord}
    yield _labelled("forcerig_mode", "1 for the mode that the rig is in", "mode", modes)
    for channel, (name, doc) in _READINGS.items():
        yield from _gauge(name, doc, status.readings.get(channel))
    yield from _gauge("forcerig_trips", "Detectors that are latched", len(status.trips))
    in_command = float(status.lease is not None)
    yield from _gauge("forcerig_in_command", "1 where somebody is in command", in_command)


def _loop(facts: Facts) -> Iterator[Metric]:
    health, loop = facts.status.loop, facts.loop
    yield from _gauge("forcerig_loop_alive", "1 while the loop runs", float(health.alive))
    yield from _gauge("forcerig_data_age_seconds", "Age of the latest tick", health.data_age_s)
    realtime = float(health.realtime)
    yield from _gauge("forcerig_loop_realtime", "1 where it has its real-time conditions", realtime)
    if loop is None:
        return
    yield CounterMetricFamily("forcerig_loop_ticks", "Ticks of this life of the loop", loop.ticks)
    yield CounterMetricFamily(
        "forcerig_loop_deadlines_missed", "Deadlines missed and skipped", loop.deadlines_missed
    )
    yield CounterMetricFamily(
        "forcerig_loop_late_ticks", "Ticks that ended after the next was due", loop.late_ticks
    )
    wakeup = "How long after its deadline a tick began: one for each wake-up"
    yield _histogram("forcerig_loop_wakeup_latency_seconds", wakeup, loop.wakeup)
    yield _histogram("forcerig_loop_tick_seconds", "How long a tick took", loop.tick_time)


def _console(facts: Facts) -> Iterator[Metric]:
    recorder, storage = facts.recorder, facts.status.storage
    yield from _gauge("forcerig_clients", "Browsers that follow the rig", facts.clients)
    yield from _gauge("forcerig_recording", "1 while a run is recorded", float(recorder.recording))
    yield from _gauge(
        "forcerig_recorder_behind_ticks",
        "Ticks of the run under way that are not on the disk yet",
        facts.recorder_behind_ticks,
    )
    yield from _gauge(
        "forcerig_recorder_missing_ticks", "Ticks that the run lacks", recorder.lost_ticks
    )
    trouble = float(recorder.trouble is not None)
    yield from _gauge("forcerig_recorder_trouble", "1 where it cannot write", trouble)
    yield from _gauge("forcerig_disk_free_bytes", "Of the runs' disk", storage.free_bytes)
    yield from _gauge(
        "forcerig_disk_recording_seconds",
        "Recording that the disk has room for",
        storage.seconds_left,
    )
    runs = {outcome.value: float(facts.runs.get(outcome.value, 0)) for outcome in Outcome}
    yield _labelled("forcerig_runs", "Runs in the book that are over", "outcome", runs)
    yield _labelled("forcerig_memory_bytes", "Held in RAM", "process", facts.memory_bytes)


def _gauge(name: str, doc: str, value: float | None) -> Iterator[Metric]:
    """Nothing where nothing is known."""
    if value is not None:
        yield GaugeMetricFamily(name, doc, value)


def _labelled(name: str, doc: str, label: str, values: Mapping[str, float]) -> Metric:
    family = GaugeMetricFamily(name, doc, labels=[label])
    for word, value in values.items():
        family.add_metric([word], value)
    return family


def _histogram(name: str, doc: str, counts: Counts) -> Metric:
    """The sum takes each count in the middle of its bin, those beyond the last edge at that edge."""
    up_to = np.cumsum(counts)
    bins = [round(edge * 1e-6 / BIN_S) for edge in _EDGES_US]
    buckets = [
        (repr(edge * 1e-6), float(up_to[at - 1])) for edge, at in zip(_EDGES_US, bins, strict=True)
    ]
    total = float(counts @ ((np.arange(len(counts)) + 0.5) * BIN_S))
    family = HistogramMetricFamily(name, doc)
    family.add_metric([], [*buckets, ("+Inf", float(up_to[-1]))], total)
    return family
