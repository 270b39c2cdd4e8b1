"""The user calibration and its score, which firmware of one generation writes otherwise than that of the next."""

import struct
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import NamedTuple

from stommel.instruments.tcm.components import order_mark

MANUALS: dict[str, tuple[str, ...]] = {
    "1007537": ("std_dev_err", "x_coverage", "y_coverage", "z_coverage", "mag_earth", "mag_hi"),
    "1014688": ("mag_cal_score", "reserved", "accel_cal_score", "dist_error", "tilt_error", "tilt_range"),
}
"""The six values of a kUserCalScore by manual. Both are 24 bytes: only the firmware tells them apart."""

KNOWN: Mapping[str, str] = MappingProxyType({"TCM3 1208": "1007537", "TCM5 1208": "1007537"})
"""Manual by type and revision of a kModInfoResp. Those that no source names are not guessed: a user adds theirs."""

ACCEPTED_SCORE = 1.0
"""Manual 1014688: a calibration of at most that is good."""


class ModuleInfo(NamedTuple):
    """What the instrument calls itself in a kModInfoResp."""

    module: str
    revision: str

    @property
    def name(self) -> str:
        """Type and revision, the key of `KNOWN`."""
        return f"{self.module} {self.revision}"


def module_info(payload: bytes) -> ModuleInfo | None:
    """Return type and revision; None where they are no text."""
    text = payload.decode("ascii", "replace")
    if not text.isascii() or not text.isprintable():
        return None
    return ModuleInfo(text[:4].strip(), text[4:].strip())


@dataclass(frozen=True)
class Calibration:
    """How far a user calibration is."""

    points: int = 0
    """Samples taken."""
    score: Mapping[str, float] = field(default_factory=dict)
    """Values of the score by name; empty before it comes."""
    saved: bool = False
    """Whether the instrument has said that it has saved it."""


def score(payload: bytes, manual: str, big_endian: bool) -> dict[str, float]:
    """Return the values of a kUserCalScore as firmware of that manual means them."""
    return dict(zip(MANUALS[manual], struct.unpack(order_mark(big_endian) + "6f", payload), strict=True))
