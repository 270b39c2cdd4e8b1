"""The missions of a vehicle: received whole, held against the vehicle, switched over as one, the one before kept.

A mission is one file with its own hash, under a number that rises; it comes into being under its name by one rename.
The highest number that is sound and fits the vehicle is the mission; there is nothing else that could contradict it.
So after a loss of power at any point the vehicle holds the old mission or the new one, and a mission that the disk has
damaged gives way to the one before it.
"""

import hashlib
import json
import re
from contextlib import suppress
from typing import NamedTuple

from stommel.control.orders import Orders
from stommel.control.orders_file import OrdersHeader, parse_orders
from stommel.control.vehicle_limits import VehicleLimits, refusals
from stommel.errors import FileError, Problem, StommelError
from stommel.files.sealing import sealed, unsealed
from stommel.files.storage import Storage, replace_whole
from stommel.onboard.coordination.stores.reception_store import ReceptionStore

_NAME = re.compile(r"mission-(\d{6,})\.orders")
_PART = "mission.part"
_STARTED = "started"


class MissionStoreError(StommelError):
    """The disk does not keep a mission, or there is none to go back to; the mission stays as it was."""


class StoredMission(NamedTuple):
    """A mission that the vehicle holds."""

    number: int
    """Higher than that of every mission before."""
    sha256: str
    """Of the text of its orders."""
    orders: Orders
    header: OrdersHeader


class MissionStore:
    """The mission that is flown, the one before it, and one that is being received."""

    def __init__(self, storage: Storage, limits: VehicleLimits) -> None:
        self._storage = storage
        self._limits = limits
        self._highest = 0
        self.notes: list[str] = []
        """What was found damaged or unfit when the store was opened, in words."""
        self.active: StoredMission | None = None
        """The mission that the vehicle holds; None before it was given any."""
        self.previous: StoredMission | None = None
        """The one before, to roll back to."""
        self.started: float | None = None
        """When the active one was started [s], by the clock that told."""
        self.start_is_kept = True
        """Whether the disk has that; while not, `start` tries again, with the time that it was given first."""
        self._open()
        self._reception = ReceptionStore(storage)
        self._discard_what_was_switched()

    # what is there

    def _open(self) -> None:
        """Find the two newest missions that are sound."""
        try:
            names = self._storage.sizes()
        except OSError as error:
            self.notes.append(f"missions cannot be read: {error.strerror or error}")
            return
        numbers = sorted((int(found[1]) for name in names if (found := _NAME.fullmatch(name))), reverse=True)
        self._highest = max(numbers, default=0)
        sound: list[StoredMission] = []
        for number in numbers:
            try:
                sound.append(self._read(number))
            except (StommelError, OSError) as error:
                reason = error.strerror or str(error) if isinstance(error, OSError) else str(error).splitlines()[0]
                self.notes.append(f"mission {number} is not used: {reason}")
            if len(sound) == 2:
                break
        self.active, self.previous = (*sound, None, None)[:2]
        if self.active is not None and self.active.number != self._highest:
            self.notes.append(f"mission {self.active.number}, {self.active.header.mission}, is flown in its place")
        self.started = self._read_started()

    def _discard_what_was_switched(self) -> None:
        """Forget a reception whose mission is flown: the power went between the two."""
        arriving = self._reception.reception
        if arriving is not None and self.active is not None and arriving.sha256 == self.active.sha256:
            self._reception.discard()

    def _read(self, number: int) -> StoredMission:
        name = _name(number)
        head, _, text = self._storage.read(name).partition(b"\n")
        sha256 = hashlib.sha256(text).hexdigest()
        if head != _head(sha256):
            raise FileError([Problem(name, "", "is damaged: its SHA-256 is another")])
        return self._checked(number, text, name)

    def _checked(self, number: int, text: bytes, origin: str) -> StoredMission:
        """The mission of a text, held against the vehicle."""
        try:
            plain = text.decode("utf-8")
        except UnicodeDecodeError:
            raise FileError([Problem(origin, "", "is not UTF-8 text")]) from None
        orders, header = parse_orders(plain, origin)
        problems = refusals(orders, header, self._limits, origin)
        if problems:
            raise FileError(problems)
        return StoredMission(number, hashlib.sha256(text).hexdigest(), orders, header)

    # a mission arrives

    def announce(self, size: int, sha256: str) -> None:
        """Begin to receive a mission of so many bytes; the same one again goes on where it was, after a restart too.

        Raises
        ------
        ReceptionError
            No mission can have this size or hash.
        """
        self._reception.announce(size, sha256)

    def take(self, offset: int, piece: bytes) -> None:
        """Take a piece of the mission that was announced.

        Raises
        ------
        ReceptionError
            None was announced, or the piece lies outside of it.
        """
        self._reception.take(offset, piece)

    @property
    def missing(self) -> list[tuple[int, int]]:
        """First byte and the one behind the last of every gap of the mission that is received."""
        arriving = self._reception.reception
        return [] if arriving is None else arriving.missing

    @property
    def announced(self) -> tuple[int, str] | None:
        """Bytes and SHA-256 of the mission that is received, also after a restart; None if none is."""
        arriving = self._reception.reception
        return None if arriving is None else (arriving.size, arriving.sha256)

    def check(self) -> StoredMission:
        """The mission that was received, held against the vehicle; it is not flown yet.

        Raises
        ------
        ReceptionError
            It is not whole.
        FileError
            It is no mission, or the vehicle cannot fly it: a problem for each limit that it breaks.
        """
        return self._checked(self._highest + 1, self._reception.whole(), "mission")

    def switch(self) -> StoredMission:
        """Take the mission that was received in place of the one that is held, which becomes the previous one.

        Raises
        ------
        ReceptionError, FileError
            As `check`; nothing has changed.
        MissionStoreError
            The disk does not keep it; nothing has changed.
        """
        mission = self.check()
        self._keep(mission, self._reception.whole())
        self._reception.discard()
        return mission

    def take_whole(self, text: bytes) -> StoredMission:
        """Take a mission that is there as a whole, in place of the one that is held.

        Raises
        ------
        ReceptionError, FileError, MissionStoreError
            As `announce` and `switch`; nothing has changed.
        """
        self.announce(len(text), hashlib.sha256(text).hexdigest())
        self.take(0, text)
        return self.switch()

    def roll_back(self) -> StoredMission:
        """Take the previous mission again; the one that is held becomes the previous one.

        Raises
        ------
        MissionStoreError
            There is none, or the disk does not keep it; nothing has changed.
        """
        if self.previous is None:
            raise MissionStoreError("mission: there is no previous one to roll back to")
        text = self.text(self.previous)
        mission = self.previous._replace(number=self._highest + 1)
        self._keep(mission, text)
        return mission

    def text(self, mission: StoredMission) -> bytes:
        """Orders file of a mission that is held, as it came.

        Raises
        ------
        MissionStoreError
            The disk has it no more, or has damaged it.
        """
        try:
            text = self._storage.read(_name(mission.number)).partition(b"\n")[2]
        except OSError as error:
            raise MissionStoreError(f"mission: cannot be read: {error.strerror or error}") from error
        if hashlib.sha256(text).hexdigest() != mission.sha256:
            raise MissionStoreError(f"mission {mission.number}: is damaged: its SHA-256 is another")
        return text

    def _keep(self, mission: StoredMission, text: bytes) -> None:
        try:
            content = _head(mission.sha256) + b"\n" + text
            replace_whole(self._storage, _name(mission.number), content, _PART)
        except OSError as error:
            raise MissionStoreError(f"mission: cannot be kept: {error.strerror or error}") from error
        self._highest = mission.number
        self.active, self.previous, self.started, self.start_is_kept = mission, self.active, None, True
        kept = {self.active.number, self.previous.number if self.previous else 0}
        # what is left over is only untidy
        with suppress(OSError):
            for name in self._storage.sizes():
                found = _NAME.fullmatch(name)
                if found and int(found[1]) not in kept:
                    self._storage.remove(name)

    # its time

    def start(self, now: float) -> None:
        """Start the mission, once: its time counts from here, also after a restart of the software.

        Raises
        ------
        MissionStoreError
            There is no mission, or the disk does not keep it: it counts until the software is restarted.
        """
        if self.active is None:
            raise MissionStoreError("mission: there is none to start")
        if self.started is not None and self.start_is_kept:
            return
        self.started = now if self.started is None else self.started
        self.start_is_kept = False
        told = json.dumps({"number": self.active.number, "started": self.started})
        try:
            replace_whole(self._storage, _STARTED, sealed(told), _PART)
        except OSError as error:
            raise MissionStoreError(f"mission: its start cannot be kept: {error.strerror or error}") from error
        self.start_is_kept = True

    def _read_started(self) -> float | None:
        """When the active mission was started; None if it was not, or if nobody can tell any more."""
        if self.active is None:
            return None
        try:
            told = unsealed(self._storage.read(_STARTED))
        except FileNotFoundError:
            return None
        except OSError as error:
            self.notes.append(f"the start of the mission cannot be read: {error.strerror or error}")
            return None
        if told is None:
            self.notes.append("the start of the mission is damaged: it counts as not started")
            return None
        found = json.loads(told)
        return float(found["started"]) if found["number"] == self.active.number else None

    @property
    def expires(self) -> float | None:
        """When the mission expires [s], by the clock of `start`; None: it is not started, or never does."""
        if self.active is None or self.started is None or self.active.header.expires_hours is None:
            return None
        return self.started + self.active.header.expires_hours * 3600.0

    def expired(self, now: float) -> bool:
        """Whether the mission has expired."""
        expires = self.expires
        return expires is not None and now >= expires


def _name(number: int) -> str:
    return f"mission-{number:06d}.orders"


def _head(sha256: str) -> bytes:
    """First line of a stored mission."""
    return f"stommel mission 1 sha256={sha256}".encode()
