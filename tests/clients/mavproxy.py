"""MAVProxy's console: lines in, words out."""

import re
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import TracebackType
from typing import Self

import pytest

PROGRAM = Path(sys.executable).with_name("mavproxy.py")
PATIENCE = 120.0
"""For an answer [s]."""


class MavProxy:
    """The program in a process of its own; its files go into a folder."""

    def __init__(self, port: int, folder: Path) -> None:
        if not PROGRAM.exists():
            pytest.skip(f"{PROGRAM} is not installed")
        options = [f"--master=tcp:127.0.0.1:{port}", "--state-basedir=.", "--logfile=mav.tlog"]
        self._process = subprocess.Popen(
            [sys.executable, str(PROGRAM), *options], cwd=folder, text=True, bufsize=1,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip
        self._heard: list[str] = []
        threading.Thread(target=self._listen, daemon=True).start()

    def _listen(self) -> None:
        stream = self._process.stdout
        assert stream is not None
        self._heard.extend(iter(lambda: stream.read(1), ""))

    @property
    def said(self) -> str:
        """All so far."""
        return "".join(self._heard)

    def wait_for(self, words: str, since: int = 0) -> str:
        """Return what was said from a place on, as soon as these words are in it."""
        end = time.monotonic() + PATIENCE
        while words not in self.said[since:]:
            assert time.monotonic() < end, f"{words!r} was not said: {self.said[since:][-3000:]}"
            time.sleep(0.05)
        return self.said[since:]

    def ask(self, line: str, words: str) -> str:
        """Say a line, and return what is said until these words are in it."""
        since = len(self.said)
        self.say(line)
        return self.wait_for(words, since)

    def say(self, line: str) -> None:
        """Say a line."""
        assert self._process.stdin is not None
        self._process.stdin.write(line + "\n")
        self._process.stdin.flush()

    def ask_again(self, line: str, pattern: str) -> re.Match[str]:
        """Say a line about once a second until its answer has a pattern, and return what was found."""
        end = time.monotonic() + PATIENCE
        while True:
            since = len(self.said)
            self.say(line)
            time.sleep(1.0)
            if found := re.search(pattern, self.said[since:]):
                return found
            assert time.monotonic() < end, f"{line}: {pattern!r} was not said: {self.said[since:][-3000:]}"

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._process.kill()
        self._process.communicate()
