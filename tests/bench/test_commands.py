"""`stommel bench` as its users run it: JSON, tables of 80 columns, plots, refusals, and the guide's examples."""

from pathlib import Path

import pytest

from stommel.bench import MARKER
from tests.support.command import Command, Outcome
from tests.support.pages import commands, guide


@pytest.fixture
def log(stommel: Command, tmp_path: Path) -> Path:
    made = stommel("bench", "generate", "zju", "--output", "bench.csv", "--seed", 5, "--period-s", 1, "--json")
    assert made.status == 0, made.err
    assert made.json["origin"] == MARKER
    assert made.json["runs"] == 24
    return tmp_path / "bench.csv"


def readable(found: Outcome) -> None:
    assert found.status == 0, found.err
    assert max(len(line) for line in found.out.splitlines()) <= 80


def test_analyse(stommel: Command, log: Path, tmp_path: Path) -> None:
    found = stommel("bench", "analyse", log, "--plots", "figures/bench", "--json").json
    assert found["generated"] is True
    assert found["origin"] == MARKER
    assert len(found["runs"]) == 24
    assert found["choice"]["motor_speed_rpm"] == pytest.approx(7000.0, rel=0.002)
    assert len(found["written"]) == 4
    assert all((tmp_path / path).stat().st_size > 5000 for path in found["written"])
    assert MARKER in " ".join(stommel("bench", "analyse", log).out.split())
    readable(stommel("bench", "analyse", log))


def test_fit(stommel: Command, log: Path, tmp_path: Path) -> None:
    found = stommel("bench", "fit", log, "--plots", "fit", "--json").json
    assert found["generated"] is True
    assert len(found["parameters"]) == 5
    for one in found["parameters"]:
        assert one["interval_95"][0] < one["value"] < one["interval_95"][1]
        assert one["true"] is not None
        assert one["true_inside"] is True
    assert len(found["correlation"]) == 5
    assert all((tmp_path / path).is_file() for path in found["written"])
    readable(stommel("bench", "fit", log))


def test_columns_by_options(stommel: Command, log: Path) -> None:
    """Without a column map beside the log, options say the same; the mark in the log remains."""
    expected = stommel("bench", "analyse", log, "--json").json["runs"]
    log.with_suffix(".toml").unlink()
    units = {"time": "time_s:s", "pressure": "pressure_mpa:MPa", "motor_speed": "motor_speed_rpm:r/min"}
    units |= {"voltage": "voltage_v:V", "current": "current_a:A", "piston_travel": "piston_travel_mm:mm"}
    options = [part for name, rest in units.items() for part in ("--column", f"{name}={rest}")]
    found = stommel("bench", "analyse", log, "--column", "run=run", *options, "--json").json
    assert found["runs"] == expected
    assert found["generated"] is True
    constant = stommel("bench", "analyse", log, "--column", "run=run", *options, "--constant", "voltage=24:V", "--json")
    assert all(run["voltage_v"] == 24.0 for run in constant.json["runs"])


def test_speed(stommel: Command) -> None:
    found = stommel("bench", "speed", "zju", "--time-limit-s", 90, "--json").json
    assert found["origin"] == MARKER
    assert found["choice"]["motor_speed_rpm"] == pytest.approx(7000.0)
    readable(stommel("bench", "speed", "zju"))


def test_pressure(stommel: Command, tmp_path: Path) -> None:
    found = stommel("bench", "pressure", "fan2013-table5", "--plot", "table5.pdf", "--json").json
    assert found["passed"] is True
    assert [hold["loss_mpa"] for hold in found["holds"]] == pytest.approx([0.067, 0.075, 0.073, 0.042, 0.046, 0.025])
    assert all((tmp_path / path).is_file() for path in found["written"])
    readable(stommel("bench", "pressure", "fan2013-table5"))


def test_a_failed_pressure_test_is_a_result(stommel: Command, tmp_path: Path) -> None:
    (tmp_path / "bad.csv").write_text("hold,from,to,from_pressure_mpa,to_pressure_mpa\n1,10:00,11:00,2.4,2.1\n")
    found = stommel("bench", "pressure", "bad.csv", "--json")
    assert found.status == 0
    assert found.json["passed"] is False
    assert "FAILED" in stommel("bench", "pressure", "bad.csv").out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("analyse", "nowhere.csv"), ["nowhere.csv: cannot be read: No such file"]),
        (("analyse", "bench.csv", "--column", "pressure"), ["--column 'pressure'", "QUANTITY=COLUMN:UNIT"]),
        (("analyse", "bench.csv", "--column", "depth=d:m"), ["depth=d:m", "pressure, motor_speed"]),
        (("analyse", "bench.csv", "--column", "pressure=pressure_mpa:atm"), ["'atm'", "unknown unit"]),
        (("analyse", "bench.csv", "--column", "pressure=depth:MPa"), ["column 'depth'", "missing"]),
        (("analyse", "bench.csv", "--constant", "voltage=high:V"), ["'high' is not a number"]),
        (("analyse", "bench.csv", "--time-limit-s", 0), ["--time-limit-s = 0: must be between 0.1 and 86400 s"]),
        (("analyse", "bench.csv", "--vehicle", "rogue"), ["[engine]"]),
        (("fit", "bench.csv", "--parameter", "colour"), ["'colour'", "unknown"]),
        (
            ("fit", "bench.csv", "--parameter", "pump_friction_n_m", "--parameter", "no_load_current_a"),
            ["tell them apart"],
        ),
        (("generate", "zju", "--output", "x.toml"), ["x.toml", ".csv"]),
        (("generate", "zju", "--output", "x.csv", "--seed", -1), ["seed = -1"]),
        (("generate", "zju", "--output", "x.csv", "--noise", -1), ["noise = -1"]),
        (("generate", "zju", "--output", "x.csv", "--period-s", 0), ["--period-s = 0: must be between 0.01 and 60 s"]),
        (
            ("generate", "zju", "--output", "x.csv", "--speed-rpm", "0"),
            ["--speed-rpm = 0: must be between 1"],
        ),
        (("generate", "zju", "--output", "x.csv", "--pressure-mpa", "-1"), ["pressure"]),
        (("speed", "zju", "--margin-percent", -1), ["--margin-percent = -1: must be between 0 and 100 %"]),
        (("pressure", "nowhere.csv"), ["nowhere.csv", "No such file"]),
    ],
)
def test_refused(stommel: Command, log: Path, arguments: tuple[object, ...], words: list[str]) -> None:
    found = stommel("bench", *arguments)
    assert found.status == 2, found
    assert found.out == ""
    assert len(found.err.splitlines()) == 1, found.err
    assert found.err.startswith("error: ")
    for word in words:
        assert word in found.err


def test_nothing_half_written_is_left(stommel: Command, tmp_path: Path) -> None:
    stommel("bench", "generate", "zju", "--output", "x.csv", "--seed", -1)
    assert list(tmp_path.iterdir()) == []


def test_the_guide_s_examples_run(stommel: Command) -> None:
    calls = commands(guide("bench"))
    assert len(calls) >= 5
    for arguments in calls:
        found = stommel(*arguments)
        assert found.status == 0, (arguments, found.err)
