"""Streams of instruments as a bad cable makes them, and what may be believed of them.

`python -m tests.support.garbled_streams 10000000` runs each parser over so many bytes and prints what it did.
"""

import math
import random
import re
import sys
import time
import tracemalloc
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from stommel.instruments.gnss.device import GnssDevice, GnssTruth
from stommel.instruments.gnss.driver import GnssDriver, GnssSettings
from stommel.instruments.gnss.fix import Fix, FixLimits
from stommel.instruments.gpctd.device import CtdTruth
from stommel.instruments.gpctd.driver import CtdDriver
from stommel.instruments.gpctd.live import VARIANTS, live_line
from stommel.instruments.tcm.device import CompassDevice, CompassTruth
from stommel.instruments.tcm.driver import CompassDriver

Value = float
"""What tells a frame: its heading, latitude or pressure."""


def crc_bit_by_bit(data: bytes, width: int, polynomial: int) -> int:
    """A CRC from zero, most significant bit first, as its definition says."""
    crc = 0
    for byte in data:
        crc ^= byte << (width - 8)
        for _ in range(8):
            crc = (crc << 1) ^ (polynomial if crc >> (width - 1) else 0)
            crc &= (1 << width) - 1
    return crc


def reflected_crc_bit_by_bit(data: bytes, polynomial: int) -> int:
    """A CRC from zero, least significant bit first."""
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc >> 1) ^ (polynomial if crc & 1 else 0)
    return crc


def tcm_is_right(frame: bytes) -> bool:
    return crc_bit_by_bit(frame[:-2], 16, 0x1021) == int.from_bytes(frame[-2:], "big")


def binary_is_right(frame: bytes) -> bool:
    return reflected_crc_bit_by_bit(frame[:-4], 0xEDB88320) == int.from_bytes(frame[-4:], "little")


def ascii_is_right(frame: bytes) -> bool:
    body, _, said = frame.rstrip(b"\r\n").partition(b"*")
    try:
        return reflected_crc_bit_by_bit(body[1:], 0xEDB88320) == int(said, 16)
    except ValueError:
        return False


def nmea_is_right(frame: bytes) -> bool:
    body, _, said = frame.rstrip(b"\r\n").partition(b"*")
    total = 0
    for byte in body[1:]:
        total ^= byte
    try:
        return total == int(said, 16)
    except ValueError:
        return False


def compass_frame(n: int) -> tuple[bytes, Value]:
    heading = round((n % 300_000 + 1) * 1e-3, 3)
    device = _COMPASS
    data = device.take(_ASK, CompassTruth(math.radians(heading), 0.1, 0.2), 0.0)
    return data, heading


def _told_compass() -> tuple[CompassDevice, CompassDriver]:
    device, driver = CompassDevice(), CompassDriver()
    for t in range(-10, 0):
        driver.take(device.take(driver.poll(t), CompassTruth(0.0, 0.0, 0.0), t), t)
    return device, driver


_ASK = bytes.fromhex("000504BF71")
_COMPASS, _ = _told_compass()


def gnss_frames(form: str) -> Callable[[int], tuple[bytes, Value]]:
    device = GnssDevice()
    name = {"novatel_binary": "BESTPOSB", "novatel_ascii": "BESTPOSA", "nmea": "GPGGA"}[form]
    device.take(b"LOG COM1 %b ONTIME 1\r\n" % name.encode(), _gnss_truth(0), 0.0)

    def frame(n: int) -> tuple[bytes, Value]:
        truth = _gnss_truth(n)
        return device.take(b"", truth, float(n + 1)), round(math.degrees(truth.latitude), 6)

    return frame


def _gnss_truth(n: int) -> GnssTruth:
    return GnssTruth(math.radians(10.0 + (n % 5_000_000) * 1e-5), math.radians(120.0), 1.79e9 + n, True, 0.0)


def ctd_frame(n: int) -> tuple[bytes, Value]:
    pressure = (n % 2_000_000) * 1e-3
    truth = CtdTruth(pressure, 12.0, 3.5)
    values = {"pressure": pressure, "temperature": truth.temperature, "conductivity": truth.conductivity}
    return live_line(VARIANTS["plain"], values) + b"\r\n", round(pressure, 3)


@dataclass
class Outcome:
    """What a parser made of a stream."""

    read: int = 0
    """Bytes."""
    sent: int = 0
    """Good frames in the stream."""
    believed: int = 0
    """Readings."""
    wrong: list[Value] = field(default_factory=list)
    """Readings that no frame with a right checksum in the stream holds."""
    missed: int = 0
    """Good frames that came to nothing."""
    missed_after_good: int = 0
    """Those of them right behind another good frame."""
    seconds: float = 0.0
    """In the parser."""
    most_kept: int = 0
    """Bytes that the parser kept at most."""


@dataclass
class Parser:
    """A parser under test."""

    frame: Callable[[int], tuple[bytes, Value]]
    is_right: Callable[[bytes], bool]
    take: Callable[[bytes, float], list[Value]]
    kept: Callable[[], int]
    flips: int
    """Bits that its checksum finds for certain."""
    beginnings: tuple[bytes, ...]
    """Bytes that look like the beginning of a frame."""
    broken: dict[Value, bytes] = field(default_factory=dict)
    """Frames that were made garbage of. Where garbage before it mends one, it stands in the stream as it was."""
    all_in: Callable[[bytes], set[Value]] = lambda _: set()
    """What a stream holds by another reader, for lines without a checksum: there a cut can make another number."""


def compass_parser() -> Parser:
    _, driver = _told_compass()

    def take(data: bytes, t: float) -> list[Value]:
        return [round(math.degrees(reading.heading), 3) for reading in driver.take(data, t)]

    beginnings = (b"\x00\x56\x05\x0c", b"\x01\x00\x0e", b"\x00\x05", b"\x00")
    return Parser(compass_frame, tcm_is_right, take, lambda: driver._framer.waiting, 3, beginnings)


def gnss_parser(form: str) -> Parser:
    limits = FixLimits(age=math.inf, slack=1e9)
    driver = GnssDriver(GnssSettings(format=form, limits=limits))

    def take(data: bytes, t: float) -> list[Value]:
        outcomes = driver.take(data, t)
        return [round(math.degrees(fix.latitude), 6) for fix in outcomes if isinstance(fix, Fix)]

    right, flips, beginnings = {
        "novatel_binary": (binary_is_right, 3, (b"\xaa\x44\x12\x1c\x2a\x00\x00\x20\x48\x00", b"\xaa\x44", b"\xaa")),
        "novatel_ascii": (ascii_is_right, 3, (b"#BESTPOSA,COM1,0", b"#", b"#" * 50, b"<")),
        "nmea": (nmea_is_right, 1, (b"$GPGGA,1", b"$", b"$GPGGA,,,,,,*", b"[COM")),
    }[form]
    parser = Parser(gnss_frames(form), right, take, lambda: driver._framer.waiting, flips, beginnings)
    if form == "nmea":
        parser.all_in = _latitudes_in
    return parser


_GGA = re.compile(rb"\$GPGGA,[^$#\r\n]*\*[0-9A-Fa-f]{2}\r\n")


def _latitudes_in(stream: bytes) -> set[Value]:
    """Of two halves of sentences, one in 256 has a right checksum: no parser can tell."""
    found = set()
    for text in filter(nmea_is_right, _GGA.findall(stream)):
        place = re.match(rb"(\d\d)(\d\d\.\d+)$", text.split(b",")[2])
        if place:
            found.add(round(int(place[1]) + float(place[2]) / 60.0, 6))
    return found


def ctd_parser() -> Parser:
    driver = CtdDriver()
    driver.sample(True)

    def take(data: bytes, t: float) -> list[Value]:
        return [round(r.pressure, 3) for r in driver.take(data, t) if math.isfinite(r.pressure)]

    # lines have no checksum: a flipped digit is another number, hence frames are cut but not flipped
    beginnings = (b"S", b"12.", b"cast  1 ")
    parser = Parser(ctd_frame, lambda _: False, take, lambda: driver._framer.waiting, 0, beginnings)
    parser.all_in = lambda data: {float(text) for text in _CTD_LINE.findall(data)}
    return parser


_CTD_LINE = re.compile(rb"(\d+\.\d{3}),\d+\.\d{4},\d+\.\d{5}\r*\n")


PARSERS: dict[str, Callable[[], Parser]] = {
    "compass": compass_parser,
    "novatel_binary": lambda: gnss_parser("novatel_binary"),
    "novatel_ascii": lambda: gnss_parser("novatel_ascii"),
    "nmea": lambda: gnss_parser("nmea"),
    "ctd": ctd_parser,
}


@dataclass(frozen=True)
class Part:
    """A part of a stream."""

    data: bytes
    value: Value | None
    """Of a good frame; None for garbage."""


def garbage(parser: Parser, draw: random.Random, n: int) -> bytes:
    """Noise, beginnings, runs of one byte, frames without their end or beginning, and frames with flipped bits."""
    kind = draw.randrange(6)
    if kind == 0:
        return draw.randbytes(draw.randrange(1, 200))
    if kind == 1:
        return draw.choice(parser.beginnings)
    if kind == 2:
        return draw.randbytes(1) * draw.randrange(1, 300)
    whole, value = parser.frame(n)
    parser.broken[value] = whole
    if kind == 3:
        return whole[: draw.randrange(1, len(whole) - 1)]
    if kind == 4 or not parser.flips:
        return whole[draw.randrange(1, len(whole)) :]
    bits = draw.sample(range(8 * len(whole)), draw.randint(1, parser.flips))
    damaged = bytearray(whole)
    for bit in bits:
        damaged[bit // 8] ^= 1 << bit % 8
    if parser.is_right(bytes(damaged)):
        parser.broken[value] = bytes(damaged)  # a letter of the checksum has become a capital
    return bytes(damaged)


def parts(parser: Parser, size: int, draw: random.Random) -> Iterator[Part]:
    total = n = 0
    while total < size:
        n += 1
        if draw.random() < 0.5:
            data, value = parser.frame(n)
            part = Part(data, value)
        else:
            data = garbage(parser, draw, n)
            part = Part(data, None)
        total += len(part.data)
        yield part


def run(parser: Parser, size: int, seed: int) -> Outcome:
    """Send a stream in pieces of any length to a parser, with silences between some."""
    draw, outcome = random.Random(seed), Outcome()
    pending: dict[Value, bool] = {}
    waiting, t, after_good, stream = b"", 0.0, False, []
    for part in parts(parser, size, draw):
        outcome.read += len(part.data)
        waiting += part.data
        stream.append(part.data)
        if part.value is not None:
            outcome.sent += 1
            pending[part.value] = after_good
        after_good = part.value is not None
        if len(waiting) > draw.randrange(1, 600):
            cut = draw.randrange(len(waiting) + 1)
            t += 0.001
            _take(parser, waiting[:cut], t, pending, outcome)
            waiting = waiting[cut:]
        if draw.random() < 0.01:
            t = _settle(parser, waiting, t, pending, outcome)
            waiting = b""
    _settle(parser, waiting, t, pending, outcome)
    everything = b"".join(stream)
    said = parser.all_in(everything)
    outcome.wrong = [value for value in outcome.wrong if value not in said and not _mended(parser, value, everything)]
    return outcome


def _mended(parser: Parser, value: Value, stream: bytes) -> bool:
    whole = parser.broken.get(value)
    return whole is not None and parser.is_right(whole) and whole in stream


def _settle(parser: Parser, waiting: bytes, t: float, pending: dict[Value, bool], outcome: Outcome) -> float:
    """Send the rest, then be silent: now everything that came must have been read."""
    _take(parser, waiting, t + 0.001, pending, outcome)
    _take(parser, b"", t + 1.0, pending, outcome)
    outcome.missed += len(pending)
    outcome.missed_after_good += sum(pending.values())
    pending.clear()
    return t + 2.0


def _take(parser: Parser, data: bytes, t: float, pending: dict[Value, bool], outcome: Outcome) -> None:
    begin = time.perf_counter()
    values = parser.take(data, t)
    outcome.seconds += time.perf_counter() - begin
    outcome.most_kept = max(outcome.most_kept, parser.kept())
    for value in values:
        outcome.believed += 1
        if pending.pop(value, None) is None:
            outcome.wrong.append(value)


def main() -> None:
    size = int(sys.argv[1]) if len(sys.argv) > 1 else 200_000
    for name, make in PARSERS.items():
        tracemalloc.start()
        run(make(), min(size, 200_000), 2)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        outcome = run(make(), size, 1)
        print(  # noqa: T201 - the result
            f"{name}: {outcome.read} bytes, {outcome.sent} good frames, {outcome.believed} believed, "
            f"{len(outcome.wrong)} wrong, {outcome.missed} missed ({outcome.missed_after_good} behind a good one), "
            f"{outcome.seconds:.1f} s, kept {outcome.most_kept} bytes at most, {peak / 1e3:.0f} kB at the peak"
        )


if __name__ == "__main__":
    main()
