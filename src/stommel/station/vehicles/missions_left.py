"""Missions that were not over when the station stopped, be it in the middle of an upload: taken up again, or ended."""

import hashlib
from collections.abc import Sequence
from math import inf
from typing import NamedTuple

from stommel.control.orders_file import parse_orders
from stommel.errors import StommelError, one_line
from stommel.station.vehicles.mission_rows import FAILED, INTERRUPTED, SENDING, SUPERSEDED, MissionRow
from stommel.station.vehicles.mission_task import HAS_NOT, MAYBE, EndedTask, Task

NOT_KNOWN = "the station was started anew, and it is not known how long it is tried: send it again"
HELD_BEFORE = (
    "the station stopped while it was on its way, and the vehicle holds it as the mission before its present one: "
    "it may have been flown; look, and send it again"
)


class Left(NamedTuple):
    """What a station goes on with."""

    task: Task | None
    """The one mission that is tried further."""
    ended: Sequence[EndedTask]
    """What the archive does not know yet to be over."""


def taken_up(rows: Sequence[MissionRow], now: float) -> Left:
    """Go on with the newest of the missions that were waiting or on their way; the others stay replaced by it.

    Parameters
    ----------
    rows
        These missions, the newest first.
    now
        The time of the vehicle [s since 1970].
    """
    if not rows:
        return Left(None, ())
    tasks = [
        Task("upload", row.user, row, inf, inf if row.until is None else row.until, row.state == SENDING)
        for row in rows
    ]  # fmt: skip
    first, *others = tasks
    ended = [
        EndedTask(task, SUPERSEDED, f"{first.title} of {first.user} came in its place; {_truth(task)}", first.user, now)
        for task in others
    ]
    if rows[0].until is None:
        return Left(None, [*ended, EndedTask(first, INTERRUPTED, f"{NOT_KNOWN}; {_truth(first)}", None, now)])
    if wrong := _unreadable(rows[0]):
        return Left(None, [*ended, EndedTask(first, FAILED, f"not sent: {wrong}; {_truth(first)}", None, now)])
    return Left(first, ended)


def _truth(task: Task) -> str:
    return MAYBE if task.may_be_aboard else HAS_NOT


def _unreadable(row: MissionRow) -> str:
    """Why orders that were good when they were given are none any more; empty where they are."""
    if hashlib.sha256(row.orders.encode()).hexdigest() != row.sha256:
        return "its orders in the archive are other than those that were given: their SHA-256 is another"
    try:
        parse_orders(row.orders, "orders")
    except StommelError as error:
        return f"this station refuses its orders, which were good when they were given: {one_line(str(error), 200)}"
    return ""
