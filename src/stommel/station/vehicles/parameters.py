"""Parameters of vehicles as people see and set them, with their history."""

from collections.abc import Mapping, Sequence
from typing import Any

from stommel.archive import Archive
from stommel.errors import StommelError
from stommel.link.endings import Ending
from stommel.link.parameters.encoding import fitting
from stommel.link.parameters.known import KnownSet
from stommel.link.shore.shore_end import ShoreEnd
from stommel.station.live.events import Happening
from stommel.station.live.hub import Hub
from stommel.station.vehicles.asking import ask
from stommel.station.vehicles.line import VehicleLine
from stommel.station.vehicles.opening import MissingError
from stommel.station.vehicles.parameter_follower import MOST_WRITES, WITHIN, ParameterFollower
from stommel.station.vehicles.parameter_rows import ParameterRow, ParameterRows
from stommel.station.vehicles.parameter_writes import WAITING, Write, WriteRows

MOST_WAITING = 50
"""Writings of one vehicle that wait for it."""


class ParameterError(StommelError):
    """A parameter cannot be set."""


class Parameters:
    """Parameters of the vehicles of a station.

    Parameters
    ----------
    archive, hub
        Of the station.
    lines
        By vehicle; those that come later too.
    """

    def __init__(self, archive: Archive, hub: Hub, lines: Mapping[int, VehicleLine]) -> None:
        self._rows, self._writes = ParameterRows(archive), WriteRows(archive)
        self._hub, self._lines = hub, lines
        self._followers: dict[int, ParameterFollower] = {}

    def follow(self, line: VehicleLine) -> None:
        """Take in a vehicle, before its line is started."""
        left = self._writes.last(line.vehicle, MOST_WRITES)
        follower = self._followers[line.vehicle] = ParameterFollower(self._rows, self._writes, self._tell, left)
        line.followers.append(follower)

    def known(self, vehicle: int) -> dict[str, Any]:
        """All parameters as they were known when the line looked last, as the API tells them; waits for no line."""
        line, follower = self._lines[vehicle], self._followers[vehicle]
        client, latest = line.end.parameters, follower.latest or {}
        ended = {outcome.component: outcome for outcome in client.refreshed or ()}
        sets = dict(client.known.sets)  # each is replaced as a whole, in the line's thread
        return {
            "refreshing": follower.refreshing,
            "components": [
                {
                    "component": known.component, "name": known.name, "state": known.state.name.lower(),
                    "whole": known.component in ended and ended[known.component].ending is Ending.WHOLE,
                    "reason": ended[known.component].words if known.component in ended else "not asked for yet",
                    "parameters": _described(known, latest),
                }
                for _, known in sorted(sets.items())
            ],
            "missing": [
                {"component": outcome.component, "name": outcome.name, "reason": outcome.words}
                for outcome in ended.values()
                if outcome.component not in sets
            ],
            "notes": list(client.known.notes),
            "writes": [write.told() for write in list(follower.writes)[::-1]],
        }  # fmt: skip

    def refresh(self, vehicle: int) -> None:
        """Ask the vehicle for all; what has not changed costs one message."""
        follower = self._followers[vehicle]
        ask(self._lines[vehicle], lambda end, t: follower.refresh(end.parameters, t))

    def write(self, vehicle: int, user: str, component: int, name: str, value: float) -> Write:
        """Begin to set a parameter, once that is written down; what becomes of it is told as it happens.

        Raises
        ------
        MissingError
            It is not known that there is such a parameter.
        StommelError
            It cannot have the value, too many writings wait, or the archive takes nothing.
        """
        line, follower = self._lines[vehicle], self._followers[vehicle]

        def begin(end: ShoreEnd, t: float) -> Write:
            known = end.parameters.known.sets.get(component)
            number = None if known is None else known.number(name)
            if known is None or number is None:
                raise MissingError(
                    f"vehicle {vehicle} has told of no parameter {name} of component {component}; refresh them first"
                )
            fitting(known.descriptions[number], value)
            if sum(write.state == WAITING for write in follower.writes) >= MOST_WAITING:
                raise ParameterError(f"vehicle {vehicle}: {MOST_WAITING} writings wait for it; wait for some of them")
            write = Write(0, component, name, value, user, line.clock.of_link(t))
            self._writes.add(vehicle, write)
            write.ticket = end.parameters.write(component, name, value, WITHIN)
            follower.writes.append(write)
            return write

        return ask(line, begin)

    def open(self, vehicle: int) -> int:
        """How many writings wait for the vehicle."""
        return sum(write.state == WAITING for write in list(self._followers[vehicle].writes))

    def history(self, vehicle: int, component: int, name: str, limit: int) -> Sequence[ParameterRow]:
        """Values of a parameter, the newest first."""
        return self._rows.history(vehicle, component, name, limit)

    def _tell(self, vehicle: int, told: dict[str, Any]) -> None:
        self._hub.publish(Happening("parameter", vehicle, told))


def _described(known: KnownSet, latest: Mapping[tuple[int, str], ParameterRow]) -> list[dict[str, Any]]:
    found = []
    for described, value in zip(known.descriptions, known.values, strict=True):
        row = latest.get((known.component, described.id))
        found.append({
            "name": described.id, "kind": described.kind.name.lower(), "value": value, "default": described.default,
            "low": described.low, "high": described.high, "unit": described.unit, "words": described.words,
            "since": None if row is None else row.t, "user": None if row is None else row.user,
        })  # fmt: skip
    return found
