"""The role matrix: every route of the application, asked by everybody."""

import re
from collections.abc import Iterator
from typing import Any

import httpx
import pytest
from fastapi import APIRouter

from stommel.station.people.roles import Role
from stommel.station.station import Station
from stommel.station.web import app as web_app
from stommel.station.web.access import least_role
from stommel.station.web.app import api_routes, create_app
from stommel.station.web.exposure import Exposure
from tests.station.stations import station as silent_station
from tests.station.web.least_roles import ADMIN, HOLDER, LEAST_ROLES, PILOT, PUBLIC, VIEWER
from tests.support.station_served import PASSWORD, logged_in, served

WHO = {"nobody": 0, "viewer": 1, "pilot": 2, "admin": 3}
RANK = {PUBLIC: 0, VIEWER: 1, PILOT: 2, HOLDER: 2, ADMIN: 3}
ROUTES = {(method, route.path) for route in api_routes() for method in route.methods or ()}
LOGGING = {("POST", "/api/session"), ("DELETE", "/api/session"), ("PUT", "/api/session/password")}
"""Would end the sessions with which the test asks, or are asked with a password."""


def test_every_route_is_in_the_table_with_its_role() -> None:
    found = {(method, route.path): least_role(route) for route in api_routes() for method in route.methods or ()}
    assert found == LEAST_ROLES


def test_the_table_knows_the_documented_routes(station: Station) -> None:
    document = create_app(station).openapi()
    found = {(method.upper(), path) for path, about in document["paths"].items() for method in about}
    assert found == ROUTES - {("GET", "/api/openapi.json")}


def test_a_route_without_a_role_does_not_start(station: Station, monkeypatch: pytest.MonkeyPatch) -> None:
    router = APIRouter(prefix="/api")
    router.add_api_route("/forgotten", lambda: None, methods=["POST"])
    monkeypatch.setattr(web_app, "ROUTERS", (*web_app.ROUTERS, router))
    with pytest.raises(ValueError, match=r"forgotten.* names no role"):
        create_app(station)


@pytest.fixture(scope="module")
def everybody(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, httpx.Client]]:
    """Somebody of each role, by session and by token."""
    folder = tmp_path_factory.mktemp("station")
    with (
        silent_station(folder, "tcp:127.0.0.1:9", start=False) as station,
        served(create_app(station, Exposure(login=True))) as address,
    ):
        clients = {"nobody": httpx.Client(base_url=address)}
        for role in (Role.VIEWER, Role.PILOT, Role.ADMIN):
            station.people.users.add(f"a-{role}", PASSWORD, role)
            clients[role.value] = logged_in(address, f"a-{role}")
            _, secret = station.people.tokens.add(f"a-{role}", "script", role, None)
            clients[f"{role} by token"] = httpx.Client(base_url=address, headers={"Authorization": f"Bearer {secret}"})
        yield clients
        for client in clients.values():
            client.close()


@pytest.mark.parametrize("who", ["nobody", "viewer", "viewer by token", "pilot", "pilot by token", "admin"])
@pytest.mark.parametrize(("method", "path"), sorted(ROUTES - LOGGING))
def test_the_matrix(everybody: dict[str, httpx.Client], who: str, method: str, path: str) -> None:
    """Refused by role before anything else is looked at; who may gets past that (to an answer, or to 404, 409, 422)."""
    least, rank = LEAST_ROLES[method, path], WHO[who.split(maxsplit=1)[0]]
    body: dict[str, Any] = {} if method in ("GET", "DELETE") else {"json": {}}
    # vehicle 200 is not there: nothing is done by asking
    answer = everybody[who].request(method, re.sub(r"\{[^}]*\}", "200", path), **body)
    if rank >= RANK[least]:
        assert answer.status_code not in (401, 403), answer.text
        assert answer.status_code < 500, answer.text
    else:
        assert answer.status_code == (401 if rank == 0 else 403), answer.text
        assert "reason" in answer.json()["detail"]
