"""`stommel can dump|decode|send`: the vehicle's CAN bus on the bench."""

import time
from collections.abc import Iterator
from enum import StrEnum
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.numbers import count_option, number_option
from stommel.cli.options import JsonOption
from stommel.cli.output import show_notes, show_table, show_values

if TYPE_CHECKING:
    from stommel.messages.adapters import Adapter
    from stommel.messages.bus import CanBus
    from stommel.messages.nodes import Network, NodeWatch

can_app = typer.Typer(help="Watch the vehicle's CAN bus, read frames, and send them on the bench.")

LOOKS_EVERY = 0.05
"""Between two looks at what has come [s]."""
MOST_KEPT = 100_000
"""Frames of a JSON answer; `dump --json` ends when it has so many."""


class InterfaceChoice(StrEnum):
    """As `stommel.messages.adapters.INTERFACES`, which is not imported at the start."""

    socketcan = "socketcan"
    slcan = "slcan"
    udp_multicast = "udp_multicast"
    virtual = "virtual"


InterfaceOption = Annotated[InterfaceChoice, typer.Option("--interface", help="How the bus is reached.")]
ChannelOption = Annotated[
    str,
    typer.Option(
        "--channel",
        help="Which one: can0, /dev/ttyACM0, a multicast address; the usual one of the interface if left out.",
    ),
]
BitrateOption = Annotated[
    int | None, count_option("--bitrate", 1, 1_000_000, "Bit rate in bit/s; given for slcan, and for nothing else")
]


def _adapter(interface: InterfaceChoice, channel: str, bitrate: int | None) -> "Adapter":
    from stommel.messages.adapters import Adapter

    return Adapter(interface.value, channel, bitrate, keys="--")


@can_app.command("dump")
def dump(
    interface: InterfaceOption = InterfaceChoice.socketcan,
    channel: ChannelOption = "",
    bitrate: BitrateOption = None,
    seconds: Annotated[float, number_option("--seconds", 0.1, 86400, "s", "How long to listen")] = 10.0,
    as_json: JsonOption = False,
) -> None:
    """Show what goes over the bus, in words with units: also what is rejected, and who is unknown.

    Example: stommel can dump --interface slcan --channel /dev/ttyACM0 --bitrate 500000 --seconds 60
    """
    from stommel.messages.bus import CanBus
    from stommel.messages.database import ACQUISITION, COORDINATOR, MOTION
    from stommel.messages.nodes import NodeWatch

    adapter = _adapter(interface, channel, bitrate)
    rows: list[dict[str, Any]] = []
    reports: list[str] = []
    watch = NodeWatch((COORDINATOR, MOTION, ACQUISITION), 0.0)
    began = time.monotonic()
    with CanBus(adapter) as bus:
        try:
            for line, row in _heard(bus, watch, began, seconds):
                if row is None:
                    reports.append(line)
                elif as_json:
                    rows.append(row)
                if not as_json:
                    typer.echo(line)
                if len(rows) == MOST_KEPT:
                    break
        except KeyboardInterrupt:
            reports.append("ended by hand")
        listened = min(time.monotonic() - began, seconds)
        counts = {name: value for name, value in bus.status()._asdict().items() if name not in ("fault", "since")}
    network = watch.snapshot(listened)
    answer = {
        "interface": adapter.interface,
        "channel": adapter.channel,
        "listened_s": round(listened, 3),
        "frames": rows,
        "nodes": [node._asdict() for node in network.nodes],
        "unknown": dict(network.unknown),
        "reports": reports,
        "counts": counts,
    }
    finish(answer, None, as_json, lambda _: _show_network(network, counts))


def _heard(
    bus: "CanBus", watch: "NodeWatch", began: float, seconds: float
) -> Iterator[tuple[str, dict[str, Any] | None]]:
    """Yield a line and a row for each frame, and a line alone for each report of the bus."""
    from stommel.messages.codec import Decoder
    from stommel.messages.spoken import as_row, sentence

    decoder, t = Decoder(), 0.0
    while t < seconds:
        time.sleep(min(LOOKS_EVERY, seconds - t))
        t = time.monotonic() - began
        for report in bus.reports():
            yield f"{t:9.3f}  {report}", None
        for frame in bus.receive():
            answer = decoder.take(frame)
            watch.take(answer, t)
            yield f"{t:9.3f}  {sentence(frame, answer)}", {"time_s": round(t, 3), **as_row(frame, answer)}


def _show_network(network: "Network", counts: dict[str, int]) -> None:
    rows = []
    for node in network.nodes:
        version = "-" if node.version is None else ".".join(str(number) for number in node.version)
        state = "never heard" if node.heard is None else "silent" if node.silent else node.state
        rows.append([node.name, state, str(node.restarts), str(node.lost), version])
    show_table("Nodes", ["node", "state", "starts", "lost", "version"], rows)
    show_notes((node.refused for node in network.nodes if node.refused), "refused")
    show_notes((f"{name} ({count} frames)" for name, count in network.unknown), "unknown")
    show_notes((f"{name}: {reason} ({count} frames)" for name, reason, count in network.rejected), "rejected")
    show_values("Frames", {name.replace("_", " "): str(count) for name, count in counts.items()})


@can_app.command("decode")
def decode(
    what: Annotated[
        list[str],
        typer.Argument(
            metavar="FRAME|LOG...", help="Frames as 100#E803..., or candump logs: (time) interface ID#DATA."
        ),
    ],
    as_json: JsonOption = False,
) -> None:
    """Say what frames mean, in words with units, and which are not to be believed.

    Example: stommel can decode 702#020000050000002A candump.log
    """
    from stommel.messages.codec import Decoder, Received
    from stommel.messages.database import message_of
    from stommel.messages.spoken import LoggedFrame, as_row, sentence

    decoders: dict[str, Decoder] = {}
    lines: list[str] = []
    rows: list[dict[str, Any]] = []
    unreadable: list[str] = []
    counts = {"good": 0, "rejected": 0, "unknown": 0, "unreadable": 0}
    for source, found in _frames_in(what):
        if not isinstance(found, LoggedFrame):
            unreadable.append(found)
            counts["unreadable"] += 1
            continue
        answer = decoders.setdefault(f"{source} {found.interface}", Decoder()).take(found.frame)
        unknown = message_of(found.frame.identifier) is None
        counts["good" if isinstance(answer, Received) else "unknown" if unknown else "rejected"] += 1
        when = {"time_s": found.time, "interface": found.interface} if source else {}
        rows.append({**when, **as_row(found.frame, answer)})
        lines.append((f"({found.time:.6f}) " if source else "") + sentence(found.frame, answer))
    answered = {"frames": rows, "unreadable": unreadable, "counts": counts}
    finish(answered, None, as_json, lambda _: _show_decoded(lines, unreadable, counts))


def _frames_in(what: list[str]) -> Iterator[tuple[str, Any]]:
    """Yield each frame with the log that it stands in, or nothing; a sentence for each line of a log that is none."""
    from stommel.files.opening import TABLE_MIB, read_text, unreadable
    from stommel.messages.spoken import FrameTextError, LoggedFrame, frame_of, log_of

    for text in what:
        if not text.strip():
            raise FrameTextError(f"{text!r}: must be ID#DATA, as 100#E803204E0000000C, or the name of a candump log")
        if "#" in text:
            yield "", LoggedFrame(0.0, "", frame_of(text))
            continue
        found = list(log_of(read_text(text, TABLE_MIB).split("\n")))
        if found and not any(isinstance(one, LoggedFrame) for one in found):
            raise unreadable(text, f"it is no candump log: {found[0]}")
        yield from ((text, one if isinstance(one, LoggedFrame) else f"{text}: {one}") for one in found)


def _show_decoded(lines: list[str], unreadable: list[str], counts: dict[str, int]) -> None:
    for line in lines:
        typer.echo(line)
    show_notes(unreadable, "unreadable")
    show_values("Frames", {name: str(count) for name, count in counts.items()})


@can_app.command("send")
def send(
    message: Annotated[str, typer.Argument(metavar="MESSAGE", help="Name of a message of the database.")],
    signals: Annotated[
        list[str] | None, typer.Argument(metavar="SIGNAL=VALUE...", help="All its signals: numbers, or their words.")
    ] = None,
    interface: InterfaceOption = InterfaceChoice.socketcan,
    channel: ChannelOption = "",
    bitrate: BitrateOption = None,
    times: Annotated[
        int, count_option("--times", 1, 10_000, "How often; with three at least one follows the counter heard before")
    ] = 3,
    period: Annotated[float, number_option("--period", 0.001, 60, "s", "Between two of them")] = 0.1,
    as_json: JsonOption = False,
) -> None:
    """Send a message on the bench; what the database does not allow is refused.

    Example: stommel can send BenchCommand target=Motion command=Stop sequence=32768 argument=0
    """
    from stommel.messages.adapters import BusError
    from stommel.messages.bus import CanBus
    from stommel.messages.codec import TURNS, Encoder
    from stommel.messages.spoken import frame_text, spoken, values_of

    values = values_of(message, signals or [])
    # another number at each call: a receiver takes the same one for a repeat
    encoder = Encoder(time.time_ns() // 100_000_000 % TURNS)
    frames = [encoder.frame(message, **values) for _ in range(times)]
    adapter = _adapter(interface, channel, bitrate)
    with CanBus(adapter) as bus:
        for number, frame in enumerate(frames):
            time.sleep(period if number else 0.0)
            if not bus.send(frame):
                raise BusError(
                    f"--channel = {adapter.channel!r}: sent {number} of {times} frames: {bus.status().fault}"
                )
    answer = {
        "interface": adapter.interface,
        "channel": adapter.channel,
        "message": message,
        "signals": {name: spoken(message, name, value) for name, value in values.items()},
        "period_s": period,
        "frames": [frame_text(frame) for frame in frames],
    }
    finish(answer, None, as_json, _show_sent)


def _show_sent(answer: dict[str, Any]) -> None:
    for text in answer["frames"]:
        typer.echo(text)
    said = ", ".join(f"{name} {value}" for name, value in answer["signals"].items())
    typer.echo(f"sent {answer['message']}: {said}")
