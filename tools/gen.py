"""Generate the console's types from the Python that declares them.

    python tools/gen.py            rewrites web/src/gen
    python tools/gen.py --check    says which files there are out of date, if any

`app.gen` writes the OpenAPI document and the wire types; openapi-typescript turns the former into
TypeScript.
"""

import filecmp
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
COMMITTED = ROOT / "web" / "src" / "gen"


def generate(folder: Path) -> None:
    """Write every generated file into `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    node = [sys.executable, str(ROOT / "tools" / "node.py")]
    api = [str(folder / "openapi.json"), "--output", str(folder / "api.ts")]
    commands = (
        [sys.executable, "-m", "app.gen", str(folder)],
        [*node, "npm", "--prefix", str(ROOT / "web"), "exec", "--", "openapi-typescript", *api],
    )
    for command in commands:
        done = subprocess.run(command, cwd=ROOT, stdout=subprocess.DEVNULL, check=False)
        if done.returncode:
            raise SystemExit(done.returncode)


def out_of_date(fresh: Path, committed: Path) -> list[str]:
    """Names of the files that differ, or that only one of the folders has."""
    names = {path.name for folder in (fresh, committed) for path in folder.glob("*")}
    same, _, _ = filecmp.cmpfiles(fresh, committed, names, shallow=False)
    return sorted(names - set(same))


def main(arguments: list[str]) -> int:
    """Generate, or check what is committed. Returns an exit status."""
    if arguments != ["--check"]:
        generate(COMMITTED)
        return 0
    with tempfile.TemporaryDirectory() as folder:
        generate(Path(folder))
        stale = out_of_date(Path(folder), COMMITTED)
    if stale:
        print(f"web/src/gen is out of date: {', '.join(stale)}; run `make gen`", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
