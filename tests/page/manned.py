"""A real station at which people log in; its vehicle is silent, so that what is given waits."""

import json
import urllib.error
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from stommel.archive import Archive
from stommel.station.people.people import People
from stommel.station.people.roles import Role
from tests.page.conftest import serve, station_command
from tests.support.ports import port_of_nobody

PASSWORD = "a long way to the sea"
PEOPLE = {"ada": Role.ADMIN, "ling": Role.PILOT, "max": Role.PILOT, "vera": Role.VIEWER}


@contextmanager
def manned_station(folder: Path) -> Iterator[str]:
    """Address of a station with the people of `PEOPLE`, until the block ends."""
    database = f"sqlite:///{folder / 'archive.sqlite'}"
    with Archive.open(database) as archive:
        people = People(archive)
        for name, role in PEOPLE.items():
            people.users.add(name, PASSWORD, role)
    with port_of_nobody() as port:
        link = ["--link", f"tcp:127.0.0.1:{port}", "--unsigned", "--model", "zju", "--login"]
        for _, address in serve(station_command(folder, "--database", database, *link)):
            yield address


def sign_in(page: Any, address: str, name: str, view: str) -> None:
    """Log somebody in, and open a view."""
    page.goto(f"{address}/#/{view}")
    page.get_by_label("Name").fill(name)
    page.get_by_label("Password").fill(PASSWORD)
    page.get_by_role("button", name="Sign in").click()
    page.get_by_role("button", name="Abort", exact=True).wait_for()


def kind(page: Any, name: str) -> Any:
    """The button that opens the form of a command."""
    return page.locator(f"[data-kind='{name}'] > button")


def told(address: str, path: str, token: str | None = None) -> Any:
    """What the station answers, without the page."""
    request = urllib.request.Request(f"{address}/api{path}")
    if token is not None:
        request.add_header("Authorization", f"Bearer {token}")
    with urllib.request.urlopen(request, timeout=60.0) as answer:
        return json.load(answer)


def status(address: str, path: str, token: str) -> int:
    """HTTP status of what the station answers."""
    try:
        told(address, path, token)
    except urllib.error.HTTPError as error:
        return error.code
    return 200
