"""Logs for tests, written by the vehicle's own logbook."""

import math

from stommel.control.dive_cycle import ASCENT, DESCENT, SURFACE
from stommel.onboard.coordination.logbook import records
from stommel.onboard.coordination.logbook.framing import LogIdentity
from stommel.onboard.coordination.logbook.logbook import Logbook, LogSettings
from tests.onboard.coordination.disk import Disk

UTC, BOOT = 1_750_000_000.0, 5000.0
"""What the vehicle's clock shows when its software has run for so long [s]."""
DIVE, STAY, CTD_EVERY = 100, 20, 4
"""Steps of a dive and of a stay at the surface, a second each; between two samples of the CTD."""

WORDS = {
    0: ("executive", "communicate: control is at the surface"),
    STAY: ("executive", "mission: descent: control dives"),
    STAY + 7: ("safety:raised", "over-depth"),
    STAY + 9: ("log:dropped", "12 records of the series detail"),
}
"""Code and words of what happens, by the step of each dive."""


def current_of(dive: int) -> float:
    """Current to the north that is known in a dive, counted from 0: the mean of the dive before [m/s]."""
    return 0.125 + 0.0625 * max(dive, 0)


def depth_at(second: int) -> float:
    """Down and up at 0.5 m/s [m]."""
    k = second % (DIVE + STAY) - STAY
    return 0.0 if k <= 0 else 0.5 * min(k, DIVE - k)


def logs(seconds: int = 3 * (DIVE + STAY), utc: float | None = UTC, file_bytes: int = 4 << 20) -> dict[str, bytes]:
    """Files of a run in which a vehicle dives three times, by name."""
    clock = None if utc is None else lambda t: utc + t - BOOT
    disk = Disk()
    settings = LogSettings(file_bytes=file_bytes)
    book = Logbook(disk, settings, LogIdentity("9.9", 1, "mine", utc), BOOT, clock)
    for second in range(seconds):
        _step(book, second)
    book.sync(BOOT + seconds)
    return {name: bytes(content.data) for name, content in disk.files.items()}


def _step(book: Logbook, second: int) -> None:
    t, depth = BOOT + second, depth_at(second)
    dive, k = divmod(second, DIVE + STAY)
    afloat = k < STAY
    phase = SURFACE if afloat else DESCENT if k < STAY + DIVE // 2 else ASCENT
    begun = t - (k - STAY)
    if not afloat and k % CTD_EVERY == 0:
        book.append(records.CTD, (t, 4.0 + 0.001 * depth, 20.0 - 0.1 * depth, depth / 0.99))
    motion, hull, fix = (
        (0.0, 1.0, -0.5, math.pi, depth, math.inf),
        (False, 8e4, 12.0, 1.5),
        (False, BOOT - 7.0, 0.5, 2.0),
    )
    book.append(records.READINGS, (t, *motion, 0.01, 1e-4, 0.0, *hull, *fix))
    dives = dive + (not afloat)
    book.append(records.DECISION, (t, phase, t, 0.0 if dives == 0 else begun, dives, int(dives > 0), 0, 0, 2, 0.1))
    sigma = 5.0 if afloat and k > 10 else 300.0
    place = math.radians(30.0) + 1e-8 * second, math.radians(122.0)
    book.append(records.NAVIGATION, (t, *place, sigma, current_of(dive - afloat), -0.25))
    book.append(records.ACTUATORS, (t, 2.5e-4, 0.0125, 0.25, False, False, 2.0, 0.5, 0.0))
    if second % 10 == 0:
        book.append(records.BATTERY, (t, 12.5, 1.5, 18.0, 10.0 * second))
    if (words := WORDS.get(k)) is not None:
        book.event(t, *words)
    book.step(t)
