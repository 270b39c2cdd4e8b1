"""Other sites' pages, names made to point here (DNS rebinding), and sockets from elsewhere are refused."""

import socket
from typing import Any

import httpx
import pytest
from websockets.sync.client import connect

from stommel.station.station import Station
from stommel.station.web.app import create_app
from stommel.station.web.exposure import Exposure
from tests.support.station_served import handshake, served

EVIL = "http://evil.example"
CHANGES = [("POST", "/api/session"), ("DELETE", "/api/session"), ("POST", "/api/vehicles/1/holder"),
           ("DELETE", "/api/vehicles/1/holder"), ("PATCH", "/api/users/ada"), ("PUT", "/api/session/password"),
           ("POST", "/api/vehicles/1/abort"), ("POST", "/api/nothing")]  # fmt: skip


def _own(client: httpx.Client) -> str:
    return str(client.base_url).rstrip("/")


@pytest.mark.parametrize(("method", "path"), CHANGES)
@pytest.mark.parametrize(
    "headers",
    [
        {"Origin": EVIL}, {"Origin": "null"}, {"Origin": ""}, {"Origin": "http://127.0.0.1:1"},
        {"Origin": "https://127.0.0.1"}, {"Origin": "http://127.0.0.1.evil.example"}, {"Origin": "http://[bad"},
        {"Sec-Fetch-Site": "cross-site"}, {"Sec-Fetch-Site": "same-site"},
    ],
    ids=str,
)  # fmt: skip
def test_other_sites_change_nothing(quay: httpx.Client, method: str, path: str, headers: dict[str, str]) -> None:
    answer = quay.request(method, path, headers=headers)
    assert answer.status_code == 403
    assert "another site" in answer.json()["detail"]["reason"]


def test_own_page_and_scripts_may(local: httpx.Client, station: Station) -> None:
    for headers in ({"Origin": _own(local)}, {"Sec-Fetch-Site": "same-origin"}, {"Sec-Fetch-Site": "none"}, {}):
        assert local.post("/api/vehicles/1/holder", json={}, headers=headers).status_code == 200
    assert station.people.holders.of(1) is not None


def test_a_form_of_another_site_is_no_json(local: httpx.Client, station: Station) -> None:
    """A plain form needs no permission of the browser; with no JSON type its body is not even read."""
    for kind in ("text/plain", "application/x-www-form-urlencoded", "multipart/form-data; boundary=x"):
        answer = local.post("/api/vehicles/1/holder", content=b"{}", headers={"content-type": kind})
        assert answer.status_code == 422
    assert station.people.holders.of(1) is None


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:8470", "127.0.0.1.evil.example", "", "a/b", "[::1", "127.0.0.1@evil.example"]
)
@pytest.mark.parametrize("path", ["/", "/api/station", "/api/vehicles"])
def test_a_name_made_to_point_here_is_not_answered(quay: httpx.Client, host: str, path: str) -> None:
    answer = quay.get(path, headers={"Host": host})
    assert answer.status_code in (400, 421)
    assert "Pier 3" not in answer.text


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "LOCALHOST:8470", "[::1]:8470", "localhost."])
def test_names_of_this_machine(quay: httpx.Client, host: str) -> None:
    assert quay.get("/api/station", headers={"Host": host}).status_code == 200


def test_two_hosts_at_once(quay: httpx.Client) -> None:
    with socket.create_connection((quay.base_url.host, quay.base_url.port or 0), timeout=60.0) as line:
        line.sendall(b"GET /api/station HTTP/1.1\r\nHost: 127.0.0.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n")
        said = b"".join(iter(lambda: line.recv(10_000), b""))
    assert said.split()[1] in (b"400", b"421")
    assert b"Pier 3" not in said


def test_nothing_is_shared_with_other_sites(quay: httpx.Client) -> None:
    for method in ("GET", "OPTIONS"):
        answer = quay.request(method, "/api/station", headers={"Origin": EVIL, "Access-Control-Request-Method": "POST"})
        assert not [name for name in answer.headers if name.startswith("access-control")]
        assert answer.headers["cross-origin-resource-policy"] == "same-origin"


@pytest.mark.parametrize("origin", [EVIL, "null", "http://127.0.0.1:1"])
def test_a_socket_from_another_site(quay: httpx.Client, origin: Any) -> None:
    assert handshake(_own(quay), Origin=origin) == 403


def test_a_socket_by_another_name(quay: httpx.Client) -> None:
    assert handshake(_own(quay), Host="evil.example") == 403


def test_a_socket_of_the_own_page_and_of_a_script(quay: httpx.Client) -> None:
    address = f"{_own(quay).replace('http', 'ws')}/api/live"
    for origin in (_own(quay), None):
        with connect(address, origin=origin) as live:  # type: ignore[arg-type]
            assert '"hello"' in live.recv(timeout=60.0)


def test_a_proxy_must_serve_tls(station: Station) -> None:
    exposure = Exposure(behind_proxy=True, names=("pier.example",))
    proxy = {"X-Forwarded-Proto": "https", "X-Forwarded-For": "203.0.113.5", "Host": "pier.example"}
    with served(create_app(station, exposure), proxy_headers=True, forwarded_allow_ips="127.0.0.1") as address:
        plain = httpx.get(f"{address}/api/station", headers={"Host": "pier.example"})
        assert plain.status_code == 403
        assert "X-Forwarded-Proto" in plain.json()["detail"]["reason"]
        assert httpx.get(f"{address}/api/station", headers=proxy).status_code == 200
        assert httpx.get(f"{address}/api/station", headers=proxy | {"Host": "evil.example"}).status_code == 421
        answer = httpx.post(
            f"{address}/api/session", json={"name": "x", "password": "y"},
            headers=proxy | {"Origin": "https://pier.example"},
        )  # fmt: skip
        assert answer.status_code == 401
    (entry,) = station.people.audit.entries()
    assert entry.address == "203.0.113.5"


def test_nobody_else_says_where_they_come_from(station: Station) -> None:
    """Brute force from one address does not look like many: only a proxy of ours is believed."""
    with served(create_app(station, Exposure(login=True)), proxy_headers=False) as address:
        headers = {"X-Forwarded-For": "203.0.113.5"}
        httpx.post(f"{address}/api/session", json={"name": "x", "password": "y"}, headers=headers)
    (entry,) = station.people.audit.entries()
    assert entry.address == "127.0.0.1"
