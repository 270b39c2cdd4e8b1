"""The flight software needs no compiler and none of the tools of the desk. Oracle: the modules that a process has."""

import pkgutil
import subprocess
import sys

import stommel.instruments
import stommel.messages
import stommel.onboard

HEAVY = (
    "numba", "llvmlite", "scipy", "xarray", "pandas", "matplotlib", "rich", "typer", "netCDF4", "zarr", "gsw", "pyproj",
    "control", "SALib", "dask", "tomlkit",
)  # fmt: skip
MODULES = sorted(
    info.name
    for package in (stommel.onboard, stommel.instruments, stommel.messages)
    for info in pkgutil.walk_packages(package.__path__, f"{package.__name__}.")
)
PROGRAM = """
import sys
for name in sys.argv[2].split():
    __import__(name)
heavy = [name for name in sys.argv[1].split() if name in sys.modules]
assert not heavy, heavy
"""


def imported(modules: list[str], heavy: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-W", "error", "-c", PROGRAM, heavy, " ".join(modules)],
        capture_output=True, text=True, check=False, timeout=120, env=dict(_environment()),
    )  # fmt: skip


def _environment() -> dict[str, str]:
    import os

    return os.environ | {"STOMMEL_COMPILE": "0"}


def test_there_is_something_to_import() -> None:
    assert "stommel.onboard.coordination.config.configuration" in MODULES
    assert "stommel.messages.codec" in MODULES
    assert "stommel.instruments.tcm.driver" in MODULES
    assert len(MODULES) > 20


def test_flight_software_imports_nothing_heavy() -> None:
    """Every module of onboard, instruments and messages in one process: none of these, not even through others."""
    done = imported(MODULES, " ".join(HEAVY))
    assert done.returncode == 0, done.stderr


def test_the_test_finds_what_is_heavy() -> None:
    done = imported(["stommel.cli.app"], "scipy typer")
    assert done.returncode == 1
    assert "AssertionError: ['typer']" in done.stderr


def test_configuration_and_decision_need_little() -> None:
    """What starts a vehicle: neither cantools nor python-can is loaded before the bus is opened."""
    done = imported(["stommel.onboard.coordination.config", "stommel.control.decision"], "can cantools serial")
    assert done.returncode == 0, done.stderr
