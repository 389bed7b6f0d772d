"""Print the path of a Chromium for the browser tests; install Debian's where root may.

Prints nothing, and says in one line on standard error what is missing, where there is none.
"""

import os
import shutil
import subprocess
import sys

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")


def find() -> str | None:
    """Path of the first browser on PATH."""
    return next((path for name in NAMES if (path := shutil.which(name))), None)


def install() -> str | None:
    """Install Debian's Chromium. Returns why that did not work, or None."""
    if not shutil.which("apt-get"):
        return "there is no apt-get to install one"
    if os.geteuid() != 0:
        return "only root may install one (apt-get install chromium)"
    print("Installing Chromium for the browser tests", file=sys.stderr)
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    apt = ["apt-get", "--quiet=2", "--option", "Acquire::Retries=3"]
    for step in (["update"], ["install", "--yes", "chromium"]):
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
    path = find()
    if path is None:
        obstacle = install()
        path = find()
        if path is None:
            why = obstacle or "the package brought none"
            print(f"Browser tests are skipped: no Chromium found, and {why}", file=sys.stderr)
            return
    print(path)


if __name__ == "__main__":
    main()
