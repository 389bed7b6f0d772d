"""How the loop process does: its age, its deadlines, its histograms, its real-time conditions."""

from typing import Any

from app.link.life import Life
from app.rigs.schemas import Condition, LoopHealth
from rtcore.latency import longest_s, quantile_s

REALTIME = ("sched_fifo", "mlockall")  # without these a deadline is a matter of luck


def loop_health(life: Life | None, record: Any, rate_hz: float | None) -> LoopHealth:
    """The health of a life of the loop; `record` is its latest telemetry."""
    if life is None:
        return LoopHealth(**_NO_LOOP)
    wakeup, tick_time = (
        life.block.fields[f"{name}_histogram"].copy() for name in ("wakeup", "tick_time")
    )
    conditions = [Condition(**condition) for condition in life.conditions()]
    had = {condition.name for condition in conditions if condition.had}
    return LoopHealth(
        alive=life.alive,
        data_age_s=life.age_s(),
        tick=int(record["tick"]),
        rate_hz=rate_hz,
        pid=life.pid,
        deadlines_missed=int(record["deadlines_missed"]),
        realtime=had.issuperset(REALTIME),
        wakeup_latency_p50_s=quantile_s(wakeup, 0.5),
        wakeup_latency_p99_s=quantile_s(wakeup, 0.99),
        wakeup_latency_max_s=longest_s(wakeup),
        tick_time_p50_s=quantile_s(tick_time, 0.5),
        tick_time_p99_s=quantile_s(tick_time, 0.99),
        tick_time_max_s=longest_s(tick_time),
        conditions=conditions,
    )


_NO_LOOP: dict[str, Any] = {
    **dict.fromkeys(LoopHealth.model_fields),
    "alive": False,
    "tick": 0,
    "deadlines_missed": 0,
    "realtime": False,
    "conditions": [],
}
