"""What the process of the simulator does: one request after the other, until its parent ends."""

import os
import signal
import threading
from collections.abc import Callable
from multiprocessing import connection, parent_process
from typing import Any

from stommel.errors import StommelError
from stommel.plans.problems import plan_from, problems_of

READY, SHARE, DONE, REFUSED, STOPPED = "ready", "share", "done", "refused", "stopped"
"""What the process says: it can work; how far it is; the answer; what is wrong with the plan; it was told to stop."""
CHECK, FLY, OPEN = "check", "fly", "open"
"""What it is asked for: the orders of a plan, its flight, or the plan of orders."""

_FIRST = {
    "name": "warm",
    "vehicle": "zju",
    "start": {"latitude_deg": 18.0, "longitude_deg": 115.0},
    "start_time": "2026-01-01T00:00:00Z",
    "duration_days": 0.01,
    "dives": {"depth_m": 50, "pitch_deg": 30, "ballast_ml": 150},
    "water": {"ocean": "south_china_sea"},
}
"""Flown before it says that it can work, so that the machine code is there."""
Progress = Callable[[float], None]
"""Is called with the share that is done."""
Answer = Callable[[Any, Progress], Any]
"""What a document is answered with."""


class _ToldToStopError(Exception):
    """The parent does not want the answer any more."""


def work(channel: "connection.Connection[Any, Any]", answers: dict[str, Answer] | None = None) -> None:
    """Answer requests (kind, document) from a channel; `answers` stand in for the simulator, in tests."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the parent's
    threading.Thread(target=_end_with_parent, daemon=True).start()
    known = _answers() if answers is None else answers
    channel.send((READY, None))
    while True:
        try:
            kind, document = channel.recv()
        except EOFError:
            return
        if kind in known:  # a late word to stop is none
            channel.send(_answer(channel, known[kind], document))


def _answer(channel: "connection.Connection[Any, Any]", answer: Answer, document: Any) -> tuple[str, Any]:
    def progress(share: float) -> None:
        if channel.poll():
            channel.recv()
            raise _ToldToStopError
        channel.send((SHARE, share))

    try:
        return DONE, answer(document, progress)
    except _ToldToStopError:
        return STOPPED, None
    except StommelError as error:
        return REFUSED, [problem.as_row() for problem in problems_of(error)]


def _answers() -> dict[str, Answer]:
    from stommel.plans.preview.flight import previewed  # noqa: PLC0415 - only this process pays for the simulator
    from stommel.plans.preview.opening import opened  # noqa: PLC0415
    from stommel.plans.preview.ordering import ordered  # noqa: PLC0415

    previewed(plan_from(_FIRST))
    return {
        CHECK: lambda document, _: ordered(plan_from(document)).as_row(),
        FLY: lambda document, progress: previewed(plan_from(document), progress),
        OPEN: lambda document, _: opened(document["orders"], document["around"]).as_row(),
    }


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        connection.wait([parent.sentinel])
        os._exit(1)
