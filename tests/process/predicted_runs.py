"""Drawn tests run on a real console, loop and all: what came of each beside what was predicted.

`python -m tests.process.predicted_runs [first] [how many]` prints a table; its exit code is 1 where a peak force is
further off than 1 %, or a margin has the wrong sign.
"""

import json
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from app.interlocks.table import Interlocks
from rtcore.interlocks import Quantity
from tests.console_process import ConsoleProcess, wait_for
from tests.generated_tests import drawn, has_a_sign, indicating

PEAK_WITHIN = 0.01


class Compared(NamedTuple):
    """One test: its prediction, and what was run of it. `peak_n` and `wrong` are empty where it was refused."""

    number: int
    verdict: str
    outcome: str
    predicted_n: float
    peak_n: float | None
    margins: int  # whose sign was compared
    below: int  # of them, those predicted below zero
    wrong: list[str]

    @property
    def off(self) -> float | None:
        """By which share of it the peak force is off."""
        return None if self.peak_n is None else abs(self.predicted_n / self.peak_n - 1)

    @property
    def holds(self) -> bool:
        """Whether the prediction came true; one that is refused is never put to the test."""
        return self.off is None or (self.off <= PEAK_WITHIN and not self.wrong)


def interlocks_file(folder: Path) -> Path:
    """Detectors that indicate, beside all as shipped but the one on missed deadlines."""
    shipped = indicating().detectors
    table = Interlocks(
        detectors=tuple(d for d in shipped if d.quantity != Quantity.DEADLINES_MISSED),
        knowingly_weaker=("deadlines_missed",),
    )
    path = folder / "indicating.json"
    path.write_text(json.dumps(table.model_dump(mode="json")))
    return path


def compare(console: ConsoleProcess, number: int) -> Compared:
    """Predict a drawn test, run it, and hold one against the other."""
    made = console.http.post("/tests", json=drawn(number))
    assert made.status_code == 201, made.text
    prediction = _predicted(console, made.json()["id"])
    predicted_n = float(prediction["peaks"]["force_n"])
    if prediction["verdict"] == "refused":
        return Compared(number, "refused", "", predicted_n, None, 0, 0, [])
    assert console.command("reset").is_success  # what was indicated in the run before
    console.make_ready()
    body = {"test_id": made.json()["id"], "override_reason": "To compare it with its prediction"}
    started = console.http.post("/runs", json=body)
    assert started.status_code == 201, started.text
    run = console.ended_run(started.json()["id"])
    told = list(_told(prediction))
    tripped = _tripped(console, run["id"])
    wrong = [name for name, below in told if below != (name in tripped)]
    return Compared(
        number,
        prediction["verdict"],
        run["outcome"],
        predicted_n,
        _peak_n(console, run["id"]),
        len(told),
        sum(below for _, below in told),
        wrong,
    )


def _predicted(console: ConsoleProcess, test_id: str) -> dict[str, Any]:
    def asked() -> Any:
        answer = console.http.post(f"/tests/{test_id}/prediction", json={"wait_s": 10})
        return answer.json() if answer.status_code == 200 else None

    found: dict[str, Any] = wait_for(asked, "the prediction")
    return found


def _told(prediction: dict[str, Any]) -> Iterator[tuple[str, bool]]:
    """The detectors whose margin has a sign, and whether it is below zero."""
    for margin in prediction["margins"]:
        if margin["margin"] is not None and has_a_sign(margin["quantity"], margin["margin"]):
            yield margin["detector"], margin["margin"] < 0


def _tripped(console: ConsoleProcess, run_id: int) -> set[str]:
    """The names of the detectors that were latched at any moment of a run."""
    bits = int(max(_samples(console, run_id, "trips")["max"]))
    names = [d["name"] for d in console.run(run_id)["interlocks"]["detectors"]]
    return {name for i, name in enumerate(names) if bits >> i & 1}


def _peak_n(console: ConsoleProcess, run_id: int) -> float:
    """The greatest force of all that was recorded: taking the load off belongs to it."""
    force = _samples(console, run_id, "force_n")
    return max(abs(value) for value in (*force["min"], *force["max"]))


def _samples(console: ConsoleProcess, run_id: int, channel: str) -> dict[str, list[float]]:
    asked: dict[str, str | int] = {"channels": channel, "points": 20_000}
    found: dict[str, dict[str, list[float]]] = console.http.get(
        f"/runs/{run_id}/samples", params=asked
    ).json()["channels"]
    return found[channel]


def campaign(numbers: range) -> Iterator[Compared]:
    """Compare drawn tests one after another, on a console of their own."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        console = ConsoleProcess(folder, interlocks=interlocks_file(folder))
        try:
            console.start()
            console.make_ready()
            for number in numbers:
                yield compare(console, number)
        finally:
            console.clean_up()


def main() -> int:
    """Print a line a test."""
    first, many = (int(word) for word in [*sys.argv[1:3], *("0", "50")[len(sys.argv) - 1 :]])
    print(
        f"{'test':>5} {'verdict':8} {'outcome':10} {'predicted':>12} {'live':>12} {'off':>8}  signs"
    )
    fails = started = 0
    for one in campaign(range(first, first + many)):
        fails += not one.holds
        started += one.peak_n is not None
        live = "" if one.peak_n is None else f"{one.peak_n:,.0f} N"
        off = "" if one.off is None else f"{100 * one.off:.2f} %"
        signs = f"{one.below} of {one.margins} below zero" + (
            f", WRONG: {', '.join(one.wrong)}" if one.wrong else ""
        )
        predicted = f"{one.predicted_n:,.0f} N"
        print(
            f"{one.number:5} {one.verdict:8} {one.outcome:10} {predicted:>12} {live:>12} {off:>8}  {signs}",
            flush=True,
        )
    print(f"{started} of {many} started, {many - started} refused, {fails} not as predicted")
    return 1 if fails else 0


if __name__ == "__main__":
    raise SystemExit(main())
