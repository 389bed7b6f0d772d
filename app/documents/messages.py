"""What Pydantic found wrong, said so that the person who wrote the document can mend it."""

import difflib
from collections.abc import Callable, Iterable
from typing import Any

from app.documents.locate import Place
from app.documents.units import say, unit_of

Details = dict[str, Any]

_BOUNDS = {
    "greater_than": ("gt", "must be above"),
    "greater_than_equal": ("ge", "must be at least"),
    "less_than": ("lt", "must be below"),
    "less_than_equal": ("le", "must be at most"),
}


def bound_of(details: Details) -> float | None:
    """The limit that an error is about, where it is about one."""
    context = details.get("ctx", {})
    key = _BOUNDS.get(details["type"], ("limit", ""))[0]
    limit: float | None = context.get(key)
    return limit


def message_for(details: Details, place: Place) -> str:
    """A sentence for one error of Pydantic's."""
    if details["type"] in _BOUNDS:
        return _outside(details, place)
    known = _SENTENCES.get(details["type"])
    return known(details, place) if known else str(details["msg"])


def nearest(word: str, names: Iterable[str]) -> str:
    """`; did you mean amplitude_n?`, or nothing where no name is near."""
    found = difflib.get_close_matches(word, list(names), n=1, cutoff=0.5)
    return f"; did you mean {found[0]}?" if found else ""


def _last_name(place: Place) -> str:
    return next((key for key in reversed(place.path) if isinstance(key, str)), "")


def _outside(details: Details, place: Place) -> str:
    unit = unit_of(_last_name(place))
    limit = say(bound_of(details), unit)
    return f"{say(details['input'], unit)} {_BOUNDS[details['type']][1]} {limit}"


def _unknown(details: Details, place: Place) -> str:
    key = str(place.path[-1])
    guess = nearest(key, place.known_names)
    return f"unknown key{guess or '; known here: ' + ', '.join(place.known_names)}"


def _no_such_kind(details: Details, place: Place) -> str:
    word = str(details["ctx"]["tag"])
    return f"unknown kind '{word}'{nearest(word, place.kinds) or '; ' + _known_kinds(place)}"


def _known_kinds(place: Place) -> str:
    return f"known: {', '.join(place.kinds)}"


def _not_a_choice(details: Details, place: Place) -> str:
    choices = str(details["ctx"]["expected"]).replace("'", "")
    word = details["input"]
    guess = (
        nearest(word, choices.replace(" or ", ", ").split(", ")) if isinstance(word, str) else ""
    )
    return f"{say(word)} must be {choices}{guess}"


def _number(details: Details, place: Place) -> str:
    return f"must be a number, is {_called(details['input'])}"


def _called(value: object) -> str:
    if value is None:
        return "empty"
    if isinstance(value, bool):
        return f"the truth value {str(value).lower()}"
    if isinstance(value, str):
        return f"the text '{value}'"[:60]
    if isinstance(value, dict | list):
        return "a mapping" if isinstance(value, dict) else "a list"
    return say(value)


def _must_be(what: str) -> Callable[[Details, Place], str]:
    return lambda details, place: f"must be {what}, is {_called(details['input'])}"


def _length(details: Details, place: Place) -> str:
    context = details["ctx"]
    few = "min_length" in context
    bound = f"at least {context['min_length']}" if few else f"at most {context['max_length']:,}"
    return f"needs {bound} {'entry' if bound.endswith(' 1') else 'entries'}"


_SENTENCES: dict[str, Callable[[Details, Place], str]] = {
    "missing": lambda details, place: f"{place.path[-1]} is missing",
    "extra_forbidden": _unknown,
    "union_tag_invalid": _no_such_kind,
    "union_tag_not_found": lambda details, place: f"kind is missing; {_known_kinds(place)}",
    "literal_error": _not_a_choice,
    "finite_number": lambda details, place: f"must be finite, is {say(details['input'])}",
    "float_type": _number,
    "float_parsing": _number,
    "int_type": _must_be("a whole number"),
    "int_from_float": _must_be("a whole number"),
    "int_parsing": _must_be("a whole number"),
    "string_type": _must_be("text"),
    "string_too_short": lambda details, place: "must not be empty",
    "string_too_long": lambda details, place: (
        f"is longer than {details['ctx']['max_length']:,} characters"
    ),
    "bool_type": _must_be("true or false"),
    "tuple_type": _must_be("a list"),
    "too_short": _length,
    "too_long": _length,
    "model_type": _must_be("a mapping of keys to values"),
    "model_attributes_type": _must_be("a mapping of keys to values"),
}
