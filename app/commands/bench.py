"""`forcerig bench`: one benchmark of the folder bench/, or all of them."""

import importlib
import json
import pkgutil
from collections.abc import Callable
from contextlib import redirect_stdout
from inspect import signature
from io import StringIO

import bench
from app.commands.output import Exit, print_json, print_refusal
from app.documents.messages import nearest
from app.errors import Code, Refusal

ALL = "all"

# Told whether to print JSON, and some for how many minutes to measure; returns the exit code.
Benchmark = Callable[..., int]


def benchmarks() -> dict[str, Benchmark]:
    """The modules of bench/ that can be run, by name."""
    names = sorted(module.name for module in pkgutil.iter_modules(bench.__path__))
    modules = {name: importlib.import_module(f"bench.{name}") for name in names}
    return {name: module.main for name, module in modules.items() if hasattr(module, "main")}


def run(name: str, as_json: bool, minutes: float | None = None) -> int:
    """Run a benchmark, or all; the exit code is the worst of them."""
    known = benchmarks()
    if name == ALL and minutes is None:
        return _all(known, as_json)
    if name not in known:
        listed = ", ".join([*known, ALL])
        detail = f"There is no benchmark '{name}'{nearest(name, known)} Known: {listed}"
        return print_refusal(Refusal(Code.INVALID_REQUEST, detail), as_json)
    if minutes is None:
        return known[name](as_json)
    if "minutes" not in signature(known[name]).parameters:
        detail = f"The benchmark '{name}' takes as long as it takes: leave --minutes out"
        return print_refusal(Refusal(Code.INVALID_REQUEST, detail), as_json)
    return known[name](as_json, minutes=minutes)


def _all(known: dict[str, Benchmark], as_json: bool) -> int:
    if not as_json:
        return max((main(False) for main in known.values()), default=Exit.PASSED)
    documents, worst = {}, 0
    for name, main in known.items():
        with redirect_stdout(StringIO()) as printed:
            worst = max(worst, main(True))
        documents[name] = json.loads(printed.getvalue())
    print_json(documents)
    return worst
