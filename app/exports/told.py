"""What an exported file says of its run: names and units of channels, and how the run was made."""

import json
from collections.abc import Mapping
from typing import Any

from rtcore.channels import CHANNEL

Scalar = str | int | float | bool
_IN_THE_WHOLE_RUN = ("events", "prediction", "measurements", "acceptance")


def unit(name: str) -> str:
    """As other programs want it: "1" for none."""
    found = CHANNEL[name].unit
    return "1" if found == "-" else found


def facts(description: Mapping[str, Any]) -> dict[str, Scalar]:
    """What fits on a line: the test's name, when, how it ended."""
    return {k: v for k, v in sorted(description.items()) if isinstance(v, Scalar)}


def documents(description: Mapping[str, Any]) -> dict[str, str]:
    """Definition and settings, each as JSON."""
    return {
        key: json.dumps(value, sort_keys=True)
        for key, value in sorted(description.items())
        if isinstance(value, dict | list) and key not in _IN_THE_WHOLE_RUN
    }
