"""The TOML files that ship with stommel, and the verbs that read them."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path
from types import MappingProxyType

STUDY = """
format = 1
name = "pitch"
mission = "pool_trial"
kind = "monte_carlo"
runs = 2
seed = 1
outputs = ["days"]

[[parameters]]
key = "mission.dives.pitch_deg"
distribution = "normal"
mean = 12
standard_deviation = 1
at_least = 8
at_most = 20
"""


@dataclass(frozen=True)
class Shipped:
    """A file, what it describes, and the calls of the command that read it; the first one reads it before all else."""

    kind: str
    name: str
    text: str
    verbs: tuple[tuple[object, ...], ...]
    beside: Mapping[str, bytes] = field(default_factory=lambda: MappingProxyType({}))
    """Files that it needs beside it."""


def _vehicle(name: str, text: str) -> Shipped:
    flight = ("--speed", 0.3, "--pitch", -30, "--json")
    verbs: tuple[tuple[object, ...], ...] = (
        ("vehicle", "check", name, "--json"),
        ("budget", name, "--json"),
        ("trim", name, *flight),
        ("modes", name, *flight),
        ("drives", name, "--json"),
        ("engine", name, "--pressure-mpa", 1, "--json"),
        ("endurance", name, "--json"),
        ("hull", name, "--json"),
        ("envelope", name, "--json"),
        ("flight-table", name, "--json"),
        ("design", name, "--no-report", "--json"),
    )
    return Shipped("vehicle", name, text, verbs)


def _all() -> tuple[Shipped, ...]:
    found = []
    for path in _folder("stommel.vehicle", "builtin"):
        found.append(_vehicle(path.name, path.read_text(encoding="utf-8")))
    for path in _folder("stommel.machinery.engine", "examples"):
        verb = ("engine", "zju", "--engine", path.name, "--pressure-mpa", 2, "--deflate-ml", 100, "--json")
        found.append(Shipped("engine", path.name, path.read_text(encoding="utf-8"), (verb,)))
    for path in _folder("stommel.simulation.scenario", "missions"):
        verb = ("simulate", path.name, "--json")
        found.append(Shipped("mission", path.name, path.read_text(encoding="utf-8"), (verb,)))
    text = (Path(str(files("stommel.machinery.hull"))) / "materials.toml").read_text(encoding="utf-8")
    verb = ("hull", "zju", "--materials", "materials.toml", "--json")
    found.append(Shipped("materials", "materials.toml", text, (verb,)))
    found.append(Shipped("study", "study.toml", STUDY, (("study", "study.toml", "--workers", 1, "--json"),)))
    bench = Path(str(files("stommel.bench"))) / "examples"
    found.append(
        Shipped(
            "bench",
            "fan2013-table5.toml",
            (bench / "fan2013-table5.toml").read_text(encoding="utf-8"),
            (("bench", "pressure", "./fan2013-table5.csv", "--json"),),
            {"fan2013-table5.csv": (bench / "fan2013-table5.csv").read_bytes()},
        )
    )
    return tuple(found)


def _folder(package: str, name: str) -> list[Path]:
    return sorted((Path(str(files(package))) / name).glob("*.toml"))


SHIPPED = _all()

COLUMN_MAP = """
format = 1
origin = "measured"
delimiter = ","
piston_diameter_mm = 50

[columns]
run = "run"
time = { column = "time_s", unit = "s" }
pressure = { column = "pressure_mpa", unit = "MPa", range = [-0.1, 10.0] }
motor_speed = { column = "motor_speed_rpm", unit = "r/min", setting = true }
voltage = { value = 24, unit = "V" }
current = { column = "current_a", unit = "A" }
piston_travel = { column = "piston_travel_mm", unit = "mm" }

[checks]
longest_gap = 3.0
stuck_rows = 10
saturated_rows = 3
fewest_rows = 20
"""
"""A column map of an engine log; it is no shipped file, and every key of one stands in it."""
