"""Datagrams of PNI's binary protocol (manual 1007537 r12, pages 33 to 41).

`ByteCount u16 | FrameID u8 | payload | CRC-16 u16`. ByteCount counts everything, itself and the CRC included. It and
the CRC are always big-endian. There is no byte to synchronise to: a frame is where count, identifier and CRC agree.
"""

import re
from binascii import crc_hqx
from enum import IntEnum
from typing import NamedTuple


class Id(IntEnum):
    """Identifiers of frames, named as in the manual."""

    GET_MOD_INFO = 1
    MOD_INFO_RESP = 2
    SET_DATA_COMPONENTS = 3
    GET_DATA = 4
    DATA_RESP = 5
    SET_CONFIG = 6
    GET_CONFIG = 7
    CONFIG_RESP = 8
    SAVE = 9
    START_CAL = 10
    STOP_CAL = 11
    SET_PARAM = 12
    GET_PARAM = 13
    PARAM_RESP = 14
    POWER_DOWN = 15
    SAVE_DONE = 16
    USER_CAL_SAMP_COUNT = 17
    USER_CAL_SCORE = 18
    SET_CONFIG_DONE = 19
    SET_PARAM_DONE = 20
    START_INTERVAL_MODE = 21
    STOP_INTERVAL_MODE = 22
    POWER_UP = 23
    SET_ACQ_PARAMS = 24
    GET_ACQ_PARAMS = 25
    ACQ_PARAMS_DONE = 26
    ACQ_PARAMS_RESP = 27
    POWER_DOWN_DONE = 28
    FACTORY_USER_CAL = 29
    FACTORY_USER_CAL_DONE = 30
    TAKE_USER_CAL_SAMPLE = 31
    FACTORY_INCL_CAL = 36
    FACTORY_INCL_CAL_DONE = 37
    SET_MODE = 46
    SET_MODE_RESP = 47
    SYNC_READ = 49


MOST_COMPONENTS = 16
MOST_TAPS = 32

_VALUED: dict[int, tuple[int, int]] = {
    Id.MOD_INFO_RESP: (8, 8),
    Id.SET_DATA_COMPONENTS: (1, 1 + MOST_COMPONENTS),
    Id.DATA_RESP: (1, 1 + 5 * MOST_COMPONENTS),
    Id.SET_CONFIG: (2, 5),
    Id.GET_CONFIG: (1, 1),
    Id.CONFIG_RESP: (2, 5),
    Id.START_CAL: (4, 4),
    Id.SET_PARAM: (3, 3 + 8 * MOST_TAPS),
    Id.GET_PARAM: (2, 2),
    Id.PARAM_RESP: (3, 3 + 8 * MOST_TAPS),
    Id.SAVE_DONE: (2, 2),
    Id.USER_CAL_SAMP_COUNT: (4, 4),
    Id.USER_CAL_SCORE: (24, 24),
    Id.SET_ACQ_PARAMS: (10, 10),
    Id.ACQ_PARAMS_RESP: (10, 10),
    Id.SET_MODE: (1, 1),
    Id.SET_MODE_RESP: (1, 1),
}
_BARE: tuple[int, ...] = (
    *(Id.GET_MOD_INFO, Id.GET_DATA, Id.SAVE, Id.STOP_CAL, Id.POWER_DOWN, Id.SET_CONFIG_DONE, Id.SET_PARAM_DONE),
    *(Id.START_INTERVAL_MODE, Id.STOP_INTERVAL_MODE, Id.POWER_UP, Id.GET_ACQ_PARAMS, Id.ACQ_PARAMS_DONE),
    *(Id.POWER_DOWN_DONE, Id.FACTORY_USER_CAL, Id.FACTORY_USER_CAL_DONE, Id.TAKE_USER_CAL_SAMPLE),
    *(Id.FACTORY_INCL_CAL, Id.FACTORY_INCL_CAL_DONE, Id.SYNC_READ),
)
PAYLOADS = _VALUED | dict.fromkeys(_BARE, (0, 0))
"""Least and greatest bytes of payload of each frame. The manual allows 4091 in any; only these can be meant."""

OVERHEAD = 5
LONGEST = OVERHEAD + max(most for _, most in PAYLOADS.values())
"""Bytes of the longest frame."""

_BEGINNING = re.compile(rb"[\x00\x01].[" + b"".join(re.escape(bytes((i,))) for i in PAYLOADS) + rb"]", re.DOTALL)
assert LONGEST < 512, "the first byte of a frame is 0 or 1"


class Datagram(NamedTuple):
    """A frame whose CRC is right."""

    identifier: int
    payload: bytes


def encoded(identifier: int, payload: bytes = b"") -> bytes:
    """Bytes of a frame."""
    body = (len(payload) + OVERHEAD).to_bytes(2, "big") + bytes((identifier,)) + payload
    return body + crc_hqx(body, 0).to_bytes(2, "big")


def look(buffer: bytes, at: int) -> tuple[Datagram | None, int] | None:
    """Look for a frame, as `framing.Framer` asks."""
    match = _BEGINNING.match(buffer, at)
    if match is None:
        later = _BEGINNING.search(buffer, at + 1)
        if later:
            return None, later.start()
        tail = max(at, len(buffer) - 2)
        if tail > at:
            return None, tail
        return None if buffer[at] <= 1 else (None, at + 1)
    count = buffer[at] << 8 | buffer[at + 1]
    identifier = buffer[at + 2]
    least, most = PAYLOADS[identifier]
    if not least <= count - OVERHEAD <= most:
        return None, at + 1
    end = at + count
    if end > len(buffer):
        return None
    if crc_hqx(buffer[at:end], 0):  # of a frame with its own CRC it is 0
        return None, at + 1
    return Datagram(identifier, buffer[at + 3 : end - 2]), end
