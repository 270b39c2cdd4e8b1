"""Whoever only looks waits for nobody who writes: not for the archive's writer, not for a line that waits for it.

Oracle: the answers come while the archive's only writer is held, which nobody lets go before they have come.
"""

import re
import threading
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import httpx
import pytest

from stommel.archive import Archive, Batch, CtdRow
from stommel.station.people.roles import Role
from stommel.station.web.app import api_routes, create_app
from stommel.station.web.exposure import Exposure
from tests.station.speaker import speaker, until
from tests.station.stations import station
from tests.support.station_served import PASSWORD, logged_in, served

ASKS_THE_VEHICLE = {"/api/vehicles/{vehicle}/listing"}
"""The vehicle itself must answer, over the radio."""
LOOKS = sorted(
    {route.path for route in api_routes() if "GET" in (route.methods or ())} - ASKS_THE_VEHICLE - {"/api/openapi.json"}
)
DIVE = [CtdRow(1.7e9 + k, 1, abs(100.0 - k), 15.0, 4.0) for k in range(200)]
"""Up and down once: profiles are found when somebody asks for them, and kept."""
PLACES = {"vehicle": "1", "id": "0000000000000001"}


@pytest.fixture(scope="module")
def held(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, httpx.Client]]:
    """A station whose archive is being written to all the time, and whose line waits for it; people of each kind."""
    patient = pytest.MonkeyPatch()
    opened = Archive.open
    patient.setattr(Archive, "open", lambda url: opened(url, busy_timeout_s=3600.0))
    folder: Path = tmp_path_factory.mktemp("held")
    with (
        speaker() as vehicle,
        station(folder, vehicle.address) as found,
        served(create_app(found, Exposure(login=True))) as address,
    ):
        vehicle.connect()
        vehicle.say("GLIDER_STATE", time_boot_ms=1, depth=1.0)
        found.archive.store(1, Batch(ctd=DIVE))
        until(lambda: found.hub.values(1))
        found.people.users.add("ada", PASSWORD, Role.ADMIN)
        session = logged_in(address, "ada")
        _, secret = found.people.tokens.add("ada", "script", Role.ADMIN, None)
        script = httpx.Client(base_url=address, headers={"Authorization": f"Bearer {secret}"})
        free, busy = threading.Event(), threading.Event()

        def write() -> None:
            with found.archive.writing():
                busy.set()
                free.wait()

        writer = threading.Thread(target=write)
        writer.start()
        busy.wait()
        found.people.audit._late.append({"t_us": 0, "action": "waits for the archive"})
        vehicle.say("GLIDER_STATE", time_boot_ms=2, depth=2.0)
        until(lambda: found.vehicles[1].ingest.has_news)  # and the line's thread waits for the writer
        with closing(session), closing(script):
            yield {"session": session, "token": script}
        free.set()
        writer.join()
        patient.undo()


@pytest.mark.parametrize("who", ["session", "token"])
@pytest.mark.parametrize("path", LOOKS)
def test_no_look_waits_for_a_writer(held: dict[str, httpx.Client], who: str, path: str) -> None:
    place = re.sub(r"\{(\w+)\}", lambda found: PLACES.get(found[1], "1"), path)
    answer = held[who].get(place, timeout=60.0)
    assert answer.status_code in (200, 304, 404, 422), answer.text
