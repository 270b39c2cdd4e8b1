"""What a vehicle sends, as it is given to the archive and read from it. Times are seconds since 1970."""

from collections.abc import Sequence
from typing import NamedTuple


class FrameRow(NamedTuple):
    """A frame of the link, as it was."""

    t: float
    direction: str
    """'in' from the vehicle, 'out' to it."""
    system: int
    component: int
    message_id: int
    sequence: int
    signed: bool
    frame: bytes


class DiveRow(NamedTuple):
    """What is known of a dive; a later row of the same dive replaces it."""

    dive: int
    t_begin: float
    t_end: float | None = None
    latitude_begin: float | None = None
    longitude_begin: float | None = None
    latitude_end: float | None = None
    longitude_end: float | None = None
    greatest_depth_m: float | None = None
    current_north_m_s: float | None = None
    current_east_m_s: float | None = None
    energy_j: float | None = None


class CtdRow(NamedTuple):
    """A sample of the CTD; None is what the instrument did not say."""

    t: float
    dive: int | None
    pressure_dbar: float | None
    temperature_degc: float | None
    conductivity_s_m: float | None


class TextRow(NamedTuple):
    """Words of the vehicle; severity is MAVLink's, 0 the worst and 7 the least."""

    t: float
    severity: int
    words: str


class Batch(NamedTuple):
    """What came at once; it is stored whole or not at all."""

    frames: Sequence[FrameRow] = ()
    samples: Sequence[tuple[str, float, float]] = ()
    """Key of the channel, time, value."""
    texts: Sequence[tuple[float, int, str]] = ()
    """Time, severity, words."""
    dives: Sequence[DiveRow] = ()
    ctd: Sequence[CtdRow] = ()
    log: int | None = None
    """Number of the log that it is from; None if it came by radio."""
