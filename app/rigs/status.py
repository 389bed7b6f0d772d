"""The status of the rig, read from the shared block: no database, no waiting."""

import math
from collections.abc import Callable
from threading import Lock
from typing import Any

import numpy as np
import numpy.typing as npt

from app.authority.schemas import LeaseOut
from app.link.life import Life
from app.link.link import Link
from app.link.words import trip_code
from app.recording.recorder import Recorder
from app.rigs.chain import chain_of
from app.rigs.history import History
from app.rigs.loop_health import loop_health
from app.rigs.permissives import Readiness, permissives
from app.rigs.reasons import Situation, reasons
from app.rigs.schemas import (
    Limits,
    ModeWord,
    Permissive,
    RecorderOut,
    RigStatus,
    RunProgress,
    Trip,
)
from app.runs.plans import Plans
from app.storage.schemas import StorageState, StorageWord
from rtcore.channels import CHANNELS, TELEMETRY
from rtcore.interlocks import Action, Comparison, Form, Quantity
from rtcore.modes import Mode

_READINGS = [c.name for c in CHANNELS if c.name not in ("tick", "time_s", "trips", "run", "mode")]
_NO_RECORD = np.full(1, -1, TELEMETRY)[0]


class StatusReader:
    """Puts the status together. May be asked from any thread."""

    def __init__(
        self,
        link: Link,
        recorder: Recorder,
        plans: Plans,
        supply_pressure_pa: float,
        storage: Callable[[], StorageState],
        *,
        lease: Callable[[], LeaseOut | None] = lambda: None,
        stop_url: str | None = None,
    ) -> None:
        self._link = link
        self._recorder = recorder
        self._plans = plans
        self._supply_pressure_pa = supply_pressure_pa
        self._storage = storage
        self._lease = lease
        self._stop_url = stop_url
        self._history: History | None = None
        self._reading = Lock()

    def read(self) -> RigStatus:
        """The status now."""
        life = self._link.life
        record = None if life is None else life.snapshot()
        if life is None or record is None:
            return self._without_loop(life)
        with self._reading:
            history = self._of(life)
            history.update(int(record["tick"]))
            trips = _trips(life, record, history)
            rate_hz = history.rate_hz()
            ticks_in_mode = history.ticks_in_mode(int(record["tick"]))
        health = loop_health(life, record, rate_hz)
        period_s = life.period_ns * 1e-9
        mode = Mode(int(record["mode"])) if health.alive else None
        supply_pa, storage = float(record["supply_pressure_pa"]), self._storage()
        return RigStatus(
            mode=self._absent() if mode is None else ModeWord.of(mode),
            mode_since_s=ticks_in_mode * period_s if health.alive else None,
            readings={name: _number(record[name]) for name in _READINGS},
            limits=self._limits(life.detectors()),
            trips=trips,
            loop=health,
            run=self._progress(life, record) if health.alive else None,
            recorder=self._recorder_out(),
            storage=storage,
            permissives=self._permissives(mode, _first(trips), supply_pa, storage),
            commands=reasons(Situation(mode, _first(trips), supply_pa)),
            chain=chain_of(life),
            injected=_injected(life),
            lease=self._lease(),
            stop_url=self._stop_url,
        )

    def _of(self, life: Life) -> History:
        if self._history is None or self._history.life is not life:
            self._history = History(life)
        return self._history

    def _without_loop(self, life: Life | None) -> RigStatus:
        no_detectors = np.empty(0)
        storage = self._storage()
        return RigStatus(
            mode=self._absent(),
            mode_since_s=None,
            readings=dict.fromkeys(_READINGS),
            limits=self._limits(no_detectors),
            trips=[],
            loop=loop_health(life, _NO_RECORD, None),
            run=None,
            recorder=self._recorder_out(),
            storage=storage,
            permissives=self._permissives(None, None, math.nan, storage),
            commands=reasons(Situation(None, None, math.nan)),
            chain=chain_of(None),
            injected=[],
            lease=self._lease(),
            stop_url=self._stop_url,
        )

    def _permissives(
        self, mode: Mode | None, trip: str | None, supply_pa: float, storage: StorageState
    ) -> list[Permissive]:
        life = self._link.life
        return permissives(
            Readiness(
                mode=mode,
                trip=trip,
                supply_pressure_pa=supply_pa,
                recorder_follows=life is not None and self._recorder.following is life,
                recorder_trouble=self._recorder.state().trouble,
                disk_is_full=storage.state is StorageWord.FULL,
            )
        )

    def _absent(self) -> ModeWord:
        return ModeWord.STARTING if self._link.starting else ModeWord.LOST

    def _limits(self, detectors: npt.NDArray[Any]) -> Limits:
        def least(quantity: Quantity) -> float | None:
            watching = [
                float(d["threshold"])
                for d in detectors
                if d["enabled"]
                and d["quantity"] == quantity
                and d["form"] == Form.VALUE
                and d["comparison"] != Comparison.BELOW
            ]
            return min(watching, default=None)

        return Limits(
            force_n=least(Quantity.FORCE_N),
            force_error_n=least(Quantity.FORCE_ERROR_N),
            displacement_m=least(Quantity.DISPLACEMENT_M),
            velocity_m_s=least(Quantity.VELOCITY_M_S),
            supply_pressure_pa=self._supply_pressure_pa,
        )

    def _progress(self, life: Life, record: Any) -> RunProgress | None:
        run_id, block = int(record["run"]), int(record["block"])
        plan = self._plans[run_id]
        if run_id == 0 or plan is None:
            return None
        return RunProgress(
            id=run_id,
            test_name=plan.test_name,
            block=block,
            blocks=len(plan.blocks),
            cycle=int(record["cycle"]),
            cycles=plan.cycles(block),
            elapsed_s=int(life.block.fields["program_ticks"]) * life.period_ns * 1e-9,
            duration_s=plan.duration_s,
            recorded_s=self._recorded_s(run_id, life.period_ns),
        )

    def _recorded_s(self, run_id: int, period_ns: int) -> float:
        state = self._recorder.state()
        return state.ticks * period_ns * 1e-9 if state.run_id == run_id else 0.0

    def _recorder_out(self) -> RecorderOut:
        state = self._recorder.state()
        return RecorderOut(
            recording=state.recording,
            lost_ticks=state.lost_ticks,
            bytes=state.size_bytes,
            trouble=state.trouble,
        )


def _injected(life: Life) -> list[str]:
    return [fault.name.lower() for fault in life.injected()] if life.alive else []


def _trips(life: Life, record: Any, history: History) -> list[Trip]:
    """What is latched, the first to trip on top."""
    latched, first = int(record["trips"]), int(life.block.fields["first_out"])
    found = []
    for i, detector in enumerate(life.detectors()):
        if latched >> i & 1:
            event = history.trip(i)
            text = event.text if event else "Tripped before this console was started"
            tick = event.tick if event else 0
            blocks = int(detector["action"]) > Action.INDICATE
            code = trip_code(detector)
            found.append(Trip(code=code, text=text, tick=tick, first=i == first, blocks=blocks))
    return sorted(found, key=lambda trip: (not trip.first, trip.tick))


def _first(trips: list[Trip]) -> str | None:
    """What has to be reset before anything else."""
    return next((trip.text for trip in trips if trip.blocks), None)


def _number(value: Any) -> float | None:
    """JSON has neither NaN nor infinity: null."""
    number = float(value)
    return number if math.isfinite(number) else None
