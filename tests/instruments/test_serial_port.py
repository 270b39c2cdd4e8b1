"""Oracle: the operating system. Drivers at one end of a pseudo-terminal, devices at the other, on real time."""

import math
import os
import sys
import threading
import time
import tty
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from stommel.errors import StommelError
from stommel.instruments.gnss.device import GnssDevice, GnssTruth
from stommel.instruments.gnss.driver import GnssDriver, GnssSettings
from stommel.instruments.gnss.fix import Fix
from stommel.instruments.gpctd.device import CtdDevice, CtdTruth
from stommel.instruments.gpctd.driver import CtdDriver
from stommel.instruments.tcm.device import CompassDevice, CompassTruth
from stommel.instruments.tcm.driver import CompassDriver, CompassSettings, CompassState
from stommel.messages.serial_port import PortError, PortSettings, PortState, SerialPort

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals")
LONGEST_WAIT = 60.0


class Bench:
    """A device behind a pseudo-terminal, in a thread of its own."""

    def __init__(self, answer: Callable[[bytes, float], bytes]) -> None:
        self._answer = answer
        self._far, near = os.openpty()
        tty.setraw(self._far)
        tty.setraw(near)
        self.port = os.ttyname(near)
        self._near = near
        os.set_blocking(self._far, False)
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def _serve(self) -> None:
        while not self._stop.is_set():
            try:
                data = os.read(self._far, 4096)
            except (BlockingIOError, OSError):
                data = b""
            out = self._answer(data, time.monotonic())
            if out:
                os.write(self._far, out)
            time.sleep(0.005)

    def unplug(self) -> None:
        self._stop.set()
        self._thread.join()
        os.close(self._far)
        os.close(self._near)


@contextmanager
def bench(answer: Callable[[bytes, float], bytes]) -> Iterator[Bench]:
    made = Bench(answer)
    try:
        yield made
    finally:
        if not made._stop.is_set():
            made.unplug()


@contextmanager
def opened(port: str, baud: int = 38_400) -> Iterator[SerialPort]:
    serial_port = SerialPort(PortSettings("compass.port", port, baud, retry=0.05))
    serial_port.connect()
    try:
        yield serial_port
    finally:
        serial_port.close()


def until(driver: Any, port: SerialPort, enough: Callable[[list[Any]], bool]) -> list[Any]:
    """Run a driver on a port until it has read enough."""
    readings: list[Any] = []
    end = time.monotonic() + LONGEST_WAIT
    while time.monotonic() < end:
        t = time.monotonic()
        port.write(driver.poll(t), t)
        readings += driver.take(port.read(t), t)
        if enough(readings):
            return readings
        time.sleep(0.005)
    raise AssertionError(f"only {len(readings)} readings: {driver.health(time.monotonic())}, {port.reason}")


def compass_answers(device: CompassDevice) -> Callable[[bytes, float], bytes]:
    truth = CompassTruth(1.0, -0.4, 0.1)
    return lambda data, t: device.take(data, truth, t)


@pytest.mark.parametrize("polled", [True, False])
def test_compass_over_a_real_port(polled: bool) -> None:
    driver = CompassDriver(CompassSettings(interval=0.05, polled=polled))
    with bench(compass_answers(CompassDevice())) as device, opened(device.port) as port:
        readings = until(driver, port, lambda found: len(found) >= 5)
    assert {round(reading.heading, 5) for reading in readings} == {1.0}
    assert driver.health(time.monotonic()).state is CompassState.SAMPLING


@pytest.mark.parametrize("form", ["novatel_binary", "novatel_ascii", "nmea"])
def test_receiver_over_a_real_port(form: str) -> None:
    truth, device = GnssTruth(0.5, 2.0, 1.79e9, True, 0.2), GnssDevice()
    driver = GnssDriver(GnssSettings(format=form, interval=0.1))
    answer = lambda data, t: device.take(data, truth._replace(utc=1.79e9 + t), t)  # noqa: E731
    with bench(answer) as far, opened(far.port) as port:
        found = until(driver, port, lambda outcomes: sum(isinstance(o, Fix) for o in outcomes) >= 3)
    assert found[-1].latitude == pytest.approx(0.5, abs=2e-9)


def test_ctd_over_a_real_port() -> None:
    truth, device = CtdTruth(100.0, 12.0, 3.5), CtdDevice(interval=0.05)
    driver = CtdDriver()
    driver.sample(True)
    with bench(lambda data, t: device.take(data, truth, t)) as far, opened(far.port, 115_200) as port:
        readings = until(driver, port, lambda found: len(found) >= 5)
    assert {reading.pressure for reading in readings} == {100.0}


def test_every_byte_comes_through() -> None:
    everything = bytes(range(256)) * 20
    came = bytearray()
    with bench(lambda data, _: data) as echo, opened(echo.port) as port:
        end, waiting = time.monotonic() + LONGEST_WAIT, everything
        while len(came) < len(everything) and time.monotonic() < end:
            t = time.monotonic()
            waiting = waiting[port.write(waiting[:500], t) :]
            came += port.read(t)
            time.sleep(0.002)
    assert bytes(came) == everything


def test_unplugged_port_is_named_and_comes_back(tmp_path: Path) -> None:
    name = tmp_path / "ttyUSB0"
    first = Bench(compass_answers(CompassDevice()))
    name.symlink_to(first.port)
    driver = CompassDriver(CompassSettings(interval=0.05, silence=0.5, answer_time=0.2))
    with opened(str(name)) as port:
        until(driver, port, lambda found: len(found) >= 3)
        first.unplug()
        name.unlink()
        end = time.monotonic() + LONGEST_WAIT
        while port.state is not PortState.LOST and time.monotonic() < end:
            t = time.monotonic()
            driver.take(port.read(t), t)
            port.write(driver.poll(t), t)
        assert port.state is PortState.LOST
        assert port.reason.startswith(f"compass.port = {name}: unplugged")
        time.sleep(0.1)
        assert port.read(time.monotonic()) == b""
        assert "there is no such port" in port.reason
        with bench(compass_answers(CompassDevice())) as second:
            name.symlink_to(second.port)
            until(driver, port, lambda found: len(found) >= 3)
        assert port.reopened == 1
        assert port.reason in {"", port.reason}


def test_absent_port_names_key_and_port() -> None:
    port = SerialPort(PortSettings("gnss.port", "/dev/ttyNOWHERE", 9600))
    with pytest.raises(
        PortError, match=r"^gnss\.port = /dev/ttyNOWHERE: there is no such port; there (is|are) [^\n]+$"
    ):
        port.connect()
    assert port.read(0.0) == b""
    assert port.write(b"x", 0.0) == 0


def test_file_is_no_port(tmp_path: Path) -> None:
    file = tmp_path / "notes.txt"
    file.write_text("no port")
    with pytest.raises(StommelError, match=r"ctd\.port = .*notes\.txt: cannot be opened as a serial port"):
        SerialPort(PortSettings("ctd.port", str(file), 9600)).connect()


def test_port_of_another_program_is_named() -> None:
    with bench(lambda _data, _t: b"") as far, opened(far.port):
        other = SerialPort(PortSettings("radio.port", far.port, 9600))
        with pytest.raises(PortError, match=r"radio\.port = .*: another program has it open"):
            other.connect()


@pytest.mark.parametrize("baud", [0, -1, 38_401, 10**12])
def test_impossible_baud_rate_names_its_key(baud: int) -> None:
    with pytest.raises(PortError, match=rf"^compass\.baud = {baud}: must be one of 1200, "):
        PortSettings("compass.port", "/dev/ttyS0", baud)


def test_full_output_refuses_and_counts() -> None:
    """Nobody reads at the other end."""
    far, near = os.openpty()
    tty.setraw(near)
    with opened(os.ttyname(near)) as port:
        accepted = sum(port.write(bytes(10_000), 0.1 * k) for k in range(100))
        assert port.refused == 1_000_000 - accepted
        assert port.refused > 0
        assert math.isfinite(accepted)
    os.close(far)
    os.close(near)
