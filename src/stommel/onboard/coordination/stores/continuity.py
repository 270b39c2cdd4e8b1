"""What must outlive a restart of the software: a few numbers in two copies, of which the newer sound one counts."""

import json
import math
from typing import NamedTuple

from stommel.files.sealing import sealed, unsealed
from stommel.files.storage import Storage, replace_whole

_COPIES = ("continuity-a", "continuity-b")
_MOST_BYTES = 1 << 16
_MOST_RESTARTS = 1 << 31


class Continuity(NamedTuple):
    """Where the software was when it last wrote."""

    starts: int = 0
    """How often it has started."""
    started: bool = False
    """Whether the operator has started the mission."""
    standing: tuple[str, ...] = ()
    """Alarms that a restart does not clear (`stommel.onboard.coordination.safety.standing_alarms`)."""
    mission: int = 0
    """Number of the mission that the rest is about."""
    waypoint: int = 0
    """That is sought; the first is 0."""
    energy_used: float = 0.0
    """Out of the battery since the mission began [J]."""


class ContinuityStore:
    """Keeps it; each write takes the older copy's place, so that a loss of power leaves one sound."""

    def __init__(self, storage: Storage) -> None:
        self._storage = storage
        self.notes: list[str] = []
        """What was found damaged, in words."""
        self._serial = -1
        self.kept = Continuity()
        """What was kept last."""
        self.written = True
        """Whether the disk took it."""
        for name in _COPIES:
            self._open(name)

    def _open(self, name: str) -> None:
        try:
            serial, kept = _copy_of(self._storage.read(name)[:_MOST_BYTES])
        except FileNotFoundError:
            return
        except (OSError, ValueError, KeyError, TypeError) as error:
            self.notes.append(f"{name} is not used: {error}")
            return
        if serial > self._serial:
            self._serial, self.kept = serial, kept

    def keep(self, continuity: Continuity) -> None:
        """Keep it, if it differs from what was kept; a disk that takes nothing leaves the last standing."""
        if continuity == self.kept and self.written:
            return
        serial = self._serial + 1
        told = json.dumps(continuity._asdict() | {"serial": serial})
        name = _COPIES[serial % 2]
        try:
            replace_whole(self._storage, name, sealed(told), f"{name}.part")
        except OSError:
            self.written = False
            return
        self._serial, self.kept, self.written = serial, continuity, True


def _copy_of(content: bytes) -> tuple[int, Continuity]:
    """Serial number and content of a copy; a ValueError where it is damaged."""
    told = unsealed(content)
    if told is None:
        raise ValueError("its SHA-256 is another")
    found = json.loads(told)
    return int(found["serial"]), _sound(found)


def _sound(found: dict[str, object]) -> Continuity:
    """Numbers of a copy within their ranges; a ValueError where one is not."""
    standing = found["standing"]
    if not isinstance(standing, list) or not all(isinstance(name, str) for name in standing):
        raise ValueError("standing: must be a list of names")
    energy = found["energy_used"]
    if not isinstance(energy, int | float) or not math.isfinite(energy) or energy < 0.0:
        raise ValueError("energy_used: must be a number from 0 on")
    whole = []
    for name in ("starts", "mission", "waypoint"):
        value = found[name]
        if not isinstance(value, int) or not 0 <= value < _MOST_RESTARTS:
            raise ValueError(f"{name}: must be a whole number from 0 on")
        whole.append(value)
    starts, mission, waypoint = whole
    return Continuity(starts, bool(found["started"]), tuple(standing), mission, waypoint, float(energy))
