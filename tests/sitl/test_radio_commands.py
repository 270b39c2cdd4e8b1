"""Every command of the table, given by radio to a vehicle in the loop and followed to its last word."""

import hashlib
from dataclasses import replace

import pytest

from stommel.control.dive_cycle import SURFACE
from stommel.control.orders_file import orders_text
from stommel.link.channel.settings import ChannelSettings
from stommel.link.commands.report import Report
from stommel.link.commands.states import State, When
from stommel.link.commands.table import COMMANDS
from stommel.link.endings import Ending
from stommel.onboard.coordination.executive import State as Mode
from stommel.simulation.scenario.mission import Mission
from stommel.simulation.scenario.orders_header import orders_header
from tests.sitl.test_radio import Flight


@pytest.fixture
def flight(trial: Mission) -> Flight:
    found = Flight(trial, ChannelSettings())
    found.until(lambda: found.shore.end.is_heard(found.now))
    return found


def given(
    flight: Flight, name: str, valid_for: float = 3000.0, when: When = When.UNTIL_EXPIRY, **values: float
) -> Report:
    """Give a command, and fly until its last word."""
    commands = flight.shore.end.commands
    id = commands.give(name, values, flight.now, valid_for=valid_for, when=when)
    flight.until(lambda: commands.report(id, flight.now).is_last)
    return commands.report(id, flight.now)


def mode(flight: Flight) -> Mode:
    view = flight.system.coordinator.view
    assert view is not None
    return view.executive.state


def test_hold_test_check_and_start_at_the_surface(flight: Flight) -> None:
    flight.until(lambda: mode(flight) is Mode.COMMUNICATE)
    assert given(flight, "hold").state is State.DONE
    flight.until(lambda: mode(flight) is Mode.HOLD, 30)
    assert given(flight, "self-test").state is State.DONE
    assert given(flight, "check").state is State.DONE
    refused = given(flight, "surface")
    assert (refused.state, refused.words) == (State.REFUSED, "it is at the surface")
    assert given(flight, "start").state is State.DONE
    flight.until(lambda: mode(flight) is Mode.COMMUNICATE, 200)
    flight.until(lambda: flight.system.plant.depth > 1.0)


def test_a_recall_given_before_the_dive_brings_the_vehicle_up_from_it(flight: Flight) -> None:
    """The command waits ashore while the vehicle dives: it is carried out at the surface, and the mission is held."""
    flight.until(lambda: flight.system.plant.depth > 1.5)
    assert given(flight, "recall").state is State.DONE
    assert flight.system.coordinator.pilot.phase == SURFACE
    flight.until(lambda: mode(flight) is Mode.HOLD, 60)


def test_at_the_next_surfacing_means_after_the_dive(flight: Flight) -> None:
    report = given(flight, "hold", when=When.AT_NEXT_SURFACING)
    memory = flight.system.coordinator.pilot.memory
    assert report.state is State.DONE
    assert memory is not None
    assert int(memory["dives"]) == 1


def test_an_abort_is_cleared_and_the_mission_begins_anew(flight: Flight) -> None:
    assert given(flight, "abort").state is State.DONE
    flight.until(lambda: mode(flight) is Mode.ABORT, 10)
    failed = given(flight, "start")
    assert (failed.state, failed.words) == (State.FAILED, "an abort stands: clear it first")
    assert given(flight, "clear").state is State.DONE
    flight.until(lambda: mode(flight) is not Mode.ABORT, 30)
    assert given(flight, "start").state is State.DONE
    flight.until(lambda: mode(flight) is Mode.COMMUNICATE, 400)


def told_ctd(flight: Flight) -> float:
    """How often the CTD's node was told to sample [s]."""
    return float(flight.system.acquisition._interval)


def test_missions_are_switched_and_rolled_back_by_command(flight: Flight, trial: Mission) -> None:
    end, coordinator = flight.shore.end, flight.system.coordinator
    before = coordinator.pilot.orders
    assert before is not None
    other = before._replace(radius=before.radius + 7.0)
    header = replace(orders_header(trial), sample_every_s=4.0)
    end.orders.send(orders_text(other, header).encode(), flight.now, 600.0, only_check=True)
    flight.until(lambda: end.orders.outcome is not None)
    assert end.orders.outcome is not None
    assert end.orders.outcome.ending is Ending.WHOLE, end.orders.outcome.words
    assert coordinator.mission == 1
    usual = told_ctd(flight)
    wrong = given(flight, "switch-mission", mission=9.0)
    assert wrong.state is State.FAILED
    assert "number 2" in wrong.words
    assert given(flight, "switch-mission", mission=2.0).state is State.DONE
    flight.until(lambda: coordinator.mission == 2, 10)
    assert coordinator.pilot.orders is not None
    assert coordinator.pilot.orders.radius == before.radius + 7.0
    flight.until(lambda: told_ctd(flight) == 4.0, 10)
    assert given(flight, "roll-back-mission").state is State.DONE
    flight.until(lambda: coordinator.mission == 3, 10)
    assert coordinator.pilot.orders.radius == before.radius
    flight.until(lambda: told_ctd(flight) == usual, 10)
    end.orders.ask(flight.now, 600.0)
    flight.until(lambda: end.orders.outcome is not None)
    assert end.orders.outcome.held is not None
    text = orders_text(before, orders_header(trial)).encode()
    assert end.orders.outcome.held.sha256 == hashlib.sha256(text).digest()


def test_a_simulated_vehicle_refuses_to_be_restarted(flight: Flight) -> None:
    """Nobody would start it again; `stommel vehicle run --supervised` is where it may."""
    refused = given(flight, "restart")
    assert (refused.state, refused.words) == (State.REFUSED, "nobody would start the software again")


def test_every_command_of_the_table_is_tried_in_the_loop() -> None:
    tried = {"hold", "self-test", "check", "surface", "start", "recall", "abort", "clear", "switch-mission",
             "roll-back-mission", "restart", "radio-time"}  # fmt: skip
    assert {row.name for row in COMMANDS} == tried
