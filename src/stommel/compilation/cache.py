"""Where machine code is kept between processes, so that no edit of the sources leaves old physics running.

Numba looks only at the file of the function it caches, not at what that function calls. Each module with compiled
functions therefore has a folder named by the hash of all that they are made of (docs/decisions/0005).
"""

import json
import os
import shutil
import sys
import tempfile
import time
import uuid
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path
from stat import S_ISDIR

from stommel.compilation.sources import Sources

PACKAGE = Path(__file__).parent.parent

_LOADED = time.time()
"""From here on the running code may differ from the sources on disk [s since 1970]."""

_CLOCK_STEP = 0.02
"""How late a file system may date a file [s]."""

_KEPT = 300
"""Entries of the cache that are kept, the newest: folders of machine code and lists of keys."""

_OTHERS_MAY_WRITE = 0o022


@cache
def folder_of(module: str) -> Path | None:
    """Return the cache folder of a module of stommel; None if there is no place for it that can be trusted.

    It lies in the folder that `NUMBA_CACHE_DIR` names, else in the user's cache, else in the temporary folder.
    """
    home = _home()
    key = _keys(home).get(module) if home else None
    if home is None or key is None:
        return None
    folder = home / f"{module.partition('.')[2]}-{key}"
    with suppress(OSError):
        os.utime(folder)  # tells _forget_old that it is in use
    return folder


@cache
def _keys(home: Path) -> dict[str, str]:
    """Return the hash of what each module's machine code is made of; empty if the sources are not what runs."""
    sources = Sources(PACKAGE)
    if not sources.files or sources.newest > _LOADED - _CLOCK_STEP:
        return {}
    known = home / f"keys-{sources.digest[:32]}-{sys.implementation.cache_tag}.json"
    try:
        keys: dict[str, str] = json.loads(known.read_bytes())
    except (OSError, ValueError):
        keys = {module: sources.key_of(module) for module in sources.compiled_modules()}
        _forget_old(home)
        _write(known, json.dumps(keys))
    return keys


def _write(path: Path, text: str) -> None:
    """Write in one step: other processes see all of the file or none."""
    part = path.with_name(f"{path.name}.{uuid.uuid4().hex[:8]}")
    try:
        part.write_text(text)
        part.replace(path)
    except OSError:  # no room: the keys are worked out again the next time
        part.unlink(missing_ok=True)


@cache
def _home() -> Path | None:
    for folder in _places():
        try:
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            if _is_ours(folder) and os.access(folder, os.W_OK | os.X_OK):
                return folder
        except OSError:
            continue
    return None


def _places() -> Iterator[Path]:
    named = os.environ.get("NUMBA_CACHE_DIR") or os.environ.get("XDG_CACHE_HOME")
    with suppress(RuntimeError):  # nobody knows where home is
        yield Path(named or Path.home() / ".cache") / "stommel"
    yield Path(tempfile.gettempdir()) / f"stommel-{os.getuid()}"


def _is_ours(folder: Path) -> bool:
    """Tell whether only we can have written here: loading machine code runs it, and anyone can take a name in /tmp."""
    status = folder.lstat()
    return S_ISDIR(status.st_mode) and status.st_uid == os.getuid() and not status.st_mode & _OTHERS_MAY_WRITE


def _forget_old(home: Path) -> None:
    """Remove the oldest entries, while other processes may do the same."""
    ages = []
    for entry in home.iterdir():
        try:
            ages.append((entry.stat().st_mtime, entry))
        except FileNotFoundError:
            continue
    for _, old in sorted(ages)[:-_KEPT]:
        if old.is_dir():
            shutil.rmtree(old, ignore_errors=True)
        else:
            old.unlink(missing_ok=True)
