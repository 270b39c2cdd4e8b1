"""`stommel station`: starts, says where it is, refuses what is not safe, ends at once."""

import re
import signal
import socket
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import httpx
import pytest

from stommel.archive import Archive
from stommel.cli.station.serve import vehicles_told
from stommel.station.people.people import People
from stommel.station.people.roles import Role
from tests.support.command import PROGRAM, Command
from tests.support.station_served import PASSWORD

SILENT = ("--link", "tcp:127.0.0.1:9", "--unsigned")


@contextmanager
def _running(folder: Path, *words: str) -> Iterator[tuple[str, "subprocess.Popen[str]"]]:
    process = subprocess.Popen(
        [PROGRAM, "station", "--port", "0", *words], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        text=True,
    )  # fmt: skip
    try:
        assert process.stdout is not None
        assert process.stderr is not None
        line = process.stdout.readline()
        found = re.search(r"https?://\S+", line)
        assert found is not None, process.stderr.read()
        yield found[0], process
    finally:
        process.kill()
        process.communicate()


def test_it_says_where_it_is_and_ends_cleanly(tmp_path: Path) -> None:
    with _running(tmp_path, *SILENT, "--name", "Pier 3") as (page, process):
        assert httpx.get(f"{page}api/station", timeout=60.0).json()["name"] == "Pier 3"
        assert "text/html" in httpx.get(page, timeout=60.0).headers["content-type"]
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=60.0)
    assert process.returncode == 0
    assert "ended; everything that came is kept" in said
    assert "Traceback" not in said


def test_a_second_station_is_refused_by_name(tmp_path: Path, stommel: Command) -> None:
    with _running(tmp_path, *SILENT, "--database", "sea.sqlite") as (page, _):
        same_folder = stommel("station", "--port", "0", "--database", "other.sqlite")
        same_archive = stommel("station", "--port", "0", "--folder", "other", "--database", "sea.sqlite")
        port = page.rstrip("/").rpartition(":")[2]
        same_port = stommel("station", "--port", port, "--folder", "third")
        assert httpx.get(f"{page}api/station", timeout=60.0).status_code == 200
    for answer, words in (
        (same_folder, "folder = station: another station uses it"),
        (same_archive, "sea.sqlite: another station uses it"),
        (same_port, f"another program uses port {port}"),
    ):
        assert answer.status == 2
        assert words in answer.err
        assert answer.err.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--host", "0.0.0.0"), "give --certificate and --key-file, or --behind-proxy"),
        (("--host", "192.0.2.7"), "needs TLS"),
        (("--host", "0.0.0.0", "--behind-proxy"), "stommel station user add NAME --role admin"),
        (("--behind-proxy",), "nobody is its admin yet"),
        (("--login",), "nobody is its admin yet"),
        (("--certificate", "none.pem"), "none.pem: there is no such file"),
        (("--key-file", "none.pem"), "only with --certificate"),
        (("--host", "no.such.host.invalid", "--behind-proxy"), "nobody is its admin yet"),
        (("--vehicle", "3"), "--vehicle"),
        (("--link", "tcp:127.0.0.1:9", "--vehicle", "1", "--vehicle", "2"), "one for each --link"),
        (("--link", "nowhere", "--unsigned"), "nowhere"),
        (("--link", "tcp:127.0.0.1:9"), "give the vehicle's key"),
        (("--settings", "none.toml"), "none.toml"),
        (("--host", ""), "host"),
    ],
)
def test_what_is_not_safe_does_not_start(tmp_path: Path, stommel: Command, words: tuple[str, ...], said: str) -> None:
    answer = stommel("station", "--port", "0", *words)
    assert answer.status == 2
    assert said in answer.err
    assert answer.err.count("\n") == 1


def test_a_host_of_another_machine(tmp_path: Path, stommel: Command) -> None:
    _add_admin(tmp_path)
    answer = stommel("station", "--port", "0", "--host", "192.0.2.7", "--behind-proxy")
    assert answer.status == 2
    assert "192.0.2.7: is no address of this machine" in answer.err


def test_with_a_certificate_people_log_in_over_tls(tmp_path: Path) -> None:
    subprocess.run(
        ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", "key.pem", "-out", "cert.pem",
         "-days", "2", "-subj", "/CN=localhost", "-addext", "subjectAltName=DNS:localhost,IP:127.0.0.1"],
        cwd=tmp_path, check=True, capture_output=True,
    )  # fmt: skip
    _add_admin(tmp_path)
    words = ("--host", "0.0.0.0", "--certificate", "cert.pem", "--key-file", "key.pem")
    with _running(tmp_path, *SILENT, *words) as (page, _):
        port = page.rstrip("/").rpartition(":")[2]
        assert page.startswith("https://")
        import ssl

        trusted = ssl.create_default_context(cafile=str(tmp_path / "cert.pem"))
        with httpx.Client(base_url=f"https://localhost:{port}", verify=trusted, timeout=60.0) as client:
            assert client.get("/api/vehicles").status_code == 401
            answer = client.post("/api/session", json={"name": "ada", "password": PASSWORD})
            cookie = answer.headers["set-cookie"]
            assert cookie.startswith("__Host-stommel_session=")
            for word in ("HttpOnly", "Secure", "SameSite=strict", "Path=/"):
                assert word.casefold() in cookie.casefold()
            assert client.get("/api/vehicles").status_code == 200
            assert client.get("/").headers["strict-transport-security"].startswith("max-age=")
        with socket.create_connection(("127.0.0.1", int(port))) as plain:
            plain.sendall(b"GET /api/station HTTP/1.1\r\nHost: localhost\r\n\r\n")
            assert b"Shore station" not in plain.recv(1000)


def test_links_of_the_command_line() -> None:
    told = vehicles_told(["tcp:a:1", "udp:b:2"], None, None, True, None, 20.0)
    assert told == [
        {"vehicle": 1, "link": "tcp:a:1", "unsigned": True, "speed": 20.0},
        {"vehicle": 2, "link": "udp:b:2", "unsigned": True, "speed": 20.0},
    ]
    assert vehicles_told(None, None, None, False, None, None) is None


def _add_admin(folder: Path) -> None:
    (folder / "station").mkdir()
    archive = Archive.open(f"sqlite:///{folder / 'station' / 'archive.sqlite'}")
    People(archive).users.add("ada", PASSWORD, Role.ADMIN)
    archive.close()
