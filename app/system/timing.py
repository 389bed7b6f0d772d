"""How the loop keeps time: its own histograms, copied from its block and never reset from here."""

from app.link.life import Life
from app.rigs.loop_health import REALTIME
from app.rigs.schemas import Condition
from app.system.schemas import Histogram, LoopTiming
from rtcore.latency import BIN_S, Counts, LoopFigures, figures_of, longest_s, quantile_s
from rtcore.realtime import Condition as Asked


def figures(life: Life) -> LoopFigures:
    """A copy of what the loop has counted."""
    asked = tuple(Asked(**condition) for condition in life.conditions())
    return figures_of(life.block, asked)


def timing(life: Life) -> LoopTiming:
    """The whole of it, for a page."""
    found = figures(life)
    had = {name for name, was_had, _ in found.conditions if was_had}
    return LoopTiming(
        life=life.name,
        pid=life.pid,
        alive=life.alive,
        period_s=life.period_ns * 1e-9,
        ticks=found.ticks,
        late_ticks=found.late_ticks,
        deadlines_missed=found.deadlines_missed,
        wakeup=_histogram(found.wakeup),
        tick_time=_histogram(found.tick_time),
        realtime=had.issuperset(REALTIME),
        conditions=[Condition(**condition._asdict()) for condition in found.conditions],
    )


def _histogram(counts: Counts) -> Histogram:
    return Histogram(
        bin_s=BIN_S,
        counts=counts.tolist(),
        p50_s=quantile_s(counts, 0.5),
        p99_s=quantile_s(counts, 0.99),
        p999_s=quantile_s(counts, 0.999),
        longest_s=longest_s(counts),
    )
