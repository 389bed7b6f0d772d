"""The simulated rig against independent truth: closed forms, balances, scipy's Radau, its own linearisation."""

from bench import conservation, replays, small_signal, static_law
from bench.report import Figure, progress, show

PARTS = (
    ("static law", static_law.figures),
    ("balances", conservation.figures),
    ("Radau, about a minute", replays.figures),
    ("small signals", small_signal.figures),
)
NOTES = [
    "sensors without noise, converters of 16 bits (small signals of the closed loop: 32 bits)",
    "balances: the equations of motion integrated in 8 steps a tick, the worst of all instants",
    "tick's own states: each tick replayed in 16 steps from the loop's state, so that its errors show",
    "planted bugs are wrong by 1 % or missing outright; the balances must see them where they can",
]


def main(as_json: bool) -> int:
    """Measure and print. Exit code 0 when measured, whether targets were met or not."""
    figures: list[Figure] = []
    for what, part in PARTS:
        progress(what)
        figures.extend(part())
    show("physics", figures, NOTES, as_json)
    return 0
