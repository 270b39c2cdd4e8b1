"""How a vehicle was at a moment of the past, in the words in which the station tells how it is."""

from collections.abc import Mapping, Sequence
from math import inf
from typing import Any, NamedTuple

from stommel.archive import Archive, DiveRow
from stommel.station.alarms.alarm import Alarm
from stommel.station.alarms.history import History
from stommel.station.alarms.severity import RANK
from stommel.station.alarms.vehicle_alarms import alarms_in
from stommel.station.alarms.vehicle_watch import ALARM_BITS
from stommel.station.replay.reading import last_told
from stommel.station.settings import VehicleSettings
from stommel.station.vehicles.attached import last_dives
from stommel.station.vehicles.summary import LAST_DIVES, Known, summary_of
from stommel.station.vehicles.underway import Sample, Underway
from stommel.station.vehicles.waiting import NOTHING
from stommel.station.vehicles.whereabouts import Whereabouts

HEARD_FOR = 60.0
"""A vehicle counts as heard if something came of it so lately [s]."""


class PastContact(NamedTuple):
    """Whether the vehicle was heard."""

    heard: bool
    last_contact: float | None
    reason: str


class Moment:
    """Follows a vehicle through a stretch of its past; times by its clock [s since 1970].

    Raises
    ------
    ArchiveError
        The archive cannot be read.
    """

    def __init__(self, settings: VehicleSettings, archive: Archive, at: float) -> None:
        self._settings, self._archive = settings, archive
        self._history = History(archive)
        self._underway = Underway()
        self._underway.restore(archive, settings.vehicle, at)
        self._whereabouts = Whereabouts()
        self._whereabouts.restore(archive, settings.vehicle, at)

    def take(self, samples: Sequence[Sample]) -> None:
        """Take what the vehicle told next."""
        self._underway.take(samples)
        self._whereabouts.take(samples)

    def summary(self, at: float, latest: Mapping[str, tuple[float, float]]) -> dict[str, Any]:
        """How the vehicle was at a time, out of the latest values until then.

        Who held command then, and what waited, is left out.
        """
        settings = self._settings
        known = Known(
            settings.vehicle, settings.title, settings.model, settings.is_simulated, settings.speed, at,
            _contact(at, latest), latest, self._dives(at), self._underway.left_surface, self._underway.approach,
            self._whereabouts.last(),
        )  # fmt: skip
        return summary_of(known) | {"holder": None, "waiting": NOTHING, "alarms": self._alarms(at, latest)}

    def _alarms(self, at: float, latest: Mapping[str, tuple[float, float]]) -> list[dict[str, Any]]:
        """Alarms that were open then, and those that the vehicle told of and the station did not keep, as of a log."""
        vehicle = self._settings.vehicle
        found = self._history.open_at(vehicle, at)
        keys = {alarm.key for alarm in found}
        _, bits = latest.get(ALARM_BITS, (0.0, 0.0))
        briefs = [alarm.as_brief() for alarm in found]
        briefs += [
            Alarm(None, vehicle, told.key, told.words, told.severity, at).as_brief() | {"raised": None}
            for told in alarms_in(int(bits) if 0.0 <= bits < inf else 0)
            if told.key not in keys
        ]
        return sorted(briefs, key=lambda brief: -RANK[brief["severity"]])

    def _dives(self, at: float) -> Sequence[DiveRow]:
        return last_dives(self._archive, self._settings.vehicle, LAST_DIVES, until=at)


def _contact(at: float, latest: Mapping[str, tuple[float, float]]) -> PastContact:
    last = last_told(latest)
    heard = last is not None and at - last <= HEARD_FOR
    return PastContact(heard, last, "" if heard else "nothing was received at that time")
