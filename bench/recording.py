"""Recording: every tick of every channel, while a client watches; what it takes and how quickly it is read.

An hour's file is made on the virtual clock through the recorder's own code, and a real console
records in real time beside it: two minutes, or as many as are asked for.
"""

from collections.abc import Iterator

import numpy as np

from bench import long_recording, watched_console
from bench.long_recording import Long
from bench.report import Figure, progress, show
from bench.watched_console import Watched
from rtcore.channels import CHANNELS

MINUTES = 2.0
HOUR_S = 3600.0
OVERVIEW_AT_MOST_S = 0.1
WINDOW_AT_MOST_S = 0.03
READINGS = {
    "overview": ("overview, 2,000 points", OVERVIEW_AT_MOST_S),
    "window_ticks": ("5 s, every tick", WINDOW_AT_MOST_S),
    "window_bins": ("5 s, 2,000 points", WINDOW_AT_MOST_S),
}


def figures_of(watched: Watched) -> Iterator[Figure]:
    """Of the run in real time."""
    run = watched.run
    note = f"{run['ticks']:,} ticks in {run['duration_s']:.0f} s, {run['outcome']}"
    missing = float(run["missing_ticks"])
    yield Figure("missing_ticks", "ticks that are not recorded", missing, "", at_most=0, note=note)
    lost, seen = float(watched.lost_ticks), f"{watched.seen_ticks:,} seen"
    yield Figure("unseen_ticks", "ticks that the client did not get", lost, "", note=seen)
    yield Figure("app_share", "processor, app", watched.app_share * 100, "%", note="of one")
    yield Figure("loop_share", "processor, loop", watched.loop_share * 100, "%", note="of one")
    yield from _memory(watched)
    for name, taken_s in watched.request_s.items():
        what, limit = READINGS[name]
        note = "over HTTP, as JSON"
        yield Figure(f"{name}_request_s", f"{what}: request", taken_s, "s", limit, note=note)


def _memory(watched: Watched) -> Iterator[Figure]:
    held = watched.app_bytes
    for place, at in (("start", 0), ("middle", len(held) // 2), ("end", -1)):
        what = f"memory of the app's own, {place}"
        yield Figure(f"app_memory_{place}_b", what, float(held[at]), "B")
    half = len(held) // 2
    if half > 10:  # what is allocated once at the start does not count
        slope = np.polyfit(watched.times_s[half:], held[half:], 1)[0]
        what = "growth in its second half, in an hour"
        yield Figure("app_growth_b", what, float(slope * HOUR_S), "B")


def figures_of_hour(found: Long) -> Iterator[Figure]:
    """Of the recording on the virtual clock."""
    for name, what, size in (
        ("part", "part, under way", found.part_bytes),
        ("file", "Parquet file", found.file_bytes),
        ("overview", "overview", found.overview_bytes),
    ):
        per_tick = size / found.ticks
        note = f"{per_tick / len(CHANNELS):.2f} bytes a sample, {size / 1e6:,.0f} MB in all"
        yield Figure(
            f"{name}_bytes_per_tick", f"{what}: bytes a tick", per_tick, "B/tick", note=note
        )
    note = "checksum, index and overview in it"
    yield Figure("append_s_per_tick", "recording, a tick", found.append_s_per_tick, "s", note=note)
    yield Figure("convert_s_per_tick", "making the file, a tick", found.convert_s_per_tick, "s")
    plain = found.plain_read_s
    yield Figure("plain_read_s", "pyarrow reads the column whole", plain, "s", note="beside it")
    for state, taken in (("over", found.over), ("under way", found.under_way)):
        for name, taken_s in taken.items():
            what, limit = READINGS[name]
            key = f"{name}_{state.replace(' ', '_')}"
            note = f"{taken_s / plain:.3f} × pyarrow's plain read"
            yield Figure(f"{key}_s", f"{what}: {state}", taken_s, "s", limit, note=note)


NOTES = [
    "one channel; medians, page cache warm, opened anew each time as a request does",
    "memory: anonymous pages; pages of mapped files are the system's to take back",
    "the console's interlock on missed deadlines is off: other work may hold up this machine",
]


def main(as_json: bool, minutes: float = MINUTES) -> int:
    """Measure and print. Exit code 0 when measured, whether targets were met or not."""
    progress(f"recording {minutes:g} min in real time, watched")
    figures = list(figures_of(watched_console.measure(minutes)))
    figures.extend(figures_of_hour(long_recording.measure(HOUR_S)))
    show("recording", figures, NOTES, as_json)
    return 0
