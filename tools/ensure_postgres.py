"""Print the folder of a PostgreSQL server's programs for the tests; install Debian's where root may.

Prints nothing, and says in one line on standard error what is missing, where there is none.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path


def find() -> str | None:
    """Debian keeps them off the PATH, a folder for each version: the newest."""
    folders = sorted(Path("/usr/lib/postgresql").glob("*/bin"), reverse=True)
    on_path = shutil.which("initdb")
    folders += [Path(on_path).resolve().parent] if on_path else []
    whole = (f for f in folders if (f / "initdb").exists() and (f / "postgres").exists())
    return next((str(folder) for folder in whole), None)


def install() -> str | None:
    """Install Debian's server. Returns why that did not work, or None."""
    if not shutil.which("apt-get"):
        return "there is no apt-get to install one"
    if os.geteuid() != 0:
        return "only root may install one (apt-get install postgresql)"
    print("Installing PostgreSQL for the database tests", file=sys.stderr)
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    apt = ["apt-get", "--quiet=2", "--option", "Acquire::Retries=3"]
    for step in (["update"], ["install", "--yes", "postgresql"]):
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


def main() -> None:
    """Find, else install and find."""
    folder = find()
    if folder is None:
        obstacle = install()
        folder = find()
        if folder is None:
            why = obstacle or "the package brought none"
            print(f"Tests on PostgreSQL are skipped: no server found, and {why}", file=sys.stderr)
            return
    print(folder)


if __name__ == "__main__":
    main()
