"""How the alarms of a station come to know what its vehicles bring."""

from collections.abc import Callable
from functools import cache
from typing import Any

from stommel.errors import StommelError
from stommel.station.alarms.alert_words import Sender
from stommel.station.alarms.contact_watch import Contact
from stommel.station.alarms.defaults import default_limits
from stommel.station.alarms.limits import ChannelWords
from stommel.station.alarms.station_alarms import StationAlarms
from stommel.station.archive import Archive
from stommel.station.channels import channel_named
from stommel.station.live.events import Happening
from stommel.station.live.hub import Hub
from stommel.station.settings import StationSettings
from stommel.station.vehicles.line import VehicleLine
from stommel.vehicle import Vehicle, load_vehicle


def alarms_of(settings: StationSettings, archive: Archive, hub: Hub, title: Callable[[int], str]) -> StationAlarms:
    """Make the alarms of a station."""
    address = settings.address or f"http://{settings.host}:{settings.port}"
    return StationAlarms(
        archive, _words, lambda kind, vehicle, row: hub.publish(Happening(kind, vehicle, row)),
        Sender(settings.name, title, address), settings.alarms, settings.alerts,
    )  # fmt: skip


def watch(alarms: StationAlarms, line: VehicleLine, summary: Callable[[], dict[str, Any]]) -> None:
    """Let the alarms watch a vehicle."""

    def contact() -> Contact:
        told = summary()
        expected = None if told["heard"] or told["next_surfacing"] is None else told["next_surfacing"]["t"]
        status = line.status()
        return Contact(told["last_contact"], expected, "" if status.is_open else status.reason)

    alarms.watch(line.vehicle, line.clock.now, contact, default_limits(file_of(line.settings.model)))


@cache
def file_of(model: str) -> Vehicle | None:
    """The vehicle file of a vehicle; None where there is none."""
    try:
        return load_vehicle(model)
    except StommelError:
        return None


def _words(key: str) -> ChannelWords:
    channel = channel_named(key)
    return ChannelWords(key, "") if channel is None else ChannelWords(channel.words, channel.unit)
