"""How the alarms come to know a station's vehicles: contact from summaries, settings from station.toml."""

from pathlib import Path
from typing import Any

import pytest

from stommel.station.alarms.contact_watch import Contact
from stommel.station.settings import load_settings
from stommel.station.watching import contact_of
from tests.station.alarms.receivers import web_server
from tests.station.client import Client
from tests.station.speaker import speaker, until
from tests.station.stations import station as running

SUMMARY: dict[str, Any] = {"last_contact": 5.0, "next_surfacing": None, "phase": "surface", "link_reason": ""}


@pytest.mark.parametrize(
    ("told", "contact"),
    [
        ({}, Contact(5.0)),
        ({"last_contact": None, "phase": None}, Contact(None)),
        ({"next_surfacing": {"t": 9.0, "why": "x"}}, Contact(5.0, 9.0)),
        ({"phase": "descent", "link_reason": "silent"}, Contact(5.0, None, True, "silent")),
        ({"phase": "drift"}, Contact(5.0, is_diving=True)),  # it hangs in the water at depth: docs/guide/missions.md
        ({"phase": "recovery"}, Contact(5.0)),  # it stays at the surface and calls
    ],
)
def test_contact_is_what_the_summary_says(told: dict[str, Any], contact: Contact) -> None:
    assert contact_of({**SUMMARY, **told}) == contact


def test_secrets_are_looked_for_beside_the_settings(tmp_path: Path) -> None:
    (tmp_path / "station.toml").write_text(
        """
        [alarms]
        surfacing_margin_s = 60
        [alerts]
        least_severity = "critical"
        [alerts.email]
        host = "mail.example.org"
        user = "station"
        password_file = "mail-password"
        sender = "station@example.org"
        recipients = ["pilot@example.org"]
        [[alerts.webhooks]]
        url = "https://example.org/x"
        secret_file = "secret"
        """
    )
    settings = load_settings(tmp_path / "station.toml")
    assert settings.alarms.surfacing_margin_s == 60.0
    assert settings.alerts.email is not None
    assert settings.alerts.email.password_file == tmp_path / "mail-password"
    assert settings.alerts.webhooks[0].secret_file == tmp_path / "secret"


def test_a_vehicle_that_falls_silent_is_told_to_people_who_are_away(tmp_path: Path) -> None:
    """The whole way: a vehicle speaks, falls silent, and a webhook is told; it speaks again, and that is told too."""
    with speaker() as vehicle, web_server() as server:
        alerts = {"webhooks": [{"url": f"http://127.0.0.1:{server.server_port}/"}]}
        told = {"alerts": alerts, "alarms": {"longest_silence_s": 10}}
        with running(tmp_path, vehicle.address, vehicle={"speed": 50.0}, **told) as made:
            vehicle.connect()
            vehicle.say("SYSTEM_TIME", time_unix_usec=1_700_000_000_000_000, time_boot_ms=1)
            until(lambda: made.hub.now(1) < 1.8e9)
            until(lambda: server.requests)
            (row,) = Client(made).get("/alarms", vehicle=1, open=True)
            assert row["key"] == "link_silent"
            vehicle.say("GLIDER_STATE", time_boot_ms=2, depth=0.0)
            until(lambda: len(server.requests) > 1)
    assert b"no dive is known" in server.requests[0][2]
    assert b"Over: Nothing heard" in server.requests[1][2]
