"""A vehicle as the station has it: its line, what is known of it, and the news of both."""

import time
from collections import deque
from collections.abc import Callable, Sequence
from typing import Any

from sqlalchemy import select

from stommel.archive import Archive, Batch, DiveRow
from stommel.archive.readers import dive_of
from stommel.archive.schema import dives
from stommel.archive.times import GREATEST_TIME, microseconds
from stommel.archive.whereabouts.dive_ends import told_dive, with_true_ends
from stommel.station.live.events import Happening, Samples, Summary
from stommel.station.live.hub import Hub
from stommel.station.settings import VehicleSettings
from stommel.station.vehicles.line import VehicleLine
from stommel.station.vehicles.summary import Known, summary_of
from stommel.station.vehicles.underway import Underway
from stommel.station.vehicles.whereabouts import Whereabouts

SUMMARY_EVERY = 1.0
"""Between two summaries [s]."""
MOST_DIVES = 10

Watcher = Callable[[int, Batch], None]


class VehicleNews:
    """Keeps the latest of one vehicle, and tells it to everybody who listens.

    Parameters
    ----------
    settings
        Of the vehicle.
    archive
        Tells what is known from before.
    hub
        Hands news on.
    extra
        Adds what others know to a summary: holder, alarms of the station.
    """

    def __init__(
        self,
        settings: VehicleSettings,
        archive: Archive,
        hub: Hub,
        extra: Callable[[int, dict[str, Any]], None],
    ) -> None:
        self._settings, self._archive, self._hub, self._extra = settings, archive, hub, extra
        self.vehicle = settings.vehicle
        self.underway = Underway()
        self.underway.restore(archive, self.vehicle)
        self.whereabouts = Whereabouts()
        self.whereabouts.restore(archive, self.vehicle, GREATEST_TIME)
        self._dives: deque[DiveRow] = deque(last_dives(archive, self.vehicle), maxlen=MOST_DIVES)
        self._told: dict[str, Any] = {}
        self._due = 0.0

    def committed(self, line: VehicleLine, batch: Batch) -> None:
        """Tell what was stored just now."""
        now = line.clock.now()
        if batch.samples:
            self.underway.take(batch.samples)
            self.whereabouts.take(batch.samples)
            self._hub.publish(Samples(self.vehicle, now, batch.samples))
        for dive in batch.dives:
            self._take_dive(dive)
        for t, severity, words in batch.texts:
            told = {"t": t, "severity": severity, "words": words}
            self._hub.publish(Happening("text", self.vehicle, told))

    def _take_dive(self, dive: DiveRow) -> None:
        """Keep a dive, in place of what was known of it: its summary is said again, and a new mission counts anew."""
        is_known = False
        for k, known in enumerate(self._dives):
            if (known.dive, known.t_begin) == (dive.dive, dive.t_begin):
                self._dives[k], is_known = dive, True
        if not is_known:
            self._dives.append(dive)
            self._hub.publish(Happening("dive", self.vehicle, told_dive(with_true_ends(dive))))

    def look(self, line: VehicleLine, t: float) -> None:  # noqa: ARG002 - as every follower
        """Tell how the vehicle is, when that has changed."""
        real = time.monotonic()
        if real < self._due:
            return
        self._due = real + SUMMARY_EVERY
        summary = self.summary(line)
        lasting = {key: value for key, value in summary.items() if key != "now"}
        if lasting != self._told:
            self._told = lasting
            self._hub.publish(Summary(self.vehicle, summary))

    def summary(self, line: VehicleLine) -> dict[str, Any]:
        """How the vehicle is."""
        settings = self._settings
        known = Known(
            self.vehicle, settings.title, settings.model, settings.is_simulated, settings.speed, line.clock.now(),
            line.status(), self._hub.values(self.vehicle), tuple(self._dives), self.underway.left_surface,
            self.underway.approach, self.whereabouts.last(), self.underway.usage,
        )  # fmt: skip
        summary = summary_of(known)
        summary["holder"] = None
        self._extra(self.vehicle, summary)
        return summary


def last_dives(archive: Archive, vehicle: int, most: int = MOST_DIVES, until: float | None = None) -> Sequence[DiveRow]:
    """The last dives of a vehicle, the oldest first; of those that had ended until a time, if one is given."""
    mine = select(dives).where(dives.c.vehicle_id == vehicle)
    if until is not None:
        mine = mine.where(dives.c.t_end_us <= microseconds(until))
    newest = mine.order_by(dives.c.t_begin_us.desc()).limit(most)
    with archive.reading() as connection:
        return [dive_of(row) for row in reversed(connection.execute(newest).all())]
