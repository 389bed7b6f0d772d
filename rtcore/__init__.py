"""The real-time loop of forcerig: one compiled tick, the simulated rig, and the memory shared with the app.

Importing this package points Numba's cache at a folder named after the sources themselves: Numba
alone would keep a stale caller when a kernel that it calls, in another file, has changed.
"""

import hashlib
import os
import shutil
import sys
from pathlib import Path

_HERE = Path(__file__).parent


def _sources_hash() -> str:
    digest = hashlib.sha256(os.environ.get("NUMBA_BOUNDSCHECK", "").encode())
    for path in sorted(_HERE.rglob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def _use_fresh_kernel_cache() -> None:
    caches = _HERE / "__pycache__"
    cache = caches / f"kernels-{_sources_hash()}"
    if not cache.exists():
        stale = sorted(caches.glob("kernels-*"), key=lambda p: p.stat().st_mtime)
        for old in stale[:-3]:
            shutil.rmtree(old, ignore_errors=True)
    os.environ["NUMBA_CACHE_DIR"] = str(cache)
    if "numba" in sys.modules:  # which has read its environment already
        sys.modules["numba"].config.CACHE_DIR = str(cache)


if "NUMBA_CACHE_DIR" not in os.environ:
    _use_fresh_kernel_cache()
