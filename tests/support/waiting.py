"""Waiting for what a test expects: a busy machine is late, not wrong."""

import time
from collections.abc import Callable

WITHIN = 60.0
"""Longest that a test waits [s]; it is only reached when something is wrong."""


def until(done: Callable[[], object], within: float = WITHIN) -> None:
    """Wait until something is so."""
    ends = time.monotonic() + within
    while not done():
        assert time.monotonic() < ends, "waited in vain"
        time.sleep(0.01)
