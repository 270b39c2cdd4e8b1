"""What a station is told: `station.toml`, and the command line over it."""

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

from stommel.files.fields import Name
from stommel.files.kinds import Flag
from stommel.files.ranges import between
from stommel.files.sentences import PRINTABLE, validated
from stommel.files.toml_reader import read_toml
from stommel.link.transports.address import read_address
from stommel.station.alarms.alert_settings import AlarmSettings, AlertSettings
from stommel.station.clock import LEAST_SPEED, MOST_SPEED

MOST_VEHICLES = 100
_PATHS = Field(min_length=1, max_length=1000, pattern=PRINTABLE)
Text = Annotated[str, _PATHS]
VehicleNumber = Annotated[int, Field(strict=True, ge=1, le=250)]
Port = Annotated[int, Field(strict=True, ge=0, le=65_535)]


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class VehicleSettings(_Table):
    """A vehicle, and how it is reached."""

    vehicle: VehicleNumber
    """Its system number on the link."""
    link: Text
    """Address: serial:/dev/ttyUSB0:57600, tcp:HOST:PORT, udp:HOST:PORT, ..."""
    name: Annotated[str, Field(max_length=80, pattern=PRINTABLE)] = ""
    model: Text = "zju"
    """Vehicle file, or the name of a built-in one."""
    key: Path | None = None
    """Key file of the vehicle (`stommel link key new`)."""
    unsigned: Flag = False
    """Speak to a vehicle that was told to believe everybody."""
    speed: Annotated[float, between(LEAST_SPEED, MOST_SPEED)] = 1.0
    """Of a simulated vehicle, times real time."""
    fetch: Literal["nothing", "essential", "detail", "raw"] = "nothing"
    """Least important series of its log that comes ashore by itself at each surfacing; those that matter more too."""
    simulated: Flag = False
    """Whether it lives in a world with a clock of its own; at another speed than 1 it always does."""

    @model_validator(mode="after")
    def _check(self) -> "VehicleSettings":
        if (self.key is None) != self.unsigned:
            told = "give the vehicle's key, or unsigned = true for a vehicle that was told to believe everybody"
            raise ValueError(told if self.key is None else "a key signs; leave out unsigned")
        return self

    @property
    def title(self) -> str:
        """What people call it."""
        return self.name or f"vehicle {self.vehicle}"

    @property
    def is_simulated(self) -> bool:
        """Whether it is no real vehicle."""
        return self.simulated or self.speed != 1.0


class StationSettings(_Table):
    """A whole station."""

    name: Name = "Shore station"
    host: Text = "127.0.0.1"
    port: Port = 8470
    database: Text = ""
    """URL of the archive; empty: `archive.sqlite` in the folder."""
    folder: Path = Path("station")
    """Files of vehicles, and what must outlive the program."""
    certificate: Path | None = None
    key_file: Path | None = None
    behind_proxy: Flag = False
    """A proxy in front serves TLS, and says so in X-Forwarded-Proto."""
    proxies: Annotated[tuple[Text, ...], Field(max_length=20)] = ("127.0.0.1", "::1")
    """Addresses of the proxy, whose X-Forwarded-For and X-Forwarded-Proto are believed."""
    login: Flag = False
    """Whether people log in at the station's own machine too."""
    known_as: Annotated[tuple[Text, ...], Field(max_length=20)] = ()
    """Names by which browsers ask for it; none allows any, where people log in."""
    address: Annotated[str, Field(max_length=500, pattern=PRINTABLE)] = ""
    """Of the page as people reach it; stands in alerts."""
    demo: Flag = False
    """Whether the page shows the guided first five minutes by itself."""
    alarms: AlarmSettings = AlarmSettings()
    alerts: AlertSettings = AlertSettings()
    vehicles: Annotated[tuple[VehicleSettings, ...], Field(max_length=MOST_VEHICLES)] = ()

    @model_validator(mode="after")
    def _check(self) -> "StationSettings":
        numbers, links = set[int](), dict[str, int]()
        for vehicle in self.vehicles:
            if vehicle.vehicle in numbers:
                raise ValueError(f"vehicles: number {vehicle.vehicle} is there twice; each vehicle has its own")
            numbers.add(vehicle.vehicle)
            read_address(vehicle.link, f"vehicles.{vehicle.vehicle}.link")
            if vehicle.link != "pty" and not vehicle.link.endswith(":0") and vehicle.link in links:
                raise ValueError(
                    f"vehicles: {links[vehicle.link]} and {vehicle.vehicle} have the same link {vehicle.link}; "
                    "each vehicle needs a line of its own"
                )
            links[vehicle.link] = vehicle.vehicle
        return self

    @property
    def database_url(self) -> str:
        """URL of the archive."""
        return self.database or f"sqlite:///{self.folder / 'archive.sqlite'}"


def load_settings(path: Path | None, told: dict[str, Any] | None = None) -> StationSettings:
    """Read `station.toml`; what the command line tells stands over it. Paths are from where the file lies.

    Raises
    ------
    FileError
        The file cannot be read, or one problem for each wrong key, with what is allowed.
    """
    document: dict[str, Any] = {} if path is None else read_toml(path)
    if path is not None:
        _from_file(document, path.parent)
    document |= {key: value for key, value in (told or {}).items() if value is not None}
    return validated(document, StationSettings, "station" if path is None else str(path))


def _from_file(document: dict[str, Any], folder: Path) -> None:
    """Paths of a file are from the file."""
    for key in ("folder", "certificate", "key_file"):
        if isinstance(document.get(key), str):
            document[key] = folder / document[key]
    alerts = document.get("alerts")
    if isinstance(alerts, dict):
        webhooks = alerts.get("webhooks")
        for way in (alerts.get("email"), *(webhooks if isinstance(webhooks, list) else ())):
            for key in ("password_file", "secret_file", "ca_file"):
                if isinstance(way, dict) and isinstance(way.get(key), str):
                    way[key] = folder / way[key]
    vehicles = document.get("vehicles")
    for vehicle in vehicles if isinstance(vehicles, list) else ():
        if isinstance(vehicle, dict) and isinstance(vehicle.get("key"), str):
            vehicle["key"] = folder / vehicle["key"]
        if isinstance(vehicle, dict) and str(vehicle.get("model", "")).endswith(".toml"):
            vehicle["model"] = str(folder / vehicle["model"])
