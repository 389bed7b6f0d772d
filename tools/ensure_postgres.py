"""Print the folder of a PostgreSQL server's programs for the tests."""

import shutil
from pathlib import Path

from tools.debian import print_found


def find() -> str | None:
    """Debian keeps them off the PATH, a folder for each version: the newest."""
    folders = sorted(Path("/usr/lib/postgresql").glob("*/bin"), reverse=True)
    on_path = shutil.which("initdb")
    folders += [Path(on_path).resolve().parent] if on_path else []
    whole = (f for f in folders if (f / "initdb").exists() and (f / "postgres").exists())
    return next((str(folder) for folder in whole), None)


if __name__ == "__main__":
    print_found(find, "postgresql", "Tests on PostgreSQL", "PostgreSQL server")
