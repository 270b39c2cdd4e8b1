"""Reads the binary logs of Slocum gliders (.dbd), as far as the tests need it.

A header of text lines; a list of sensors, in the file or in a cache named by its checksum; then cycles. Each cycle
begins with `d` and two bits a sensor: 0 is not measured, 1 as before, 2 a new value, which follows in its own size.
"""

import struct
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

_FORMS = {1: "b", 2: "h", 4: "f", 8: "d"}
_KNOWN_CYCLE = 16
"""Bytes by which a reader finds out how numbers are stored: `s`, `a`, 0x1234, 123.456, 123456789.12345."""


def read_log(path: Path, cache: Path, wanted: tuple[str, ...]) -> NDArray[np.float64]:
    """Sensors `wanted` of every cycle (rows); not a number where a cycle has none of them."""
    raw = path.read_bytes()
    header, at = _header(raw)
    sensors = _sensors(raw, header, at, cache)
    if header["sensor_list_factored"] != "1":
        for _ in range(int(header["total_num_sensors"])):
            at = raw.index(b"\n", at) + 1
    order = "<" if struct.unpack_from("<h", raw, at + 2)[0] == 0x1234 else ">"
    at += _KNOWN_CYCLE
    states = int(header["state_bytes_per_cycle"])
    now, rows = dict.fromkeys(wanted, np.nan), []
    while raw[at : at + 1] == b"d":
        state, at = raw[at + 1 : at + 1 + states], at + 1 + states
        row = dict.fromkeys(wanted, np.nan)
        for k, (name, size) in enumerate(sensors):
            code = state[k // 4] >> (6 - 2 * (k % 4)) & 3
            if code == 2:
                if name in now:
                    now[name] = struct.unpack_from(order + _FORMS[size], raw, at)[0]
                at += size
            if code and name in row:
                row[name] = now[name]
        rows.append(list(row.values()))
    return np.array(rows)


def _header(raw: bytes) -> tuple[dict[str, str], int]:
    header: dict[str, str] = {}
    at, lines = 0, 1
    while len(header) < lines:
        end = raw.index(b"\n", at)
        key, _, value = raw[at:end].decode("ascii").partition(":")
        header[key.strip()] = value.strip()
        lines = int(header.get("num_ascii_tags", lines + 1))
        at = end + 1
    return header, at


def _sensors(raw: bytes, header: dict[str, str], at: int, cache: Path) -> list[tuple[str, int]]:
    """Name and size in bytes of every sensor that the cycles hold."""
    if header["sensor_list_factored"] == "1":
        text = (cache / f"{header['sensor_list_crc'].lower()}.cac").read_text("ascii")
    else:
        text = raw[at:].split(b"s\x61", 1)[0].decode("ascii", "replace")
    lines = [line.split() for line in text.splitlines() if line.startswith("s: T")]
    return [(line[5], int(line[4])) for line in lines]
