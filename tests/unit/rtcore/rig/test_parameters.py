"""The rig's parameters: what is refused, and what the shipped rig is made of."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from annotated_types import Ge, Gt, Le
from pydantic import BaseModel, ValidationError

from rtcore.rig.constants import bypass_flow_gain, plant_constants, valve_flow_gain
from rtcore.rig.parameters import RigParameters, load_rig, rig_from
from rtcore.rig.plant import PLANT


class Bound(NamedTuple):
    """A number just beyond what one parameter may be, and that bound."""

    part: str
    name: str
    beyond: float
    bound: float
    allowed: bool


def bounds() -> Iterator[Bound]:
    for part, field in RigParameters.model_fields.items():
        kind = field.annotation
        if not (isinstance(kind, type) and issubclass(kind, BaseModel)):
            continue
        for name, inner in kind.model_fields.items():
            whole = inner.annotation is int
            for rule in inner.metadata:
                limit = getattr(rule, {Ge: "ge", Gt: "gt", Le: "le"}.get(type(rule), ""), None)
                if limit is None:
                    continue
                step = 1 if whole else max(abs(float(limit)), 1e-9) * 1e-6
                outside = limit + step if isinstance(rule, Le) else limit - step
                yield Bound(part, name, outside, limit, not isinstance(rule, Gt))


BOUNDS = list(bounds())


def ids(bound: Bound) -> str:
    return f"{bound.part}.{bound.name}={bound.beyond:g}"


@pytest.mark.parametrize("bound", BOUNDS, ids=ids)
def test_a_value_beyond_its_bound_is_refused_with_its_path(bound: Bound) -> None:
    with pytest.raises(ValidationError) as refused:
        rig_from({bound.part: {bound.name: bound.beyond}})
    assert [error["loc"] for error in refused.value.errors()] == [(bound.part, bound.name)]


@pytest.mark.parametrize("bound", [b for b in BOUNDS if b.allowed], ids=ids)
def test_a_value_at_its_bound_is_taken(bound: Bound) -> None:
    part = RigParameters.model_fields[bound.part].annotation
    assert isinstance(part, type)
    assert issubclass(part, BaseModel)
    values = getattr(load_rig(), bound.part).model_dump() | {bound.name: bound.bound}
    assert getattr(part.model_validate(values), bound.name) == bound.bound


def test_every_number_is_bounded_on_both_sides() -> None:
    sides: dict[tuple[str, str], set[bool]] = {}
    for b in BOUNDS:
        sides.setdefault((b.part, b.name), set()).add(b.beyond > b.bound)
    shipped = load_rig().model_dump()
    parts = {part: values for part, values in shipped.items() if isinstance(values, dict)}
    numbers = {(part, name) for part, values in parts.items() for name in values}
    assert len(numbers) > 70
    assert {key for key in numbers if sides.get(key) != {True, False}} == set()


@pytest.mark.parametrize(
    ("part", "name", "value", "why"),
    [
        ("structure", "c_lc", 1e6, "structure of this rig moves at 267,202 1/s"),
        ("structure", "k_2", 1e10, "less stiffness or damping"),
        ("unit", "c_tra", 1e6, "or more mass"),
        ("sensors", "zeta_lc", 2.0, "load cell's chain of this rig moves at"),
        ("unit", "stroke_m", 0.06, "volume_1_m3 is less than unit.stroke_m"),
        ("load_actuator", "volume_2_m3", 7e-5, "volume_2_m3 is less than unit.stroke_m"),
    ],
)
def test_values_that_do_not_go_together_are_refused(
    part: str, name: str, value: float, why: str
) -> None:
    with pytest.raises(ValidationError, match=why):
        rig_from({part: {name: value}})


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, "many", None])
def test_only_numbers_are_taken_for_numbers(value: Any) -> None:
    with pytest.raises(ValidationError):
        rig_from({"load_actuator": {"area_m2": value}})


@pytest.mark.parametrize(
    ("overrides", "path"),
    [
        ({"suply": {}}, ("suply",)),
        ({"supply": {"high_bar": 210}}, ("supply", "high_bar")),
        ({"structure": 3}, ("structure",)),
        ({"name": ""}, ("name",)),
    ],
)
def test_what_is_not_known_is_refused_with_its_path(
    overrides: dict[str, Any], path: tuple[str, ...]
) -> None:
    with pytest.raises(ValidationError) as refused:
        rig_from(overrides)
    assert [error["loc"] for error in refused.value.errors()] == [path]


def test_a_file_need_name_only_what_differs(tmp_path: Path) -> None:
    path = tmp_path / "rig.yaml"
    path.write_text("structure: {k_pl: 5.0e+7}\n", encoding="utf-8")
    changed, shipped = load_rig(path), load_rig()
    assert changed.structure.k_pl == 5e7
    assert changed.structure.k_2 == shipped.structure.k_2
    assert changed.supply == shipped.supply


@pytest.mark.parametrize("text", ["[1, 2]", "3", "just words", ""])
def test_a_file_that_is_no_mapping_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "rig.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match="a rig is a mapping"):
        load_rig(path)


def test_parameters_are_frozen() -> None:
    with pytest.raises(ValidationError):
        load_rig().supply.high_pa = 1e6  # type: ignore[misc]


def test_every_parameter_reaches_the_constants_of_the_plant() -> None:
    """A parameter that changes nothing in the kernels would be a lie."""
    elsewhere = {"high_pa", "low_pa", "ramp_pa_s"}  # the pump's, which the rig's record holds
    shipped = load_rig()
    plain = plant_constants(shipped)
    idle = set()
    for part in ("supply", "fluid", "servovalve", "load_actuator", "structure", "unit"):
        for name, value in getattr(shipped, part).model_dump().items():
            other = value * 1.01 if value else 1e-12
            changed = plant_constants(rig_from({part: {name: other}}))
            if all(np.array_equal(changed[n], plain[n]) for n in PLANT.names or ()):
                idle.add(name)
    assert idle <= elsewhere


def test_the_shipped_rig_is_the_one_of_the_sheet() -> None:
    rig = load_rig()
    assert rig.load_actuator.area_m2 == pytest.approx(math.pi / 4 * (0.07**2 - 0.04**2), rel=2e-4)
    assert rig.servovalve.spool_rate_m_s / rig.servovalve.spool_stroke_m == pytest.approx(420.0)
    assert rig.servovalve.omega_f_rad_s == pytest.approx(2 * math.pi * 450)
    assert rig.servovalve.spool_gain_rad_s == pytest.approx(2 * math.pi * 110)
    assert rig.sensors.omega_lc_rad_s == pytest.approx(2 * math.pi * 2000)
    assert rig.sensors.omega_lvt_rad_s == pytest.approx(2 * math.pi * 1500)
    assert rig.unit.omega_t_rad_s == pytest.approx(2 * math.pi * 12)
    s, unit = rig.structure, rig.unit
    y_0 = 1 / unit.k_tra + 1 / s.k_2 + 1 / s.k_lc + 1 / s.k_pl
    assert y_0 == pytest.approx(2.791666666666667e-08)
    flow_gain = valve_flow_gain(rig) * math.sqrt(rig.supply.high_pa - rig.supply.tank_pa)
    assert rig.load_actuator.area_m2 / flow_gain == pytest.approx(1.4413, abs=1e-4)
    assert bypass_flow_gain(rig) == pytest.approx(1.8408e-8, rel=1e-4)
