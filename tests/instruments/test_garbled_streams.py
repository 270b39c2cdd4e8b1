"""Oracles: what was put into a stream, and checksums worked out bit by bit from their definitions."""

import random
import time

import pytest

from tests.support.garbled_streams import PARSERS, run

SIZE = 200_000
LONGEST = {"compass": 264, "novatel_binary": 400, "novatel_ascii": 400, "nmea": 400, "ctd": 160}
"""Bytes of the longest frame: more is never kept."""


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("name", PARSERS)
def test_garbled_streams_give_what_was_sent_and_nothing_else(name: str, seed: int) -> None:
    """Every good frame is read, also right after garbage; of lines without a checksum, all but the first after it."""
    outcome = run(PARSERS[name](), SIZE, seed)
    assert outcome.read >= SIZE
    assert outcome.believed > 200
    assert outcome.wrong == []
    assert outcome.missed_after_good == 0
    if name != "ctd":
        assert outcome.missed == 0
    assert outcome.most_kept <= LONGEST[name]


@pytest.mark.parametrize("name", PARSERS)
def test_noise_alone_gives_nothing(name: str) -> None:
    parser, draw = PARSERS[name](), random.Random(3)
    for n in range(SIZE // 500):
        assert parser.take(draw.randbytes(500), 0.01 * n) == []


WORST = {
    "compass": (b"\x01\x00\x0e", b"\x00\x56\x05", b"\x00\x00", b"\x01\x08\x0c"),
    "novatel_binary": (b"\xaa\x44\x12\x1c\x2a\x00\x00\x20\x48\x00", b"\xaa\x44\x12", b"\xaa"),
    "novatel_ascii": (b"#", b"#BESTPOSA", b"A", b"[", b"[COM"),
    "nmea": (b"$", b"$GPGGA,", b"<", b"$\r", b"*"),
    "ctd": (b"1", b"S", b"S>", b"\n", b"cast 1 "),
}
"""Bytes that, repeated, keep a parser busiest."""


@pytest.mark.parametrize(("name", "worst"), [(name, worst) for name in WORST for worst in WORST[name]])
def test_time_is_linear_in_the_bytes(name: str, worst: bytes) -> None:
    """Twenty times the bytes take twenty times the processor's time, a square four hundred times: 120 tells."""
    seconds = {}
    for size in (10_000, 200_000):
        best = float("inf")
        for _ in range(3):
            parser = PARSERS[name]()
            begin = time.process_time()
            parser.take(worst * (size // len(worst)), 0.0)
            best = min(best, time.process_time() - begin)
        seconds[size] = best
        assert parser.kept() <= LONGEST[name]
    assert seconds[200_000] < 120.0 * seconds[10_000] + 0.01
