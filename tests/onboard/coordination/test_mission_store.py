"""Missions of a vehicle: whole or not at all. Oracle: the missions that were sent, and the limits of a vehicle."""

import hashlib
import random
from collections.abc import Callable

import pytest

from stommel.control.orders_file import orders_text
from stommel.control.vehicle_limits import VehicleLimits, refusals
from stommel.errors import FileError
from stommel.onboard.coordination.stores.missions import MissionStore, MissionStoreError
from stommel.onboard.coordination.stores.reception import ReceptionError
from tests.onboard.coordination.disk import Disk, PowerCutError
from tests.support.orders import ORDERS

LIMITS = VehicleLimits(
    vehicle_sha256="0" * 64,
    ballast_ml=(-250, 350),
    moving_mass_mm=(200, 400),
    steering_deg=30,
    depth_rating_m=200,
    internal_pressure_kpa=105,
    battery_wh=1000,
)
OLD, NEW, THIRD = (ORDERS.replace("There and back", name).encode() for name in ("old", "new", "third"))


def send(store: MissionStore, text: bytes) -> None:
    store.announce(len(text), hashlib.sha256(text).hexdigest())
    store.take(0, text)


def holding(*missions: bytes) -> Disk:
    disk = Disk()
    store = MissionStore(disk, LIMITS)
    for text in missions:
        send(store, text)
        store.switch()
    return disk


def held(store: MissionStore) -> tuple[str | None, str | None]:
    """Names of the active mission and the previous one."""
    return tuple(mission and mission.header.mission for mission in (store.active, store.previous))  # type: ignore[return-value]


def test_a_mission_is_switched_over_and_the_one_before_kept() -> None:
    disk = holding(OLD, NEW, THIRD)
    store = MissionStore(disk, LIMITS)
    assert held(store) == ("third", "new")
    assert store.notes == []
    assert store.active is not None
    assert orders_text(store.active.orders, store.active.header).split() == orders_text(
        *_parsed(THIRD)
    ).split()  # fmt: skip
    assert len(disk.files) == 2, "missions pile up"
    store.roll_back()
    assert held(store) == held(MissionStore(disk, LIMITS)) == ("new", "third")
    store.roll_back()
    assert held(MissionStore(disk, LIMITS)) == ("third", "new")


def _parsed(text: bytes):  # type: ignore[no-untyped-def]
    from stommel.control.orders_file import parse_orders

    return parse_orders(text.decode(), "orders")


def switch(store: MissionStore) -> None:
    send(store, THIRD)
    store.switch()


CHANGES: dict[str, tuple[Callable[[MissionStore], object], tuple[str, str]]] = {
    "switch": (switch, ("third", "new")),
    "roll back": (MissionStore.roll_back, ("old", "new")),
    "start": (lambda store: store.start(1000.0), ("new", "old")),
}


@pytest.mark.parametrize("name", CHANGES)
@pytest.mark.parametrize("keeps_unsynced", [True, False])
def test_power_cut_at_every_operation_leaves_the_old_or_the_new(name: str, keeps_unsynced: bool) -> None:
    """Every operation of the disk is cut in its middle; what is found is the state before or the state after, whole."""
    change, after = CHANGES[name]
    seen = set()
    for operations in range(1, 40):
        disk = holding(OLD, NEW)
        store = MissionStore(disk, LIMITS)
        disk.operations_left = operations
        cut = False
        try:
            change(store)
        except PowerCutError:
            cut = True
        for seed in range(20):
            found = disk.after_power_cut(random.Random(seed), keeps_unsynced)
            again = MissionStore(found, LIMITS)
            assert again.notes == []
            seen.add(held(again))
            assert held(again) in {("new", "old"), after}
            if not cut:
                assert held(again) == after
            if name == "start":
                assert again.started in ({None, 1000.0} if cut else {1000.0})
            # and the vehicle can be told anew
            send(again, ORDERS.encode())
            again.switch()
            assert held(MissionStore(found, LIMITS))[0] == "There and back"
        if not cut:
            break
    assert not cut
    assert seen == {("new", "old"), after}


def test_every_damaged_byte_of_the_active_mission_is_noticed() -> None:
    disk = holding(OLD, NEW)
    newest = max(disk.files)
    whole = bytes(disk.files[newest].data)
    for i in range(0, len(whole), 7):
        damaged = bytearray(whole)
        damaged[i] ^= 0x10
        disk.files[newest].data = damaged
        store = MissionStore(disk, LIMITS)
        assert held(store) == ("old", None), i
        assert store.notes == [
            "mission 2 is not used: mission-000002.orders: is damaged: its SHA-256 is another",
            "mission 1, old, is flown in its place",
        ]
    for length in range(0, len(whole), 100):
        disk.files[newest].data = bytearray(whole[:length])
        assert held(MissionStore(disk, LIMITS)) == ("old", None)


def test_a_mission_after_a_damaged_one_does_not_take_its_number() -> None:
    disk = holding(OLD, NEW)
    disk.files[max(disk.files)].data[100] ^= 1
    switch(store := MissionStore(disk, LIMITS))
    assert held(store) == held(again := MissionStore(disk, LIMITS)) == ("third", "old")
    assert again.notes == []


def test_no_mission_and_no_disk() -> None:
    store = MissionStore(Disk(), LIMITS)
    assert held(store) == (None, None)
    assert not store.expired(1e12)
    with pytest.raises(MissionStoreError, match="no previous one"):
        store.roll_back()
    with pytest.raises(MissionStoreError, match="none to start"):
        store.start(0.0)
    disk = holding(OLD)
    disk.broken = True
    assert MissionStore(disk, LIMITS).notes == ["missions cannot be read: Input/output error"]


def test_a_full_disk_leaves_the_mission_as_it_is() -> None:
    disk = holding(OLD)
    for room in (0, 10, len(NEW) // 2):
        disk.room = room
        store = MissionStore(disk, LIMITS)
        send(store, NEW)
        with pytest.raises(MissionStoreError, match="cannot be kept: No space left on device"):
            store.switch()
        assert held(store) == held(MissionStore(disk, LIMITS)) == ("old", None)
    disk.room = None
    store.switch()
    assert held(MissionStore(disk, LIMITS)) == ("new", "old")


def test_pieces_come_in_any_order_and_twice() -> None:
    draw = random.Random(3)
    for _ in range(50):
        store = MissionStore(Disk(), LIMITS)
        size = draw.randint(50, 700)
        pieces = [(i, NEW[i : i + size]) for i in range(0, len(NEW), size)] * draw.randint(1, 2)
        draw.shuffle(pieces)
        store.announce(len(NEW), hashlib.sha256(NEW).hexdigest())
        there: set[int] = set()
        for offset, piece in pieces:
            if len(there) < len(NEW):
                with pytest.raises(ReceptionError, match=rf"mission: {len(NEW) - len(there)} of {len(NEW)} bytes"):
                    store.switch()
            store.take(offset, piece)
            there |= set(range(offset, offset + len(piece)))
            gaps = {byte for first, last in store.missing for byte in range(first, last)}
            assert gaps == set(range(len(NEW))) - there
            store.announce(len(NEW), hashlib.sha256(NEW).hexdigest())  # the same again: goes on
        assert store.switch().header.mission == "new"
        assert store.missing == []


def test_what_was_not_announced_so_is_refused() -> None:
    store = MissionStore(holding(OLD), LIMITS)
    with pytest.raises(ReceptionError, match="no new one has been sent to the vehicle; send one first"):
        store.take(0, b"x")
    with pytest.raises(ReceptionError, match=r"size = 2000000: must be between 1 and 1048576 bytes"):
        store.announce(2_000_000, "0" * 64)
    with pytest.raises(ReceptionError, match="must be a SHA-256 digest"):
        store.announce(10, "f")
    store.announce(len(NEW), hashlib.sha256(NEW).hexdigest())
    for offset in (-1, len(NEW)):
        with pytest.raises(ReceptionError, match="must lie within 0 to"):
            store.take(offset, b"x")
    store.take(0, NEW[:-1] + b"#")
    with pytest.raises(ReceptionError, match="is not the file that was sent; send it again"):
        store.switch()
    assert store.missing == [(0, len(NEW))]
    send(store, b"\xff\xfe")
    with pytest.raises(FileError, match="mission: is not UTF-8 text"):
        store.switch()
    assert held(store) == ("old", None)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"' + "0" * 64, '"' + "1" * 64, "vehicle_sha256 = 111111111111...: the orders are for another vehicle"),
        ("ballast_dive_m3 = -1e-4", "ballast_dive_m3 = -2.6e-4", "-0.00026: must be between -0.00025 and 0.00035 m3"),
        ("ballast_climb_m3 = 2e-4", "ballast_climb_m3 = 4e-4", "dives.ballast_climb_m3 = 0.0004: must be between"),
        ("ballast_surface_m3 = 3e-4", "ballast_surface_m3 = 4e-4", "dives.ballast_surface_m3 = 0.0004"),
        ("ballast_drift_m3 = 1e-5", "ballast_drift_m3 = -4e-4", "dives.ballast_drift_m3 = -0.0004"),
        ("moving_mass_drift_m = 0.25", "moving_mass_drift_m = 0.1", "moving_mass_drift_m = 0.1: must be between 0.2"),
        ("surface_s = 300.0", "surface_s = 300.0\nmoving_mass_surface_m = 0.5", "dives.moving_mass_surface_m = 0.5"),
        ("limit_rad = 0.17", "limit_rad = 0.6", "heading_control.limit = 34.3775: must be between 0 and 30 deg"),
        ("depth_m = 100.0", "depth_m = 210.0", "dives.depth_m = 210: must be between 0 and 200 m"),
        ("abort_depth_m = 110.0", "abort_depth_m = 221.0", "dives.abort_depth_m = 221: must be between 100 and 220 m"),
        ("abort_depth_m = 110.0", "abort_depth_m = 90.0", "dives.abort_depth_m = 90: must be between 100"),
        ("turn_depth_m = 10.0", "turn_depth_m = 101.0", "dives.turn_depth_m = 101: must be between 0 and 100 m"),
        ("energy_j = 3e6", "energy_j = 3.7e6", "alarms.energy_j = 3.7e+06: must be between 0 and 3.6e+06 J"),
        ("leak = true", "leak = true\ninternal_pressure_pa = 110e3", "internal_pressure_pa = 110000: must be between"),
    ],
)
def test_each_impossible_limit_is_named(old: str, new: str, words: str) -> None:
    assert old in ORDERS
    store = MissionStore(holding(OLD), LIMITS)
    send(store, ORDERS.replace(old, new, 1).encode())
    with pytest.raises(FileError) as refused:
        store.check()
    assert words in str(refused.value)
    with pytest.raises(FileError):
        store.switch()
    assert held(store) == ("old", None)


def test_all_impossible_limits_are_named_at_once() -> None:
    orders, header = _parsed(OLD)
    narrow = LIMITS.model_copy(update={"ballast_ml": (-1.0, 1.0), "depth_rating_m": 5.0, "steering_deg": 1.0})
    assert len(refusals(orders, header, narrow, "mission")) == 7
    assert refusals(orders, header, LIMITS, "mission") == []


def test_a_mission_that_no_longer_fits_the_vehicle_is_not_flown() -> None:
    disk = holding(OLD)
    store = MissionStore(disk, LIMITS.model_copy(update={"depth_rating_m": 50.0}))
    assert held(store) == (None, None)
    assert "mission 1 is not used: mission-000001.orders: dives.depth_m = 100: must be between" in store.notes[0]


def test_a_mission_expires_so_long_after_its_start() -> None:
    """Also after a restart of the software; a new mission has not begun."""
    disk = holding(OLD)
    store = MissionStore(disk, LIMITS)
    assert not store.expired(1e9)
    store.start(1000.0)
    store.start(2000.0)
    store = MissionStore(disk, LIMITS)
    assert (store.started, store.expires) == (1000.0, 1000.0 + 48 * 3600.0)
    assert not store.expired(1000.0 + 48 * 3600.0 - 1.0)
    assert store.expired(1000.0 + 48 * 3600.0)
    send(store, ORDERS.replace("expires_hours = 48.0\n", "").encode())
    store.switch()
    assert MissionStore(disk, LIMITS).started is None
    store.start(0.0)
    assert not store.expired(1e12)
    disk.files["started"].data[70] ^= 1
    store = MissionStore(disk, LIMITS)
    assert store.started is None
    assert store.notes == ["the start of the mission is damaged: it counts as not started"]
