"""A simulated vehicle has a clock of its own world; nothing is kept before it is known."""

from collections import deque

from stommel.link.service import Received
from stommel.station.clock import VehicleClock
from stommel.station.vehicles.ingest import MOST_EARLY, UNSET_FOR, Ingest

WORLD = 1_782_864_000.0
"""What the vehicle's clock shows: months before or behind that of this machine."""


class Silence:
    """No sentences."""

    def __init__(self) -> None:
        self.texts: deque[object] = deque()


def ingest() -> Ingest:
    return Ingest(1, VehicleClock(20.0, utc=lambda: 1.8e9, monotonic=lambda: 0.0), Silence())  # type: ignore[arg-type]


def depth(boot_s: float, value: float) -> Received:
    fields = {"time_boot_ms": int(1e3 * boot_s), "phase": 1, "executive": 3, "dive": 1, "waypoint": 0, "depth": value,
              "altitude": 1.0, "surface_time_left": float("nan"), "mission": 1, "alarms": 0}  # fmt: skip
    return Received(1, 1, "GLIDER_STATE", fields)


def told_time(boot_s: float) -> Received:
    fields = {"time_unix_usec": int(1e6 * (WORLD + boot_s)), "time_boot_ms": int(1e3 * boot_s)}
    return Received(1, 1, "SYSTEM_TIME", fields)


def test_a_vehicle_that_flew_long_before_it_is_heard_keeps_its_own_time() -> None:
    """A station that starts late hears a depth before the clock: the depth has the time of the vehicle's world."""
    found = ingest()
    found.hear(b"a", [depth(5000.0, 12.0)], 1.8e9)
    assert found.samples == []
    found.hear(b"b", [told_time(5001.0)], 1.8e9 + 1.0)
    (t,) = [t for key, t, _ in found.samples if key == "depth_m"]
    assert abs(t - (WORLD + 5000.0)) < 2.0


def test_a_vehicle_that_never_tells_its_clock_is_kept_after_a_while() -> None:
    """Without a fix it may never know; then the station's own time is better than nothing."""
    found = ingest()
    found.hear(b"a", [depth(10.0, 12.0)], 1.8e9)
    found.hear(b"b", [depth(11.0 + UNSET_FOR, 13.0)], 1.8e9 + UNSET_FOR + 1.0)
    assert [value for key, _, value in found.samples if key == "depth_m"] == [12.0, 13.0]


def test_a_slow_simulation_is_not_taken_for_a_vehicle_without_a_clock() -> None:
    """On a busy machine an hour of ours may be a minute of the vehicle's; its first fix still comes in time."""
    found = ingest()
    found.hear(b"a", [depth(10.0, 12.0)], 1.8e9)
    found.hear(b"b", [depth(60.0, 13.0)], 1.8e9 + 4.0 * UNSET_FOR)
    assert found.samples == []


def test_what_waits_for_a_clock_is_bounded_in_bytes_and_then_kept_by_ours() -> None:
    """A line that is no more read for it would never hear the clock either."""
    found = ingest()
    size, told = 1 << 16, 0
    while found.samples == [] and told <= 2 * MOST_EARLY:
        assert not found.is_full, "the line must be read on"
        told += size
        found.hear(bytes(size), [depth(10.0, float(told))], 1.8e9)
    assert told == MOST_EARLY
    assert sum(key == "depth_m" for key, _, _ in found.samples) == MOST_EARLY // size
    assert not found.is_early
