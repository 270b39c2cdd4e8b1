"""One decorator for every compiled function, so that all of them share one floating-point contract.

The compiler may fuse a multiplication with an addition (`contract`), as C compilers do, but may not reorder sums:
one machine and one seed give the same bytes. Division by zero follows IEEE 754, as in NumPy.
"""

import hashlib
import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

import numba

_COMPILED_PACKAGES = ("analysis", "control", "dynamics", "ocean", "seawater", "simulation")
"""Where compiled functions and what they call live."""

_KEPT_CACHES = 8
"""Machine code of this many states of the source is kept: the newest."""


def _keep_machine_code() -> None:
    """Give every state of the source a cache folder of its own.

    Numba looks only at the file of the function it caches, not at what that function calls: after an edit, or an
    update, it would run old physics. A folder named by the hash of the sources cannot. It lies in the user's cache,
    so that a read-only installation works too; NUMBA_CACHE_DIR is respected.
    """
    if os.environ.get("NUMBA_CACHE_DIR"):
        return
    package = Path(__file__).parent
    digest = hashlib.sha256()
    sources = (source for name in _COMPILED_PACKAGES for source in (package / name).rglob("*.py"))
    for source in sorted(sources):
        digest.update(source.relative_to(package).as_posix().encode() + b"\0" + source.read_bytes())
    home = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "stommel"
    folder = home / digest.hexdigest()[:16]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        folder.touch()
        _forget_old(home)
    except OSError:
        folder = Path(tempfile.gettempdir()) / f"stommel-{os.getuid()}" / folder.name
        folder.mkdir(parents=True, exist_ok=True)
    numba.config.CACHE_DIR = str(folder)  # type: ignore[attr-defined]  # set from NUMBA_CACHE_DIR at run time


def _forget_old(home: Path) -> None:
    import shutil  # noqa: PLC0415 - seldom needed

    caches = sorted((entry for entry in home.iterdir() if entry.is_dir()), key=lambda entry: -entry.stat().st_mtime)
    for old in caches[_KEPT_CACHES:]:
        shutil.rmtree(old, ignore_errors=True)


_keep_machine_code()

_Arguments = ParamSpec("_Arguments")
_Result = TypeVar("_Result")


def compiled(function: Callable[_Arguments, _Result]) -> Callable[_Arguments, _Result]:
    """Compile `function` with Numba on its first call and keep the machine code on disk for later processes.

    The same source serves real and complex arguments: a complex step through it gives exact derivatives.
    """
    decorate: Any = numba.njit(cache=True, error_model="numpy", fastmath={"contract"})
    decorated: Callable[_Arguments, _Result] = decorate(function)
    return decorated


def inlined(function: Callable[_Arguments, _Result]) -> Callable[_Arguments, _Result]:
    """Compile a building block that only compiled code calls; it is kept within its callers, not on disk.

    Inlining is forced: left to itself the compiler makes calls of the larger blocks, passes their tuples through memory
    and repeats what they share (the rotation, the sine and cosine of the mass's roll), at half as much time again.
    """
    decorate: Any = numba.njit(error_model="numpy", fastmath={"contract"}, forceinline=True)
    decorated: Callable[_Arguments, _Result] = decorate(function)
    return decorated
