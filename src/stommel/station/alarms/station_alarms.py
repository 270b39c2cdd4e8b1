"""The alarms of a station: what every vehicle brings is watched, kept and told."""

import logging
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from threading import Event, Lock, Thread
from typing import Any, NamedTuple

from stommel.archive.archive import Archive
from stommel.archive.times import as_kept
from stommel.station.alarms.alarm import Alarm
from stommel.station.alarms.alert_settings import AlarmSettings, AlertSettings
from stommel.station.alarms.alert_words import Sender
from stommel.station.alarms.alerts import Alerts
from stommel.station.alarms.change import Change
from stommel.station.alarms.contact_watch import Contact
from stommel.station.alarms.history import History
from stommel.station.alarms.limit_table import LimitTable
from stommel.station.alarms.limit_watch import Sample
from stommel.station.alarms.limits import Limit, Naming, SetLimit
from stommel.station.alarms.register import Register
from stommel.station.alarms.severity import Severity
from stommel.station.alarms.vehicle_watch import VehicleWatch

ARCHIVE_FAILING, ALERTS_FAILING = "archive_failing", "alerts_failing"
_WORDS: Mapping[str, tuple[str, Severity]] = {
    ARCHIVE_FAILING: ("The archive does not take what comes", "critical"),
    ALERTS_FAILING: ("Alerts do not go out", "warning"),
}
_LOOK_S = 0.5
_log = logging.getLogger(__name__)

Publish = Callable[[str, int | None, Mapping[str, Any]], None]
"""Is told the kind of what happened, the vehicle, and the row."""


class _Watched(NamedTuple):
    watch: VehicleWatch
    now: Callable[[], float]
    contact: Callable[[], Contact | None]


class StationAlarms:
    """Watches, history, limits and alerts of all vehicles; may be called from any thread.

    Parameters
    ----------
    archive
        Where alarms and limits are kept.
    naming
        What people call a channel.
    publish
        Hands on that an alarm or a limit changed.
    sender
        Who tells people that are away.
    settings, alerts
        `[alarms]` and `[alerts]` of station.toml.
    folder
        Where alerts wait over a restart; None: nowhere.
    """

    def __init__(
        self,
        archive: Archive,
        naming: Naming,
        publish: Publish,
        sender: Sender,
        settings: AlarmSettings | None = None,
        alerts: AlertSettings | None = None,
        folder: Path | None = None,
    ) -> None:
        self._archive, self._naming, self._publish = archive, naming, publish
        self._settings = settings or AlarmSettings()
        self.history = History(archive)
        self._limits = LimitTable(archive)
        self.alerts = Alerts(
            alerts or AlertSettings(),
            sender,
            lambda way, reason: self.report(ALERTS_FAILING, way, reason),
            folder=folder,
        )
        self._register = Register(self.history, self._tell, self.alerts.take)
        self._watched: dict[int, _Watched] = {}
        self._lock = Lock()
        self._one_person = Lock()
        """Held while a limit is changed, so that what is watched is what is kept."""
        self._troubles: dict[str, dict[str, str]] = {}
        self._stopped = Event()
        self._thread = Thread(target=self._run, name="alarms", daemon=True)

    # what is watched

    def watch(
        self,
        vehicle: int,
        now: Callable[[], float],
        contact: Callable[[], Contact | None],
        defaults: Sequence[Limit] = (),
    ) -> None:
        """Watch a vehicle that the archive knows.

        Parameters
        ----------
        vehicle
            Its number.
        now
            Its clock [s since 1970].
        contact
            When it was heard, and when it shall be heard next; None while its clock is not known.
        defaults
            Limits of channels that never had one.

        Raises
        ------
        ArchiveError
            The archive fails.
        """
        self._limits.add_new(vehicle, defaults, "vehicle file")
        open_keys = [alarm.key for alarm in self._register.open_of(vehicle)]
        watch = VehicleWatch(self._naming, self._settings, open_keys)
        begun = watch.begin(self._limits.limits_of(vehicle), self._archive.latest(vehicle))
        self._watched[vehicle] = _Watched(watch, now, contact)
        self._register.put(vehicle, begun)

    def take(self, vehicle: int, samples: Sequence[Sample]) -> None:
        """Take samples that came together; never waits for the archive."""
        watched = self._watched.get(vehicle)
        if watched is not None:
            self._register.put(vehicle, watched.watch.take(samples))

    def report(self, key: str, source: str, reason: str) -> None:
        """Take that something of the station's own fails at a source, and why; an empty reason: no longer."""
        words, severity = _WORDS.get(key, (key.replace("_", " ").capitalize(), "warning"))
        with self._lock:
            troubles = self._troubles.setdefault(key, {})
            (troubles.pop(source, None) if not reason else troubles.update({source: reason}))
            told = f"{words}: {next(iter(troubles.values()))}" if troubles else words
            change = Change(key, bool(troubles), time.time(), None, told, severity)
        self._register.put(None, [change])

    def start(self) -> None:
        """Begin to keep and tell alarms."""
        if not self.alerts.ways:
            self.report(ALERTS_FAILING, "", "")
        self.alerts.start()
        self._thread.start()

    def stop(self) -> None:
        """Keep what has changed, and end."""
        self._stopped.set()
        if self._thread.is_alive():
            self._thread.join(5.0)
        self._register.settle()
        self.alerts.stop()

    def look(self) -> None:
        """See what is due, and keep and tell what has changed; the thread does it twice a second."""
        for vehicle, watched in list(self._watched.items()):
            try:
                self._register.put(vehicle, watched.watch.look(watched.now(), watched.contact()))
            except Exception:  # noqa: BLE001 - one vehicle's defect must not silence the alarms of all
                _log.exception("alarms of vehicle %d", vehicle)
        self.report(ARCHIVE_FAILING, "alarms", self._register.settle())
        self._register.settle()
        self.alerts.look()

    def _run(self) -> None:
        while not self._stopped.wait(_LOOK_S):
            try:
                self.look()
            except Exception:  # noqa: BLE001 - nobody would know that alarms have ended
                _log.exception("alarms")

    def _tell(self, alarm: Alarm) -> None:
        self._publish("alarm", alarm.vehicle, alarm.as_row())

    # what people do

    def open_of(self, vehicle: int | None) -> list[Alarm]:
        """Open alarms of a vehicle, or of the station, the oldest first."""
        return self._register.open_of(vehicle)

    def acknowledge(self, number: int, user: str, note: str) -> Alarm:
        """Write who has seen an alarm, by the clock of its vehicle.

        Raises
        ------
        AlarmError
            There is no such alarm, or somebody has acknowledged it.
        ArchiveError
            The archive does not take it.
        """
        alarm = self.history.alarm(number)
        watched = self._watched.get(alarm.vehicle) if alarm is not None and alarm.vehicle is not None else None
        now = time.time() if watched is None else watched.now()
        return self._register.acknowledge(number, user, note, as_kept(now))

    def limits_of(self, vehicle: int) -> list[Limit]:
        """Limits of a vehicle, by channel."""
        return self._watched[vehicle].watch.limits()

    def set_limits(self, vehicle: int) -> list[SetLimit]:
        """Limits of a vehicle, by channel, and who set each."""
        return self._limits.set_limits(vehicle)

    def put_limit(self, vehicle: int, limit: Limit, user: str) -> None:
        """Keep a limit in place of the channel's limit before, and watch it.

        Raises
        ------
        ArchiveError
            The archive does not take it; the one before is still watched.
        """
        watched = self._watched[vehicle]
        with self._one_person:
            self._limits.put(vehicle, limit, user)
            self._register.put(vehicle, watched.watch.put(limit, watched.now()))
            self._tell_limit(vehicle, limit.channel, user, limit)

    def remove_limit(self, vehicle: int, channel: str, user: str) -> bool:
        """Watch a channel no more; whether it had a limit.

        Raises
        ------
        ArchiveError
            The archive does not take it; it is still watched.
        """
        watched = self._watched[vehicle]
        with self._one_person:
            if channel not in {limit.channel for limit in watched.watch.limits()}:
                return False
            self._limits.remove(vehicle, channel, user)
            self._register.put(vehicle, watched.watch.remove(channel, watched.now()) or [])
            self._tell_limit(vehicle, channel, user, None)
            return True

    def _tell_limit(self, vehicle: int, channel: str, user: str, limit: Limit | None) -> None:
        told = None if limit is None else limit.model_dump()
        self._publish("limit", vehicle, {"channel": channel, "user": user, "limit": told})
