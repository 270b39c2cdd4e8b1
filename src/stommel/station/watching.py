"""The alarms of a station over its vehicles: what they are told, and what summaries say of them."""

from collections.abc import Callable, Mapping
from typing import Any

from stommel.errors import StommelError
from stommel.station.alarms.alert_words import Sender
from stommel.station.alarms.contact_watch import Contact
from stommel.station.alarms.defaults import default_limits
from stommel.station.alarms.limits import ChannelWords
from stommel.station.alarms.severity import RANK
from stommel.station.alarms.station_alarms import ARCHIVE_FAILING, StationAlarms
from stommel.station.archive import Archive
from stommel.station.channels import channel_named
from stommel.station.live.events import Happening
from stommel.station.live.hub import Hub
from stommel.station.settings import StationSettings
from stommel.station.vehicles.line import VehicleLine
from stommel.station.vehicles.summary import AT_SURFACE
from stommel.vehicle import Vehicle, load_vehicle


def alarms_of(settings: StationSettings, archive: Archive, hub: Hub) -> StationAlarms:
    """Return the alarms of a station, which watch nothing yet."""
    titles = {vehicle.vehicle: vehicle.title for vehicle in settings.vehicles}
    sender = Sender(settings.name, lambda number: titles.get(number, f"vehicle {number}"), settings.alerts.page or "")
    return StationAlarms(
        archive,
        channel_words,
        lambda kind, vehicle, row: hub.publish(Happening(kind, vehicle, row)),
        sender,
        settings.alarms,
        settings.alerts,
    )


def channel_words(key: str) -> ChannelWords:
    """What people call a channel."""
    channel = channel_named(key)
    return ChannelWords(key, "") if channel is None else ChannelWords(channel.words, channel.unit)


def watch_line(alarms: StationAlarms, line: VehicleLine, summary: Callable[[], Mapping[str, Any]]) -> None:
    """Watch the vehicle of a line, with the limits of its file until somebody sets others.

    Raises
    ------
    ArchiveError
        The archive fails.
    """

    def contact() -> Contact | None:
        alarms.report(ARCHIVE_FAILING, f"vehicle {line.vehicle}", line.status().archive)
        return contact_of(summary()) if line.clock.is_set else None

    alarms.watch(line.vehicle, line.clock.now, contact, default_limits(_vehicle_named(line.settings.model)))


def contact_of(summary: Mapping[str, Any]) -> Contact:
    """When a vehicle was heard, and when it shall be heard next, from its summary."""
    expected = summary["next_surfacing"]
    phase = summary["phase"]
    return Contact(
        summary["last_contact"],
        None if expected is None else expected["t"],
        phase is not None and phase not in AT_SURFACE,
        summary["link_reason"],
    )


def tell_open(alarms: StationAlarms, vehicle: int, summary: dict[str, Any]) -> None:
    """Put the open alarms of a vehicle into its summary, the worst first."""
    found = sorted(alarms.open_of(vehicle), key=lambda alarm: -RANK[alarm.severity])
    summary["alarms"] = [{"key": alarm.key, "words": alarm.words, "severity": alarm.severity} for alarm in found]


def _vehicle_named(model: str) -> Vehicle | None:
    try:
        return load_vehicle(model)
    except StommelError:
        return None
