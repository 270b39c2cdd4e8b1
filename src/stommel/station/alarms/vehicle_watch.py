"""All that is watched of one vehicle."""

from collections.abc import Iterable, Mapping, Sequence
from math import isfinite
from threading import Lock

from stommel.archive.times import is_time
from stommel.station.alarms.alert_settings import AlarmSettings
from stommel.station.alarms.change import Change
from stommel.station.alarms.contact_watch import Contact, ContactWatch
from stommel.station.alarms.limit_watch import LimitWatch, Sample
from stommel.station.alarms.limits import Limit, Naming
from stommel.station.alarms.vehicle_alarms import VehicleAlarmWatch

ALARM_BITS = "vehicle_alarms"
"""Channel of the vehicle's own alarms."""


class VehicleWatch:
    """Limits, own alarms and contact of a vehicle; may be called from any thread.

    Parameters
    ----------
    naming
        What people call a channel.
    settings
        When a silence is an alarm.
    open_keys
        Alarms that were raised before, as from before a restart.
    """

    def __init__(self, naming: Naming, settings: AlarmSettings, open_keys: Iterable[str] = ()) -> None:
        keys = frozenset(open_keys)
        self._lock = Lock()
        self._limits = LimitWatch(naming, keys)
        self._own = VehicleAlarmWatch(keys)
        self._contact = ContactWatch(
            settings.surfacing_margin_s, settings.longest_silence_s, settings.longest_dive_s, keys
        )

    def begin(self, limits: Iterable[Limit], latest: Mapping[str, tuple[float, float]]) -> list[Change]:
        """Watch limits, and hold the newest values that are known against them."""
        with self._lock:
            for limit in limits:
                self._limits.put(limit, 0.0)
        return self.take([(key, t, value) for key, (t, value) in latest.items()])

    def take(self, samples: Sequence[Sample]) -> list[Change]:
        """Take samples that came together; those of a time that is none say nothing."""
        samples = [sample for sample in samples if is_time(sample[1])]
        with self._lock:
            changes = self._limits.take(samples)
            bits = [(t, value) for key, t, value in samples if key == ALARM_BITS and isfinite(value) and value >= 0.0]
            for t, value in sorted(bits):
                changes += self._own.take(t, int(value))
        return changes

    def look(self, now: float, contact: Contact | None) -> list[Change]:
        """See at a time [s] what is due; without a contact, only of the limits."""
        with self._lock:
            return self._limits.look(now) + ([] if contact is None else self._contact.look(now, contact))

    def put(self, limit: Limit, t: float) -> list[Change]:
        """Watch a limit in place of the channel's limit before."""
        with self._lock:
            return self._limits.put(limit, t)

    def remove(self, channel: str, t: float) -> list[Change] | None:
        """Watch a channel no more; None if it had no limit."""
        with self._lock:
            return self._limits.remove(channel, t) if self._limits.limit_of(channel) is not None else None

    def limits(self) -> list[Limit]:
        """All limits, by channel."""
        with self._lock:
            return self._limits.limits
