"""Oracles: logs as NovAtel's notes and others' receivers print them, and NovAtel's own decoder novatel-edie."""

import math
import random
from typing import Any

import pytest
from novatel_edie import oem

from stommel.instruments.gnss.gps_time import utc_of, week_and_ms
from stommel.instruments.gnss.novatel.codec import (
    SIZES,
    Message,
    from_ascii,
    from_binary,
    to_ascii,
    to_binary,
)
from stommel.instruments.gnss.novatel.logs import BestPos, BestVel, Header, Log, Time, no_position

BESTPOS = (
    "#BESTPOSA,COM1,0,47.0,FINESTEERING,1803,27504.000,00000000,6145,9603;SOL_COMPUTED,L1_FLOAT,32.81519645735,"
    '35.00791046612,19.9359,20.3000,WGS84,0.0363,0.0538,0.0956,"0",3.000,0.000,18,9,9,0,0,00,00,01*ecbd3409'
)
"""NovAtel, ASCII to binary log conversion example; its binary twin ends c3 ef 64 d2."""
PRINTED = (
    BESTPOS,
    "#BESTVELA,COM1,0,61.0,FINESTEERING,1337,334167.000,00000000,827b,1984;SOL_COMPUTED,PSRDIFF,0.250,4.000,0.0206,"
    "227.712486,0.0493,0.0*0e68bf05",
    "#BESTVELA,COM1,0,68.5,FINESTEERING,1802,459952.900,00000000,8c02,12832;SOL_COMPUTED,DOPPLER_VELOCITY,0.150,0.000,"
    "0.0505,12.520238,-0.0537,0.0*18021b75",
    "#TIMEA,COM1,0,79.0,FINESTEERING,2169,301319.000,00000000,9924,13307;VALID,1.088781766e-09,1.522570309e-09,"
    "-18.00000000000,2021,8,4,11,41,41000,VALID*c2402aae",
    "#TIMEA,COM1,0,48.5,FINESTEERING,1702,47.848,00000000,ddae,7053;VALID,-3.432839221e-09,6.603391298e-08,"
    "-16.00000000000,2013,11,6,15,40,51000,VALID*10581099",
    "#TIMEA,COM1,0,86.5,FINESTEERING,1930,428348.000,02000020,9924,32768;VALID,1.667187222e-10,9.641617960e-10,"
    "-18.00000000000,2017,1,5,22,58,50000,VALID*2a066e78",
)


def read(line: str) -> Message:
    message = from_ascii(line.encode() + b"\r\n")
    assert message is not None
    return message


def of_edie(data: bytes) -> Any:
    parser = oem.Parser()
    parser.write(data)
    [message] = list(parser)
    return message


def logs(draw: random.Random) -> Log:
    kind = draw.randrange(4)
    if kind == 0:
        return no_position(draw.randrange(8))
    if kind == 1:
        angle = draw.uniform(0.0, 360.0)
        return BestVel(0, 8, 0.25, 0.0, draw.uniform(0.0, 3.0), angle, draw.uniform(-1.0, 1.0))
    if kind == 2:
        return Time(0, draw.uniform(-1e-6, 1e-6), 1e-8, -18.0, 2026, 7, 22, 18, 23, draw.randrange(60_000), 1)
    sigmas = (draw.uniform(0.5, 9.0), draw.uniform(0.5, 9.0), draw.uniform(0.5, 9.0))
    place = (draw.uniform(-90.0, 90.0), draw.uniform(-180.0, 180.0), draw.uniform(-5.0, 5.0), draw.uniform(-50.0, 50.0))
    return BestPos(0, 16, *place, 61, *sigmas, "0", 0.0, draw.uniform(0.0, 3.0), 12, 9, 9)


MESSAGES = [
    Message(Header(2300 + n, 1000 * n, version=3620, idle=n % 100 / 2.0), logs(random.Random(n))) for n in range(60)
]


@pytest.mark.parametrize("line", PRINTED)
def test_printed_logs_are_read_and_written_again(line: str) -> None:
    assert to_ascii(read(line)) == line.encode() + b"\r\n"


def test_printed_position() -> None:
    header, log = read(BESTPOS)
    assert isinstance(log, BestPos)
    assert (header.week, header.ms, header.version) == (1803, 27_504_000, 9603)
    assert (log.latitude, log.longitude, log.height, log.used) == (32.81519645735, 35.00791046612, 19.9359, 9)


def test_binary_twin_of_the_printed_position() -> None:
    data = to_binary(read(BESTPOS))
    assert len(data) == 104
    assert data[-4:].hex(" ") == "c3 ef 64 d2"


@pytest.mark.parametrize("line", PRINTED)
def test_binary_is_edies_byte_for_byte(line: str) -> None:
    data = to_binary(read(line))
    assert data == bytes(of_edie(line.encode() + b"\r\n").to_binary().message)


@pytest.mark.parametrize("line", PRINTED)
def test_edies_binary_is_read_as_what_was_printed(line: str) -> None:
    message = from_binary(bytes(of_edie(line.encode() + b"\r\n").to_binary().message))
    assert message is not None
    assert to_ascii(message) == line.encode() + b"\r\n"


def values(message: Any) -> list[Any]:
    said = message.to_dict()
    return [value for name, value in said.items() if name != "header"]


@pytest.mark.parametrize("message", MESSAGES)
def test_edie_reads_what_is_written(message: Message) -> None:
    for data in (to_binary(message), to_ascii(message)):
        found = of_edie(data)
        header = found.to_dict()["header"]
        assert (header["week"], header["milliseconds"]) == (message.header.week, message.header.ms)
        for mine, theirs in zip(message.log, values(found), strict=False):
            if isinstance(mine, float):
                assert theirs == pytest.approx(mine, abs=6e-4)
            elif isinstance(mine, int):
                assert int(theirs) == mine
        lengths = {BestPos: 21, BestVel: 8, Time: 11}
        assert len(values(found)) == lengths[type(message.log)]


@pytest.mark.parametrize("message", MESSAGES)
def test_both_formats_come_back(message: Message) -> None:
    binary, text = from_binary(to_binary(message)), from_ascii(to_ascii(message))
    assert binary is not None
    assert text is not None
    assert binary.header == text.header == message.header
    for theirs in (binary.log, text.log):
        assert all(
            a == pytest.approx(b, abs=6e-4) if isinstance(b, float) else a == b
            for a, b in zip(theirs, message.log, strict=True)
        )


def test_every_flipped_bit_of_a_binary_log_is_found() -> None:
    data = to_binary(read(BESTPOS))
    for bit in range(8 * len(data)):
        damaged = bytearray(data)
        damaged[bit // 8] ^= 1 << bit % 8
        assert from_binary(bytes(damaged)) is None


@pytest.mark.parametrize(
    "line",
    [
        BESTPOS[:-9],
        BESTPOS[:-1],
        BESTPOS[:-8] + "00000000",
        BESTPOS.replace("32.8", "32.9"),
        "#*00000000",
        "#BESTPOSA*zzzzzzzz",
        "#",
    ],
)
def test_lines_without_a_right_crc_are_none(line: str) -> None:
    assert from_ascii(line.encode()) is None


@pytest.mark.parametrize(
    "text",
    [
        "BESTPOSA,COM1;x",
        "BESTPOSA",
        "RANGEA,COM1,0,47.0,FINESTEERING,1803,27504.000,00000000,6145,9603;1",
        "TIMEA,COM1,0,47.0,WHEN,1803,27504.000,00000000,6145,9603;VALID,0,0,0,1,1,1,1,1,1,VALID",
        "TIMEA,COM1,0,47.0,FINE,1e999,27504.000,00000000,6145,9603;VALID,0,0,0,1,1,1,1,1,1,VALID",
        "TIMEA,COM1,0,47.0,FINE,1,inf,00000000,6145,9603;VALID,0,0,0,1,1,1,1,1,1,VALID",
    ],
)
def test_fields_that_make_no_sense_are_none(text: str) -> None:
    """Also under a right CRC."""
    from stommel.instruments.gnss.novatel.codec import crc

    assert from_ascii(f"#{text}*{crc(text.encode()):08x}\r\n".encode()) is None


def test_sizes_are_the_manuals() -> None:
    assert {number: size - 32 for number, size in SIZES.items()} == {42: 72, 99: 44, 101: 44}


@pytest.mark.parametrize(
    ("utc", "week", "ms"),
    [
        (1628077283.0, 2169, 301_301_000),  # 4 August 2021 11:41:23 UTC
        (1554595181.999, 2047, 604_799_999),  # a millisecond before the roll-over of April 2019
        (1554595182.0, 2048, 0),
        (315964800.0 - 18.0, 0, 0),
    ],
)
def test_weeks_and_milliseconds(utc: float, week: int, ms: int) -> None:
    assert week_and_ms(utc) == (week, ms)
    assert utc_of(week, ms) == pytest.approx(utc, abs=1e-6)


def test_printed_time_agrees_with_its_own_header() -> None:
    header, log = read(PRINTED[3])
    assert isinstance(log, Time)
    assert utc_of(header.week, header.ms) == 1628077301.0  # 11:41:41 UTC
    assert math.isclose(log.ms, 41_000)
