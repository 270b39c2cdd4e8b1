"""What a test expects of the page is asked until it is so: a browser on a busy machine is late, not wrong.

No test takes a pause for a proof. Where nothing may happen, the page has its own time for it: `passes`, `all_asked`.
"""

import time
from collections.abc import Callable
from typing import Any, TypeVar
from weakref import WeakKeyDictionary

T = TypeVar("T")
PATIENCE_S = 60.0
"""Longest that a test waits; it is only reached when something is wrong."""
QUIET_MS = 200
"""Of the page's own time: longer than it waits before it asks what follows from an answer."""
_traffic: WeakKeyDictionary[Any, "Traffic"] = WeakKeyDictionary()


class Traffic:
    """Requests of a page: how many there were, and which are under way."""

    def __init__(self, page: Any) -> None:
        self.asked, self.under_way = 0, set[Any]()
        page.on("request", self._begins)
        page.on("requestfinished", self._ends)
        page.on("requestfailed", self._ends)
        _traffic[page] = self

    def _begins(self, request: Any) -> None:
        self.asked += 1
        self.under_way.add(request)

    def _ends(self, request: Any) -> None:
        self.under_way.discard(request)


def until(page: Any, holds: Callable[[], object]) -> None:
    """Let the page go on until something holds."""
    ends = time.monotonic() + PATIENCE_S
    while not holds():
        assert time.monotonic() < ends, "it did not happen in time"
        page.wait_for_timeout(50)


def becomes(page: Any, read: Callable[[], T], wanted: object) -> T:
    """What is read of the page, once it is what is wanted; what it was in the end is told."""
    ends = time.monotonic() + PATIENCE_S
    while (found := read()) != wanted and time.monotonic() < ends:
        page.wait_for_timeout(50)
    assert found == wanted
    return found


def comes_to_rest(page: Any, read: Callable[[], T]) -> T:
    """What is read of the page, once it stays as it is."""
    ends, before = time.monotonic() + PATIENCE_S, read()
    while True:
        passes(page, QUIET_MS)
        found = read()
        if found == before:
            return found
        assert time.monotonic() < ends, f"it does not come to rest: {before}, then {found}"
        before = found


def at_rest(page: Any) -> None:
    """Wait until everything that a view asks for is there and drawn."""
    traffic, ends = _traffic[page], time.monotonic() + PATIENCE_S
    while True:
        before = traffic.asked
        passes(page, QUIET_MS)
        if before == traffic.asked and not traffic.under_way and not page.evaluate("window.heldBack ?? 0"):
            return
        assert time.monotonic() < ends, f"still under way: {[request.url for request in traffic.under_way]}"


def passes(page: Any, ms: float) -> None:
    """Let some of the page's own time pass, and let it draw: what it meant to do before that, it has done."""
    page.evaluate(
        "(ms) => new Promise((done) => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(done)), ms))",
        ms,
    )


def all_asked(page: Any) -> None:
    """Every request that the page has made until now is seen by the test when this returns."""
    page.evaluate("fetch('./api/station').then((answer) => answer.text()).then(() => undefined)")
