"""Where machine code is kept between processes, so that no edit of the sources leaves old physics running.

Numba looks only at the file of the function it caches, not at what that function calls. Each compiled package therefore
has a cache folder named by the hash of its own sources and of the packages below it (docs/decisions/0005).
"""

import hashlib
import os
import shutil
import tempfile
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).parent.parent

LAYERS = (
    ("geometry",), ("seawater",), ("control",), ("dynamics", "ocean"), ("machinery",), ("analysis",), ("bench",),
    ("planning",), ("simulation",),
)  # fmt: skip
"""Packages with compiled functions, the lower ones first: a function calls its own layer and those below."""

_KEPT = 24
"""Folders that are kept, the newest."""


@cache
def folder_of(package: str) -> Path:
    """Return the cache folder of a package of stommel; it lies in the user's cache, or in the temporary folder."""
    digest = hashlib.sha256(package.encode() + (PACKAGE / "compilation" / "decorators.py").read_bytes())
    for layer in LAYERS:
        for name in layer:
            digest.update(_hash_of(name))
        if package in layer:
            break
    home = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "stommel"
    folder = home / f"{package}-{digest.hexdigest()[:16]}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        folder.touch()
        _forget_old(home)
    except OSError:
        folder = Path(tempfile.gettempdir()) / f"stommel-{os.getuid()}" / folder.name
        folder.mkdir(parents=True, exist_ok=True)
    return folder


@cache
def _hash_of(package: str) -> bytes:
    digest = hashlib.sha256()
    for source in sorted((PACKAGE / package).rglob("*.py")):
        digest.update(source.relative_to(PACKAGE).as_posix().encode() + b"\0" + source.read_bytes())
    return digest.digest()


def _forget_old(home: Path) -> None:
    folders = [entry for entry in home.iterdir() if entry.is_dir()]
    if len(folders) > _KEPT:
        for old in sorted(folders, key=lambda entry: entry.stat().st_mtime)[:-_KEPT]:
            shutil.rmtree(old, ignore_errors=True)
