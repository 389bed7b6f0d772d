"""First-outs played again: over the recorded ticks, and on the virtual rig."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from app.errors import Refusal
from app.first_outs.account import Account
from app.first_outs.peaks import peaks_of
from app.first_outs.replay_schemas import ReplayOut, ValueChanged
from app.first_outs.replaying import records_of, replay
from app.first_outs.rerun_schemas import CourseOut, RerunAsked, RerunOut
from app.first_outs.rerunning import Played
from app.first_outs.reruns import Rerun, Reruns
from app.first_outs.service import FirstOuts
from app.first_outs.words import rerun_text
from app.interlocks.record import interlocks_from
from app.prediction.schemas import Computing
from app.recording.bins import Columns
from app.recording.samples import Levels
from app.runs.samples import known_channels, window_of
from rtcore.interlocks import Quantity

# What only a live rig and its console know.
NOT_RERUN = ("app_silence_s", "deadlines_missed", "unrecorded_s")


class PlayedSamples:
    """The ticks of a course in memory, as of any recorded samples."""

    def __init__(self, played: Played) -> None:
        self._records = played.records
        self.first_tick = int(played.records["tick"][0])
        self.last_tick = int(played.records["tick"][-1])

    def chunks(self, names: Sequence[str], first_tick: int, last_tick: int) -> Iterator[Columns]:
        """The columns `tick` and `names` between two ticks, both included."""
        low, high = np.searchsorted(self._records["tick"], (first_tick, last_tick + 1))
        part = self._records[low:high]
        yield {name: part[name] for name in dict.fromkeys(["tick", *names])}

    def levels(self) -> Levels:
        return ()


class Again:
    """Replays and re-runs of the first-outs."""

    def __init__(self, first_outs: FirstOuts, reruns: Reruns) -> None:
        self._first_outs = first_outs
        self._reruns = reruns

    def replay(self, number: int, changes: Mapping[str, Any]) -> ReplayOut | Refusal:
        """Which detectors trip over the recorded ticks, with these values changed."""
        account = self._first_outs.account(number)
        if isinstance(account, Refusal):
            return account
        samples = self._first_outs.samples(number)
        if isinstance(samples, Refusal):
            return samples
        return replay(account, samples, changes)

    def rerun(self, number: int, asked: RerunAsked) -> RerunOut | Computing | Refusal:
        """What happens on the virtual rig with one value changed."""
        names = known_channels(asked.channels)
        if isinstance(names, Refusal):
            return names
        account = self._first_outs.account(number)
        if isinstance(account, Refusal):
            return account
        found = self._reruns.of(
            number, account, asked.change.path, asked.change.value, asked.wait_s
        )
        if not isinstance(found, Rerun):
            return found
        return self._shown(number, account, found, names, asked.points)

    def _shown(
        self, number: int, account: Account, found: Rerun, names: Sequence[str], points: int
    ) -> RerunOut:
        made, period_s = found.made, account.period_ns * 1e-9
        unchanged, changed = found.unchanged, found.changed
        outcomes = ((p.first_out, p.peaks) for p in (unchanged, changed))
        return RerunOut(
            change=ValueChanged(path=made.path, before=made.before, value=made.value),
            recorded=self._recorded(number, account, names, points),
            unchanged=_course(unchanged, names, period_s, points),
            changed=_course(changed, names, period_s, points),
            lead_s=found.scene.trip_tick * period_s,
            from_the_beginning=found.scene.program is not None and found.scene.begun is None,
            not_rerun=_not_rerun(account),
            text=rerun_text(made, account.first, *outcomes),
        )

    def _recorded(
        self, number: int, account: Account, names: Sequence[str], points: int
    ) -> CourseOut:
        samples = self._first_outs.samples(number)
        window, peaks = None, account.peaks
        if not isinstance(samples, Refusal):
            period_s = account.period_ns * 1e-9
            window = window_of(samples, names, account.tick, period_s, -1e9, None, points)
            peaks = peaks_of(records_of(samples), account.tick, period_s)
        return CourseOut(trips=account.trips, first_out=account.first, peaks=peaks, samples=window)


def _course(played: Played, names: Sequence[str], period_s: float, points: int) -> CourseOut:
    window = window_of(PlayedSamples(played), names, played.tick, period_s, -1e9, None, points)
    return CourseOut(
        trips=played.trips, first_out=played.first_out, peaks=played.peaks, samples=window
    )


def _not_rerun(account: Account) -> list[str]:
    """The detectors of what only a live rig knows."""
    table = interlocks_from(account.settings.interlocks)
    if isinstance(table, Refusal):
        return []
    alive = {Quantity[name.upper()] for name in NOT_RERUN}
    return [d.name for d in table.detectors if d.quantity in alive]
