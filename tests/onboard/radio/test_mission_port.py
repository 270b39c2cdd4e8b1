"""Missions from the radio to the vehicle's store. Oracle: the orders that were held, the vehicle's limits."""

import hashlib
import random

import pytest

from stommel.control.orders_file import orders_text, parse_orders
from stommel.control.vehicle_limits import VehicleLimits
from stommel.link.endings import Ending
from stommel.link.missions.orders_client import OrdersClient
from stommel.link.missions.orders_server import OrdersServer
from stommel.link.missions.port import Waypoint, WaypointPlan, WaypointProgress
from stommel.link.missions.waypoint_client import WaypointClient
from stommel.link.missions.waypoint_server import WaypointServer
from stommel.onboard.coordination.stores.missions import MissionStore
from stommel.onboard.radio.mission_port import MissionPort, with_waypoints
from tests.link.line import End, Line, losing
from tests.onboard.coordination.disk import Disk
from tests.support.orders import ORDERS

LIMITS = VehicleLimits(
    vehicle_sha256="0" * 64, ballast_ml=(-250, 350), moving_mass_mm=(200, 400), steering_deg=30, depth_rating_m=200,
    internal_pressure_kpa=105, battery_wh=1000,
)  # fmt: skip
PLACES = (Waypoint(300_000_001, -1_799_999_999), Waypoint(-899_999_999, 1_800_000_000), Waypoint(1, 1))


class Flown:
    """A coordinator that flies whatever it is given."""

    def __init__(self) -> None:
        self.words = ""
        self.current = 0

    def progress(self) -> WaypointProgress:
        return WaypointProgress(self.current)

    def aim_at(self, number: int) -> str:
        self.current = number
        return ""

    def why_not_now(self) -> str:
        return self.words


def ported(disk: Disk | None = None, holding: str | None = ORDERS) -> tuple[MissionStore, MissionPort, Flown]:
    store = MissionStore(disk or Disk(), LIMITS)
    if holding is not None:
        store.announce(len(holding), hashlib.sha256(holding.encode()).hexdigest())
        store.take(0, holding.encode())
        store.switch()
    flown = Flown()
    return store, MissionPort(lambda: store, flown), flown


def test_waypoints_are_put_into_the_orders_that_are_held() -> None:
    """All else of the orders is as it was, also after a restart; the mission before is kept."""
    disk = Disk()
    _, port, _ = ported(disk)
    plan = WaypointPlan(PLACES, 60.0, 250.0)
    assert list(port.take_plan(plan)) == []
    assert port.plan() == plan
    again = MissionStore(disk, LIMITS)
    assert again.active is not None
    before, header = parse_orders(ORDERS, "orders")
    expected = before._replace(
        waypoints=again.active.orders.waypoints, radius=250.0, dives=before.dives._replace(depth=60.0)
    )
    assert orders_text(again.active.orders, again.active.header) == orders_text(expected, header)
    assert again.previous is not None
    assert again.previous.sha256 == hashlib.sha256(ORDERS.encode()).hexdigest()
    assert list(port.take_plan(WaypointPlan(PLACES[:1], None, None))) == []
    assert port.plan() == WaypointPlan(PLACES[:1], 60.0, 250.0)


def test_a_depth_as_a_message_holds_it_changes_nothing() -> None:
    """A mission that is fetched and sent again is the mission: 32 bits must not make 99.9 m of 99.90000152587891 m."""
    orders, _ = parse_orders(ORDERS.replace("depth_m = 100.0", "depth_m = 99.9", 1), "orders")
    same = with_waypoints(orders, WaypointPlan(PLACES, 99.90000152587891, 500.0))
    assert same.dives == orders.dives
    assert same.radius == orders.radius


@pytest.mark.parametrize(
    ("plan", "words"),
    [
        (WaypointPlan(PLACES, 250.0, None), "dives.depth_m = 250: must be between 0 and 200 m"),
        (WaypointPlan(PLACES, None, 1.0), "acceptance_radius_m = 1.0: must be between 5 and 100000 m"),
    ],
)
def test_what_the_vehicle_cannot_fly_is_refused(plan: WaypointPlan, words: str) -> None:
    store, port, _ = ported()
    refusals = port.take_plan(plan)
    assert any(words in refusal.words for refusal in refusals)
    assert store.active is not None
    assert store.active.number == 1


def test_a_drifting_mission_keeps_its_depth() -> None:
    drifting = ORDERS.replace("drift_s = 0.0", "drift_s = 600.0")
    assert drifting != ORDERS
    _, port, _ = ported(holding=drifting)
    (refusal,) = port.take_plan(WaypointPlan(PLACES, 50.0, None))
    assert refusal.words == "depth = 50 m: must be 100 m, in which the orders aboard let the vehicle drift"


def test_a_vehicle_without_orders_refuses_waypoints() -> None:
    _, port, _ = ported(holding=None)
    (refusal,) = port.take_plan(WaypointPlan(PLACES, None, None))
    assert refusal.words == "the vehicle holds no orders that waypoints could be put into: send an orders file"
    assert port.plan() is None
    assert port.held().sha256 == b""
    assert port.aim_at(0) == "waypoint 0: the vehicle holds no waypoints"


def test_a_mission_that_must_not_be_replaced_now_is_kept() -> None:
    store, port, flown = ported()
    flown.words = "the vehicle is under water"
    (refusal,) = port.take_plan(WaypointPlan(PLACES, None, None))
    assert refusal.words == "mission: the vehicle is under water"
    assert store.active is not None
    assert store.active.number == 1


def test_a_file_goes_on_after_a_restart_of_the_vehicle() -> None:
    """What has arrived lies on the disk: no byte of it is asked for again, and the switch needs no announcement."""
    disk = Disk()
    _, port, _ = ported(disk, holding=None)
    text = ORDERS.encode()
    sha256 = hashlib.sha256(text).digest()
    port.announce(len(text), sha256)
    port.take_piece(0, text[:700])
    again = MissionPort(lambda: MissionStore(disk, LIMITS), Flown())
    assert again.announced() == sha256
    assert list(again.missing()) == [(700, len(text))]
    again.take_piece(700, text[700:])
    again.switch()
    assert again.held().sha256 == sha256
    assert again.announced() == b""


def test_aiming() -> None:
    _, port, flown = ported()
    assert port.aim_at(1) == ""
    assert flown.current == 1
    assert port.aim_at(2) == "waypoint 2: must be between 0 and 1"


def test_over_a_bad_line_into_the_store() -> None:
    """An orders file, then waypoints, at 30 % loss; what the shore believes is what the disk holds."""
    disk = Disk()
    _, port, _ = ported(disk, holding=None)
    orders, waypoints = OrdersClient(1, random.Random(1)), WaypointClient(1)
    servers = [OrdersServer(1, 1, port, port), WaypointServer(1, 1, port)]
    line = Line(End(255, 190, [orders, waypoints]), End(1, 1, servers), losing(random.Random(3), 0.3))
    orders.send(ORDERS.encode(), line.t)
    line.run(lambda: orders.outcome is not None, 600.0)
    assert orders.outcome is not None
    assert orders.outcome.ending is Ending.WHOLE
    wrong = ORDERS.replace('vehicle_sha256 = "0', 'vehicle_sha256 = "1').replace("depth_m = 100.0", "depth_m = 300.0")
    orders.send(wrong.encode(), line.t)
    line.run(lambda: orders.outcome is not None, 600.0)
    assert orders.outcome.ending is Ending.REFUSED
    assert len(orders.outcome.words) >= 2
    assert any("dives.depth_m = 300: must be between 0 and 200 m" in words for words in orders.outcome.words)
    waypoints.send(WaypointPlan(PLACES, 75.0, None), line.t)
    line.run(lambda: waypoints.outcome is not None, 600.0)
    assert waypoints.outcome is not None
    assert waypoints.outcome.ending is Ending.WHOLE, waypoints.outcome
    active = MissionStore(disk, LIMITS).active
    assert active is not None
    assert (active.number, active.orders.dives.depth, len(active.orders.waypoints)) == (2, 75.0, 3)


def test_a_mission_that_the_disk_has_damaged_is_no_file_and_hides_no_other() -> None:
    disk = Disk()
    store, port, _ = ported(disk)
    assert list(port.take_plan(WaypointPlan(PLACES, None, None))) == []
    assert set(port.texts()) == {"active.orders", "previous.orders"}
    assert store.previous is not None
    damaged = next(name for name in disk.sizes() if f"{store.previous.number:}" in name and "mission" in name)
    disk.remove(damaged)
    assert set(port.texts()) == {"active.orders"}
