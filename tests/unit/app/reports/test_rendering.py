"""A report as PDF and HTML: its words are in it, literally, and the same bytes come twice."""

from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import pypdfium2
import pytest

from app.errors import Code, Refusal
from app.reports.branding import Branding, branding
from app.reports.rendering import render_html, render_pdf
from app.reports.report import (
    Column,
    Facts,
    Item,
    Report,
    Row,
    Section,
    Table,
    Tone,
    Verdict,
    Words,
)

WICKED = (
    '#strong[x] *b* _i_ $x^2$ `raw` #eval("1") #read("/report.json") @label <label> \\ // {{ 7*7 }}',
    "<script>alert(1)</script> <img src=x onerror=alert(1)> &amp; \"quoted\" 'so'",
    "= heading",
    "https://example.org/#x",
    "\u202egnp.exe\u0007",
)


def report_of(words: tuple[str, ...] = ("plain",)) -> Report:
    """The words wherever users' words can be."""
    text = words[0]
    items: tuple[Item, ...] = (
        *(Words(word) for word in words),
        Facts(tuple((word, word) for word in words)),
        Table(text, (Column(text), Column("n", number=True)), (Row((text, "1"), Tone.BAD),)),
    )
    sections = (Section(text, items), Section("Next", items, own_page=True))
    verdict = Verdict("FAILED", f"1 of 2. {text}", Tone.BAD)
    when = datetime(2026, 3, 2, 9, 30, tzinfo=UTC)
    return Report("Test report", text, "Run 7", verdict, items, sections, when, "forcerig 0.1.0")


@pytest.fixture
def look() -> Branding:
    found = branding(None, None)
    assert isinstance(found, Branding)
    return found


def pages(pdf: bytes | Refusal) -> list[str]:
    """The text of each page, spaces and line breaks alike."""
    assert isinstance(pdf, bytes), pdf
    document = pypdfium2.PdfDocument(pdf)
    try:
        return [" ".join(page.get_textpage().get_text_range().split()) for page in document]
    finally:
        document.close()


def test_the_verdict_is_on_the_first_page_and_its_number_on_each(look: Branding) -> None:
    first, *others = pages(render_pdf(report_of(), look))
    assert "FAILED" in first
    assert f"1 of {1 + len(others)}" in first
    for number, text in enumerate([first, *others], 1):
        assert f"{number} of {1 + len(others)}" in text
        assert "Run 7" in text


@pytest.mark.parametrize("word", WICKED[:4])
def test_what_people_write_is_shown_and_never_carried_out(look: Branding, word: str) -> None:
    plain = "".join("".join(pages(render_pdf(report_of((word,)), look))).split())
    shown = "".join(word.split()).replace('"', '"')
    assert shown in plain.replace("\u201c", '"').replace("\u2019", "'").replace("\u200b", "")


@pytest.mark.parametrize("word", WICKED)
def test_html_escapes_all_of_it(look: Branding, word: str) -> None:
    html = render_html(report_of((word,)), look).decode()
    assert "<script" not in html
    assert "<img src=x" not in html
    assert "49" not in html.split("</style>")[1]


def test_any_character_can_be_set(look: Branding) -> None:
    assert pages(render_pdf(report_of(WICKED), look))


def test_the_same_report_has_the_same_bytes(look: Branding) -> None:
    assert render_pdf(report_of(WICKED), look) == render_pdf(report_of(WICKED), look)
    assert render_html(report_of(WICKED), look) == render_html(report_of(WICKED), look)


def test_a_report_without_a_date_has_none_of_the_clock(look: Branding) -> None:
    undated = replace(report_of(), dated=None)
    assert render_pdf(undated, look) == render_pdf(undated, look)


def test_a_labs_logo_and_template_are_used(tmp_path: Path, look: Branding) -> None:
    logo, template = tmp_path / "logo.svg", tmp_path / "own.typ"
    logo.write_text('<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>')
    template.write_text('#let r = json("/report.json")\nOurs: #r.subtitle #image("/" + r.logo)\n')
    own = branding(logo, template)
    assert isinstance(own, Branding)
    (only,) = pages(render_pdf(report_of(("Seal test",)), own))
    assert only == "Ours: Seal test"
    assert "data:image/svg+xml" in render_html(report_of(), own).decode()


def test_a_template_that_is_wrong_is_refused_with_what_is_wrong(tmp_path: Path) -> None:
    template = tmp_path / "own.typ"
    template.write_text("#nothing-like-it")
    own = branding(None, template)
    assert isinstance(own, Branding)
    refused = render_pdf(report_of(), own)
    assert isinstance(refused, Refusal)
    assert refused.code is Code.INVALID_REPORT
    assert "nothing-like-it" in refused.detail


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [("gone.svg", None, "No such file"), ("logo.exe", b"MZ", ".svg, .png, .jpg")],
)
def test_a_logo_that_cannot_be_used_is_refused(
    tmp_path: Path, name: str, content: bytes | None, said: str
) -> None:
    logo = tmp_path / name
    if content is not None:
        logo.write_bytes(content)
    refused = branding(logo, None)
    assert isinstance(refused, Refusal)
    assert said in refused.detail


def test_a_template_that_is_gone_or_no_text_is_refused(tmp_path: Path) -> None:
    for content in (None, b"\xff\xfe\x00"):
        template = tmp_path / "own.typ"
        if content is not None:
            template.write_bytes(content)
        refused = branding(None, template)
        assert isinstance(refused, Refusal)
        assert "FORCERIG_REPORT_TEMPLATE" in refused.detail
