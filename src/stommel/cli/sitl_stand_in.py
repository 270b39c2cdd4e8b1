"""`stommel sitl stand-in`: a simulated vehicle on real ports, for software that runs as it will at sea."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.numbers import number_option
from stommel.cli.options import JsonOption
from stommel.cli.output import show_values
from stommel.cli.paths import folder_parser
from stommel.cli.sitl_radio import LinkOption, connected

if TYPE_CHECKING:
    from stommel.sitl.stand_in import StandIn

LONGEST = 366.0 * 86400.0


def stand_in(
    scenario: Annotated[str, typer.Argument(metavar="SCENARIO", help="A mission file, or a shipped mission.")],
    ports: Annotated[
        Path,
        typer.Option(
            "--ports",
            metavar="FOLDER",
            parser=folder_parser("--ports"),
            help="Folder in which the serial ports compass, gnss and radio appear.",
        ),
    ],
    channel: Annotated[
        str, typer.Option("--channel", metavar="ADDRESS", help="Multicast address of the CAN bus.")
    ] = "239.74.163.2",
    link: LinkOption = None,
    parameters: Annotated[
        Path | None,
        typer.Option(
            "--parameters",
            metavar="FOLDER",
            parser=folder_parser("--parameters"),
            help="Folder in which the nodes keep their parameters; without it they forget them.",
        ),
    ] = None,
    seconds: Annotated[float | None, number_option("--seconds", 1.0, LONGEST, "s", "Stop after this time")] = None,
    as_json: JsonOption = False,
) -> None:
    """Simulate a vehicle's nodes and instruments on real ports, in real time, for `stommel vehicle run`.

    Example: stommel sitl stand-in pool_trial --ports build/ports
    """  # fmt: skip
    from stommel.messages.adapters import Adapter
    from stommel.messages.bus import CanBus
    from stommel.simulation.scenario.shipped import mission_path
    from stommel.sitl.scenario import load_scenario
    from stommel.sitl.stand_in import StandIn

    mission, faults, radio = load_scenario(mission_path(scenario))
    if faults:
        raise typer.BadParameter("has faults, which fly in `stommel sitl fly` alone", param_hint="SCENARIO")
    with connected(link) as shore:
        bus = CanBus(Adapter("udp_multicast", channel, keys="--"))
        try:
            stood_in = StandIn(mission, bus, ports, radio=radio, shore=shore, parameters=parameters)
        except BaseException:
            bus.close()
            raise
        answer = _stood(stood_in, seconds)
    finish(answer, None, as_json, _show)


def _stood(stood_in: "StandIn", seconds: float | None) -> dict[str, Any]:
    from stommel.cli.vehicle_run import until_asked

    with stood_in, until_asked() as asked:
        for note in stood_in.system.notes:
            typer.echo(f"note: {note}", err=True)
        for name, path in stood_in.terminals.paths.items():
            typer.echo(f"{name}: {path}", err=True)
        stood_in.run(LONGEST if seconds is None else seconds, asked)
        return _answer(stood_in)


def _answer(stood_in: "StandIn") -> dict[str, Any]:
    system = stood_in.system
    return {
        "time_s": system.plant.time,
        "depth_m": system.plant.depth,
        "nodes": stood_in.modes,
        "radio": {
            "sent_bytes": system.air.channel.vehicle.counts.sent_bytes,
            "heard_bytes": system.air.channel.shore.counts.arrived_bytes,
        },
    }


def _show(row: dict[str, Any]) -> None:
    values = {
        "depth": f"{row['depth_m']:.1f} m",
        "radio": f"{row['radio']['sent_bytes']} bytes sent, {row['radio']['heard_bytes']} heard",
        "nodes": ", ".join(f"{name} {mode}" for name, mode in row["nodes"].items()),
    }
    show_values(f"Stood in for {row['time_s']:.0f} s", values)
