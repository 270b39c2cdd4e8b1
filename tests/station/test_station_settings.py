"""What a station is told. Oracle: the rules of errors: file, key, value, and what is allowed."""

from pathlib import Path
from typing import Any

import pytest

from stommel.errors import FileError, StommelError
from stommel.station.settings import load_settings
from stommel.station.station import Station

VEHICLE = {"vehicle": 1, "link": "tcp:127.0.0.1:5760", "unsigned": True}
FILE = """
name = "Pier 3"
port = 9000
folder = "kept"
[[vehicles]]
vehicle = 3
link = "serial:/dev/ttyUSB0:57600"
key = "sea.key"
model = "mine.toml"
[alerts]
quiet_s = 60
"""


def test_a_file_is_read_with_paths_from_where_it_lies_and_the_command_line_over_it(tmp_path: Path) -> None:
    file = tmp_path / "station.toml"
    file.write_text(FILE)
    settings = load_settings(file, {"port": 9001, "name": None})
    assert (settings.name, settings.port, settings.folder) == ("Pier 3", 9001, tmp_path / "kept")
    (vehicle,) = settings.vehicles
    assert (vehicle.key, vehicle.model) == (tmp_path / "sea.key", str(tmp_path / "mine.toml"))
    assert settings.database_url == f"sqlite:///{tmp_path / 'kept' / 'archive.sqlite'}"
    assert settings.alerts.quiet_s == 60


@pytest.mark.parametrize(
    ("told", "words"),
    [
        ({"vehicles": [VEHICLE | {"vehicle": 0}]}, "between 1 and 250"),
        ({"vehicles": [VEHICLE | {"vehicle": 251}]}, "between 1 and 250"),
        ({"vehicles": [VEHICLE | {"link": "carrier pigeon"}]}, "serial:"),
        ({"vehicles": [VEHICLE, VEHICLE]}, "there twice"),
        ({"vehicles": [VEHICLE, VEHICLE | {"vehicle": 2}]}, "each vehicle needs a line of its own"),
        ({"vehicles": [{"vehicle": 1, "link": "pty"}]}, "unsigned = true"),
        ({"vehicles": [VEHICLE | {"key": "a.key"}]}, "leave out unsigned"),
        ({"vehicles": [VEHICLE | {"speed": 0.0}]}, "0.1"),
        ({"vehicles": [VEHICLE | {"speed": 1e6}]}, "1000"),
        ({"port": 70_000}, "65535"),
        ({"prot": 1}, "port"),
        ({"name": ""}, "empty"),
    ],
)
def test_what_cannot_be_is_refused_with_the_key_and_what_is_allowed(told: dict[str, Any], words: str) -> None:
    with pytest.raises(StommelError) as error:
        load_settings(None, told)
    assert words in str(error.value)


def test_several_problems_are_told_at_once(tmp_path: Path) -> None:
    file = tmp_path / "station.toml"
    file.write_text("port = 70000\nbehind_proxy = 3\n")
    with pytest.raises(FileError) as error:
        load_settings(file)
    assert len(error.value.problems) == 2
    assert all(problem.file == str(file) for problem in error.value.problems)


def test_a_second_station_on_the_same_folder_is_refused_by_name(tmp_path: Path) -> None:
    settings = load_settings(None, {"folder": tmp_path})
    first = Station(settings)
    try:
        with pytest.raises(StommelError, match="another station uses it"):
            Station(settings)
    finally:
        first.stop()
    Station(settings).stop()


def test_a_line_that_is_taken_is_refused_while_the_station_runs(tmp_path: Path) -> None:
    station = Station(load_settings(None, {"folder": tmp_path, "vehicles": [VEHICLE]}))
    try:
        other = load_settings(None, {"vehicles": [VEHICLE | {"vehicle": 2}]}).vehicles[0]
        with pytest.raises(StommelError, match="leads to vehicle 1 already"):
            station.attach(other)
        with pytest.raises(StommelError, match="has it already"):
            station.attach(station.settings.vehicles[0])
        free = other.model_copy(update={"link": "tcp:127.0.0.1:5761"})
        assert station.attach(free).vehicle == 2
    finally:
        station.stop()
