"""The table of detectors as people write it: what makes sense survives, and what does not is refused at its key."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.documents.refusal import Problem
from app.documents.writing import to_data
from app.errors import Refusal
from app.interlocks.defaults import default_interlocks
from app.interlocks.quantities import REACH
from app.interlocks.record import describe, interlocks_from, to_record
from app.interlocks.table import Detector, Interlocks
from rtcore.interlocks import Action, Comparison, Form, Quantity, interlocks_are_valid
from rtcore.memory.layout import EVENT
from rtcore.modes import Mode, is_pressurised

PERIOD_S = 250e-6
GOOD = {
    "name": "force",
    "quantity": "force_n",
    "comparison": "magnitude_above",
    "threshold": 55e3,
    "action": "shutdown",
    "armed": ["running"],
}


def test_a_table_survives_being_written_in_words() -> None:
    table = default_interlocks()
    data = to_data(table)
    force = next(row for row in data["detectors"] if row["name"] == "force")
    assert force["quantity"] == "force_n"
    assert force["armed"] == [m.name.lower() for m in Mode if is_pressurised(m)]
    assert interlocks_from(data) == table


@st.composite
def detectors(draw: st.DrawFn, name: str) -> Detector:
    """Any that makes sense."""
    quantity = draw(st.sampled_from(list(Quantity)))
    reach = REACH[quantity]
    form = draw(st.sampled_from(Form)) if reach.flows else Form.VALUE
    comparison = draw(st.sampled_from(Comparison))
    least = -1e9 if reach.low is None else reach.low
    most = 1e9 if reach.high is None else reach.high
    inside = st.floats(least, most, exclude_min=True, exclude_max=True)
    low, threshold = sorted(draw(st.tuples(inside, inside).filter(lambda pair: pair[0] != pair[1])))
    magnitude = draw(st.floats(0.0, most, exclude_max=True))
    action = draw(st.sampled_from(Action))
    band = comparison is Comparison.OUTSIDE
    return Detector(
        name=name,
        quantity=quantity,
        form=form,
        comparison=comparison,
        threshold=magnitude if comparison is Comparison.MAGNITUDE_ABOVE else threshold,
        low=low if band else None,
        horizon_s=draw(st.floats(1e-4, 1.0)) if form is Form.LOOK_AHEAD else None,
        smoothing_s=draw(st.none() | st.floats(1e-4, 10.0)) if form is not Form.VALUE else None,
        persistence_s=draw(st.floats(0.0, 60.0)),
        action=action,
        armed=tuple(draw(st.sets(st.sampled_from(Mode), min_size=1))),
        latching=action >= Action.STOP or draw(st.booleans()),
        enabled=draw(st.booleans()),
        text=draw(st.text(st.characters(exclude_characters="\0", codec="utf-8"), max_size=40)),
    )


def tables() -> st.SearchStrategy[Interlocks]:
    """Tables of one to four detectors."""
    drawn = st.integers(1, 4).flatmap(
        lambda count: st.tuples(*(detectors(f"drawn_{i}") for i in range(count)))
    )
    return drawn.map(lambda found: Interlocks(detectors=found))


@given(tables())
def test_every_table_that_makes_sense_reaches_the_loop_and_comes_back(table: Interlocks) -> None:
    record = to_record(table, PERIOD_S)
    assert interlocks_are_valid(record.reshape(1)[0])
    for written, d in zip(table.detectors, record["detectors"], strict=False):
        assert as_written(d, written.name, written.text) == written.model_copy(
            update={"persistence_s": pytest.approx(written.persistence_s, abs=PERIOD_S)}
        )
    assert interlocks_from(to_data(table)) == table


def as_written(d: Any, name: str, text: str) -> Detector:
    """A DETECTOR record as somebody would have written it."""
    form, comparison = Form(int(d["form"])), Comparison(int(d["comparison"]))
    ticks = int(d["persistence_ticks"])
    return Detector(
        name=name,
        quantity=Quantity(int(d["quantity"])),
        form=form,
        comparison=comparison,
        threshold=float(d["threshold"]),
        low=float(d["low"]) if comparison is Comparison.OUTSIDE else None,
        horizon_s=float(d["horizon_s"]) or None,
        smoothing_s=float(d["smoothing_s"]) or None,
        persistence_s=0.0 if ticks == 1 else ticks * PERIOD_S,
        action=Action(int(d["action"])),
        armed=tuple(mode for mode in Mode if int(d["armed_modes"]) >> mode & 1),
        latching=bool(d["latching"]),
        enabled=bool(d["enabled"]),
        text=text,
    )


@pytest.mark.parametrize(
    ("changed", "path", "says"),
    [
        ({"quantity": "force"}, "detectors[0].quantity", "did you mean force_n?"),
        ({"quantity": "sensor_faults"}, "detectors[0].quantity", "load_cell, lvt, lvdt"),
        ({"armed": []}, "detectors[0].armed", "at least 1 entry"),
        ({"armed": ["runing"]}, "detectors[0].armed[0]", "did you mean running?"),
        ({"threshold": float("nan")}, "detectors[0].threshold", "must be finite"),
        ({"treshold": 1}, "detectors[0].treshold", "did you mean threshold?"),
        ({"persistence_s": -1}, "detectors[0].persistence_s", "at least 0 s"),
        ({"comparison": "outside"}, "detectors[0].low", "needs its lower end"),
        ({"comparison": "outside", "low": 55e3}, "detectors[0].low", "below the threshold, 55,000 N"),
        ({"comparison": "outside", "low": -60e3}, "detectors[0].low", "never be passed"),
        ({"low": 1.0}, "detectors[0].low", "only a band has a lower end"),
        ({"threshold": 60e3}, "detectors[0].threshold", "60,000 N is all there can be"),
        ({"threshold": -1.0}, "detectors[0].threshold", "always trip"),
        ({"latching": False}, "detectors[0].latching", "a shutdown always latches"),
        ({"form": "look_ahead"}, "detectors[0].horizon_s", "needs a horizon"),
        ({"horizon_s": 0.01}, "detectors[0].horizon_s", "only a look-ahead"),
        ({"smoothing_s": 0.01}, "detectors[0].smoothing_s", "only a rate"),
        ({"quantity": "load_cell", "form": "rate", "threshold": 1.0}, "detectors[0].form", "only its value"),
        ({"text": "x" * 501}, "detectors[0].text", "longer than 500"),
    ],
)  # fmt: skip
def test_what_means_nothing_is_refused(changed: dict[str, object], path: str, says: str) -> None:
    refusal = interlocks_from({"detectors": [GOOD | changed]})
    assert isinstance(refusal, Refusal)
    (problem,) = refusal.faults
    assert isinstance(problem, Problem)
    assert problem.path == path
    assert says in problem.expected


def test_all_that_is_wrong_is_told_at_once() -> None:
    both = [GOOD | {"low": 1.0, "latching": False}, GOOD | {"name": "other", "threshold": 1e6}]
    refusal = interlocks_from({"detectors": both})
    assert isinstance(refusal, Refusal)
    assert [fault.path for fault in refusal.faults] == [
        "detectors[0].low",
        "detectors[0].latching",
        "detectors[1].threshold",
    ]


def test_a_rate_may_be_faster_than_any_reading_is_large() -> None:
    assert isinstance(
        interlocks_from({"detectors": [GOOD | {"form": "rate", "threshold": 2e7}]}), Interlocks
    )


def test_two_detectors_of_one_name_cannot_be_told_apart() -> None:
    refusal = interlocks_from({"detectors": [GOOD, GOOD]})
    assert isinstance(refusal, Refusal)
    assert "detectors[1].name: two detectors are named force" in refusal.detail


def test_a_trip_is_told_with_its_value_and_its_limit() -> None:
    table = Interlocks(
        detectors=(
            Detector(
                name="force_error",
                quantity=Quantity.FORCE_ERROR_N,
                comparison=Comparison.MAGNITUDE_ABOVE,
                threshold=15e3,
                persistence_s=0.05,
                action=Action.STOP,
                armed=(Mode.RUNNING,),
            ),
        )
    )
    event = np.zeros((), EVENT)
    event["code"], event["value"], event["limit"] = 0, -16_200.4, 15e3
    told = describe(table, event, PERIOD_S)
    assert told == "Force error 16,200 N for 50 ms, limit 15,000 N"
