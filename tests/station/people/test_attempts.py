"""Brute force: each wrong password makes the next wait longer, by name and by address."""

from itertools import pairwise
from typing import Any

import pytest

from stommel.station.people.attempts import network
from stommel.station.people.errors import TooManyTriesError, WrongLoginError
from stommel.station.people.people import People
from stommel.station.people.roles import Role
from tests.support.station_served import PASSWORD


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Thousands of tries would take argon2 minutes."""
    monkeypatch.setattr(
        "stommel.station.people.people.verified", lambda given, known: given == PASSWORD and bool(known)
    )


def _tries(people: People, clock: Any, name: str, address: str, seconds: float) -> list[float]:
    """When somebody who never gives up gets to try in that time."""
    begin, at = clock.now, []
    while clock.now < begin + seconds:
        try:
            people.log_in(name, "wrong", address)
        except WrongLoginError:
            at.append(clock.now - begin)
        except TooManyTriesError as error:
            clock.now += error.wait
    return at


@pytest.mark.usefixtures("quick")
def test_waits_grow_and_a_day_gives_few_tries(people: People, clock: Any) -> None:
    people.users.add("anna", PASSWORD, Role.PILOT)
    at = _tries(people, clock, "anna", "10.0.0.1", 86_400.0)
    waits = [later - earlier for earlier, later in pairwise(at)]
    assert len(at) <= 40
    assert waits[:4] == [0.0] * 4
    assert waits[4] == pytest.approx(60.0, abs=2.0)
    assert waits[9] > waits[4]
    assert waits[19] > waits[9]


@pytest.mark.usefixtures("quick")
def test_the_right_password_does_not_pass_a_wait_either(people: People, clock: Any) -> None:
    people.users.add("anna", PASSWORD, Role.PILOT)
    for _ in range(5):
        with pytest.raises(WrongLoginError):
            people.log_in("anna", "wrong", "10.0.0.1")
    with pytest.raises(TooManyTriesError, match="try again in"):
        people.log_in("anna", PASSWORD, "10.0.0.1")
    assert people.log_in("anna", PASSWORD, "10.0.0.2")[0].name == "anna"  # who is elsewhere is not locked out
    clock.now += 61.0
    assert people.log_in("anna", PASSWORD, "10.0.0.1")[0].name == "anna"
    with pytest.raises(WrongLoginError):  # and begins anew
        people.log_in("anna", "wrong", "10.0.0.1")


@pytest.mark.usefixtures("quick")
def test_one_address_with_many_names(people: People, clock: Any) -> None:
    tries = 0
    for number in range(100):
        try:
            people.log_in(f"user{number}", "wrong", f"2001:db8::{number:x}")  # one household of IPv6
        except WrongLoginError:
            tries += 1
        except TooManyTriesError:
            break
    assert tries == 20


@pytest.mark.usefixtures("quick")
def test_many_addresses_with_one_name(people: People, clock: Any) -> None:
    people.users.add("anna", PASSWORD, Role.PILOT)
    tries = 0
    for number in range(200):
        try:
            people.log_in("anna", "wrong", f"10.0.{number}.1")
        except WrongLoginError:
            tries += 1
        except TooManyTriesError:
            break
    assert tries == 30


def test_wrong_tokens_count_by_address(people: People, clock: Any) -> None:
    for number in range(20):
        assert people.by_token(f"stommel_{number}", "10.0.0.1") is None
    with pytest.raises(TooManyTriesError):
        people.by_token("stommel_x", "10.0.0.1")
    people.users.add("anna", PASSWORD, Role.PILOT)
    _, script = people.tokens.add("anna", "plots", Role.VIEWER, None)
    assert people.by_token(script, "10.0.0.1")


def test_unknown_names_take_as_long_as_known_ones(people: People, monkeypatch: pytest.MonkeyPatch) -> None:
    """The oracle is what takes the time: one argon2 of the same settings each, whoever it is."""
    from pwdlib.hashers.argon2 import Argon2Hasher

    people.users.add("anna", PASSWORD, Role.PILOT)
    people.users.add("gone", PASSWORD, Role.PILOT)
    people.change("gone", disabled=True)
    worked: list[str] = []
    verify = Argon2Hasher.verify

    def noted(self: Argon2Hasher, password: str, known: str) -> bool:
        worked.append("$".join(str(known).split("$")[1:4]))
        return verify(self, password, known)

    monkeypatch.setattr(Argon2Hasher, "verify", noted)
    for name in ("anna", "nobody", "gone"):
        with pytest.raises(WrongLoginError):
            people.log_in(name, "wrong", "10.0.0.1")
    assert len(worked) == 3
    assert set(worked) == {worked[0]}
    assert worked[0].startswith("argon2id$v=19$m=65536")


def test_a_refused_login_is_in_the_audit_log(people: People) -> None:
    with pytest.raises(WrongLoginError):
        people.log_in("<script>", "wrong password", "10.0.0.9")
    (entry,) = people.audit.entries()
    assert (entry.action, entry.user, entry.address, entry.detail) == (
        "log in refused", None, "10.0.0.9", {"name": "<script>"},
    )  # fmt: skip


def test_what_counts_as_one_origin() -> None:
    assert network("2001:db8::1") == network("2001:db8::ffff:1")
    assert network("2001:db8:0:1::1") != network("2001:db8:0:2::1")
    assert network("::ffff:10.0.0.1") == network("10.0.0.1")
    assert network("unknown") == "unknown"
