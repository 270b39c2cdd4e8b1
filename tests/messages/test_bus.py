"""The edge to the adapter. Oracle: what went in on the other side, and a clock: reported within 1 s, received again.

Field report 28 (hardbyte/python-can#907, #1667): an error ended the receiving thread and the program went on deaf.
"""

import os
import socket
import subprocess
import sys
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from typing import Any

import can
import pytest

from stommel.messages.adapters import Adapter, BusError, multicast_of, open_adapter
from stommel.messages.bus import MOST, WAIT, CanBus
from stommel.messages.frames import Frame

FRAME = Frame(0x123, b"\x01\x02")


class World:
    """A fake adapter's other end: what it hears, and how it breaks."""

    def __init__(self) -> None:
        self.heard: deque[can.Message] = deque()
        self.sent: list[can.Message] = []
        self.recv_error: Exception | None = None
        self.send_error: Exception | None = None
        self.open_error: Exception | None = None
        self.state = can.BusState.ACTIVE
        self.hangs = 0.0
        self.opened = 0

    def open(self, _: Adapter) -> Any:
        if self.open_error is not None:
            raise self.open_error
        self.opened += 1
        return FakePort(self)


class FakePort:
    def __init__(self, world: World) -> None:
        self.world = world

    @property
    def state(self) -> can.BusState:
        return self.world.state

    def recv(self, timeout: float) -> can.Message | None:
        time.sleep(self.world.hangs)
        if self.world.recv_error is not None:
            raise self.world.recv_error
        if self.world.heard:
            return self.world.heard.popleft()
        time.sleep(min(timeout, 0.01))
        return None

    def send(self, message: can.Message, timeout: float | None = None) -> None:
        if self.world.send_error is not None:
            raise self.world.send_error
        self.world.sent.append(message)

    def shutdown(self) -> None:
        if self.world.open_error is not None:
            raise self.world.open_error


def message(identifier: int = 0x123, data: bytes = b"\x01\x02", **kind: bool) -> can.Message:
    return can.Message(arbitration_id=identifier, data=data, **({"is_extended_id": False} | kind))  # type: ignore[arg-type]


def within(seconds: float, holds: Callable[[], object]) -> bool:
    """Counted in looks, 5 ms apart on a machine with nothing else to do: other work makes all threads late alike."""
    for _ in range(round(seconds / 0.005)):
        if holds():
            return True
        time.sleep(0.005)
    return bool(holds())


@pytest.fixture
def world() -> World:
    return World()


@pytest.fixture
def bus(world: World) -> Iterator[CanBus]:
    with CanBus(Adapter("virtual", "fake"), world.open) as bus:
        yield bus


def hears(bus: CanBus, world: World) -> bool:
    world.heard.append(message())
    found: list[Frame] = []
    return within(3.0, lambda: found.extend(bus.receive()) or FRAME in found)


FAILURES = [
    OSError(19, "No such device"),
    can.CanOperationError("device gone"),
    ValueError("bad bytes from the adapter"),
    RuntimeError(),
    can.CanError("x" * 1000),
]


@pytest.mark.parametrize("error", FAILURES, ids=lambda error: type(error).__name__)
def test_an_error_of_receiving_is_reported_within_a_second_and_reception_resumes(
    bus: CanBus, world: World, error: Exception
) -> None:
    assert hears(bus, world)
    world.recv_error = error
    assert within(1.0, lambda: bus.status().fault)
    assert bus.reports()[0].startswith("CAN bus virtual fake: receiving failed: ")
    world.recv_error = None
    assert hears(bus, world)
    assert bus.status().fault == ""
    assert "works again after" in bus.reports()[-1]


def test_an_error_of_sending_is_reported_at_once_and_sending_resumes(bus: CanBus, world: World) -> None:
    assert bus.send(FRAME)
    world.send_error = can.CanOperationError("transmit buffer full")
    assert not bus.send(FRAME)
    assert "sending failed: transmit buffer full" in bus.status().fault
    world.send_error = None
    assert within(3.0, lambda: bus.send(FRAME))
    assert hears(bus, world)
    assert bus.status().unsent >= 1


def test_an_unplugged_adapter_comes_back(bus: CanBus, world: World) -> None:
    world.open_error = BusError("can.channel = 'fake': there is no such adapter; is it plugged in?")
    world.recv_error = OSError(5, "Input/output error")
    assert within(1.0, lambda: "there is no such adapter" in bus.status().fault)
    assert not bus.send(FRAME)
    time.sleep(1.2)
    assert bus.status().faults == 1
    assert len(bus.reports()) == 2
    world.open_error = world.recv_error = None
    assert hears(bus, world)
    assert bus.status().reopened == 1


def test_bus_off_by_the_adapters_state(bus: CanBus, world: World) -> None:
    world.state = can.BusState.ERROR
    assert within(1.0, lambda: bus.status().fault == "bus-off")
    world.state = can.BusState.ACTIVE
    assert hears(bus, world)


@pytest.mark.parametrize(
    ("bits", "words"),
    [(0x040, "bus-off"), (0x044, "bus-off"), (0x080, "bus error"), (0x020, "no acknowledgement"), (0x008, "protocol")],
)
def test_bus_off_and_errors_by_error_frames(bus: CanBus, world: World, bits: int, words: str) -> None:
    """Error frames as Linux gives them; the controller is left to the kernel's restart."""
    world.heard.append(message(bits, bytes(8), is_error_frame=True))
    assert within(1.0, lambda: bus.status().fault.startswith(words))
    assert world.opened == 1
    world.heard.append(message(0x100, bytes(8), is_error_frame=True))
    assert within(1.0, lambda: bus.status().fault == "")


def test_a_lost_arbitration_is_no_fault(bus: CanBus, world: World) -> None:
    world.heard.append(message(0x002, bytes(8), is_error_frame=True))
    assert hears(bus, world)
    assert (bus.status().faults, bus.receive()) == (0, [])


def test_a_driver_that_hangs_is_reported_within_a_second(bus: CanBus, world: World) -> None:
    world.hangs = 1.5
    time.sleep(WAIT)
    assert within(1.0, lambda: "hangs" in bus.status().fault)
    world.hangs = 0.0
    assert hears(bus, world)
    assert bus.status().fault == ""


def test_frames_of_other_kinds_are_counted_and_passed_over(bus: CanBus, world: World) -> None:
    world.heard.append(message(0x123, is_extended_id=True))
    world.heard.append(message(0x123, b"", is_remote_frame=True))
    world.heard.append(message(0x123, is_fd=True))
    assert within(1.0, lambda: bus.status().passed_over == 3)
    assert bus.receive() == []


def test_frames_that_nobody_fetches_are_bounded(bus: CanBus, world: World) -> None:
    world.heard.extend(message(k % 0x800) for k in range(MOST + 50))
    assert within(10.0, lambda: bus.status().received == MOST + 50)
    assert bus.status().dropped == 50
    assert len(bus.receive()) == MOST


def test_first_opening_raises_and_leaves_no_thread(world: World) -> None:
    world.open_error = BusError("can.channel = 'fake': there is no such adapter; is it plugged in?")
    with pytest.raises(BusError):
        CanBus(Adapter("virtual", "fake"), world.open)


def test_two_buses_within_one_program() -> None:
    with CanBus(Adapter("virtual", "two")) as one, CanBus(Adapter("virtual", "two")) as other:
        sent = [Frame(k, bytes((k,))) for k in range(50)]
        assert all(one.send(frame) for frame in sent)
        found: list[Frame] = []
        assert within(2.0, lambda: found.extend(other.receive()) or len(found) == 50)
        assert found == sent
        assert one.receive() == []


ECHO = """
import sys, time
from stommel.messages.adapters import multicast_of, Adapter
from stommel.messages.bus import CanBus
from stommel.messages.frames import Frame
with CanBus(Adapter("udp_multicast", sys.argv[1])) as bus:
    print("ready", flush=True)
    end = time.monotonic() + 20.0
    while time.monotonic() < end:
        for frame in bus.receive():
            if frame.identifier == 0x7FF:
                sys.exit(0)
            if frame.identifier < 0x400:
                bus.send(Frame(frame.identifier + 0x400, frame.data[::-1]))
        time.sleep(0.005)
sys.exit(1)
"""


def test_two_programs_over_loopback() -> None:
    """Real sockets: frames come back from another process with their bytes turned round."""
    address = "239.74.163.77"
    try:
        bus = CanBus(Adapter("udp_multicast", address))
        bus.send(Frame(0x7FE, b""))
        assert not bus.status().fault, bus.status().fault
    except (BusError, AssertionError) as error:
        pytest.skip(f"this kernel refuses multicast: {error}")
    with bus, subprocess.Popen([sys.executable, "-c", ECHO, address], stdout=subprocess.PIPE, text=True) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == "ready\n"
        sent = [Frame(k, bytes((k, k + 1, k + 2))) for k in range(1, 41)]
        found: list[Frame] = []
        for frame in sent:
            bus.send(frame)
            time.sleep(0.002)
        expected = [Frame(frame.identifier + 0x400, frame.data[::-1]) for frame in sent]
        if not within(5.0, lambda: found.extend(bus.receive()) or expected[-1] in found) and not found:
            other.kill()
            pytest.skip("this kernel carries no multicast between programs")
        assert found == expected  # and nothing of our own
        bus.send(Frame(0x7FF, b""))
        assert other.wait(10) == 0


@pytest.mark.parametrize(("ours", "others"), [("239.74.163.79", "239.74.163.80"), ("ff05::4a79", "ff05::4a80")])
def test_buses_at_two_addresses_of_one_machine_do_not_hear_each_other(ours: str, others: str) -> None:
    """Two vehicles on one bench: what one is told must not move the other. All have python-can's one port."""
    with ExitStack() as opened:
        try:
            here, there, beside = (
                opened.enter_context(CanBus(Adapter("udp_multicast", one))) for one in (ours, ours, others)
            )
        except BusError as error:
            pytest.skip(f"this kernel refuses multicast: {error}")
        here.send(FRAME)
        if not within(2.0, lambda: FRAME in there.receive()):
            pytest.skip("this kernel carries no multicast between programs")
        beside.send(FRAME)  # its own other end is not there; time enough that all has come
        time.sleep(0.1)
        assert FRAME not in beside.receive()
        assert FRAME not in there.receive()


@pytest.mark.parametrize(
    ("address", "option"),
    [
        ("239.74.163.81:43301", (socket.IPPROTO_IP, socket.IP_MULTICAST_TTL)),
        ("[ff05::4a81]:43302", (socket.IPPROTO_IPV6, socket.IPV6_MULTICAST_HOPS)),
    ],
)
def test_a_bus_that_stays_here_makes_no_hop(address: str, option: tuple[int, int]) -> None:
    """Oracle: what the system says of the socket."""
    for stays_here, hops in ((True, 0), (False, 1)):
        try:
            bus = open_adapter(Adapter("udp_multicast", address, stays_here=stays_here))
        except BusError as error:
            pytest.skip(f"this kernel refuses multicast: {error}")
        with bus, socket.socket(fileno=os.dup(bus.fileno())) as port:
            assert port.getsockopt(*option) == hops


def test_a_bus_over_loopback_survives_bytes_that_are_no_frame() -> None:
    address = "239.74.163.78"
    try:
        bus = CanBus(Adapter("udp_multicast", address))
    except BusError as error:
        pytest.skip(f"this kernel refuses multicast: {error}")
    with bus, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as stranger:
        try:
            stranger.sendto(b"\x00garbage", (address, 43113))
        except OSError as error:
            pytest.skip(f"this kernel refuses multicast: {error}")
        if not within(1.0, lambda: bus.status().faults):
            pytest.skip("this kernel carries no multicast between programs")
        with open_adapter(Adapter("udp_multicast", address)) as other:
            found: list[Frame] = []

            def again() -> bool:
                other.send(message())
                found.extend(bus.receive())
                return FRAME in found

            assert within(3.0, again)


@pytest.mark.parametrize(
    ("asked", "says"),
    [
        (("socketcn", "can0"), "can.interface = 'socketcn': must be one of socketcan, slcan, udp_multicast, virtual"),
        (("socketcn", "can0"), "did you mean socketcan?"),
        (("slcan", "/dev/ttyACM0"), "can.bitrate = not given: slcan needs one of 10000, 20000,"),
        (("slcan", "/dev/ttyACM0", 123), "can.bitrate = 123: slcan needs one of"),
        (("socketcan", "can0", 500000), "can.bitrate = 500000: leave it out; it is set with: ip link set can0"),
        (("virtual", "x", 500000), "can.bitrate = 500000: leave it out; virtual has none"),
        (("udp_multicast", "10.0.0.1"), "can.channel = '10.0.0.1': must be a multicast address, 224.0.0.0 to"),
        (("udp_multicast", "239.1.1.1:99"), "can.channel = '239.1.1.1:99': must be a multicast address"),
        (("udp_multicast", "239.1.1.1:"), "can.channel = '239.1.1.1:': must be a multicast address"),
        (("udp_multicast", "nowhere"), "can.channel = 'nowhere': must be a multicast address"),
        (("virtual", "a\nb"), "can.channel = 'a\\nb': must be a name"),
    ],
)
def test_an_impossible_adapter_is_refused_by_its_key(asked: tuple[Any, ...], says: str) -> None:
    with pytest.raises(BusError) as refused:
        Adapter(*asked)
    assert says in str(refused.value)


def test_a_missing_adapter_is_named() -> None:
    with pytest.raises(BusError) as refused:
        open_adapter(Adapter("slcan", "/dev/ttyNOWHERE", 500000))
    assert str(refused.value) == "can.channel = '/dev/ttyNOWHERE': there is no such adapter; is it plugged in?"
    with pytest.raises(BusError) as refused:
        open_adapter(Adapter("socketcan", "can77"))
    assert str(refused.value).startswith(("can.interface = 'socketcan': this system has none", "can.channel = 'can77'"))


@pytest.mark.parametrize(
    ("error", "says"),
    [
        (OSError(97, "Address family not supported by protocol"), "can.interface = 'virtual': this system has none"),
        (OSError(19, "No such device"), "can.channel = 'fake': there is no such adapter"),
        (OSError(13, "Permission denied"), "can.channel = 'fake': not permitted to this user"),
        (OSError(100, "Network is down"), "can.channel = 'fake': it is down; set it up with: ip link set fake up"),
        (RuntimeError("strange"), "can.channel = 'fake': cannot be opened: strange"),
    ],
)
def test_what_a_driver_says_becomes_a_sentence(monkeypatch: pytest.MonkeyPatch, error: Exception, says: str) -> None:
    def refuse(**_: object) -> None:
        raise error

    monkeypatch.setattr(can, "Bus", refuse)
    with pytest.raises(BusError) as refused:
        open_adapter(Adapter("virtual", "fake"))
    assert says in str(refused.value)


@pytest.mark.parametrize(
    ("channel", "found"),
    [
        ("239.74.163.2", ("239.74.163.2", None)), ("239.74.163.2:43200", ("239.74.163.2", 43200)),
        ("ff15::1", ("ff15::1", None)), ("[ff15::1]:43200", ("ff15::1", 43200)), ("10.0.0.1:43200", None),
        ("239.74.163.2:70000", None), ("239.74.163.2:x", None), ("", None),
    ],
)  # fmt: skip
def test_a_multicast_channel_may_name_its_port(channel: str, found: tuple[str, int | None] | None) -> None:
    assert multicast_of(channel) == found
