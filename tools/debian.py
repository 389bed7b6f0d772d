"""A program of Debian's for the tests: found, else installed where root may."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable


def print_found(find: Callable[[], str | None], package: str, skipped: str, wanted: str) -> None:
    """Print what `find` finds, the package installed where it finds nothing.

    Prints nothing, and says in one line on standard error which tests are skipped and why, where there is none.
    """
    found = find()
    if found is None:
        obstacle = _install(package, wanted)
        found = find()
        if found is None:
            why = obstacle or "the package brought none"
            print(f"{skipped} are skipped: no {wanted} found, and {why}", file=sys.stderr)
            return
    print(found)


def _install(package: str, wanted: str) -> str | None:
    """Install a package. Returns why that did not work, or None."""
    if not shutil.which("apt-get"):
        return "there is no apt-get to install one"
    if os.geteuid() != 0:
        return f"only root may install one (apt-get install {package})"
    print(f"Installing {wanted} for the tests", file=sys.stderr)
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    apt = ["apt-get", "--quiet=2", "--option", "Acquire::Retries=3"]
    for step in (["update"], ["install", "--yes", package]):
        done = subprocess.run(
            [*apt, *step],
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=sys.stderr,
            check=False,
        )
        if done.returncode:
            return f"apt-get {step[0]} failed"
    return None
