"""`stommel link` where nobody answers, or nothing can be asked: exit status 2, one line that says what to do."""

import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import typer

from stommel.cli.app import app
from tests.cli.afloat_link import new_key
from tests.cli.test_bad_input import refused
from tests.cli.test_terminal_equals_json import leaves
from tests.support.command import Command

NOWHERE = ("--to", "tcp:127.0.0.1:1")
LOCAL = ("link command list", "link key new", "link key show", "link key check")
"""Verbs that speak to no vehicle."""
ARGUMENTS = {
    "link params get": ("A",), "link params set": ("A", "1"), "link mission upload": ("orders.toml",),
    "link mission download": ("o.toml",), "link files get": ("log/1.log", "1.log"), "link files put": ("notes.txt",),
    "link command send": ("hold",),
}  # fmt: skip
SPEAKING = [
    verb for path, _ in leaves(typer.main.get_command(app))
    if (verb := " ".join(path)).startswith("link ") and verb not in LOCAL
]  # fmt: skip


@pytest.fixture(autouse=True)
def _files(tmp_path: Path, stommel: Command) -> None:
    (tmp_path / "notes.txt").write_text("hello")
    if not (tmp_path / "orders.toml").exists():
        assert stommel("orders", "pool_trial", "--output", "orders.toml").status == 0


def call(verb: str) -> tuple[str, ...]:
    return (*verb.split(), *ARGUMENTS.get(verb, ()))


@pytest.mark.parametrize("verb", SPEAKING)
def test_every_verb_asks_for_key_address_and_folder(stommel: Command, tmp_path: Path, verb: str) -> None:
    """In one place, so in the same words."""
    begin = (*call(verb), "--state", "s")
    refused(stommel(*begin, "--unsigned"), "--to")
    refused(stommel(*begin, *NOWHERE), "--key: give the vehicle's key, or --unsigned")
    refused(stommel(*begin, "--to", "radio", "--unsigned"), "--to = radio: must be one of serial:/dev/ttyUSB0:115200")
    refused(stommel(*begin, *NOWHERE, "--key", "none.key"), "none.key: cannot be read: No such file or directory")
    new_key(tmp_path, "seven.key", 7)
    refused(stommel(*begin, *NOWHERE, "--key", "seven.key", "--unsigned"), "a key signs; leave out --unsigned")
    other = stommel(*begin, *NOWHERE, "--key", "seven.key", "--vehicle", "8")
    refused(other, "--vehicle: 8: seven.key is the key of vehicle 7")
    refused(stommel(*begin, *NOWHERE, "--unsigned", "--within", "0"), "--within = 0: must be between 0.1 and")
    refused(stommel(*call(verb), *NOWHERE, "--unsigned", "--state", "notes.txt"), "--state", "notes.txt")


@pytest.mark.parametrize(
    "verb", [verb for verb in SPEAKING if verb not in ("link command send", "link command follow")]
)
def test_nobody_there_is_one_line_after_the_time_that_was_given(stommel: Command, verb: str) -> None:
    found = stommel(*call(verb), *NOWHERE, "--unsigned", "--state", "s", "--within", "0.3")
    refused(found, "vehicle 1 was not heard within 0.3 s over tcp:127.0.0.1:1: refused: no program listens there")


def test_a_command_to_nobody_stays_queued(stommel: Command) -> None:
    """It was given: the next program with this folder sends it, while it has not expired."""
    line = (*NOWHERE, "--unsigned", "--state", "s", "--within", "0.3", "--json")
    found = stommel("link", "command", "send", "hold", *line)
    assert (found.status, found.json["is_last"]) == (1, False)
    (again,) = stommel("link", "command", "follow", *line).json["commands"]
    assert again["id"] == found.json["id"]


@contextmanager
def peer(says: bytes) -> Iterator[str]:
    """A program that says something to whoever connects, over and over; its address."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(10.0)
        ended = threading.Event()

        def talk() -> None:
            connection, _ = server.accept()
            with connection:
                while not ended.wait(0.05):
                    try:
                        connection.sendall(says)
                    except OSError:
                        return

        thread = threading.Thread(target=talk, daemon=True)
        thread.start()
        yield f"tcp:127.0.0.1:{server.getsockname()[1]}"
        ended.set()
        thread.join(10.0)


def test_bytes_without_frames_are_named(stommel: Command) -> None:
    """As from a modem at another speed."""
    with peer(b"\x80\x1f\xfe\x00" * 50) as address:
        found = stommel("link", "status", "--to", address, "--unsigned", "--state", "s", "--within", "1.5")
    refused(found, "bytes came, but no frame in them: another speed of the port at the other end")


def test_a_silent_peer_is_named(stommel: Command) -> None:
    with peer(b"") as address:
        found = stommel("link", "status", "--to", address, "--unsigned", "--state", "s", "--within", "0.5")
    refused(found, "nothing came; it is under water, out of reach, or its radio is off")
