"""Users: names, passwords, roles, and somebody always looks after the station."""

import pytest
from sqlalchemy import text

from stommel.station.people.errors import PeopleError, UnknownPersonError
from stommel.station.people.people import People
from stommel.station.people.roles import Role
from tests.support.station_served import PASSWORD


def test_a_password_is_kept_as_an_argon2_hash_only(people: People, tmp_path: object) -> None:
    people.users.add("anna", PASSWORD, Role.PILOT)
    with people.users._archive.reading() as connection:
        (row,) = connection.execute(text("select * from users")).all()
    assert row.password_hash.startswith("$argon2id$")
    assert PASSWORD not in str(row)


@pytest.mark.parametrize(
    "name", ["", " ", "a b", "../etc", "local", "LOCAL", "x" * 65, "<b>", "a\x00", "-x", "_x", "a/b"]
)
def test_names_that_nobody_may_have(people: People, name: str) -> None:
    with pytest.raises(PeopleError, match="no name") as caught:
        people.users.add(name, PASSWORD, Role.VIEWER)
    assert caught.value.key == "name"


def test_one_spelling_of_a_name(people: People) -> None:
    people.users.add("Åsa", PASSWORD, Role.VIEWER)
    with pytest.raises(PeopleError, match="already"):
        people.users.add("A\u030asa".upper(), PASSWORD, Role.ADMIN)
    assert people.log_in("ÅSA", PASSWORD, "10.0.0.1")[0].name == "åsa"


@pytest.mark.parametrize("password", ["short", "aaaaaaaaaaaaaaa", "anna-anna-bob", "x" * 201])
def test_weak_passwords_are_refused_and_not_repeated(people: People, password: str) -> None:
    with pytest.raises(PeopleError) as caught:
        people.users.add("anna", password, Role.VIEWER)
    assert caught.value.key == "password"
    assert password not in str(caught.value)
    assert people.users.everybody() == []


def test_the_last_admin_stays(people: People) -> None:
    people.users.add("ada", PASSWORD, Role.ADMIN)
    people.users.add("paul", PASSWORD, Role.PILOT)
    for change in (
        lambda: people.change("ada", role=Role.PILOT), lambda: people.change("ada", disabled=True),
        lambda: people.remove("ada"),
    ):  # fmt: skip
        with pytest.raises(PeopleError, match="last admin"):
            change()
    assert [(p.name, p.role, p.disabled) for p in people.users.everybody()] == [
        ("ada", Role.ADMIN, False), ("paul", Role.PILOT, False),
    ]  # fmt: skip
    people.change("paul", role=Role.ADMIN)
    people.remove("ada")


def test_nobody_of_that_name(people: People) -> None:
    with pytest.raises(UnknownPersonError, match="nobody is named bob"):
        people.change("bob", role=Role.ADMIN)
    with pytest.raises(UnknownPersonError):
        people.remove("bob")


def test_who_is_kept_out_or_gets_a_new_password_is_out_at_once(people: People) -> None:
    people.users.add("ada", PASSWORD, Role.ADMIN)
    people.users.add("paul", PASSWORD, Role.PILOT)
    for change in ({"disabled": True}, {"disabled": False, "password": "another way to the sea"}):
        _, secret = people.log_in("paul", PASSWORD, "10.0.0.1")
        _, script = people.tokens.add("paul", "plots", Role.VIEWER, 10.0)
        assert people.sessions.user_of(secret)
        assert people.tokens.user_of(script)
        people.change("paul", **change)
        assert people.sessions.user_of(secret) is None
        assert (people.tokens.user_of(script) is None) == bool(change["disabled"])
        people.change("paul", disabled=False)
        assert people.sessions.user_of(secret) is None


def test_a_role_counts_at_once(people: People) -> None:
    people.users.add("ada", PASSWORD, Role.ADMIN)
    people.users.add("paul", PASSWORD, Role.PILOT)
    user, secret = people.log_in("paul", PASSWORD, "10.0.0.1")
    assert user.role is Role.PILOT
    people.change("paul", role=Role.VIEWER)
    known = people.sessions.user_of(secret)
    assert known is not None
    assert known.role is Role.VIEWER
