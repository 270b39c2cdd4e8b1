"""Python as its users start it: a process of its own, in which warnings are errors."""

import subprocess
import sys
from pathlib import Path


def run_python(*arguments: object, folder: Path | None = None) -> str:
    """Standard output of `python` with these arguments, which must succeed."""
    done = subprocess.run(
        [sys.executable, "-W", "error", *map(str, arguments)],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout
