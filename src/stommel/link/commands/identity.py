"""Who the vehicle is, for ordinary MAVLink software: AUTOPILOT_VERSION."""

from collections.abc import Iterable
from typing import NamedTuple

from stommel.messages.mavlink import Fields, enumeration

CAPABILITIES = ("MISSION_INT", "COMMAND_INT", "FTP", "FLIGHT_TERMINATION", "MAVLINK2", "PARAM_ENCODE_BYTEWISE")
"""What a vehicle with all services of the link can, by the words of MAV_PROTOCOL_CAPABILITY."""
_RELEASED, _DEVELOPED = 255, 0
"""FIRMWARE_VERSION_TYPE: official, and dev."""


class Identity(NamedTuple):
    """Who the vehicle is."""

    version: str
    """Of the software, as `1.2.3`; with more behind it, it is one under development."""
    uid: int = 0
    """Number of the hardware; 0 where it has none."""
    capabilities: Iterable[str] = CAPABILITIES

    def values(self) -> Fields:
        """Fields of AUTOPILOT_VERSION."""
        bits = enumeration("MAV_PROTOCOL_CAPABILITY")
        return {
            "capabilities": sum(bits[f"MAV_PROTOCOL_CAPABILITY_{word}"] for word in self.capabilities),
            "uid": self.uid,
            "flight_sw_version": _version_number(self.version),
            "flight_custom_version": self.version.encode()[:8],
        }


def _version_number(version: str) -> int:
    """Major, minor, patch and kind of a version, a byte each."""
    parts = version.replace("+", ".").split(".")
    numbers = [min(int(part), 255) if part.isdecimal() else 0 for part in [*parts, "", "", ""][:3]]
    released = len(parts) == 3 and all(part.isdecimal() for part in parts)
    kind = _RELEASED if released else _DEVELOPED
    return numbers[0] << 24 | numbers[1] << 16 | numbers[2] << 8 | kind
