"""Names of a log's files: run of the software, number in it, series, and whether it was sent ashore."""

import re
from typing import NamedTuple

from stommel.messages.log.layout import SERIES

_PATTERN = re.compile(rf"(\d{{5,}})-(\d{{6,}})-({'|'.join(SERIES)})(\.sent)?\.log")


class LogName(NamedTuple):
    """What the name of a file says; sorted, the oldest file is first."""

    run: int
    """Which start of the software."""
    number: int
    """Within it."""
    series: str
    """One of `SERIES`."""
    sent: bool
    """Whether it was sent ashore."""

    @property
    def text(self) -> str:
        """The name."""
        return f"{self.run:05d}-{self.number:06d}-{self.series}{'.sent' if self.sent else ''}.log"


def log_name(name: str) -> LogName | None:
    """Read a file's name; None if it is none of a log."""
    found = _PATTERN.fullmatch(name)
    return LogName(int(found[1]), int(found[2]), found[3], found[4] is not None) if found else None
