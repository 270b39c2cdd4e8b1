"""One evening at the shore: every verb of `stommel link` against a simulated glider at the surface, in its order.

Oracle: what the glider itself holds, its library's files, and the files in the folder.
"""

import hashlib
from collections.abc import Iterator
from importlib import import_module
from io import StringIO
from typing import Any

import pytest

from stommel.cli.status import INTERRUPTED
from stommel.link.commands.table import COMMANDS
from stommel.simulation.scenario.shipped import mission_path
from tests.cli.afloat_link import Shore, new_key
from tests.clients.afloat import afloat
from tests.support.command import run_here
from tests.support.terminal import numbers_in, same, tables, values

MOTION_NODE, COORDINATOR = 25, 1


@pytest.fixture(scope="module")
def shore(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Shore]:
    folder = tmp_path_factory.mktemp("shore")
    with afloat(folder) as vehicle:
        yield Shore(folder, vehicle)


@pytest.fixture(autouse=True)
def _nothing_half_written(shore: Shore) -> Iterator[None]:
    yield
    assert not [path for path in shore.folder.rglob("*") if ".part" in path.name]


def printed(capsys: pytest.CaptureFixture[str], module: str, row: Any, show: str = "_show") -> str:
    """What a verb lays out for people of an answer that `--json` has given."""
    capsys.readouterr()
    getattr(import_module(f"stommel.cli.link.{module}"), show)(row)
    return capsys.readouterr().out


def test_status_tells_of_the_vehicle_and_the_link(shore: Shore, capsys: pytest.CaptureFixture[str]) -> None:
    found = shore.json("status", "--seconds", "4")
    assert (found["vehicle"], found["signing"]) == (1, "unsigned")
    status = found["status"]
    north, east = shore.vehicle.place
    assert status["latitude_deg"] == pytest.approx(29.0 + north / 111e3, abs=2e-3)
    assert status["longitude_deg"] == pytest.approx(126.0 + east / 97e3, abs=2e-3)
    assert (status["alarms"], status["mission"]) == ([], 1)
    assert found["link"]["good"] > 3
    assert found["link"]["bad"] == 0
    text = printed(capsys, "status", found)
    told = values(text)
    link = found["link"]
    expected = {
        "latitude": status["latitude_deg"], "longitude": status["longitude_deg"], "depth": status["depth_m"],
        "heading": status["heading_deg"], "pitch": status["pitch_deg"], "roll": status["roll_deg"],
        "ballast volume": status["ballast_ml"], "moving mass": status["moving_mass_mm"],
        "battery": status["voltage_v"], "battery left": status["battery_left_share"] * 100.0,
        "mission": status["mission"], "dive": status["dive"], "waypoint": status["waypoint"],
        "until the next dive": status["surface_time_left_s"], "to the waypoint": status["waypoint_distance_m"] / 1e3,
        "position may be wrong by": status["position_sigma_m"], "last position by GPS": status["fix_age_s"],
        "current to the north": status["current_north_m_s"], "current to the east": status["current_east_m_s"],
        "above the sea floor": status["altitude_m"],
        "frames": [link["good"], link["lost"], link["bad"], link["duplicate"]],
        "round trip": [link["round_trip_time"], link["time_out"]],
    }  # fmt: skip
    for name, value in told.items():
        if name in expected:
            assert same(value, expected[name]), (name, value, expected[name])
        elif name == "vehicle's clock":
            low, high = found["clock_offset_s"]
            assert same(value, [(low + high) / 2, (high - low) / 2])
        else:
            assert not numbers_in(value), name
    assert {"latitude", "battery", "frames", "depth"} <= set(told)
    # listens for as long as it is told to
    assert len(shore.json("status", "--seconds", "0.5")["status"]) == len(status)
    assert shore.json("status", "--seconds", "0.5")["link"]["good"] < link["good"]


def test_parameters_are_listed_read_and_set(shore: Shore, capsys: pytest.CaptureFixture[str]) -> None:
    found = shore.json("params", "list")
    by_component = {each["component"]: each for each in found["components"]}
    for component, each in by_component.items():
        aboard = shore.vehicle.values(component)
        assert {row["name"]: row["value"] for row in each["parameters"]} == pytest.approx(aboard, rel=1e-6)
        assert each["whole"] is True
    shown = tables(printed(capsys, "params", found))
    assert len(shown) == len(by_component) >= 3
    for table, each in zip(shown, found["components"], strict=True):
        assert len(table.rows) == len(each["parameters"])
        assert same(table.title, f"{each['name']} (component {each['component']})")
        for cells, row in zip(table.rows, each["parameters"], strict=True):
            assert cells["name"] == row["name"]
            assert float(cells["value"]) == pytest.approx(row["value"], rel=1e-5)
            low, _, high = cells["range"].partition(" to ")
            assert [float(low), float(high)] == pytest.approx([row["low"], row["high"]], rel=1e-5)
    one = f"{MOTION_NODE}:QUIET_AFTER"
    assert shore.json("params", "get", one) == {"component": MOTION_NODE, "name": "QUIET_AFTER", "value": 5.0}
    assert shore.json("params", "set", one, "8") == {"component": MOTION_NODE, "name": "QUIET_AFTER", "value": 8.0}
    assert shore.vehicle.values(MOTION_NODE)["QUIET_AFTER"] == 8.0
    shown_one = printed(capsys, "params", shore.json("params", "get", one), "_show_single")
    assert values(shown_one) == {"QUIET_AFTER": "8"}
    assert shown_one.startswith(f"Component {MOTION_NODE}")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("get", "QUIET_AFTER"), "say 25:QUIET_AFTER or 26:QUIET_AFTER"),
        (("get", "QUIET_AFTR"), "QUIET_AFTR: is no parameter of the vehicle; did you mean QUIET_AFTER?"),
        (("get", "9:XYZ"), "9:XYZ: is no parameter of the vehicle; `stommel link params list` shows them"),
        (("set", "25:QUIET_AFTER", "800"), "must be between 1 and 60"),
    ],
)
def test_a_wrong_parameter_is_one_line(shore: Shore, arguments: tuple[str, ...], words: str) -> None:
    found = shore.call("params", *arguments)
    assert (found.status, found.out, len(found.err.splitlines())) == (2, "", 1)
    assert words in found.err


def test_a_mission_goes_up_comes_down_and_goes_back(shore: Shore, capsys: pytest.CaptureFixture[str]) -> None:
    first = shore.json("mission", "show")
    assert first["sha256"] == hashlib.sha256(shore.vehicle.orders_text).hexdigest()
    assert first["waypoints_deg"] == [[29.5, 126.0], [29.5, 126.5]]
    assert first["depth_m"] == 20.0
    text = printed(capsys, "mission", first)
    (table,) = tables(text)
    assert [[float(row["latitude [deg]"]), float(row["longitude [deg]"])] for row in table.rows] == [
        list(place) for place in shore.vehicle.waypoints
    ]
    told = values(text.partition("Waypoints")[0])
    assert told == {"mission": first["mission"], "SHA-256": first["sha256"], "dives to": "20 m"}
    assert text.startswith(f"Mission {first['number']}\n")

    orders = shore.folder / "orders.toml"
    assert run_here(shore.folder, "orders", mission_path("kuroshio"), "--output", orders).status == 0
    content = orders.read_bytes()
    checked = shore.json("mission", "upload", orders, "--only-check")
    assert (checked["checked_only"], checked["sha256"]) == (True, first["sha256"])
    sent = shore.json("mission", "upload", orders)
    assert sent["sha256"] == hashlib.sha256(content).hexdigest()
    assert (sent["previous_sha256"], sent["number"]) == (first["sha256"], first["number"] + 1)
    assert shore.vehicle.orders_text == content

    down = shore.json("mission", "download", "aboard.toml")
    assert (down["sha256"], down["written"]) == (sent["sha256"], ["aboard.toml"])
    assert (shore.folder / "aboard.toml").read_bytes() == content
    refused = shore.call("mission", "download", "aboard.toml")
    assert (refused.status, refused.err) == (2, "error: aboard.toml: already exists; --force replaces it\n")
    # other orders aboard by now, and the file is there: it is replaced, and nothing lies beside it
    back = shore.json("mission", "roll-back")
    assert back["sha256"] == first["sha256"]
    assert shore.json("mission", "download", "aboard.toml", "--force")["sha256"] == first["sha256"]
    assert (shore.folder / "aboard.toml").read_bytes() == shore.vehicle.orders_text
    assert [path.name for path in shore.folder.glob("aboard*")] == ["aboard.toml"]


def test_what_is_no_orders_file_does_not_go_to_sea(shore: Shore) -> None:
    (shore.folder / "none.toml").write_text("format = 1\n")
    before = shore.vehicle.orders_text
    found = shore.call("mission", "upload", "none.toml")
    assert (found.status, found.out) == (2, "")
    assert "none.toml" in found.err
    assert shore.vehicle.orders_text == before


def test_files_go_up_and_come_down(shore: Shore, capsys: pytest.CaptureFixture[str]) -> None:
    content = bytes(range(256)) * 20
    (shore.folder / "notes.txt").write_bytes(content)
    sent = shore.json("files", "put", "notes.txt")
    assert (sent["path"], sent["bytes"]) == ("inbox/notes.txt", len(content))
    inbox = shore.json("files", "list", "inbox")
    assert inbox == {"files": [{"path": "inbox/notes.txt", "bytes": len(content)}]}
    (table,) = tables(printed(capsys, "files", inbox, "_show_list"))
    assert [(row["path"], row["bytes"]) for row in table.rows] == [("inbox/notes.txt", str(len(content)))]
    everything = {each["path"]: each["bytes"] for each in shore.json("files", "list")["files"]}
    assert everything["missions/active.orders"] == len(shore.vehicle.orders_text)
    assert "inbox/notes.txt" in everything

    got = shore.json("files", "get", "inbox/notes.txt", "home/notes.txt")
    assert (shore.folder / "home" / "notes.txt").read_bytes() == content
    assert (got["sha256"], got["written"]) == (hashlib.sha256(content).hexdigest(), ["home/notes.txt"])
    assert (got["bytes_in_vain"], got["released"]) == (0, False)
    assert values(printed(capsys, "files", got)) == {"bytes": str(len(content)), "SHA-256": got["sha256"]}
    # another file has the name: it stays, and the new one is named
    (shore.folder / "mine.txt").write_text("mine")
    kept = shore.json("files", "get", "inbox/notes.txt", "mine.txt")
    assert (shore.folder / "mine.txt").read_text() == "mine"
    assert kept["written"] != ["mine.txt"]
    assert (shore.folder / kept["written"][0]).read_bytes() == content
    # what may not go stays aboard, and is home all the same
    held = shore.call("files", "get", "missions/active.orders", "active.orders", "--release")
    assert (held.status, len(held.err.splitlines())) == (2, 1)
    assert "is whole here, and not released aboard: " in held.err
    assert (shore.folder / "active.orders").read_bytes() == shore.vehicle.orders_text


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("list", "nowhere"), "error: nowhere: file not found"),
        (("get", "inbox/none.txt", "none.txt"), "error: inbox/none.txt: there is no such file"),
        (("get", "../../etc/passwd", "none.txt"), "path '../../etc/passwd': must be of plain names below the root"),
        (("put", "missing.txt"), "missing.txt: cannot be read: No such file or directory"),
    ],
)
def test_a_wrong_file_is_one_line(shore: Shore, arguments: tuple[str, ...], words: str) -> None:
    found = shore.call("files", *arguments)
    assert (found.status, found.out, len(found.err.splitlines())) == (2, "", 1)
    assert words in found.err
    assert not (shore.folder / "none.txt").exists()


def test_a_full_disk_is_named_and_what_came_is_kept(shore: Shore, monkeypatch: pytest.MonkeyPatch) -> None:
    """A disk of 20 kB: error ENOSPC, as the operating system gives it."""
    from stommel.link.files.folder_disk import FolderDisk

    write, room = FolderDisk.write, 20_000

    def full(disk: FolderDisk, name: str, offset: int, data: bytes) -> None:
        if offset + len(data) > room:
            raise OSError(28, "No space left on device")
        write(disk, name, offset, data)

    with monkeypatch.context() as patch:
        patch.setattr(FolderDisk, "write", full)
        found = shore.call("files", "get", "missions/active.orders", "full.orders")
    assert (found.status, found.out, len(found.err.splitlines())) == (2, "", 1)
    assert "No space left on device" in found.err
    assert not (shore.folder / "full.orders").exists()
    assert (shore.folder / "full.orders.part").exists()
    again = shore.json("files", "get", "missions/active.orders", "full.orders")  # there is room again
    assert again["bytes_in_vain"] == 0
    assert (shore.folder / "full.orders").read_bytes() == shore.vehicle.orders_text


def test_commands_are_listed_given_and_followed(shore: Shore, capsys: pytest.CaptureFixture[str]) -> None:
    listed = run_here(shore.folder, "link", "command", "list", "--json").json
    assert [each["name"] for each in listed["commands"]] == [row.name for row in COMMANDS]
    words = printed(capsys, "command", listed, "_show_list")
    for row in COMMANDS:
        assert row.name in words
        for one in row.parameters:
            assert f"{one.name}={one.low:g}..{one.high:g}" in words
    held = shore.json("command", "send", "hold", "--expires", "90", "--when", "at-once")
    assert (held["state"], held["is_last"], held["name"]) == ("done", True, "hold")
    assert values(printed(capsys, "command", held)) == {
        "state": "done", "id": held["id"], "expires": held["expires"]
    }  # fmt: skip
    timed = shore.json("command", "send", "radio-time", "time=120")
    assert timed["state"] == "done"
    assert shore.vehicle.values(COORDINATOR)["SURFACE_TIME"] == 120.0
    answer = shore.json("command", "follow")
    followed = answer["commands"]
    assert {each["id"]: each["name"] for each in followed} == {held["id"]: "hold", timed["id"]: "radio-time"}
    text = printed(capsys, "command", answer, "_show_reports")
    assert all(each["id"] in text for each in followed)
    # the state folder is what is followed: another one knows of nothing
    other = run_here(shore.folder, "link", "command", "follow", *shore.line[:-1], "other", "--json")
    assert other.json["commands"] == []


def test_a_command_that_waits_is_taken_back(shore: Shore) -> None:
    waiting = shore.json("command", "send", "check", "--when", "at-next-surfacing", "--within", "3")
    assert (waiting["state"], waiting["is_last"]) == ("waiting aboard", False)
    (found,) = [
        each for each in shore.json("command", "follow", "--cancel", waiting["id"])["commands"]
        if each["id"] == waiting["id"]
    ]  # fmt: skip
    assert found["is_last"] is True
    assert found["state"] != "done"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("send", "hld"), "hld"),
        (("send", "hold", "time=1"), "hold: has no parameter 'time'"),
        (("send", "radio-time"), "time"),
        (("send", "radio-time", "time=5"), "60"),
        (("send", "radio-time", "time"), "time: must be KEY=VALUE with a number, as time=120"),
        (("send", "hold", "--expires", "0"), "--expires = 0: must be between 1 and 2.6e+06 s"),
        (("follow", "--cancel", "hello"), "--cancel = hello: must be the id of a command"),
    ],
)
def test_a_wrong_command_is_one_line(shore: Shore, arguments: tuple[str, ...], words: str) -> None:
    found = shore.call("command", *arguments)
    assert (found.status, found.out, len(found.err.splitlines())) == (2, "", 1)
    assert words in found.err


@pytest.mark.parametrize(("answer", "status"), [("n\n", 1), ("\n", 1), ("", INTERRUPTED)])
def test_a_dangerous_command_is_asked_about(
    shore: Shore, monkeypatch: pytest.MonkeyPatch, answer: str, status: int
) -> None:
    """No, nothing, or an input that is at its end."""
    monkeypatch.setattr("sys.stdin", StringIO(answer))
    asked = shore.call("command", "send", "restart")
    assert (asked.status, asked.out.strip()) == (status, "")
    assert "restart: for some seconds nobody decides" in asked.err
    assert "restart" not in {each["name"] for each in shore.json("command", "follow")["commands"]}


def test_a_dangerous_command_is_given_with_a_yes(shore: Shore) -> None:
    assert shore.json("command", "send", "clear", "--yes")["state"] == "done"


def test_another_vehicle_is_named(shore: Shore) -> None:
    found = shore.call("status", "--vehicle", "7", "--within", "2")
    assert (found.status, found.out, len(found.err.splitlines())) == (2, "", 1)
    assert "vehicle 7 was not heard within 2 s" in found.err
    assert "heard is vehicle 1: name it with --vehicle" in found.err


def test_a_vehicle_that_does_not_sign_is_not_believed(shore: Shore) -> None:
    new_key(shore.folder, "afloat.key")
    found = run_here(shore.folder, "link", "status", *shore.line[:2], "--key", "afloat.key", "--state", "signed",
                     "--within", "2")  # fmt: skip
    assert (found.status, found.out, len(found.err.splitlines())) == (2, "", 1)
    assert "vehicle 1 was not heard within 2 s" in found.err
    assert "unsigned" in found.err


def test_a_second_program_is_kept_out_of_the_folder(shore: Shore) -> None:
    from stommel.files.folder_lock import locked

    (shore.folder / "state" / "vehicle-1").mkdir(parents=True, exist_ok=True)
    with locked(shore.folder / "state" / "vehicle-1"):
        found = shore.call("status")
    assert (found.status, found.out) == (2, "")
    told = "another `stommel link` speaks to this vehicle; wait for its end, or give another folder by --state"
    assert found.err == f"error: state/vehicle-1: {told}\n"
    assert shore.call("status", "--seconds", "0.5").status == 0
