"""How the line to a vehicle is, in figures and in words."""

from typing import NamedTuple

from stommel.link.shore.shore_end import ShoreEnd
from stommel.link.statistics import LinkStatistics
from stommel.link.transports.transport import Transport, TransportState
from stommel.station.clock import VehicleClock
from stommel.station.vehicles.ingest import Ingest


class LineStatus(NamedTuple):
    """How the line to a vehicle is; times are those of the vehicle [s since 1970]."""

    heard: bool
    since: float | None
    """Since when it is heard without a pause."""
    last_contact: float | None
    transport: str
    """Address."""
    is_open: bool
    reason: str
    """Why the vehicle is not heard, in words; empty while it is."""
    archive: str
    """Why what comes is not kept, in words; empty while it is."""
    waiting: int
    """Frames that the archive does not have yet."""
    statistics: LinkStatistics
    notes: tuple[str, ...]


def status_of(
    end: ShoreEnd,
    clock: VehicleClock,
    ingest: Ingest,
    transport: Transport | None,
    reason: str,
    address: str,
    archive: str,
    failure: str,
    t: float,
) -> LineStatus:
    """Look at a line at a time of the link [s]; in its thread."""
    presence = end.presence.peers.get(end.vehicle)
    heard = presence is not None and presence.is_heard(t)
    since = clock.of_link(presence.since) if presence is not None and heard else None
    notes = [*end.session.notes, *end.commands.notes]
    if failure:
        notes.append(failure)
    return LineStatus(
        heard, since, ingest.heard_at, address if transport is None else transport.name,
        transport is not None and transport.state is TransportState.OPEN, "" if heard else reason,
        archive, len(ingest.frames), end.link(t), tuple(notes),
    )  # fmt: skip


def complaint(end: ShoreEnd, transport: Transport | None, transport_reason: str, came: int, t: float) -> str:
    """Why a vehicle is not heard, of which so many messages came."""
    if transport is None:
        return transport_reason
    if transport.reason:
        return f"{transport.name}: {transport.reason}"
    if told := end.session.line.complaint(t):
        return told
    if end.guard.refusals.by_reason:
        return "; ".join(end.guard.status)
    others = sorted({system for system, _ in end.session.peers()} - {end.vehicle[0]})
    if others and came == 0:
        return f"heard is {', '.join(f'vehicle {system}' for system in others)}; the number of this one is another"
    if came:
        return "nothing comes; it is under water, out of reach, or its radio is off"
    if end.session.versions:
        return end.session.versions
    return "nothing came yet; it is under water, out of reach, or its radio is off"
