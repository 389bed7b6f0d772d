"""What protects people is not taken away without a word: by what it watches, whatever it is called."""

from typing import Any

import pytest

from app.errors import Code, Refusal
from app.interlocks.defaults import default_interlocks
from app.interlocks.detector import Detector
from app.interlocks.safeguards import GUARDED, adoptable, shortfalls
from app.interlocks.table import Interlocks
from rtcore.interlocks import Action
from rtcore.modes import Mode


def table(changed: str | None = None, said: tuple[str, ...] = (), **changes: Any) -> Interlocks:
    """The shipped table, with one detector changed; without it where there are no changes."""
    found: list[Detector] = []
    for detector in default_interlocks().detectors:
        if detector.name != changed:
            found.append(detector)
        elif changes:
            found.append(detector.model_copy(update=changes))
    return Interlocks(detectors=tuple(found), knowingly_weaker=said)


def test_the_shipped_table_falls_short_of_nothing() -> None:
    assert shortfalls(table()) == ()
    assert adoptable(table()) == default_interlocks()


@pytest.mark.parametrize("name", GUARDED)
def test_none_of_the_guarded_is_left_out_or_switched_off(name: str) -> None:
    for found, says in (
        (table(name), "there is none"),
        (table(name, enabled=False), "switched off"),
    ):
        refusal = adoptable(found)
        assert isinstance(refusal, Refusal)
        assert refusal.code is Code.INTERLOCKS_WEAKENED
        assert f"({name}: " in refusal.detail
        assert says in refusal.detail
        assert [w["detector"] for w in refusal.about["weakened"]] == [name]  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"threshold": 58e3}, "its limit is 58,000 N, as shipped 55,000 N"),
        ({"persistence_s": 0.001}, "it waits 0.001 s, as shipped 0 s"),
        ({"action": Action.STOP}, "its action is stop, as shipped shutdown"),
        ({"armed": (Mode.RUNNING,)}, "it is not armed when pressurising, ready, holding, stopping"),
    ],
)
def test_weaker_is_told_in_words(changes: dict[str, Any], says: str) -> None:
    (short,) = shortfalls(table("force", **changes))
    assert (short.detector, short.text) == ("force", says)


def test_stronger_is_no_shortfall_and_a_name_does_not_matter() -> None:
    assert shortfalls(table("force", threshold=30e3)) == ()
    assert shortfalls(table("force", name="load", armed=tuple(Mode))) == ()


def test_what_is_said_is_adopted_and_no_more_is_kept_than_is_so() -> None:
    adopted = adoptable(table("force", ("force", "load_cell"), threshold=58e3))
    assert isinstance(adopted, Interlocks)
    assert adopted.knowingly_weaker == ("force",)


def test_a_word_for_what_is_not_guarded_is_a_slip() -> None:
    refusal = adoptable(table(said=("loadcell",)))
    assert isinstance(refusal, Refusal)
    (fault,) = refusal.faults
    assert fault.path == "knowingly_weaker[0]"
    assert "did you mean load_cell?" in fault.expected


def test_what_is_not_guarded_may_go() -> None:
    assert isinstance(adoptable(table("underpeak")), Interlocks)
