"""Print the path of a Chromium for the browser tests."""

import shutil

from tools.debian import print_found

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")


def find() -> str | None:
    """Path of the first browser on PATH."""
    return next((path for name in NAMES if (path := shutil.which(name))), None)


if __name__ == "__main__":
    print_found(find, "chromium", "Browser tests", "Chromium")
