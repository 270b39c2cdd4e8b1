"""The radio of a simulated vehicle, as its commands offer it: where the shore may connect, and who is believed."""

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.files.units import counted

if TYPE_CHECKING:
    from stommel.link.signing.guard import Guard
    from stommel.sitl.radio.outside import Outside
    from stommel.sitl.system import System

LinkOption = Annotated[
    str | None,
    typer.Option(
        "--link",
        metavar="ADDRESS",
        help="Where a shore may connect to the radio: tcp-listen:HOST:PORT, udp-listen:HOST:PORT, pty, ...",
    ),
]
KeyOption = Annotated[
    Path | None,
    typer.Option(
        "--key",
        metavar="KEY",
        help="Key of the vehicle (`stommel link key new`); without it, whoever connects commands.",
    ),
]


@contextmanager
def connected(address: str | None) -> Iterator["Outside | None"]:
    """Open the address for a shore; nothing where there is none."""
    if address is None:
        yield None
        return
    from stommel.link.transports.opening import open_transport
    from stommel.sitl.radio.outside import Outside

    transport = open_transport(address, "--link")
    try:
        typer.echo(f"shore: {transport.name}", err=True)
        yield Outside(transport)
    finally:
        transport.close()


@contextmanager
def shore_at(address: str | None, key: Path | None) -> Iterator[tuple["Outside | None", "Guard | None"]]:
    """Open the address for a shore, and its end of the keys; nothing where there is none."""
    if address is None:
        if key is not None:
            raise typer.BadParameter("is of use only with --link", param_hint="--key")
        yield None, None
        return
    from stommel.link.signing.guard import Guard
    from stommel.link.signing.key_file import KeyFile
    from stommel.sitl.faults.disk import MemoryDisk
    from stommel.sitl.radio.station import SYSTEM

    with connected(address) as shore:
        if key is None:
            typer.echo("note: no --key: the vehicle believes whoever connects", err=True)
            guard = Guard.unsigned(SYSTEM)
        else:
            file = KeyFile(key)
            file.read()
            # stamps are of the real world: who connects has a real clock
            guard = Guard(SYSTEM, file, MemoryDisk(), time.time(), os.urandom)
        yield shore, guard


def radio_at_the_end(system: "System") -> dict[str, Any]:
    """What went over the radio in a flight."""
    session, channel, guard = system.link.session, system.air.channel, system.link.guard
    peers = session.peers().values()
    return {
        "mode": guard.mode.value,
        "sent_bytes": channel.vehicle.counts.sent_bytes,
        "frames_heard": sum(counts.good for counts in peers),
        "frames_lost": sum(counts.lost for counts in peers),
        "frames_refused": guard.refusals.by_reason.total(),
    }


def radio_words(row: dict[str, Any]) -> str:
    """The same in a line."""
    return (
        f"{row['sent_bytes'] / 1000.0:.0f} kB sent, {counted(row['frames_heard'], 'frame')} heard from the shore, "
        f"{row['frames_lost']} lost, {row['frames_refused']} refused; {row['mode']}"
    )
