"""`forcerig check`: is this a test, and what does it come to?"""

from collections.abc import Sequence

from rich.console import Console
from rich.table import Table

from app.commands.output import Exit, print_json, print_refusal, text_console
from app.commands.which_test import find_definition
from app.definitions.blocks import Block
from app.definitions.definition import Definition
from app.definitions.motions import Motion
from app.definitions.outline import Outline, outline
from app.definitions.saying import in_words
from app.documents.units import say
from app.errors import Refusal


def check(test: str, as_json: bool) -> Exit:
    """Validate a test and print its blocks, durations, cycles and peaks."""
    definition = find_definition(test)
    if isinstance(definition, Refusal):
        return print_refusal(definition, as_json)
    found = outline(definition)
    if as_json:
        print_json({"name": definition.name, **found.model_dump(mode="json")})
    else:
        _print(definition, found)
    return Exit.PASSED


def _print(definition: Definition, found: Outline) -> None:
    console = text_console()
    console.print(definition.name, style="bold", markup=False)
    console.print(_blocks(found))
    _print_words(console, definition.blocks)
    if found.motion:
        console.print(_motion(found))
        _print_words(console, definition.motion)
    console.print(
        f"{say(found.duration_s, 's')}, {found.cycles:,} cycles, "
        f"peak {say(found.peak_force_n, 'N')}, {say(found.peak_displacement_m, 'm')}"
    )
    if found.motion_duration_s > found.duration_s:
        left_s = found.motion_duration_s - found.duration_s
        console.print(f"The motion would go on for {say(left_s, 's')} after the last block.")


def _print_words(console: Console, items: Sequence[Block | Motion]) -> None:
    """What the table does not show of each block."""
    for i, item in enumerate(items):
        words = in_words(item)
        if words:
            console.print(f"{i} {item.kind}: {words}", markup=False, highlight=False)


def _table(name: str, unit: str) -> Table:
    table = Table()
    table.add_column(name, no_wrap=True)
    for heading in ("starts (s)", "lasts (s)", "cycles", f"least ({unit})", f"greatest ({unit})"):
        table.add_column(heading, justify="right")
    return table


def _blocks(found: Outline) -> Table:
    table = _table("block", "N")
    for b in found.blocks:
        values = (b.start_s, b.duration_s, b.cycles, b.min_force_n, b.max_force_n)
        table.add_row(f"{b.index} {b.kind}", *(say(value) for value in values))
    return table


def _motion(found: Outline) -> Table:
    table = _table("motion", "m")
    for m in found.motion:
        values = (m.start_s, m.duration_s, m.cycles, m.min_displacement_m, m.max_displacement_m)
        table.add_row(f"{m.index} {m.kind}", *(say(value) for value in values))
    return table
