"""Break detectors and states in every way that cosmic-ray knows; their tests must see each: `make mutants`.

Every mutant is tried in a fork of this process, in which nothing of rtcore that is mutated has been imported.
"""

import importlib.abc
import importlib.util
import os
import signal
import sys
from collections.abc import Iterator
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

os.environ["NUMBA_DISABLE_JIT"] = "1"  # a mutant is to be run, not compiled
os.environ["PYTEST_DISABLE_PLUGIN_AUTOLOAD"] = "1"

import coverage
import hypothesis
import numba
import pytest
from cosmic_ray.mutating import mutate_code
from cosmic_ray.plugins import get_operator, operator_names
from rich.console import Console
from rich.progress import track

MODULES = ("rtcore.interlocks", "rtcore.modes")
TESTS = ("tests/unit/rtcore/test_interlocks.py", "tests/unit/rtcore/test_modes.py")
PATIENCE_S = 120
UNCOMPILED = "core/RemoveDecorator"  # only a compiled run can tell
OPTIONS = ("-x", "-q", "-c", os.devnull, "--rootdir", ".", "--noconftest", "-p", "no:cacheprovider")


class Mutant(NamedTuple):
    """One way in which a module is broken."""

    module: str
    operator: str
    occurrence: int
    source: str


class Broken(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Hands out the mutant where its module is imported."""

    def __init__(self, mutant: Mutant, path: Path) -> None:
        self._mutant, self._path = mutant, path

    def find_spec(self, name: str, path: object, target: object = None) -> ModuleSpec | None:
        if name != self._mutant.module:
            return None
        return importlib.util.spec_from_loader(name, self, origin=str(self._path))

    def exec_module(self, module: ModuleType) -> None:
        exec(compile(self._mutant.source, str(self._path), "exec"), module.__dict__)


def path_of(module: str) -> Path:
    return Path(*module.split(".")).with_suffix(".py")


def mutants(module: str) -> Iterator[Mutant]:
    """All of a module."""
    code = path_of(module).read_bytes()
    for name in sorted(operator_names()):
        operator, occurrence = get_operator(name), 0
        if operator.arguments():  # one that would have to be told what to put in
            continue
        while (source := mutate_code(code, operator(), occurrence)) is not None:
            yield Mutant(module, name, occurrence, source)
            occurrence += 1


def run_tests(*options: str) -> int:
    hypothesis.settings.register_profile(
        "mutants",
        deadline=None,
        max_examples=50,
        database=None,
        suppress_health_check=list(hypothesis.HealthCheck),
    )
    hypothesis.settings.load_profile("mutants")
    return int(pytest.main([*OPTIONS, *options, *TESTS]))


def survives(mutant: Mutant) -> bool:
    """Whether the tests pass on a mutant."""
    child = os.fork()
    if child == 0:
        silence = os.open(os.devnull, os.O_WRONLY)
        os.dup2(silence, 1)
        os.dup2(silence, 2)
        signal.alarm(PATIENCE_S)  # one that does not end is killed, too
        sys.meta_path.insert(0, Broken(mutant, path_of(mutant.module)))
        code = 1
        try:
            compiled = mutant.operator == UNCOMPILED
            numba.config.DISABLE_JIT = not compiled
            code = run_tests(*(("-k", "is_compiled") if compiled else ()))
        finally:
            os._exit(code)
    return os.waitpid(child, 0)[1] == 0


def coverage_of() -> float:
    """Lines and branches of the modules that their tests run, %."""
    child = os.fork()
    if child == 0:
        measured = coverage.Coverage(branch=True, include=[str(path_of(m)) for m in MODULES])
        measured.start()
        failed = run_tests()
        measured.stop()
        whole = measured.report(show_missing=True, file=sys.stderr)
        os._exit(100 if failed else int(100 - whole))
    return 100.0 - os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def main() -> int:
    """Exit code 0 where all is covered and every mutant was killed."""
    covered = coverage_of()
    found = [mutant for module in MODULES for mutant in mutants(module)]
    bar = track(found, "mutants", console=Console(stderr=True), transient=True)
    survivors = [mutant for mutant in bar if survives(mutant)]
    for mutant in survivors:
        print(f"survived: {mutant.module} {mutant.operator} {mutant.occurrence}")
    print(f"{len(found)} mutants, {len(survivors)} survived; lines and branches {covered:.0f} %")
    return int(bool(survivors) or covered < 100.0)


if __name__ == "__main__":
    sys.exit(main())
