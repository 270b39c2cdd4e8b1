"""Oracle: the folder itself. Every verb says in one way what it wrote, and refuses in one way what it cannot write."""

import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.main import get_command

from stommel.cli.app import app
from stommel.errors import OutputError
from tests.onboard.coordination.magnetic_vehicle import MagneticVehicle, samples_text

MISSION = """
name = "an hour of dives"
vehicle = "zju"
start_time = 2026-07-01T00:00:00Z
duration_days = 0.04
start = { latitude_deg = 18.0, longitude_deg = 115.0 }
waypoints = [{ latitude_deg = 19.0, longitude_deg = 115.0 }]
dives = { depth_m = 40, pitch_deg = 35, ballast_ml = 200 }
ocean = { name = "still" }
"""
STUDY = """
name = "two"
mission = "mission.toml"
kind = "monte_carlo"
runs = 2
parameters = [{ key = "mission.dives.pitch_deg", distribution = "uniform", from = 30, to = 40 }]
"""
PLAN = """{"name": "a hop", "vehicle": "zju", "start_time": "2026-07-01T00:00:00Z", "duration_days": 0.1,
"start": {"latitude_deg": 18.0, "longitude_deg": 115.0}, "waypoints": [{"latitude_deg": 18.5, "longitude_deg": 115.0}],
"dives": {"depth_m": 50, "pitch_deg": 35, "ballast_ml": 100}, "water": {"ocean": "south_china_sea"}}
"""
LOCUS = ("root-locus", "zju", "--over", "wing_position", "--from", "0", "--to", "0.2", "--points", "2")
PICTURES = ("trial", "sawtooth", "map", "energy", "actuators", "ctd")


def both(folder: str, *names: str) -> list[str]:
    return [f"{folder}/{name}{ending}" for name in names for ending in (".png", ".svg")]


WRITERS: dict[str, tuple[tuple[str, ...], list[str]]] = {
    "design": (("design", "rogue", "--output", "new/r.html"), ["new/r.html"]),
    "root-locus": ((*LOCUS, "--plot", "l.svg"), ["l.svg"]),
    "hull": (("hull", "zju", "--plot", "new/h.pdf"), ["new/h.pdf"]),
    "drives": (("drives", "zju", "--plot", "d.png"), ["d.png"]),
    "engine": (("engine", "zju", "--inflate-ml", "100", "--plot", "e.png"), ["e.png"]),
    "endurance": (("endurance", "zju", "--plot", "e.svg"), ["e.svg"]),
    "budget": (("budget", "zju", "--apply", "mine.toml", "--plot", "b.PNG"), ["mine.toml", "b.PNG"]),
    "flight-table": (("flight-table", "zju", "--output", "f.toml"), ["f.toml"]),
    "orders": (("orders", "mission.toml", "--output", "new/o.toml"), ["new/o.toml"]),
    "plan check": (("plan", "check", "plan.json", "--output", "new/o.toml"), ["new/o.toml"]),
    "plan preview": (("plan", "preview", "plan.json", "--output", "new/p.json"), ["new/p.json"]),
    "plan open": (
        ("plan", "open", "orders.toml", "--vehicle", "zju", "--start", "18,115", "--output", "new/p.json"),
        ["new/p.json"],
    ),
    "simulate": (
        ("simulate", "mission.toml", "--output", "m.nc", "--track", "t.KML", "--plots", "all"),
        ["m.nc", "t.KML", *both("all", *PICTURES), "all/mission.html"],
    ),
    "study": (
        ("study", "study.toml", "--workers", "1", "--output", "s.nc", "--plots", "p"),
        ["s.nc", *both("p", "runs")],
    ),
    "sitl fly": (
        ("sitl", "fly", "mission.toml", "--output", "m.nc", "--track", "t.KML", "--plots", "all"),
        ["m.nc", "t.KML", *both("all", *PICTURES), "all/mission.html"],
    ),
    "vehicle config": (("vehicle", "config", "zju", "--force", "--output", "new"), ["new/CONFIG.toml"]),
    "vehicle calibrate-compass": (
        ("vehicle", "calibrate-compass", "samples.csv", "--force", "--output", "new/c.toml"),
        ["new/c.toml"],
    ),
    "vehicle new": (("vehicle", "new", "mine.toml"), ["mine.toml"]),
    "bench generate": (("bench", "generate", "zju", "--output", "new/log.csv"), ["new/log.csv", "new/log.toml"]),
    "bench analyse": (("bench", "analyse", "bench.csv", "--plots", "p"), both("p", "performance", "response")),
    "bench fit": (("bench", "fit", "bench.csv", "--plots", "p"), both("p", "fit", "fit-curves")),
    "bench pressure": (("bench", "pressure", "fan2013-table5", "--plot", "t.png"), ["t.png"]),
    "ocean show": (("ocean", "show", "pool", "--plot", "o.png"), ["o.png"]),
    "link key new": (("link", "key", "new", "new/zju-1.key"), ["new/zju-1.key"]),
}
"""Every verb that can write, and the files that it then writes."""
NEW = ("vehicle new", "link key new")
"""Verbs that are asked for nothing but a file."""

ELSEWHERE = {
    "sitl campaign": "tests/sitl/test_campaign_command: a journal, and what fails",
    "sitl stand-in": "tests/sitl/test_real_ports: ports that go when it ends",
    "station export": "tests/archive/test_commands: from an archive that is made there",
    "link files get": "tests/cli/test_link_story, with all that `stommel link` keeps by --state",
    "link mission download": "as link files get",
    "link status": "as link files get",
    **{f"link params {verb}": "as link files get" for verb in ("list", "get", "set")},
    **{f"link mission {verb}": "as link files get" for verb in ("show", "upload", "roll-back")},
    **{f"link files {verb}": "as link files get" for verb in ("list", "put")},
    **{f"link command {verb}": "as link files get" for verb in ("send", "follow")},
}
"""Verbs that write, but not what they were asked for at their end."""

SAVE = {
    "--plot": (".png", ".svg", ".pdf"),
    "--plots": (),
    "--apply": (".toml",),
    "--track": (".geojson", ".kml"),
    "--log": (),
    "--state": (),
    "--ports": (),
    "--parameters": (),
    "FILE": (".toml",),
    "KEYFILE": (".key",),
    "COPY": (),
}
SAVE_AS = {
    "design": (".html",),
    "simulate": (".nc",),
    "sitl fly": (".nc",),
    "study": (".nc", ".zarr"),
    "vehicle calibrate-compass": (".toml",),
    "bench generate": (".csv",),
    "flight-table": (".toml",),
    "orders": (".toml",),
    "plan check": (".toml",),
    "plan preview": (".json",),
    "plan open": (".json",),
    "station export": (".nc", ".csv"),
}
"""What the names of written files end with, by option; of --output by verb."""


def verbs(group: Any = None, before: str = "") -> Iterator[tuple[str, Any]]:
    """Every verb of the program, with the words that call it."""
    for name, command in (group or get_command(app)).commands.items():
        if hasattr(command, "commands"):
            yield from verbs(command, f"{before}{name} ")
        else:
            yield f"{before}{name}", command


def outputs(command: Any, *metavars: str) -> list[str]:
    """Options and arguments of a verb that name what it writes."""
    return [
        parameter.opts[0] if parameter.param_type_name == "option" else parameter.metavar
        for parameter in command.params
        if parameter.metavar in metavars
    ]


METAVARS = ("FILE", "FOLDER", "KEYFILE", "COPY")
OUTPUTS = [(verb, option) for verb, command in verbs() for option in outputs(command, *METAVARS)]
FOLDERS = {(verb, option) for verb, command in verbs() for option in outputs(command, "FOLDER")}


SAMPLES = samples_text(MagneticVehicle(60.0), np.random.default_rng(1))
"""Of a compass that was turned in its vehicle."""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mission.toml").write_text(MISSION)
    (tmp_path / "study.toml").write_text(STUDY)
    (tmp_path / "plan.json").write_text(PLAN)
    (tmp_path / "samples.csv").write_text(SAMPLES)
    (tmp_path / "file").write_text("in the way")
    (tmp_path / "folder").mkdir()
    return tmp_path


def files_in(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file() and ".runs/" not in str(path)}


def test_the_table_holds_every_verb_that_writes() -> None:
    assert set(WRITERS) | set(ELSEWHERE) == {verb for verb, _ in OUTPUTS}
    assert {option for _, option in OUTPUTS} == {*SAVE, "--output"}


Ask = Callable[..., str]


@pytest.fixture
def ask(folder: Path, capsys: pytest.CaptureFixture[str]) -> Ask:
    """Ask a verb in this process, and return what it prints."""

    def answer(*arguments: str) -> str:
        app(list(arguments), standalone_mode=False)
        return capsys.readouterr().out

    return answer


@pytest.fixture
def logged(folder: Path, ask: Ask) -> None:
    """Lay a log and orders beside, for the verbs that read them."""
    ask("bench", "generate", "zju", "--output", "bench.csv", "--period-s", "1")
    ask("plan", "check", "plan.json", "--output", "orders.toml")


@pytest.mark.parametrize("verb", WRITERS)
@pytest.mark.usefixtures("logged")
def test_what_was_written_is_listed_and_nothing_else(ask: Ask, folder: Path, verb: str) -> None:
    arguments, expected = WRITERS[verb]
    before = files_in(folder)
    found = json.loads(ask(*arguments, "--json"))
    assert found["written"] == expected
    assert not {"plots", "files", "report", "output"} & set(found)
    assert files_in(folder) == before | set(expected)
    for name in expected:
        assert (folder / name).stat().st_size > 200
    if verb in ("vehicle new", "budget"):
        (folder / "mine.toml").unlink()
    if verb == "link key new":
        (folder / "new" / "zju-1.key").unlink()
    assert ask(*arguments).splitlines()[-len(expected) :] == [f"wrote {name}" for name in expected]


@pytest.mark.parametrize("verb", sorted(set(WRITERS) - {*NEW, "vehicle config", "bench generate", "study"}))
@pytest.mark.usefixtures("logged")
def test_a_verb_that_wrote_nothing_says_so(ask: Ask, folder: Path, verb: str) -> None:
    arguments, _ = WRITERS[verb]
    before = files_in(folder)
    first = next(i for i, word in enumerate(arguments) if word in ("--plot", "--plots", "--apply", "--output"))
    nothing = ("--no-report",) if verb == "design" else ()
    assert json.loads(ask(*arguments[:first], *nothing, "--json"))["written"] == []
    assert files_in(folder) == before


def refusal(verb: str, option: str, text: str) -> str:
    """What a verb answers to an output, asked about a vehicle, mission or log that does not exist."""
    # the output is looked at first: nothing else would be found wrong before the work begins
    place = [text] if option in METAVARS else [option, text]
    needed = {
        "root-locus": list(LOCUS[2:]),
        "link files get": ["log/1.log"] if option == "COPY" else [],
        "plan open": ["--vehicle", "zju", "--start", "18,115"],
        "station export": ["--vehicle", "1"],
    }
    required = needed.get(verb, [])
    subject = [] if option in METAVARS or verb == "station export" else ["there-is-no-such-thing"]
    with pytest.raises(OutputError) as caught:
        app([*verb.split(), *subject, *required, *place], standalone_mode=False)
    return str(caught.value)


@pytest.mark.parametrize(("verb", "option"), OUTPUTS)
def test_paths_that_cannot_be_written_are_refused_before_any_work(folder: Path, verb: str, option: str) -> None:
    before = files_in(folder)
    is_folder = (verb, option) in FOLDERS
    ending = "" if is_folder else next(iter(SAVE.get(option) or SAVE_AS.get(verb) or ()), "")
    long = "n" * 300 + ending
    words = {
        "": "names no",
        "  ": "names no",
        "/": "is the root" if is_folder else "is a folder",
        f"file/new{ending}": "Not a directory",
        long: "File name too long",
        f"new/{long}": "File name too long",
        "n/" * 3000 + f"x{ending}": "File name too long",
        f"/proc/new{ending}": "cannot be written",
    }
    if is_folder:
        words["file"] = "Not a directory"
    else:
        words |= {"folder": "is a folder", ".": "is a folder", "..": "is a folder"}
    for text, what in words.items():
        told = refusal(verb, option, text)
        assert told.startswith(f"{option} ")
        assert what in told
        assert len(told) < 300
        assert "\n" not in told
    assert files_in(folder) == before
    assert sorted(path.name for path in folder.iterdir() if path.is_dir()) == ["folder"]


@pytest.mark.parametrize(
    ("verb", "option"),
    [(verb, option) for verb, option in OUTPUTS if (verb, option) not in FOLDERS and SAVE.get(option) != ()],
)
def test_another_ending_is_refused_with_those_that_are_allowed(folder: Path, verb: str, option: str) -> None:
    allowed = SAVE.get(option) or SAVE_AS[verb]
    for name in ("hull.v2", "plot", "plot.jpeg", "plot.", allowed[0], f"plot{allowed[0]}.old"):
        if (verb, name) == ("vehicle new", "plot"):
            continue  # a bare name is that of the vehicle: tests/vehicle/test_new_vehicle.py
        told = refusal(verb, option, name)
        assert told.startswith(f"{option} {name}: the name must end with ")
        assert re.findall(r"\.[a-z]+\b", told.split("must end with")[1]) == list(allowed)


def test_a_path_of_several_lines_is_told_in_one(folder: Path) -> None:
    assert refusal("drives", "--plot", "a\nb") == r"--plot 'a\nb': the name must end with .png, .svg or .pdf"


def test_two_outputs_of_one_name_are_refused(ask: Ask) -> None:
    with pytest.raises(OutputError, match=r"^--output m\.nc: is the folder of --plots as well$"):
        ask("simulate", "mission.toml", "--output", "m.nc", "--plots", "m.nc")
    with pytest.raises(OutputError, match=r"^--track t\.kml: is the folder of --plots as well$"):
        ask("simulate", "mission.toml", "--track", "t.kml", "--plots", "t.kml")
    with pytest.raises(OutputError, match=r"^--output s\.nc: is the folder of --plots as well$"):
        ask("study", "study.toml", "--output", "s.nc", "--plots", "s.nc")


@pytest.mark.parametrize(
    ("ending", "begins"), [(".png", b"\x89PNG"), (".svg", b"<?xml"), (".pdf", b"%PDF"), (".SVG", b"<?xml")]
)
def test_the_ending_of_a_plot_is_its_format(ask: Ask, folder: Path, ending: str, begins: bytes) -> None:
    for name in ("one", "two"):
        ask("bench", "pressure", "fan2013-table5", "--plot", f"{name}{ending}")
    first, second = ((folder / f"{name}{ending}").read_bytes() for name in ("one", "two"))
    assert first.startswith(begins)
    assert first == second


def test_the_default_report_is_refused_before_any_work_too(stommel: Any, folder: Path) -> None:
    (folder / "rogue-design.html").mkdir()
    found = stommel("design", "rogue")
    assert (found.status, found.out) == (2, "")
    assert found.err == "error: --output rogue-design.html: cannot be written: it is a folder\n"


def test_a_name_of_250_characters_is_written(ask: Ask, folder: Path) -> None:
    """The longest that file systems take is 255; what is written beside it while it grows must be no longer."""
    name = "n" * 246 + ".png"
    ask("bench", "pressure", "fan2013-table5", "--plot", name)
    assert (folder / name).read_bytes().startswith(b"\x89PNG")
