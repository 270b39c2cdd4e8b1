"""`stommel station serve`: vehicles, archive and page until Ctrl-C."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.numbers import number_option
from stommel.cli.station.options import DatabaseOption, FolderOption, SettingsOption

if TYPE_CHECKING:
    from stommel.station.settings import StationSettings
    from stommel.station.station import Station

LinkOption = Annotated[
    list[str] | None,
    typer.Option(
        "--link", metavar="ADDRESS", help="Line to a vehicle: serial:DEVICE:BAUD, tcp:HOST:PORT, udp:HOST:PORT; again."
    ),
]
VehicleOption = Annotated[
    list[int] | None,
    typer.Option("--vehicle", min=1, max=250, help="Number of the vehicle of each --link; 1, 2, ... if left out."),
]
KeyOption = Annotated[
    list[Path] | None, typer.Option("--key", metavar="KEY", help="Key file of the vehicle of each --link.")
]


def serve(
    database: DatabaseOption = None,
    link: LinkOption = None,
    vehicle: VehicleOption = None,
    key: KeyOption = None,
    unsigned: Annotated[
        bool, typer.Option("--unsigned", help="The vehicles of --link were told to believe everybody.")
    ] = False,
    model: Annotated[
        str | None, typer.Option("--model", metavar="VEHICLE", help="Vehicle file of --link, or a built-in one.")
    ] = None,
    sitl: Annotated[
        str | None,
        typer.Option("--sitl", metavar="MISSION", help="Fly a simulated glider beside the station, reached by radio."),
    ] = None,
    speed: Annotated[
        float | None,
        number_option("--speed", 0.1, 100.0, "", "Of simulated vehicles, times real time; 20 with --sitl if left out"),
    ] = None,
    settings: SettingsOption = None,
    folder: FolderOption = None,
    name: Annotated[str | None, typer.Option("--name", help="Name of the station on the page.")] = None,
    host: Annotated[
        str | None, typer.Option("--host", metavar="HOST", help="Where the page is served; 127.0.0.1 if left out.")
    ] = None,
    port: Annotated[
        int | None, typer.Option("--port", min=0, max=65535, help="Port of the page, 8470; 0 takes a free one.")
    ] = None,
    certificate: Annotated[
        Path | None, typer.Option("--certificate", metavar="PEM", help="Certificate for TLS, PEM.")
    ] = None,
    key_file: Annotated[Path | None, typer.Option("--key-file", metavar="PEM", help="Its key, PEM.")] = None,
    behind_proxy: Annotated[
        bool | None, typer.Option("--behind-proxy", help="A proxy in front serves TLS and sets X-Forwarded-Proto.")
    ] = None,
    login: Annotated[
        bool | None, typer.Option("--login", help="People log in at this machine too (elsewhere they always do).")
    ] = None,
) -> None:
    """Attach the vehicles, keep everything they send and serve the page; Ctrl-C ends.

    Example: stommel station --database sea.sqlite --link serial:/dev/ttyUSB0:57600 --key zju-1.key
    """
    from stommel.station.settings import load_settings

    told: dict[str, Any] = {
        "database": database, "folder": folder, "name": name, "host": host, "port": port, "certificate": certificate,
        "key_file": key_file, "behind_proxy": behind_proxy or None, "login": login or None,
        "vehicles": vehicles_told(link, vehicle, key, unsigned, model, speed),
    }  # fmt: skip
    with _simulated(sitl, speed, folder, told) as ended:
        run(load_settings(settings, told), ended)


@contextmanager
def _simulated(
    sitl: str | None, speed: float | None, folder: Path | None, told: dict[str, Any]
) -> Iterator[Mapping[int, Callable[[], str]]]:
    """Fly a simulated glider beside the station, and add it to what the station is told; gives why it flies no more."""
    if sitl is None:
        yield {}
        return
    from stommel.cli.station.simulated import SPEED, SimulatedGlider

    known = list(told["vehicles"] or ())
    number = next(n for n in range(1, 251) if n not in {vehicle["vehicle"] for vehicle in known})
    with SimulatedGlider(sitl, speed or SPEED, folder or Path("station"), number) as glider:
        told |= {"vehicles": [*known, glider.settings], "demo": True, "folder": glider.folder}
        yield {number: lambda: glider.ended}


def vehicles_told(
    links: Sequence[str] | None,
    numbers: Sequence[int] | None,
    keys: Sequence[Path] | None,
    unsigned: bool,
    model: str | None,
    speed: float | None,
) -> list[dict[str, Any]] | None:
    """Vehicles as the command line tells them; None if it names no link."""  # fmt: skip
    if not links:
        for option, value in (("--vehicle", numbers), ("--key", keys), ("--unsigned", unsigned), ("--model", model)):
            if value:
                raise typer.BadParameter("is of use only with --link", param_hint=option)
        return None
    for option, values in (("--vehicle", numbers), ("--key", keys)):
        if values and len(values) != len(links):
            raise typer.BadParameter(f"give one for each --link: {len(links)}, not {len(values)}", param_hint=option)
    told = []
    for k, link in enumerate(links):
        row: dict[str, Any] = {"vehicle": numbers[k] if numbers else k + 1, "link": link, "unsigned": unsigned}
        row |= {"key": keys[k]} if keys else {}
        row |= {"model": model} if model else {}
        row |= {"speed": speed} if speed is not None else {}
        told.append(row)
    return told


def run(settings: "StationSettings", ended: Mapping[int, Callable[[], str]] | None = None) -> None:
    """Serve a station until it is ended; `ended` tells of vehicles why they will never be heard again."""
    import logging

    from stommel.station.station import Station
    from stommel.station.web.app import create_app
    from stommel.station.web.exposure import Exposure
    from stommel.station.web.serving import listening, serve

    exposure = Exposure.told(settings)
    exposure.require_secret()
    logging.basicConfig(format="%(levelname)s: %(message)s", level=logging.WARNING)
    station = Station(settings)
    for number, words in (ended or {}).items():
        station.vehicles[number].ended = words
    try:
        exposure.require_people(station.people.users.admins())
        taken, exposure = listening(exposure)
        with taken:
            app = create_app(station, exposure)
            station.start()
            serve(app, exposure, taken, lambda: _greet(station, exposure.address))
    finally:
        station.stop()
    typer.echo("ended; everything that came is kept", err=True)


def _greet(station: "Station", address: str) -> None:
    """Say where the page is, and what is attached."""
    for line in station.vehicles.values():
        typer.echo(f"{line.settings.title}: {line.settings.link}", err=True)
    typer.echo(f"archive: {station.archive.name}", err=True)
    typer.echo(f"page: {address}  (Ctrl-C ends)")
