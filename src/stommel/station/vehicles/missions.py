"""Missions as people give them: kept with who and hash, sent whole, and compared with what the vehicle holds."""

import hashlib
from collections.abc import Mapping, Sequence
from math import degrees
from typing import Any

from stommel.archive import Archive
from stommel.control.orders_file import parse_orders
from stommel.errors import StommelError
from stommel.plans.flown import geofence_of
from stommel.station.live.events import Happening
from stommel.station.live.hub import Hub
from stommel.station.vehicles.asking import ask
from stommel.station.vehicles.line import VehicleLine
from stommel.station.vehicles.mission_follower import MissionFollower
from stommel.station.vehicles.mission_rows import FAILED, OPEN, WAITING, MissionRow, MissionRows, MissionState
from stommel.station.vehicles.mission_task import Task
from stommel.station.vehicles.missions_left import taken_up
from stommel.station.vehicles.opening import MissingError, VehicleError, vehicle_folder


class MissionError(VehicleError):
    """A mission cannot be given, or taken back, now."""


class Missions:
    """Missions of the vehicles of a station.

    Parameters
    ----------
    archive, hub
        Of the station.
    lines
        By vehicle; those that come later too.
    """

    def __init__(self, archive: Archive, hub: Hub, lines: Mapping[int, VehicleLine]) -> None:
        self._rows, self._hub, self._lines = MissionRows(archive), hub, lines
        self._followers: dict[int, MissionFollower] = {}

    def follow(self, line: VehicleLine) -> None:
        """Take in a vehicle, before its line is started."""
        folder = vehicle_folder(line.folder, line.vehicle) / "orders"
        left = taken_up(self._rows.in_states(line.vehicle, *OPEN), line.clock.now())
        follower = self._followers[line.vehicle] = MissionFollower(self._rows, folder, self._tell, left)
        line.followers.append(follower)

    def upload(
        self,
        vehicle: int,
        user: str,
        orders: str,
        *,
        plan: Mapping[str, Any] | None = None,
        preview: Mapping[str, Any] | None = None,
        valid_for_s: float,
    ) -> MissionRow:
        """Give orders to a vehicle: written down, then sent; it takes them whole, or keeps those that it has.

        They come in place of every request before them that is not over.

        Raises
        ------
        FileError
            The text is no orders file.
        VehicleError
            The line is busy; the mission is kept as failed.
        ArchiveError
            It cannot be written; nothing was given.
        """
        _, header = parse_orders(orders, "orders")
        line, follower = self._lines[vehicle], self._followers[vehicle]
        sha256 = hashlib.sha256(orders.encode()).hexdigest()
        row = MissionRow(0, vehicle, line.clock.now(), user, header.mission, sha256, orders, plan, WAITING)
        try:
            task = ask(line, lambda _end, t: follower.put(line, Task("upload", user, row, valid_for_s), t, preview))
        except VehicleError as error:
            self._rows.add(row._replace(state=FAILED), f"not sent: {error}", preview)
            raise
        assert task.row is not None
        return task.row

    def roll_back(self, vehicle: int, user: str, valid_for_s: float) -> None:
        """Let the vehicle hold the orders before its present ones.

        Raises
        ------
        MissionError
            It holds none, or nobody knows yet.
        ArchiveError
            It cannot be written that others are replaced by this; they go on.
        """
        line, follower = self._lines[vehicle], self._followers[vehicle]
        if follower.held is None:
            raise MissionError(f"vehicle {vehicle}: it is not known what it holds: {follower.words}")
        if not follower.held.previous:
            raise MissionError(f"vehicle {vehicle}: it holds no orders before the present ones")
        ask(line, lambda _end, t: follower.put(line, Task("roll-back", user, None, valid_for_s), t))
        self._tell(vehicle, None)

    def take_back(self, vehicle: int, id: int, user: str) -> MissionRow:
        """Take back a mission that the vehicle does not have yet.

        Raises
        ------
        MissingError
            There is no such mission.
        MissionError
            It is over: the vehicle has it, or it has ended another way.
        """
        self.find(vehicle, id)
        line, follower = self._lines[vehicle], self._followers[vehicle]
        wanted = lambda task: task.row is not None and task.row.id == id  # noqa: E731
        is_done = ask(line, lambda _end, _t: follower.take_back(line, wanted, user))
        row, history = self.find(vehicle, id)
        if not is_done:
            words = f"{row.state}: {history[-1].words}" if history else row.state
            raise MissionError(f"mission {id} cannot be taken back any more; it is {words}")
        return row

    def take_back_roll_back(self, vehicle: int, user: str) -> None:
        """Take back the request to hold the orders before again.

        Raises
        ------
        MissionError
            None waits.
        """
        line, follower = self._lines[vehicle], self._followers[vehicle]
        if not ask(line, lambda _end, _t: follower.take_back(line, lambda task: task.kind == "roll-back", user)):
            raise MissionError(f"vehicle {vehicle}: no return to the mission before waits")

    def open(self, vehicle: int) -> int:
        """How many requests of people are not over."""
        return len(self._followers[vehicle].open)

    def aboard(self, vehicle: int) -> dict[str, Any]:
        """Which mission the vehicle holds, and what is on its way, as the API tells it; waits for no line."""
        follower = self._followers[vehicle]
        task, progress = follower.underway
        upload = next((each for each in follower.open if each.row is not None), None)
        rolls = next((each for each in follower.open if each.row is None), None)
        held, missing = follower.held, follower.words or None
        row = None if held is None or not held.sha256 else self._rows.of_hash(vehicle, held.sha256.hex())
        if held is not None and not held.sha256:
            missing = "the vehicle holds no mission"
        elif held is not None and row is None:
            missing = missing or "its orders are being fetched"
        flown = {"waypoints": [], "geofence": [], "depth_m": None} if row is None else _flown(row)
        return {
            "number": None if held is None else held.number, "name": None if held is None else held.name or None,
            "sha256": None if held is None else held.sha256.hex(),
            "previous_sha256": None if held is None else held.previous.hex(),
            "t": None if held is None else follower.held_at,
            "missing": missing, "waiting": follower.waiting,
            "upload": None if upload is None or upload.row is None else self.told(upload.row) | {
                "progress": progress._asdict() if progress is not None and task is upload else None
            },
            "roll_back": None if rolls is None else {"user": rolls.user, "expires": self._expires(vehicle, rolls)},
            "mission": None if row is None else self.told(row), **flown,
        }  # fmt: skip

    def held_at(self, vehicle: int, t: float) -> dict[str, Any]:
        """Which mission the vehicle held at a time [s since 1970], as the API tells it."""
        row = self._rows.held_at(vehicle, t)
        flown = {"waypoints": [], "geofence": [], "depth_m": None} if row is None else _flown(row)
        return {
            "number": None, "name": None if row is None else row.name, "sha256": None if row is None else row.sha256,
            "previous_sha256": None, "t": t, "waiting": 0, "upload": None, "roll_back": None,
            "missing": "it is not known which mission the vehicle held then" if row is None else None,
            "mission": None if row is None else self.told(row), **flown,
        }  # fmt: skip

    def list(self, vehicle: int, limit: int) -> Sequence[MissionRow]:
        """The last missions of a vehicle, the newest first."""
        return self._rows.page(vehicle, limit)

    def find(self, vehicle: int, id: int) -> tuple[MissionRow, Sequence[MissionState]]:
        """A mission, and what became of it.

        Raises
        ------
        MissingError
            There is no such mission.
        """
        row = self._rows.find(vehicle, id)
        if row is None:
            raise MissingError(f"vehicle {vehicle} has no mission {id}")
        return row, self._rows.history(id)

    def told(self, row: MissionRow) -> dict[str, Any]:
        """A mission as lists of the API tell it."""
        history = self._rows.history(row.id)
        found = row._asdict() | {"words": history[-1].words if history else ""}
        if history:
            found["state"] = history[-1].state
        del found["orders"], found["plan"], found["until"]
        follower = self._followers.get(row.vehicle)
        mine = [each for each in (() if follower is None else follower.open) if each.row and each.row.id == row.id]
        is_open = mine and found["state"] in OPEN
        return found | {"expires": self._expires(row.vehicle, mine[0]) if is_open else None}

    def _expires(self, vehicle: int, task: Task) -> float:
        return self._lines[vehicle].clock.of_link(task.until)

    def _tell(self, vehicle: int, id: int | None) -> None:
        row = None if id is None else self._rows.find(vehicle, id)
        data = {"aboard": True} if row is None else self.told(row)
        self._hub.publish(Happening("mission", vehicle, data))


def _flown(row: MissionRow) -> dict[str, Any]:
    """What of a mission a map shows."""
    fence = [{"latitude": one.latitude_deg, "longitude": one.longitude_deg} for one in geofence_of(row.plan)]
    try:
        orders, _ = parse_orders(row.orders, "orders")
    except StommelError as error:
        missing = f"its orders cannot be read here: {error}"[:300]
        return {"waypoints": [], "geofence": fence, "depth_m": None, "missing": missing}
    places = [
        {
            "latitude": degrees(float(latitude)), "longitude": degrees(float(longitude)),
            "radius_m": float(orders.radius),
        }
        for latitude, longitude in orders.waypoints
    ]  # fmt: skip
    return {"waypoints": places, "geofence": fence, "depth_m": float(orders.dives.depth)}
