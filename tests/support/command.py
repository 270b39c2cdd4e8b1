"""The command `stommel`: within the process of the tests, which is quick, or as the process that its users start."""

import json
import subprocess
import sys
from collections.abc import Callable
from contextlib import chdir, redirect_stderr, redirect_stdout
from dataclasses import dataclass
from io import BytesIO, TextIOWrapper
from pathlib import Path
from typing import Any
from unittest.mock import patch

from stommel.cli import main

PROGRAM = Path(sys.executable).with_name("stommel")
"""The installed command."""


@dataclass(frozen=True)
class Outcome:
    """Exit status, standard output and standard error of one call."""

    status: int
    out: str
    err: str

    @property
    def json(self) -> Any:
        return json.loads(self.out)


Command = Callable[..., Outcome]
"""Takes the arguments behind `stommel`."""


def run_here(folder: Path, *arguments: object) -> Outcome:
    """Call the entry point of the command, as if started in `folder`. Warnings are errors here, as in every test."""
    out, err = Captured(), Captured()
    status: Any = None
    # a program, not a module of the package that runs the tests
    program = patch.object(sys.modules["__main__"], "__package__", "", create=True)
    command_line = patch.object(sys, "argv", ["stommel", *map(str, arguments)])
    with program, command_line, chdir(folder), redirect_stdout(out), redirect_stderr(err):
        try:
            main()
        except SystemExit as end:
            status = end.code
    return _sound(Outcome(status, out.text(), err.text()))


def run_process(folder: Path, *arguments: object) -> Outcome:
    """Run the installed command in `folder`."""
    done = subprocess.run(
        [PROGRAM, *map(str, arguments)], cwd=folder, capture_output=True, text=True, check=False, timeout=300
    )
    return _sound(Outcome(done.returncode, done.stdout, done.stderr))


class Captured(TextIOWrapper):
    """A stream that encodes what is written, as standard output does, and keeps it."""

    def __init__(self) -> None:
        self._bytes = BytesIO()
        super().__init__(self._bytes, encoding="utf-8", write_through=True)

    def text(self) -> str:
        self.flush()
        return self._bytes.getvalue().decode("utf-8")


def _sound(found: Outcome) -> Outcome:
    assert "Traceback" not in found.err
    assert "this is a defect" not in found.err, found.err
    return found
