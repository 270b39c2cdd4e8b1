"""Oracle: the operating system, over loopback and pseudo-terminals; sockets of the other end are plain ones."""

import os
import socket
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import serial

from stommel.link.exchange import exchange
from stommel.link.outbox import Priority
from stommel.link.session import Session
from stommel.link.transports import Transport, TransportError, TransportState, open_transport
from stommel.link.transports.address import read_address
from stommel.link.transports.inherited import reserved, take_over
from stommel.link.transports.outgoing import OutgoingBytes
from stommel.link.transports.tcp import TcpClient
from tests.support.ports import free_port, port_of_nobody

from ..helpers import Listener, Speaker

LONGEST_WAIT = 60.0
on_posix = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals")


def until(condition: Callable[[], Any]) -> Any:
    begin = time.monotonic()
    while time.monotonic() - begin < LONGEST_WAIT:
        if found := condition():
            return found
        time.sleep(0.002)
    raise AssertionError("it did not come to that")


def is_open(transport: Transport) -> bool:
    transport.read(time.monotonic())
    return transport.state is TransportState.OPEN


def listening() -> tuple[socket.socket, int]:
    made = socket.socket()
    made.bind(("127.0.0.1", 0))
    made.listen()
    return made, made.getsockname()[1]


def talk_over(near: Transport, far: Transport) -> None:
    """Two sessions say 200 messages to each other."""
    ears = Listener(), Listener()
    message: tuple[str, Any] = ("SYSTEM_TIME", {"time_boot_ms": 7})
    sessions = [Session(n, 1, [ears[n], Speaker(Priority.DATA, [message] * 200)]) for n in (0, 1)]

    def done() -> bool:
        for session, transport in zip(sessions, (near, far), strict=True):
            exchange(session, transport, time.monotonic())
        return all(len(ear.heard) >= 190 for ear in ears)  # what is said before anybody listens may be lost

    until(done)


@pytest.mark.parametrize("kind", ["tcp", "udp"])
@pytest.mark.parametrize("host", ["127.0.0.1", "localhost"])
def test_two_sessions_talk_over_the_network(kind: str, host: str) -> None:
    far = open_transport(f"{kind}-listen:{host}:0")
    near = open_transport(far.name)
    try:
        near.write(b"\0", time.monotonic())
        until(lambda: is_open(near) and near.write(b"\0", time.monotonic()) and is_open(far))
        talk_over(near, far)
    finally:
        near.close()
        far.close()


@on_posix
def test_two_sessions_talk_over_a_pseudo_terminal_and_a_serial_port() -> None:
    far = open_transport("pty")
    near = open_transport(f"serial:{far.name}:115200")
    try:
        talk_over(near, far)
    finally:
        near.close()
        far.close()


def test_a_refused_connection_is_tried_until_somebody_listens() -> None:
    with port_of_nobody() as port:
        client = TcpClient(read_address(f"tcp:127.0.0.1:{port}"), retry=0.05)
        until(lambda: not is_open(client) and client.reason.startswith("refused"))
        assert client.write(b"hello", time.monotonic()) == 0
    try:
        server = open_transport(f"tcp-listen:127.0.0.1:{port}")
        until(lambda: is_open(client) and is_open(server))
        assert client.reason == ""
        server.close()
        until(lambda: not is_open(client) and client.reason)
        again = open_transport(f"tcp-listen:127.0.0.1:{port}")
        until(lambda: is_open(client) and is_open(again))
        assert client.reopened == 1
        again.close()
    finally:
        client.close()


def test_who_connects_again_is_heard_though_the_old_connection_was_never_closed() -> None:
    server = open_transport("tcp-listen:127.0.0.1:0")
    port = int(server.name.rpartition(":")[2])
    with socket.create_connection(("127.0.0.1", port)) as old:
        old.sendall(b"old")
        until(lambda: server.read(time.monotonic()) == b"old")
        with socket.create_connection(("127.0.0.1", port)) as new:
            new.sendall(b"new")
            until(lambda: server.read(time.monotonic()) == b"new")
            server.write(b"answer", time.monotonic())
            assert new.recv(10) == b"answer"
        until(lambda: not is_open(server))
        assert server.reason == "the other end closed it"
    server.close()


def test_a_peer_that_takes_nothing_never_blocks_and_is_given_up() -> None:
    made, port = listening()
    client = TcpClient(read_address(f"tcp:127.0.0.1:{port}"))
    try:
        until(lambda: is_open(client))
        begin, t = time.monotonic(), time.monotonic()
        for _ in range(2000):
            client.write(bytes(min(10_000, client.room(t))), t)
        assert time.monotonic() - begin < 5.0
        assert client.waiting(t) > 50_000
        client.read(t + 4.0)
        assert client.state is TransportState.OPEN
        client.read(t + 6.0)
        assert client.reason == "the other end takes no bytes"
        assert client.waiting(t) == 0
    finally:
        client.close()
        made.close()


def test_a_network_without_an_answer_is_said_after_a_time() -> None:
    client = TcpClient(read_address("tcp:127.0.0.1:9"), retry=100.0)
    client._attempt = socket.socket()  # one that nobody ever answers
    client._tried = 0.0
    client.read(11.0)
    assert client.reason == "no answer"
    assert client.state is TransportState.WAITING
    client.close()


def test_a_listener_has_the_socket_that_was_bound_for_its_program() -> None:
    """Nobody is let in before it listens; the socket is given once, and to no other address."""
    with reserved("127.0.0.1") as made:
        port = made.getsockname()[1]
        with pytest.raises(ConnectionRefusedError):
            socket.create_connection(("127.0.0.1", port))
        with pytest.raises(TransportError, match="another program listens there already"):
            open_transport(f"tcp-listen:127.0.0.1:{port}")
        take_over(os.dup(made.fileno()))
    other = open_transport("tcp-listen:127.0.0.1:0")
    server = open_transport(f"tcp-listen:127.0.0.1:{port}")
    with socket.create_connection(("127.0.0.1", port)) as client:
        until(lambda: is_open(server))
        client.sendall(b"hello")
        until(lambda: server.read(0.0) == b"hello")
    with pytest.raises(TransportError, match="another program listens there already"):
        open_transport(f"tcp-listen:127.0.0.1:{port}")
    server.close()
    other.close()
    open_transport(f"tcp-listen:127.0.0.1:{port}").close()


def test_udp_that_was_refused_is_heard_again_by_itself() -> None:
    """yamcs/yamcs#455: after silence a UDP link received nothing until it was enabled by hand."""
    port = free_port()
    client = open_transport(f"udp:127.0.0.1:{port}")
    client.write(b"anybody", 0.0)
    until(lambda: client.read(0.0) == b"" and client.reason.startswith("refused"))
    server = open_transport(f"udp-listen:127.0.0.1:{port}")
    day = 86_400.0
    until(lambda: client.write(b"hello", day) and server.read(day))
    assert server.write(b"answer", 2 * day) == 6  # the last one is answered after any silence
    until(lambda: client.read(2 * day) == b"answer")
    assert client.reason == ""
    client.close()
    server.close()


def test_udp_answers_all_who_spoke_lately_and_no_crowd() -> None:
    server = open_transport("udp-listen:127.0.0.1:0")
    port = int(server.name.rpartition(":")[2])
    clients = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(6)]
    assert server.write(b"nobody", 0.0) == 0
    for client in clients:
        client.settimeout(0.2)
        client.sendto(b"x", ("127.0.0.1", port))
        until(lambda: server.read(10.0))
    server.write(b"all", 10.0)
    heard = []
    for client in clients:
        try:
            heard.append(client.recv(10))
        except TimeoutError:
            heard.append(b"")
        client.close()
    assert heard == [b"", b"", b"all", b"all", b"all", b"all"]
    server.close()


@on_posix
def test_an_unplugged_serial_port_is_named_and_comes_back() -> None:
    far, near = os.openpty()
    name = os.ttyname(near)
    os.close(near)
    line = open_transport(f"serial:{name}:57600", "radio.port")
    os.close(far)
    until(lambda: not is_open(line))
    assert line.state is TransportState.LOST
    assert line.reason.startswith(f"radio.port = {name}: ")
    assert line.write(b"x", time.monotonic()) == 0
    assert line.room(time.monotonic()) == 0
    line.close()


@on_posix
def test_a_wrong_speed_is_named_from_the_bytes() -> None:
    """What a UART makes of another speed is bytes without frames; here they are made up."""
    terminal = open_transport("pty")
    session = Session(1, 1, [])
    with serial.Serial(terminal.name, 9600) as other:
        other.write(bytes((0x80, 0xF8, 0x1C, 0x00)) * 200)
        t = time.monotonic()
        until(lambda: (exchange(session, terminal, t), session.line.bytes >= 800)[1])
    assert "another speed" in session.line.complaint(t + 1.0)
    terminal.close()


@on_posix
def test_a_pseudo_terminal_that_nobody_opens_never_blocks() -> None:
    terminal = open_transport("pty")
    begin = time.monotonic()
    for number in range(1000):
        terminal.write(bytes(min(1000, terminal.room(0.001 * number))), 0.001 * number)
    assert time.monotonic() - begin < 5.0
    assert terminal.waiting(1.0) <= 65_536
    terminal.read(100.0)
    assert terminal.waiting(100.0) == 0
    terminal.close()
    assert terminal.read(101.0) == b""
    assert terminal.write(b"x", 101.0) == 0


def test_bytes_are_taken_whole_or_not_at_all() -> None:
    queue = OutgoingBytes(10)
    assert queue.put(b"12345678", 0.0) == 8
    assert queue.put(b"abc", 0.0) == 0
    assert len(queue) == 8


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "must be one of serial:/dev/ttyUSB0:115200, tcp:HOST:PORT, "),
        ("ftp:host:1", "must be one of "),
        ("pty:x", "must be one of "),
        ("serial:/dev/ttyUSB0", "name of the port or its speed is missing; must be like serial:/dev/ttyUSB0:115200"),
        ("serial::9600", "name of the port or its speed is missing"),
        ("tcp:host", "host or port is missing; must be like tcp:HOST:PORT"),
        ("tcp:host:ten", "host or port is missing"),
        ("udp:host:0", "port 0: must be from 1 to 65535"),
        ("udp-listen:host:65536", "port 65536: must be from 0 to 65535"),
        ("tcp:host:99999999999999999999", "port 99999999999999999999: must be from 1 to 65535"),
    ],
)
def test_an_address_that_says_nothing_is_named(text: str, said: str) -> None:
    with pytest.raises(TransportError) as raised:
        open_transport(text, "link.port")
    assert str(raised.value).startswith(f"link.port = {text}: {said}")
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("serial:/dev/ttyNOWHERE:115200", "link.port = /dev/ttyNOWHERE: there is no such port"),
        ("serial:/dev/ttyNOWHERE:1234", "link.baud = 1234: must be one of"),
        ("tcp:no.such.host.invalid:5760", "link.port = tcp:no.such.host.invalid:5760: no host of this name is known"),
        ("udp-listen:203.0.113.7:5760", "link.port = udp-listen:203.0.113.7:5760: this machine has no such address"),
    ],
)
def test_what_cannot_be_opened_is_named(text: str, said: str) -> None:
    with pytest.raises(TransportError) as raised:
        open_transport(text)
    assert str(raised.value).startswith(said)
    assert "\n" not in str(raised.value)


def test_a_port_that_another_program_has_is_named() -> None:
    first = open_transport("tcp-listen:127.0.0.1:0")
    text = first.name.replace("tcp:", "tcp-listen:")
    with pytest.raises(TransportError, match="another program listens there already"):
        open_transport(text)
    first.close()


def test_addresses_of_version_6_are_in_brackets() -> None:
    assert read_address("tcp:[::1]:5760")[2:] == ("tcp", "::1", 5760)
    assert read_address("serial:COM3:57600").bit_rate == 57_600
    assert read_address("udp:host:1").bit_rate is None


def test_nothing_in_the_link_but_the_edge_opens_sleeps_or_asks_for_the_time() -> None:
    import stommel.link

    room = Path(stommel.link.__file__).parent
    forbidden = ("import socket", "import serial", "import time\n", "import select", "import threading")
    found = [
        f"{path.relative_to(room)}: {word.strip()}"
        for path in room.rglob("*.py")
        if "transports" not in path.parts
        for word in forbidden
        if word in path.read_text(encoding="utf-8")
    ]
    assert found == []
