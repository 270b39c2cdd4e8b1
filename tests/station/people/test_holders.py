"""One pilot at a time holds command of a vehicle, and everybody sees who."""

import threading
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from stommel.archive import Archive
from stommel.station.people.errors import HeldError, PeopleError
from stommel.station.people.holders import Hold, Holders
from stommel.station.people.people import People
from stommel.station.people.roles import Role, User
from tests.support.station_served import PASSWORD

PAUL, PIA, ADA = User("paul", Role.PILOT), User("pia", Role.PILOT), User("ada", Role.ADMIN)


def test_taken_silently_where_nobody_has_it(people: People, told: list[Any], clock: Any) -> None:
    hold = people.holders.need(1, PAUL)
    assert (hold.user, hold.since) == ("paul", clock.now)
    assert people.holders.need(1, PAUL) == hold
    assert told == [(1, hold)]
    assert people.holders.of(2) is None


def test_two_pilots_at_once(people: People, told: list[Any]) -> None:
    people.holders.need(1, PAUL)
    with pytest.raises(HeldError, match=r"paul holds command of vehicle 1 since .* take it with a reason") as caught:
        people.holders.need(1, PIA)
    assert caught.value.holder == "paul"
    with pytest.raises(HeldError):
        people.holders.take(1, PIA, "  ")
    hold = people.holders.take(1, PIA, "paul is asleep")
    assert (hold.user, hold.taken_from, hold.reason) == ("pia", "paul", "paul is asleep")
    assert told[-1] == (1, hold)
    with pytest.raises(HeldError, match="pia holds"):
        people.holders.give_up(1, PAUL)
    people.holders.give_up(1, PIA)
    assert told[-1] == (1, None)
    assert people.holders.of(1) is None


def test_no_force_against_a_higher_role(people: People) -> None:
    people.holders.need(1, ADA)
    with pytest.raises(HeldError, match="only an admin"):
        people.holders.take(1, PIA, "I want to")
    people.holders.take(1, User("eve", Role.ADMIN), "ada has left")


def test_who_may_no_longer_fly_gives_up(people: People, told: list[Any]) -> None:
    people.users.add("ada", PASSWORD, Role.ADMIN)
    for change in (
        lambda: people.change("paul", disabled=True), lambda: people.change("paul", role=Role.VIEWER),
        lambda: people.remove("paul"),
    ):  # fmt: skip
        if people.users.known("paul") is None:
            people.users.add("paul", PASSWORD, Role.PILOT)
        people.change("paul", role=Role.PILOT, disabled=False)
        people.holders.take(1, PAUL)
        change()
        assert people.holders.of(1) is None
        assert told[-1] == (1, None)


def test_a_hold_outlives_the_station(people: People, tmp_path: Path) -> None:
    hold = people.holders.need(3, PAUL)
    again = Archive.open(f"sqlite:///{tmp_path / 'archive.sqlite'}")
    assert People(again).holders.of(3) == hold
    again.close()


def test_of_many_at_once_one_gets_it(people: People) -> None:
    got: list[str] = []
    start = threading.Barrier(8)

    def grab(name: str) -> None:
        start.wait()
        try:
            people.holders.need(1, User(name, Role.PILOT))
        except HeldError:
            return
        got.append(name)

    threads = [threading.Thread(target=grab, args=(f"p{number}",)) for number in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(got) == 1


def test_a_reason_has_an_end(people: People) -> None:
    people.holders.need(1, PAUL)
    with pytest.raises(PeopleError, match="too long"):
        people.holders.take(1, PIA, "x" * 501)


def test_the_last_that_is_told_is_what_is_so(people: People) -> None:
    """A change that is told late must not be told after the next one."""
    told, begun, go_on = list[str | None](), threading.Event(), threading.Event()

    def hear(_vehicle: int, hold: Hold | None) -> None:
        if hold is not None and hold.user == "paul":
            begun.set()
            go_on.wait(0.5)
        told.append(None if hold is None else hold.user)

    holders = Holders(people.users._archive, time.time, hear)
    first = threading.Thread(target=lambda: holders.take(1, PAUL))
    first.start()
    begun.wait(5.0)
    holders.take(1, PIA, "the watch is over")
    go_on.set()
    first.join()
    held = holders.of(1)
    assert held is not None
    assert told[-1] == held.user == "pia"


@pytest.mark.parametrize("doing", ["disable", "demote", "remove"])
def test_a_station_that_dies_in_the_middle_leaves_nobody_in_command_who_may_not_fly(
    people: People, monkeypatch: pytest.MonkeyPatch, doing: str
) -> None:
    """Oracle: the archive takes one transaction more, as if the power went after it."""
    people.users.add("ada", PASSWORD, Role.ADMIN)
    people.users.add("paul", PASSWORD, Role.PILOT)
    people.holders.take(1, PAUL)
    archive: Any = people.users._archive
    writing, left = archive.writing, [1]

    def once() -> Any:
        left[0] -= 1
        if left[0] < 0:
            raise KeyboardInterrupt
        return writing()

    monkeypatch.setattr(archive, "writing", once)
    with suppress(KeyboardInterrupt):
        if doing == "remove":
            people.remove("paul")
        elif doing == "disable":
            people.change("paul", disabled=True)
        else:
            people.change("paul", role=Role.VIEWER)
    assert people.holders.of(1) is None
