"""Every kind of file that users write, with what loads it, and everything that can be wrong with a file."""

import os
import signal
import socket
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

import pytest

from stommel.bench import load_map, read_engine_log, read_pressure_test
from stommel.bench.column_map import EngineLogMap
from stommel.control.flight_table_file import read_flight_table
from stommel.control.orders_file import read_orders
from stommel.dynamics.state_files import read_states
from stommel.machinery.engine import load_engine
from stommel.machinery.hull import load_materials
from stommel.mission.loading import load_plan
from stommel.onboard.coordination.compass.calibration_file import read_calibration
from stommel.onboard.coordination.compass.samples_file import read_samples
from stommel.onboard.coordination.config import read_configuration
from stommel.seawater import read_stratification
from stommel.simulation.scenario.loading import load_mission
from stommel.studies.study import load_study
from stommel.vehicle import builtin_text, load_vehicle
from tests.support.configuration import CALIBRATION, CONFIGURATION
from tests.support.orders import ORDERS

COLUMNS = """
[columns]
time = { column = "t", unit = "s" }
pressure = { column = "p", unit = "MPa" }
motor_speed = { column = "n", unit = "r/min" }
voltage = { value = 24, unit = "V" }
current = { column = "I", unit = "A" }
piston_travel = { column = "s", unit = "mm" }
"""
HOLDS = "hold,from,to,from_pressure_mpa,to_pressure_mpa\n1,08:00,09:00,3.0,2.95\n"
STUDY = """
name = "two pools"
mission = "pool_trial"
kind = "sweep"
[[parameters]]
key = "mission.seed"
values = [1, 2]
"""


PLAN = """
name = "to the buoy"
waypoints = [{ latitude_deg = 18.5, longitude_deg = 116.5 }]
dives = { depth_m = 80, pitch_deg = 30, speed_m_s = 0.3 }
"""
WAY = """
moving_mass_mm = [[1, 2], [3, 4]]
angle_of_attack_deg = [[1, 2], [3, 4]]
speed_m_s = [[0.1, 0.2], [0.3, 0.4]]
turn_pole_per_s = [[-1, -2], [-3, -4]]
turn_drive_per_s2 = [[1, 2], [3, 4]]
"""
FLIGHT_TABLE = f"""
format = 1
kind = "flight table"
vehicle = "mine"
vehicle_sha256 = "{"0" * 64}"
physics = "full"
stommel = "0"
density_kg_m3 = 1025
drag_per_mass_per_m = 0.1
pitch_deg = [20, 30]
ballast_ml = [100, 200]
[dive]{WAY}[climb]{WAY}
"""


def shipped(package: str, name: str) -> str:
    return (resources.files(package) / name).read_text(encoding="utf-8")


def _map(path: str) -> EngineLogMap:
    log = Path("log.csv")
    log.write_text("t,p\n1,2\n")
    return load_map(log, Path(path))


def _described(path: str) -> Any:
    table = Path("holds.csv")
    table.write_text(HOLDS)
    return read_pressure_test(table, Path(path)).description


def _log(path: str) -> Any:
    quantity = {"unit": "s", "column": "t"}
    names = ("time", "pressure", "motor_speed", "voltage", "current", "piston_travel")
    units = {"pressure": "MPa", "motor_speed": "r/min", "voltage": "V", "current": "A", "piston_travel": "mm"}
    columns = {name: quantity | {"unit": units.get(name, "s")} for name in names}
    return read_engine_log(Path(path), EngineLogMap.model_validate({"columns": columns}))


TOML_KINDS: dict[str, tuple[Callable[[str], Any], Callable[[], str]]] = {
    "vehicle": (lambda path: load_vehicle(path).document, lambda: builtin_text("zju")),
    "mission": (
        lambda path: load_mission(path).scenario,
        lambda: shipped("stommel.simulation.scenario", "missions/pool_trial.toml"),
    ),
    "plan": (load_plan, lambda: PLAN),
    "flight table": (lambda path: str(read_flight_table(path)), lambda: FLIGHT_TABLE),
    "orders": (lambda path: str(read_orders(path)), lambda: ORDERS),
    "configuration": (lambda path: read_configuration(path).file, lambda: CONFIGURATION),
    "compass calibration": (read_calibration, lambda: CALIBRATION),
    "study": (lambda path: load_study(path).file, lambda: STUDY),
    "engine": (load_engine, lambda: shipped("stommel.machinery.engine", "examples/high-pressure.toml")),
    "materials": (lambda path: load_materials(Path(path)), lambda: shipped("stommel.machinery.hull", "materials.toml")),
    "column map": (_map, lambda: COLUMNS),
    "pressure test": (_described, lambda: 'title = "a test"\n[limits]\nlargest_loss_mpa = 0.2\n'),
}
"""What loads a file of each kind from a path, and the text of a good one."""

TABLES: dict[str, Callable[[str], Any]] = {
    "profile": read_stratification,
    "engine log": _log,
    "table of holds": lambda path: read_pressure_test(path),
    "compass samples": read_samples,
    "states": lambda path: read_states(Path(path)),
}
"""What loads the other texts."""

LOADERS = {name: load for name, (load, _) in TOML_KINDS.items()} | TABLES


@dataclass(frozen=True)
class Refused:
    """A path that cannot be read, and what is said about it."""

    make: Callable[[Path], str]
    """Makes it in a folder."""
    sentence: str
    """What follows the name of the file."""


def _written(content: bytes) -> Callable[[Path], str]:
    def make(folder: Path) -> str:
        (folder / "x.toml").write_bytes(content)
        return str(folder / "x.toml")

    return make


def _pipe(folder: Path) -> str:
    os.mkfifo(folder / "x.toml")
    return str(folder / "x.toml")


def _folder(folder: Path) -> str:
    (folder / "x.toml").mkdir()
    return str(folder / "x.toml")


def _socket(folder: Path) -> str:
    with socket.socket(socket.AF_UNIX) as end:
        end.bind(str(folder / "x.toml"))
    return str(folder / "x.toml")


def _link(folder: Path) -> str:
    (folder / "x.toml").symlink_to(folder / "x.toml")
    return str(folder / "x.toml")


def _large(folder: Path) -> str:
    with (folder / "large.txt").open("wb") as file:
        file.truncate(100 * 1000 * 1000)
    return str(folder / "large.txt")


UNREADABLE = {
    "pipe": Refused(_pipe, "it is a pipe"),
    "folder": Refused(_folder, "it is a folder"),
    "socket": Refused(_socket, "it is a socket"),
    "zero": Refused(lambda _: "/dev/zero", "it is a device"),
    "random": Refused(lambda _: "/dev/urandom", "it is a device"),
    "full": Refused(lambda _: "/dev/full", "it is a device"),
    "missing": Refused(lambda folder: str(folder / "nowhere.toml"), "No such file or directory"),
    "no such folder": Refused(lambda folder: str(folder / "no" / "x.toml"), "No such file or directory"),
    "in a file": Refused(lambda folder: f"{_written(b'')(folder)}/x.toml", "Not a directory"),
    "circle": Refused(_link, "Too many levels of symbolic links"),
    "long name": Refused(lambda folder: str(folder / f"{'x' * 300}.toml"), "File name too long"),
    "long path": Refused(lambda folder: f"{folder}/{'x/' * 3000}x.toml", "File name too long"),
    "empty": Refused(lambda _: "", "it is a folder, the one that you are in"),
    "here": Refused(lambda _: ".", "it is a folder, the one that you are in"),
    "root": Refused(lambda _: "/", "it is a folder"),
    "latin": Refused(
        _written("# fine\nname = 'Gleiter für'".encode("latin-1")), "it is not UTF-8 text: line 2 has the byte 0xfc"
    ),
    "utf-16": Refused(_written("name = 1".encode("utf-16")), "it is not UTF-8 text: line 1 has the byte 0xff"),
}
"""Of any file: what is wrong with it, and how that is said after "cannot be read: "."""

LARGE = Refused(_large, "it is larger than {} MiB, the most that is read")

_INTEGER = (
    "table.key: must be a whole number between -9223372036854775808 and 9223372036854775807, the integers of TOML"
)
_DEEP = "is nested too deeply: at most 32 tables and lists may stand within each other"

NOT_USABLE = {
    "5000 digits": Refused(_written(b"[table]\nkey = " + b"7" * 5000), _INTEGER),
    "-5000 digits": Refused(_written(b"[table]\nkey = -" + b"7_" * 5000 + b"7"), _INTEGER),
    "5000 digits in a list": Refused(
        _written(b"key = [1, " + b"7" * 5000 + b"]"), _INTEGER.replace("table.key", "key.1")
    ),
    "20 digits": Refused(_written(b"[table]\nkey = 9223372036854775808"), _INTEGER),
    "6000 hexadecimal digits": Refused(_written(b"[table]\nkey = 0x" + b"f" * 6000), _INTEGER),
    "lists in lists": Refused(_written(b"key = " + b"[" * 100_000 + b"]" * 100_000), _DEEP),
    "33 lists": Refused(_written(b"key = " + b"[" * 33 + b"]" * 33), _DEEP),
    "tables in tables": Refused(_written(b"key = " + b"{a=" * 50_000 + b"1" + b"}" * 50_000), _DEEP),
    "a key of 100 000 parts": Refused(_written(b".".join([b"a"] * 100_000) + b" = 1"), _DEEP),
    "a table of 100 000 parts": Refused(_written(b"[" + b" . ".join([b'"a b"'] * 100_000) + b"]"), _DEEP),
    "a key twice": Refused(
        _written(b"[table]\nkey = 1\nkey = 2\nother = 3\n"), "is not valid TOML: line 3: key stands twice"
    ),
    "a key twice, at the end": Refused(
        _written(b"key = 1\r\n\r\nkey = 2"), "is not valid TOML: line 3: key stands twice"
    ),
    "a table twice": Refused(
        _written(b"[a.b]\nkey = 1\n[a.b]\nkey = 2\n"), "is not valid TOML: line 3: a.b stands twice"
    ),
    "an inline key twice": Refused(
        _written(b"a = 1\nb = { c = 1, c = 2 }\n"), "is not valid TOML: line 2: c stands twice"
    ),
    "no value": Refused(_written(b"key =\n"), "is not valid TOML: Invalid value (at line 1, column 6)"),
    "zeros": Refused(_written(bytes(100)), "is not valid TOML: Invalid statement (at line 1, column 1)"),
}
"""Of TOML files: what is wrong with the text, and how that is said after the name of the file."""


@contextmanager
def in_time(seconds: int) -> Iterator[None]:
    """Fail, and not hang, where what is inside waits for ever."""

    def too_late(*_: object) -> None:
        pytest.fail(f"no answer within {seconds} s")

    before = signal.signal(signal.SIGALRM, too_late)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)
