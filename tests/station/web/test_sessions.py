"""Logging in, holds, tokens and the audit log as a browser and a script see them."""

import threading
import time
from concurrent.futures import ThreadPoolExecutor

import httpx
import pytest

from stommel.station.station import Station
from stommel.station.web.app import create_app
from stommel.station.web.exposure import Exposure
from tests.support.station_served import PASSWORD, logged_in, served


def test_log_in_and_out(address: str) -> None:
    with httpx.Client(base_url=address) as client:
        answer = client.post("/api/session", json={"name": "Paul", "password": PASSWORD})
        assert answer.json() == {"name": "paul", "role": "pilot"}
        cookie = answer.headers["set-cookie"].casefold()
        assert "httponly" in cookie
        assert "samesite=strict" in cookie
        assert PASSWORD not in answer.text
        assert client.get("/api/station").json()["user"] == {"name": "paul", "role": "pilot"}
        secret = client.cookies["stommel_session"]
        assert client.delete("/api/session").status_code == 204
        assert client.get("/api/station").json()["user"] is None
        stolen = httpx.get(f"{address}/api/vehicles", cookies={"stommel_session": secret})
        assert stolen.status_code == 401


def test_wrong_name_and_wrong_password_read_the_same(address: str) -> None:
    told = [
        httpx.post(f"{address}/api/session", json={"name": name, "password": password})
        for name, password in (("paul", "not this one"), ("nobody", PASSWORD))
    ]
    assert [answer.status_code for answer in told] == [401, 401]
    assert told[0].json() == told[1].json()
    assert "set-cookie" not in told[0].headers


def test_brute_force_is_told_to_wait(address: str) -> None:
    def attempt(password: str) -> httpx.Response:
        return httpx.post(f"{address}/api/session", json={"name": "paul", "password": password}, timeout=60.0)

    begin = time.monotonic()
    assert [attempt(f"wrong {k}").status_code for k in range(5)] == [401] * 5
    answer = attempt(PASSWORD)
    took = time.monotonic() - begin
    assert answer.status_code == 429
    assert 58 - took <= int(answer.headers["retry-after"]) <= 62
    assert "try again in" in answer.json()["detail"]["reason"]
    assert "set-cookie" not in answer.headers


def test_two_pilots_at_once(paul: httpx.Client, pia: httpx.Client, vera: httpx.Client) -> None:
    assert paul.post("/api/vehicles/1/holder", json={}).json()["holder"]["user"] == "paul"
    refused = pia.post("/api/vehicles/1/holder", json={})
    assert refused.status_code == 409
    assert "paul holds command" in refused.json()["detail"]["reason"]
    assert pia.delete("/api/vehicles/1/holder").status_code == 409
    unsaid = pia.post("/api/vehicles/1/holder", json={"by_force": True, "reason": " "})
    assert unsaid.json()["detail"]["key"] == "reason"
    taken = pia.post("/api/vehicles/1/holder", json={"by_force": True, "reason": "paul is asleep"}).json()["holder"]
    assert (taken["user"], taken["taken_from"], taken["reason"]) == ("pia", "paul", "paul is asleep")
    assert vera.get("/api/vehicles/1/holder").json()["holder"]["user"] == "pia"
    assert vera.get("/api/vehicles/1").json()["holder"] == "pia"
    assert pia.delete("/api/vehicles/1/holder").status_code == 204
    assert vera.get("/api/vehicles/1/holder").json() == {"holder": None}


def test_a_script_speaks_by_token_with_a_lesser_role(paul: httpx.Client, address: str) -> None:
    made = paul.post("/api/tokens", json={"name": "plots", "role": "viewer", "days": 3}).json()
    script = {"Authorization": f"Bearer {made['secret']}"}
    assert httpx.get(f"{address}/api/vehicles", headers=script).status_code == 200
    assert httpx.post(f"{address}/api/vehicles/1/holder", json={}, headers=script).status_code == 403
    for method, path, body in (
        ("POST", "tokens", {"name": "more", "role": "viewer"}),
        ("PUT", "session/password", {"password": PASSWORD, "new_password": "another way to the sea"}),
    ):
        answer = httpx.request(method, f"{address}/api/{path}", json=body, headers=script)
        assert answer.status_code == 403
        assert "a token changes no" in answer.json()["detail"]["reason"]
    assert made["secret"] not in paul.get("/api/tokens").text
    assert paul.post("/api/tokens", json={"name": "up", "role": "admin"}).status_code == 422
    assert paul.post("/api/tokens", json={"name": "x", "role": "viewer", "user": "ada"}).status_code == 403
    assert paul.delete(f"/api/tokens/{made['token']['token']}").status_code == 204
    assert httpx.get(f"{address}/api/vehicles", headers=script).status_code == 401


def test_tokens_of_others_are_not_seen_nor_removed(paul: httpx.Client, pia: httpx.Client, ada: httpx.Client) -> None:
    number = paul.post("/api/tokens", json={"name": "plots", "role": "viewer"}).json()["token"]["token"]
    assert pia.get("/api/tokens").json() == []
    assert pia.delete(f"/api/tokens/{number}").status_code == 404
    assert [row["name"] for row in ada.get("/api/tokens").json()] == ["plots"]
    assert ada.delete(f"/api/tokens/{number}").status_code == 204


@pytest.mark.parametrize("header", ["Bearer x", "Bearer", "Basic YTpi", "Token x"])
def test_a_wrong_token_is_no_visitor_of_the_loopback(quay: httpx.Client, header: str) -> None:
    answer = quay.get("/api/vehicles", headers={"Authorization": header})
    assert answer.status_code == (200 if not header.partition(" ")[2].strip() else 401)


def test_an_admin_keeps_somebody_out_at_once(ada: httpx.Client, paul: httpx.Client) -> None:
    assert paul.get("/api/vehicles").status_code == 200
    assert ada.patch("/api/users/paul", json={"disabled": True}).status_code == 200
    assert paul.get("/api/vehicles").status_code == 401
    last = ada.patch("/api/users/ada", json={"role": "viewer"})
    assert last.status_code == 422
    assert "last admin" in last.json()["detail"]["reason"]


def test_a_new_password_needs_the_present_one(paul: httpx.Client, address: str) -> None:
    change = {"password": "not this one", "new_password": "another way to the sea"}
    assert paul.put("/api/session/password", json=change).status_code == 401
    assert paul.put("/api/session/password", json=change | {"password": PASSWORD}).status_code == 204
    assert paul.get("/api/vehicles").status_code == 401
    logged_in(address, "paul", "another way to the sea").close()


def test_every_change_is_in_the_audit_log_without_secrets(
    ada: httpx.Client, paul: httpx.Client, station: Station
) -> None:
    ada.post("/api/users", json={"name": "bob", "password": "a very long word", "role": "viewer"})
    paul.post("/api/vehicles/1/holder", json={"by_force": False})
    paul.get("/api/vehicles")
    paul.post("/api/users", json={})
    rows = ada.get("/api/audit").json()
    told = [(row["action"], row["user"], row["vehicle"], row["address"]) for row in rows]
    assert told[:2] == [("take command", "paul", 1, "127.0.0.1"), ("add user", "ada", None, "127.0.0.1")]
    assert rows[1]["detail"]["body"] == {"name": "bob", "password": "***", "role": "viewer"}
    assert "a very long word" not in str(rows)
    assert {row["action"] for row in rows} == {"take command", "add user", "log in"}
    older = ada.get(f"/api/audit?before={rows[0]['entry']}&limit=1").json()
    assert [row["entry"] for row in older] == [rows[1]["entry"]]


def test_no_password_of_ones_own_is_in_the_audit_log(ada: httpx.Client, paul: httpx.Client) -> None:
    change = {"password": PASSWORD, "new_password": "another way to the sea"}
    assert paul.put("/api/session/password", json=change).status_code == 204
    row = ada.get("/api/audit").json()[0]
    assert (row["action"], row["user"]) == ("change password", "paul")
    assert row["detail"]["body"] == {"password": "***", "new_password": "***"}


def test_the_log_is_added_to_only(ada: httpx.Client) -> None:
    for method in ("POST", "PUT", "PATCH", "DELETE"):
        assert ada.request(method, "/api/audit").status_code == 405


def test_at_the_machine_itself_actions_are_noted_too(local: httpx.Client, station: Station) -> None:
    local.post("/api/vehicles/1/holder", json={})
    (entry,) = station.people.audit.entries()
    assert (entry.action, entry.user, entry.vehicle) == ("take command", "local", 1)


def test_many_logins_at_once_do_not_pile_up(station: Station, monkeypatch: pytest.MonkeyPatch) -> None:
    """argon2 takes 64 MB a try: tries wait for each other, and not without end."""
    together, most = 0, 0
    right = threading.Lock()

    def slow(_given: str, _known: str | None) -> bool:
        nonlocal together, most
        with right:
            together += 1
            most = max(most, together)
        time.sleep(0.01)
        with right:
            together -= 1
        return False

    monkeypatch.setattr("stommel.station.people.people.verified", slow)
    with served(create_app(station, Exposure(login=True))) as address, ThreadPoolExecutor(40) as crowd:

        def attempt(number: int) -> int:
            body = {"name": f"n{number}", "password": "wrong password"}
            return httpx.post(f"{address}/api/session", json=body, timeout=60.0).status_code

        found = list(crowd.map(attempt, range(60)))
    assert set(found) <= {401, 429}
    assert found.count(401) == 20  # as many as one address may try in a minute
    assert most == 1
