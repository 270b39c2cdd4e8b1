"""`stommel link` without a vehicle: what cannot be is one line and status 2, and damage is told.

Oracle: the rules of errors (`stommel.cli`), and what was put into the folders by hand.
"""

import socket
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from stommel.link.frames import frame_bytes
from stommel.link.signing.key_file import KeyFile, new_keys
from stommel.messages.mavlink import message_named
from tests.support.command import Outcome, run_here

NOBODY = ("--to", "tcp:127.0.0.1:9", "--within", "0.1")


def refused(folder: Path, *arguments: object) -> str:
    """The one line of an error."""
    found = run_here(folder, "link", *arguments, *NOBODY)
    assert (found.status, found.out) == (2, "")
    (line,) = found.err.splitlines()
    return line


@pytest.mark.parametrize("state", ["there", "there/below"])
@pytest.mark.parametrize("signed", [False, True])
def test_state_folder_that_cannot_be(tmp_path: Path, state: str, *, signed: bool) -> None:
    (tmp_path / "there").write_text("a file")
    KeyFile(tmp_path / "a.key").write(new_keys(1, 1.8e9))
    who = ("--key", "a.key") if signed else ("--unsigned",)
    line = refused(tmp_path, "status", *who, "--state", state)
    assert line == f"error: --state {state}: cannot be written: Not a directory"


def follow(folder: Path, *arguments: object) -> Outcome:
    return run_here(folder, "link", "command", "follow", "--unsigned", "--state", "state", *NOBODY, *arguments)


def test_damaged_queue_of_commands_is_told_and_not_shown_as_empty(tmp_path: Path) -> None:
    (tmp_path / "state" / "vehicle-1").mkdir(parents=True)
    (tmp_path / "state" / "vehicle-1" / "commands").write_bytes(bytes(range(40)))
    (note,) = follow(tmp_path, "--json").json["notes"]
    assert note.startswith("commands: is damaged")
    assert "note: commands: is damaged" in follow(tmp_path).out


def test_commands_of_before_the_clock_was_set_back_are_told_as_taken_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    give = ("link", "command", "send", "hold", "--unsigned", "--state", "state", *NOBODY, "--json")
    monkeypatch.setattr("time.time", lambda: 1.8e9)
    given = run_here(tmp_path, *give)
    assert given.status == 1
    monkeypatch.setattr("time.time", lambda: 1.8e9 - 86_400.0)
    found = follow(tmp_path, "--json").json
    assert all(each["words"].startswith("taken back") for each in found["commands"])
    assert [each["id"] for each in found["commands"]] == [given.json["id"]]
    assert "clock is 86400 s behind" in found["notes"][0]


def test_commands_for_one_vehicle_are_not_those_of_another_in_the_same_folder(tmp_path: Path) -> None:
    """Given ashore to vehicle 1 while it is away; whoever then speaks to vehicle 2 must not say it there."""
    give = ("link", "command", "send", "hold", "--unsigned", "--state", "state", *NOBODY, "--json")
    given = run_here(tmp_path, *give, "--vehicle", 1).json
    assert follow(tmp_path, "--json", "--vehicle", 2).json["commands"] == []
    assert [each["id"] for each in follow(tmp_path, "--json").json["commands"]] == [given["id"]]


@contextmanager
def saying(words: bytes) -> Iterator[str]:
    """Address of a program that says the same again and again to whoever connects."""
    with socket.create_server(("127.0.0.1", 0)) as server:

        def talk() -> None:
            try:
                connected, _ = server.accept()
                with connected:
                    while True:
                        connected.sendall(words)
                        time.sleep(0.02)
            except OSError:  # it has heard enough
                return

        thread = threading.Thread(target=talk)
        thread.start()
        yield f"tcp:127.0.0.1:{server.getsockname()[1]}"
        thread.join(10.0)


def status_of(folder: Path, address: str) -> str:
    found = run_here(folder, "link", "status", "--to", address, "--unsigned", "--state", "state", "--within", "1.5")
    assert (found.status, found.out) == (2, "")
    return found.err


def test_a_peer_of_mavlink_1_is_not_silence(tmp_path: Path) -> None:
    """A HEARTBEAT of the old protocol, byte for byte from pymavlink."""
    with saying(bytes.fromhex("fe09000101000000000016080004032001")) as address:
        told = status_of(tmp_path, address)
    assert "bytes came, but no" in told  # how many tells whether it may be another speed of the port
    assert "nothing came" not in told


def test_a_peer_with_another_release_of_the_messages_is_named(tmp_path: Path) -> None:
    kind = message_named("HEARTBEAT")
    other = frame_bytes(kind._replace(crc_extra=kind.crc_extra ^ 1), kind.pack({"type": 12}), 1, 1, 0)
    with saying(other) as address:
        assert "the other end has another version of HEARTBEAT" in status_of(tmp_path, address)
