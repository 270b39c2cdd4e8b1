"""Missions that come over the radio, and the store that keeps them."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from math import degrees, isclose, radians
from typing import Protocol

import numpy as np

from stommel.control.orders import Orders
from stommel.control.orders_file import orders_text
from stommel.errors import FileError, StommelError
from stommel.link.missions.port import HeldOrders, Waypoint, WaypointPlan, WaypointProgress, WaypointRefusal
from stommel.onboard.coordination.stores.missions import MissionStore, MissionStoreError

_E7 = 1e7
_SINGLE = 1e-6
"""Share by which a number may be off that came as 32 bits."""


class FlownMission(Protocol):
    """What the coordinator says of the mission that it flies, and what it is told."""

    def progress(self) -> WaypointProgress:
        """How far the vehicle has come."""

    def aim_at(self, number: int) -> str:
        """Aim at a waypoint; why not, in words, or nothing."""

    def why_not_now(self) -> str:
        """Why no other mission may be taken now, in words, or nothing."""


class MissionRefusedError(StommelError):
    """No other mission is taken now."""


class MissionPort:
    """Both ways to a mission: whole orders files, and waypoints for the orders that are held.

    Waypoints alone are no orders. They are put into those that are held, and what comes of it is received, checked and
    switched over as any orders file; a vehicle that holds none refuses them.

    Parameters
    ----------
    store
        Opens the vehicle's missions, when they are first asked for.
    flown
        What is done with them.
    """

    def __init__(self, store: Callable[[], MissionStore], flown: FlownMission) -> None:
        self._open_store, self._flown = store, flown
        self.opened: MissionStore | None = None
        """The store, once anybody has asked for missions."""

    @property
    def _store(self) -> MissionStore:
        if self.opened is None:
            self.opened = self._open_store()
        return self.opened

    # whole orders files

    def held(self) -> HeldOrders:
        """Which orders are held."""
        active, previous = self._store.active, self._store.previous
        if active is None:
            return HeldOrders(0, "", b"", b"")
        before = b"" if previous is None else bytes.fromhex(previous.sha256)
        return HeldOrders(active.number, active.header.mission, bytes.fromhex(active.sha256), before)

    def announce(self, size: int, sha256: bytes) -> None:
        """Begin to receive a file; the same one again goes on where it was."""
        self._store.announce(size, sha256.hex())

    def announced(self) -> bytes:
        """SHA-256 of the file that is being received, also after a restart; empty for none."""
        announced = self._store.announced
        return b"" if announced is None else bytes.fromhex(announced[1])

    def take_piece(self, offset: int, piece: bytes) -> None:
        """Take some bytes of the file that is being received."""
        self._store.take(offset, piece)

    def missing(self) -> Sequence[tuple[int, int]]:
        """First byte and the one behind the last of every gap of the file that is being received."""
        return self._store.missing

    def check(self) -> None:
        """Hold the file that was received against the vehicle."""
        self._store.check()

    def switch(self) -> None:
        """Hold the file that was received, after the same check."""
        self._allow()
        self._store.switch()

    def roll_back(self) -> None:
        """Hold the orders before again."""
        self._allow()
        self._store.roll_back()

    def _allow(self) -> None:
        words = self._flown.why_not_now()
        if words:
            raise MissionRefusedError(f"mission: {words}")

    # as commands ask for it

    def fly_uploaded(self, number: int) -> str:
        """Hold the file that was received, if it has this number or the number is 0; words on what is held now.

        Raises
        ------
        StommelError
            It is another, or it cannot be held.
        """
        found = self._store.check().number
        if number not in (0, found):
            raise MissionRefusedError(f"mission {number}: the one that was uploaded is number {found}")
        self.switch()
        return self._words()

    def fly_previous(self) -> str:
        """Hold the orders before again; words on what is held now.

        Raises
        ------
        StommelError
            There are none, or they cannot be held.
        """
        self.roll_back()
        return self._words()

    def _words(self) -> str:
        held = self.held()
        return f"mission {held.number}: {held.name}"

    def texts(self) -> Mapping[str, bytes]:
        """Orders files that are held and can be read, by what a shore sees them under."""
        store, texts = self._store, {}
        for name, mission in (("active.orders", store.active), ("previous.orders", store.previous)):
            if mission is not None:
                with suppress(MissionStoreError):  # damaged: for the shore it is not there
                    texts[name] = store.text(mission)
        return texts

    # waypoints

    def plan(self) -> WaypointPlan | None:
        """What is held, with depth and radius; None for no mission."""
        active = self._store.active
        if active is None:
            return None
        orders = active.orders
        waypoints = tuple(Waypoint(_whole(latitude), _whole(longitude)) for latitude, longitude in orders.waypoints)
        return WaypointPlan(waypoints, float(orders.dives.depth), float(orders.radius))

    def take_plan(self, plan: WaypointPlan) -> Sequence[WaypointRefusal]:
        """Make orders of a plan and switch over to them as one; reasons why not, and then nothing has changed."""
        active = self._store.active
        if active is None:
            words = "the vehicle holds no orders that waypoints could be put into: send an orders file"
            return [WaypointRefusal(words)]
        try:
            self._allow()
            text = orders_text(with_waypoints(active.orders, plan), active.header, "mission").encode()
            self._store.take_whole(text)
        except FileError as error:
            return [WaypointRefusal(str(problem)) for problem in error.problems]
        except StommelError as error:
            return [WaypointRefusal(str(error))]
        return []

    def progress(self) -> WaypointProgress:
        """How far the vehicle has come."""
        return self._flown.progress()

    def aim_at(self, number: int) -> str:
        """Aim at a waypoint; why not, in words, or nothing."""
        plan = self.plan()
        count = 0 if plan is None else len(plan.waypoints)
        if not count:
            return f"waypoint {number}: the vehicle holds no waypoints"
        if not 0 <= number < count:
            return f"waypoint {number}: must be between 0 and {count - 1}"
        return self._flown.aim_at(number)


def with_waypoints(orders: Orders, plan: WaypointPlan) -> Orders:
    """Orders with the waypoints of a plan, and with its depth and radius where it has them.

    Raises
    ------
    MissionRefusedError
        The orders hang in the water at the depth that they were made for, and the plan has another.
    """
    dives = orders.dives
    if plan.depth is not None and not isclose(plan.depth, dives.depth, rel_tol=_SINGLE):
        if dives.drift_time > 0.0:
            words = (
                f"depth = {plan.depth:g} m: must be {dives.depth:g} m, in which the orders aboard let the vehicle drift"
            )
            raise MissionRefusedError(words)
        dives = dives._replace(depth=plan.depth)
    places = [(radians(each.latitude / _E7), radians(each.longitude / _E7)) for each in plan.waypoints]
    radius = orders.radius
    if plan.radius is not None and not isclose(plan.radius, radius, rel_tol=_SINGLE):
        radius = plan.radius
    return orders._replace(
        waypoints=np.array(places, dtype=float).reshape(-1, 2),
        dives=dives,
        radius=radius,
    )


def _whole(angle: float) -> int:
    """An angle [rad] in 1e-7 deg, longitudes beyond 180 deg as the west that they are."""
    whole = round(degrees(float(angle)) * _E7)
    return whole - round(360 * _E7) if whole > round(180 * _E7) else whole
