"""Whole orders files over a bad line. Oracle: the bytes that were sent; the vehicle holds the old ones or the new."""

import hashlib
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from stommel.errors import StommelError
from stommel.link.endings import Ending
from stommel.link.missions.orders_client import PIECE, OrdersClient, OrdersOutcome
from stommel.link.missions.orders_server import OrdersServer
from stommel.link.service import Received
from stommel.messages.mavlink import Fields, message_named
from tests.link.line import End, Line, Says, losing, losing_number
from tests.link.missions.vehicle import Vehicle, orders_joined

FIRST = b"the first orders"
TO: Fields = {"target_system": 1, "target_component": 1}


def content(size: int, seed: int = 0) -> bytes:
    return random.Random(seed).randbytes(size)


def ended(client: OrdersClient, line: Line, within: float = 3600.0) -> OrdersOutcome:
    line.run(lambda: client.outcome is not None, within)
    assert client.outcome is not None
    return client.outcome


def test_a_file_is_sent_checked_and_held() -> None:
    vehicle = Vehicle()
    client, line = orders_joined(vehicle)
    new = content(20_000)
    client.send(new, line.t, only_check=True)
    assert ended(client, line) == OrdersOutcome(Ending.WHOLE)
    assert vehicle.files == [FIRST]
    pieces = line.counted("ORDERS_PIECE")
    assert pieces == -(-len(new) // PIECE)
    client.send(new, line.t)
    assert ended(client, line) == OrdersOutcome(Ending.WHOLE)
    assert line.counted("ORDERS_PIECE") == pieces, "what was checked is not sent again"
    assert vehicle.files == [FIRST, new]
    client.ask(line.t)
    held = ended(client, line).held
    assert held is not None
    assert (held.number, held.name, held.sha256) == (2, "in memory", hashlib.sha256(new).digest())
    assert held.previous == hashlib.sha256(FIRST).digest()
    client.roll_back(held.previous, line.t)
    assert ended(client, line) == OrdersOutcome(Ending.WHOLE)
    assert vehicle.files[-1] == FIRST
    client.roll_back(b"x" * 32, line.t)
    assert ended(client, line).words == ("orders: the ones before are others, or there are none",)


def test_any_single_message_lost() -> None:
    """Each message in turn: it ends whole, and what is said again is what was lost, with what follows from it."""
    new = content(3_000)
    client, line = orders_joined(Vehicle())
    client.send(new, line.t)
    ended(client, line)
    total = len(line.sent)
    assert total > 20
    for number in range(total):
        vehicle = Vehicle()
        client, line = orders_joined(vehicle)
        line.loses = losing_number(number)
        client.send(new, line.t)
        assert ended(client, line, 30.0).ending is Ending.WHOLE, f"message {number} lost"
        assert vehicle.files == [FIRST, new]
        assert vehicle.repeated == 0
        assert len(line.sent) <= total + 3


def test_a_session_of_a_hundred_files_cut_anywhere() -> None:
    """mavlink/qgroundcontrol#6731. Loss, late copies, kills of the shore's program and restarts of the vehicle's."""
    for session in range(5):
        draw = random.Random(session)
        vehicle = Vehicle()
        client, line = orders_joined(vehicle)
        line.loses, line.latency = losing(draw, 0.25), 0.1
        sent = [FIRST]
        for number in range(100):
            sent.append(content(draw.choice([700, 2_000]), 1000 * session + number))
            if draw.random() < 0.2:
                client = OrdersClient(1, random.Random(1000 * session + number))
                line.shore.services = [client]
            client.send(sent[-1], line.t)
            cut_at = line.t + draw.uniform(0.0, 6.0)
            while line.t < cut_at and client.outcome is None:
                line.step()
                if line.flying and draw.random() < 0.05:
                    due, copy = draw.choice(line.flying)
                    line.flying.append((due + draw.uniform(0.0, 9.0), copy))
                if draw.random() < 0.003:
                    vehicle.restart()
            if client.outcome is not None and client.outcome.ending is Ending.WHOLE:
                assert vehicle.files[-1] == sent[-1]
        assert set(vehicle.files) <= set(sent)
        assert len(vehicle.files) > 20


def test_a_file_over_many_surfacings() -> None:
    """It goes on where it was, and nothing that arrived is sent again, but what was on its way at the end of each."""
    vehicle = Vehicle()
    client, line = orders_joined(vehicle)
    line.rate = 600.0
    new = content(60_000)
    client.send(new, line.t)
    surfacings = 0
    while client.outcome is None:
        surfacings += 1
        assert surfacings < 20
        line.is_silent = False
        line.wait(20.0)
        line.is_silent = True
        line.wait(120.0)
        if client.outcome is None:
            assert client.progress(line.t).of == len(new)
    assert client.outcome.ending is Ending.WHOLE
    assert surfacings > 5
    assert vehicle.files == [FIRST, new]
    assert vehicle.repeated <= 0.01 * len(new)


@pytest.mark.parametrize(("loss", "latency"), [(0.0, 0.05), (0.3, 0.5), (0.2, 1.0)])
def test_missing_ranges_are_asked_for_in_one_message(loss: float, latency: float) -> None:
    """PX4/PX4-Autopilot#11078: no more than 5 % comes twice, whatever the round trip."""
    for seed in range(5):
        vehicle = Vehicle()
        client, line = orders_joined(vehicle, seed)
        line.loses, line.latency, line.rate = losing(random.Random(seed), loss), latency, 2400.0
        client.send(content(30_000, seed), line.t)
        assert ended(client, line).ending is Ending.WHOLE
        assert vehicle.repeated <= (0.05 * 30_000 if loss else 0)


def test_a_refusal_has_every_reason() -> None:
    """More reasons than one message holds, some of them lost; nothing has changed aboard."""
    vehicle = Vehicle()
    client, line = orders_joined(vehicle)
    line.loses = losing(random.Random(2), 0.3)
    bad = [f"bad {number}" for number in range(12)]
    client.send("\n".join(bad).encode(), line.t)
    assert ended(client, line) == OrdersOutcome(Ending.REFUSED, tuple(f"mission: {line}: must be good" for line in bad))
    assert vehicle.files == [FIRST]
    line.loses = lambda sent: False
    client.send(bytes(2 << 20), line.t)
    outcome = ended(client, line)
    assert (outcome.ending, outcome.words) == (
        Ending.REFUSED, ("mission: size = 2097152: must be between 1 and 1048576 bytes",),
    )  # fmt: skip
    with pytest.raises(StommelError, match="empty"):
        client.send(b"", line.t)


def test_a_late_copy_of_a_request_is_not_carried_out_again() -> None:
    """Rolling back twice would be forward again; only the newest request of a session counts, and it counts once."""
    vehicle = Vehicle()
    client, line = orders_joined(vehicle)
    client.send(content(500), line.t)
    ended(client, line)
    client.roll_back(hashlib.sha256(FIRST).digest(), line.t)
    ended(client, line)
    requests = [sent.received for sent in line.sent if sent.received.name == "ORDERS_REQUEST"]
    client.send(content(500, 1), line.t)
    ended(client, line)
    held = list(vehicle.files)
    for _ in range(3):
        for request in requests:
            line.vehicle.services[0].take(request, line.t)
    line.wait(1.0)
    assert vehicle.files == held


def test_a_vehicle_that_does_not_answer_fails_within_its_time() -> None:
    client, line = orders_joined(Vehicle())
    line.vehicle.services = []
    client.send(content(5_000), line.t, within=100.0)
    assert ended(client, line, 110.0) == OrdersOutcome(Ending.FAILED, ("not finished within 100 s",))


NAMES = ["ORDERS_ANNOUNCE", "ORDERS_PIECE", "ORDERS_REQUEST", "ORDERS_STATE_REQUEST"]


@given(st.lists(st.tuples(st.sampled_from(NAMES), st.binary(max_size=250)), max_size=6))
def test_no_message_ends_the_server(messages: list[tuple[str, bytes]]) -> None:
    """Any payload of any message; whatever it then says can be packed."""
    vehicle = Vehicle()
    line = Line(End(255, 190, [Says()]), End(1, 1, [OrdersServer(1, 1, vehicle, vehicle)]))
    for name, payload in messages:
        values = message_named(name).unpack(payload) | {"target_system": 1, "target_component": 1}
        line.vehicle.services[0].take(Received(255, 190, name, values), line.t)
        line.step()
    line.wait(0.2)
    assert vehicle.files == [FIRST]
