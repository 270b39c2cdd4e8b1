"""`stommel engine` through the front door."""

import re
from pathlib import Path

import pytest

from tests.support.command import Command
from tests.support.pages import commands, guide

KEYS = {
    "duration_s", "volume_ml", "energy_j", "peak_current_a", "pump_efficiency", "losses_j", "stalled", "piston_end_mm",
}  # fmt: skip
GUIDE = guide("engine")


def test_json(stommel: Command) -> None:
    found = stommel("engine", "zju", "--pressure-mpa", 2.0, "--inflate-ml", 500, "--json").json
    assert set(found) >= KEYS
    assert found["duration_s"] == pytest.approx(80.0, abs=0.1)
    assert found["volume_ml"] == pytest.approx(500.0, abs=0.2)
    assert found["stalled"] is False
    assert found["energy_residual"] < 1e-3
    assert found["oil_residual"] < 1e-6
    assert len(found["courses"]["t_s"]) == len(found["courses"]["current_a"])
    # the efficiency of section 5.1.2 from what is printed
    assert found["pump_efficiency"] == pytest.approx(2.0 * found["volume_ml"] / found["energy_j"], rel=1e-9)


def test_stall_is_a_result(stommel: Command) -> None:
    done = stommel("engine", "zju", "--pressure-mpa", 9, "--inflate-ml", 500, "--json")
    assert done.status == 0
    assert done.json["stalled"] is True
    assert done.json["outcome"] == "no flow"
    assert 7.5 < done.json["stall_pressure_mpa"] < 8.5
    assert done.json["volume_ml"] == pytest.approx(0.0, abs=0.01)
    shown = stommel("engine", "zju", "--pressure-mpa", 9, "--inflate-ml", 500).out
    assert "it inflates below 8 MPa" in shown


def test_terminal_and_plot(stommel: Command, tmp_path: Path) -> None:
    done = stommel(
        "engine",
        "zju",
        "--pressure-mpa",
        2,
        "--inflate-ml",
        500,
        "--deflate-ml",
        500,
        "--hold-s",
        10,
        "--plot",
        "cycle.png",
    )
    assert done.status == 0
    assert max(len(line) for line in done.out.splitlines()) <= 80
    assert (tmp_path / "cycle.png").read_bytes().startswith(b"\x89PNG")
    assert done.out.splitlines()[-1] == "wrote cycle.png"
    assert [path.name for path in tmp_path.iterdir()] == ["cycle.png"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("zju", "--pressure-mpa", -1), ["--pressure-mpa = -1: must be between 0 and 200 MPa"]),
        (("zju", "--pressure-mpa", "nan"), ["--pressure-mpa = nan: must be between 0 and 200 MPa"]),
        (("zju", "--inflate-ml", 600), ["inflate = 600 ml", "0 to 500.7 ml"]),
        (("zju", "--inflate-ml", -5), ["--inflate-ml = -5: must be between 0.001 and 100000 ml"]),
        (("zju", "--inflate-ml", 100, "--deflate-ml", 200), ["deflate = 200 ml", "inflated 100 ml"]),
        (("zju", "--inflate-ml", 100, "--hold-s", -1), ["--hold-s = -1: must be between 0 and 86400 s"]),
        (("zju", "--motor-speed-rpm", 0), ["--motor-speed-rpm = 0: must be between 1 and 50000 r/min"]),
        (("rogue",), ["no table [engine]", "slocum-1000m"]),
        (("zju", "--engine", "webb"), ["neither an example nor a file", "high-pressure, slocum-1000m"]),
        (("zju", "--plot", "."), ["cannot be written"]),
    ],
)
def test_refused(stommel: Command, arguments: tuple[object, ...], words: list[str]) -> None:
    done = stommel("engine", *arguments)
    assert done.status == 2, done
    assert done.out == ""
    assert len(done.err.splitlines()) == 1
    for word in words:
        assert word in done.err


EXAMPLES = commands(GUIDE, "engine")


@pytest.mark.parametrize("example", EXAMPLES, ids=" ".join)
def test_examples_of_the_guide(stommel: Command, example: list[str]) -> None:
    assert stommel(*example).status == 0


def test_guide_has_examples_and_its_own_engine(stommel: Command, tmp_path: Path) -> None:
    """The engine that the guide prints in full is an engine."""
    assert len(EXAMPLES) >= 5
    toml = re.search(r"```toml\n(format.*?)```", GUIDE, re.DOTALL)
    assert toml is not None
    (tmp_path / "mine.toml").write_text(toml[1], encoding="utf-8")
    found = stommel("engine", "zju", "--engine", "mine.toml", "--pressure-mpa", 5, "--inflate-ml", 100, "--json").json
    assert found["stalled"] is False
    assert found["engine"] == "my piston pump"
