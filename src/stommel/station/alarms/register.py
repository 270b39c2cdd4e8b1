"""Which alarms are open; each is written once, and told whatever the archive does."""

import logging
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from threading import Lock

from sqlalchemy.exc import SQLAlchemyError

from stommel.archive.errors import ArchiveError
from stommel.archive.times import as_kept
from stommel.station.alarms.alarm import Alarm
from stommel.station.alarms.change import Change
from stommel.station.alarms.history import History

Tell = Callable[[Alarm], None]
MOST_WAITING = 10_000
"""Changes, and alarms that wait for the archive; beyond it the oldest is forgotten."""
_log = logging.getLogger(__name__)


@dataclass(eq=False)
class _Raising:
    alarm: Alarm
    is_waiting: bool = False
    """For the archive."""


class Register:
    """Turns changes into alarms, one row for each raising.

    Changes come from any thread, and nobody who brings one waits; `settle` writes and tells them.

    Parameters
    ----------
    history
        The alarms in the archive.
    tell
        Is told an alarm as it is now: raised, cleared, acknowledged, or kept at last.
    alert
        Is told once that an alarm was raised, and once that it was cleared.
    """

    def __init__(self, history: History, tell: Tell, alert: Tell) -> None:
        self._history, self._tell, self._alert = history, tell, alert
        self._lock = Lock()
        self._settling = Lock()
        self._changes: deque[tuple[int | None, Change]] = deque(maxlen=MOST_WAITING)
        self._waiting: deque[_Raising] = deque(maxlen=MOST_WAITING)
        self._open = {(alarm.vehicle, alarm.key): _Raising(alarm) for alarm in history.open_alarms()}

    def put(self, vehicle: int | None, changes: list[Change]) -> None:
        """Take changes of a vehicle, or of the station."""
        self._changes.extend((vehicle, change) for change in changes)

    def open_of(self, vehicle: int | None) -> list[Alarm]:
        """Open alarms of a vehicle, or of the station, the oldest first."""
        with self._lock:
            found = [raising.alarm for (of, _), raising in self._open.items() if of == vehicle]
        return sorted(found, key=lambda alarm: alarm.raised)

    def acknowledge(self, number: int, user: str, note: str, t: float) -> Alarm:
        """Write who has seen an alarm, and tell it.

        Raises
        ------
        AlarmError
            There is no such alarm, or somebody has acknowledged it.
        ArchiveError
            The archive does not take it.
        """
        with self._settling:
            alarm = self._history.acknowledge(number, user, note, t)
            with self._lock:
                raising = self._open.get((alarm.vehicle, alarm.key))
                if raising is not None and raising.alarm.id == number:
                    raising.alarm = alarm
        self._tell(alarm)
        return alarm

    def settle(self) -> str:
        """Write and tell what has changed; returns why the archive does not take it, or nothing."""
        with self._settling:
            changed = []
            while self._changes:
                raising = self._changed(*self._changes.popleft())
                changed += [raising] if raising is not None else []
            kept, reason = self._written()
        for raising in changed:
            self._tell(raising.alarm)
            self._alert(raising.alarm)
        for raising in kept:
            if raising not in changed:
                self._tell(raising.alarm)
        return reason

    def _changed(self, vehicle: int | None, change: Change) -> _Raising | None:
        """Open or close an alarm; None if it is so already."""
        place, t = (vehicle, change.key), as_kept(change.t)
        with self._lock:
            raising = self._open.get(place)
            if change.raised == (raising is not None):
                return None
            if raising is None:
                raising = self._open[place] = _Raising(
                    Alarm(None, vehicle, change.key, change.words, change.severity, t, change.value)
                )
            else:
                del self._open[place]
                raising.alarm = replace(raising.alarm, cleared=max(t, raising.alarm.raised))
        if not raising.is_waiting:
            raising.is_waiting = True
            self._waiting.append(raising)
        return raising

    def _written(self) -> tuple[list[_Raising], str]:
        kept: list[_Raising] = []
        while self._waiting:
            raising = self._waiting[0]
            try:
                number = raising.alarm.id
                if number is None:
                    number = self._history.add(raising.alarm)
                    with self._lock:
                        raising.alarm = replace(raising.alarm, id=number)
                if raising.alarm.cleared is not None:
                    self._history.clear(number, raising.alarm.cleared)
            except ArchiveError as error:
                return kept, str(error)
            except SQLAlchemyError:  # no later try would help: it must not keep the others waiting
                _log.exception("an alarm that the archive never takes: %s", raising.alarm)
            self._waiting.popleft()
            raising.is_waiting = False
            kept.append(raising)
        return kept, ""
