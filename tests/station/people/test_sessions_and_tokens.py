"""Sessions and tokens: hashed, ended in time, never above the person."""

from typing import Any

import pytest
from sqlalchemy import text

from stommel.station.people.errors import PeopleError, UnknownPersonError
from stommel.station.people.people import People
from stommel.station.people.roles import Role
from stommel.station.people.sessions import IDLE_S, LONGEST_S, MOST
from tests.support.station_served import PASSWORD

HERE = "10.0.0.1"


@pytest.fixture
def secret(people: People) -> str:
    people.users.add("paul", PASSWORD, Role.PILOT)
    return people.log_in("paul", PASSWORD, HERE)[1]


def test_the_archive_holds_no_secret(people: People, secret: str) -> None:
    _, script = people.tokens.add("paul", "plots", Role.PILOT, None)
    with people.users._archive.reading() as connection:
        kept = str(
            [connection.execute(text(f"select * from {table}")).all() for table in ("sessions", "tokens", "audit")]
        )
    assert secret not in kept
    assert script not in kept
    assert len(secret) >= 43  # 256 bits in base 64


def test_a_session_that_rests_ends(people: People, secret: str, clock: Any) -> None:
    clock.now += IDLE_S - 1.0
    assert people.sessions.user_of(secret)
    clock.now += IDLE_S - 1.0  # it was used, so it lives on
    assert people.sessions.user_of(secret)
    clock.now += IDLE_S + 1.0
    assert people.sessions.user_of(secret) is None


def test_a_session_in_use_ends_after_a_week(people: People, secret: str, clock: Any) -> None:
    begin = clock.now
    while clock.now < begin + LONGEST_S - 3600.0:
        assert people.sessions.user_of(secret)
        clock.now += 3600.0
    clock.now = begin + LONGEST_S + 1.0
    assert people.sessions.user_of(secret) is None


def test_log_out(people: People, secret: str) -> None:
    people.sessions.end(secret)
    assert people.sessions.user_of(secret) is None
    people.sessions.end("nonsense")


def test_sessions_of_a_person_are_bounded(people: People, secret: str, clock: Any) -> None:
    for _ in range(MOST):
        clock.now += 1.0
        last = people.sessions.begin("paul", HERE)
    assert people.sessions.user_of(secret) is None
    assert people.sessions.user_of(last)


@pytest.mark.parametrize("wrong", ["", "x", "\ud800", "x" * 10_000, "stommel_x"])
def test_a_wrong_secret_is_nobody(people: People, secret: str, wrong: str) -> None:
    assert people.sessions.user_of(wrong) is None
    assert people.tokens.user_of(wrong) is None


def test_a_token_ends_in_time(people: People, secret: str, clock: Any) -> None:
    _, script = people.tokens.add("paul", "plots", Role.VIEWER, 2.0)
    clock.now += 2.0 * 86400.0 - 1.0
    user = people.tokens.user_of(script)
    assert user is not None
    assert (user.name, user.role, user.via) == ("paul", Role.VIEWER, "token")
    assert people.tokens.of("paul")[0].last_used == clock.now
    clock.now += 2.0
    assert people.tokens.user_of(script) is None


def test_a_token_is_never_above_its_person(people: People, secret: str) -> None:
    people.users.add("ada", PASSWORD, Role.ADMIN)
    with pytest.raises(PeopleError, match="cannot lend the role admin"):
        people.tokens.add("paul", "all", Role.ADMIN, None)
    _, script = people.tokens.add("paul", "fly", Role.PILOT, None)
    people.change("paul", role=Role.VIEWER)
    user = people.tokens.user_of(script)
    assert user is not None
    assert user.role is Role.VIEWER


def test_tokens_are_removed_by_their_person(people: People, secret: str) -> None:
    people.users.add("ada", PASSWORD, Role.ADMIN)
    token, script = people.tokens.add("paul", "plots", Role.VIEWER, None)
    with pytest.raises(UnknownPersonError):
        people.tokens.remove(token.token, "ada")
    assert people.tokens.user_of(script)
    people.tokens.remove(token.token, "paul")
    assert people.tokens.user_of(script) is None
