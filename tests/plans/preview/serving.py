"""What the process of a worker does in tests, in place of the simulator: functions of a module, for another process."""

import os
import time
from multiprocessing.connection import Connection
from typing import Any

from stommel.plans.preview.work import Progress, work
from stommel.plans.problems import PlanError, PlanProblem


def _echo(document: Any, progress: Progress) -> Any:
    progress(0.5)
    return {"echo": document}


def _slow(document: Any, progress: Progress) -> Any:
    for step in range(int(document)):
        time.sleep(0.01)
        progress(step / document)
    return "slept"


def _babble(document: Any, progress: Progress) -> Any:
    until = time.monotonic() + document
    while time.monotonic() < until:
        progress(0.5)
    return "spoke"


def _deaf(document: Any, progress: Progress) -> Any:
    del progress
    time.sleep(document)
    return "slept"


def _die(document: Any, progress: Progress) -> Any:
    del progress
    os._exit(int(document))


def _refuse(document: Any, progress: Progress) -> Any:
    del progress
    raise PlanError([PlanProblem("dives.depth_m", str(document), "too deep", "at most 200 m")])


def serve(channel: "Connection[Any, Any]") -> None:
    answers = {"echo": _echo, "fly": _slow, "deaf": _deaf, "die": _die, "refuse": _refuse, "babble": _babble}
    work(channel, answers | {"check": _echo})


def serve_nothing(channel: "Connection[Any, Any]") -> None:
    """Break before it can work."""
    channel.close()
    os._exit(3)
