"""What is drawn and said of a reading: places in order, colours, words, and what the process is told."""

from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.scene import layout, words
from app.scene.chain import Chain, Reading
from app.scene.colours import FORCE, PRESSURE, UNKNOWN, of_force, of_pressure
from app.scene.layout import Sizes, drawn
from app.scene.shapes import coil
from app.scene.telling import LiveTold, Moment, RigTold, Told, View, ViewTold, line, told_in
from rtcore.rig.parameters import load_rig

CHAIN = Chain.of(load_rig())
SIZES = Sizes.of(CHAIN)
READING = Reading(12e3, -0.004, 13e6, 8e6, 21e6, 0.2)


def test_sections_and_masses_are_to_scale() -> None:
    assert pytest.approx(0.035, rel=1e-3) == SIZES.bore_m  # 70/40 mm, as the rig's sheet says
    assert pytest.approx(0.020, rel=1e-3) == SIZES.rod_m
    assert pytest.approx(CHAIN.m_1_kg) == layout.STEEL_KG_M3 * SIZES.mass_1_m**3


@given(st.floats(-60e3, 60e3), st.floats(-0.03, 0.03), st.floats(1, 100), st.floats(1, 3))
def test_no_part_is_drawn_through_another(
    force_n: float, displacement_m: float, deformation: float, travel: float
) -> None:
    at = drawn(CHAIN, SIZES, Reading(force_n, displacement_m), deformation, travel)
    cap = layout.CAP_M
    ends = [
        (0.0, layout.BODY_FROM_M + at.body),  # spring of the plate
        (layout.BODY_FROM_M + cap + at.body, at.piston - 0.5 * layout.PISTON_M),  # chamber 1
        (at.piston + 0.5 * layout.PISTON_M, layout.BODY_TO_M - cap + at.body),  # chamber 2
        (layout.BODY_TO_M + at.body, at.rod_end),
        (at.rod_end, at.mass_1),
        (at.mass_1 + SIZES.mass_1_m, at.mass_2),
        (at.mass_2 + SIZES.mass_2_m, at.unit),
        (at.unit, SIZES.unit_body_from_m),
        (SIZES.unit_body_from_m, at.unit + layout.UNIT_ROD_M),  # the rod stays in the unit
    ]
    assert all(low < high for low, high in ends)
    assert all(a[0] < b[0] for a, b in pairwise(ends[:-1]))


def test_what_is_not_known_is_drawn_at_rest_in_grey_and_said_so() -> None:
    at_rest = drawn(CHAIN, SIZES, Reading(0.0, 0.0), 50.0, 1.0)
    assert drawn(CHAIN, SIZES, Reading(), 50.0, 1.0) == at_rest
    assert of_pressure(None, 21e6) == of_force(None, 60e3) == UNKNOWN
    assert of_pressure(float("nan"), 21e6) == UNKNOWN
    assert words.force(None) == "– kN"


def test_colours_run_from_one_end_to_the_other_and_not_beyond() -> None:
    assert of_pressure(0.0, 21e6) == of_pressure(-1e5, 21e6) == PRESSURE[0]
    assert of_pressure(21e6, 21e6) == of_pressure(30e6, 21e6) == PRESSURE[-1]
    assert (of_force(-60e3, 60e3), of_force(0.0, 60e3), of_force(60e3, 60e3)) == FORCE
    light = [sum(of_pressure(p, 100.0)) for p in range(0, 101, 5)]
    assert light == sorted(light)  # in order for every eye, and in grey


def test_words_are_those_of_the_pages() -> None:
    assert words.force(-12345.6) == "−12.35 kN"
    assert words.pressure(20.96e6) == "210 bar"
    assert words.length(-1e-9) == "0.00 mm"
    assert words.share(0.305) in ("30 %", "31 %")


def test_a_coil_is_one_long_and_closed_along_its_wire() -> None:
    mesh = coil(0.05, 0.004)
    assert mesh.vertices[:, 0].min() == pytest.approx(0.0, abs=0.05)
    assert mesh.vertices[:, 0].max() == pytest.approx(1.0, abs=0.05)
    assert mesh.faces.max() < len(mesh.vertices)


VIEW = View(20.0, 2.0, Moment(replace(CHAIN, k_pl=1e8), READING))


@pytest.mark.parametrize(
    "told",
    [
        RigTold(CHAIN),
        LiveTold(READING),
        LiveTold(Reading()),
        ViewTold("a/b", View()),
        ViewTold("a/b", VIEW),
    ],
    ids=["rig", "live", "live, unknown", "view, live", "view, recorded"],
)
def test_the_process_hears_what_it_is_told(told: Told) -> None:
    text = line(told)
    assert text.count(b"\n") == 1
    assert text.endswith(b"\n")
    assert told_in(text) == told
