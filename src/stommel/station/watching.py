"""How the alarms of a station come to know what its vehicles bring."""

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

from stommel.archive import Archive
from stommel.errors import StommelError
from stommel.station.alarms.alert_words import Sender
from stommel.station.alarms.contact_watch import Contact
from stommel.station.alarms.defaults import default_limits
from stommel.station.alarms.limits import ChannelWords
from stommel.station.alarms.severity import RANK
from stommel.station.alarms.station_alarms import ARCHIVE_FAILING, StationAlarms
from stommel.station.channels import channel_named
from stommel.station.live.events import Happening
from stommel.station.live.hub import Hub
from stommel.station.logbook.doings import Doings
from stommel.station.settings import StationSettings
from stommel.station.vehicles.line import VehicleLine
from stommel.station.vehicles.summary import AT_SURFACE
from stommel.vehicle import Vehicle, load_vehicle


def alarms_of(
    settings: StationSettings, archive: Archive, hub: Hub, doings: Doings, title: Callable[[int], str]
) -> StationAlarms:
    """Make the alarms of a station; a limit that somebody sets stands in the log book when it is told."""

    def publish(kind: str, vehicle: int | None, row: Mapping[str, Any]) -> None:
        if kind == "limit" and vehicle is not None:
            doings.add(vehicle, "limit", row["user"], limit_words(row["channel"], row["limit"]))
        hub.publish(Happening(kind, vehicle, row))

    address = settings.address or f"http://{settings.host}:{settings.port}"
    return StationAlarms(
        archive, _words, publish,
        Sender(settings.name, title, address), settings.alarms, settings.alerts,
        settings.folder / "alerts",
    )  # fmt: skip


def watch(alarms: StationAlarms, line: VehicleLine, summary: Callable[[], dict[str, Any]]) -> None:
    """Let the alarms watch a vehicle, with the limits of its file until somebody sets others.

    Raises
    ------
    ArchiveError
        The archive fails.
    """

    def contact() -> Contact | None:
        alarms.report(ARCHIVE_FAILING, f"vehicle {line.vehicle}", line.status().archive)
        return contact_of(summary()) if line.clock.is_set else None

    alarms.watch(line.vehicle, line.clock.now, contact, default_limits(file_of(line.settings.model)))


def contact_of(summary: Mapping[str, Any]) -> Contact:
    """When a vehicle was heard, and when it shall be heard next, from its summary."""
    expected, phase = summary["next_surfacing"], summary["phase"]
    return Contact(
        heard=summary["last_contact"],
        expected=None if expected is None else expected["t"],
        is_diving=phase is not None and phase not in AT_SURFACE,
        trouble=summary["link_reason"],
    )


def open_alarms(alarms: StationAlarms, vehicle: int) -> list[dict[str, Any]]:
    """Open alarms of a vehicle, and of the station itself, as the summary tells them, the worst first."""
    found = sorted([*alarms.open_of(vehicle), *alarms.open_of(None)], key=lambda alarm: -RANK[alarm.severity])
    return [alarm.as_brief() for alarm in found]


def limit_words(key: str, limit: Mapping[str, Any] | None) -> str:
    """A limit that somebody has set or removed, in words."""
    words, unit = _words(key)
    if limit is None:
        return f"Limit of {words} removed"
    told = [
        f"at least {limit['low']:.10g} {unit}".rstrip() if limit["low"] is not None else "",
        f"at most {limit['high']:.10g} {unit}".rstrip() if limit["high"] is not None else "",
        f"hysteresis {limit['hysteresis']:.10g} {unit}".rstrip() if limit["hysteresis"] else "",
        f"after {limit['delay_s']:.10g} s" if limit["delay_s"] else "",
    ]
    return f"Limit of {words}: {', '.join(part for part in told if part)}; {limit['severity']}"


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
