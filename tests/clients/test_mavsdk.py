"""The simulated glider in the hands of MAVSDK. Oracle: the library as it is, and what the vehicle did aboard."""

import asyncio
from collections.abc import AsyncGenerator, Awaitable, Callable, Iterable, Iterator
from contextlib import asynccontextmanager, suppress
from math import degrees, nan
from pathlib import Path
from typing import Any, TypeVar

import pytest

from stommel.link.parameters.port import COORDINATOR_COMPONENT, MOTION_COMPONENT
from stommel.onboard.coordination.executive import State
from tests.clients.afloat import Afloat, afloat

T = TypeVar("T")
PATIENCE = 120.0
"""For anything that is asked for [s]."""
GOOD = [(29.2, 126.3), (29.3, 126.4)]


@pytest.fixture(scope="module")
def vehicle(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Afloat]:
    with afloat(tmp_path_factory.mktemp("vehicle")) as found:
        yield found


@asynccontextmanager
async def connected(port: int) -> AsyncGenerator[Any, None]:
    from mavsdk.asyncio.mavsdk import Configuration, Mavsdk
    from mavsdk.component_type import ComponentType

    configuration = Configuration.create_with_component_type(ComponentType.GROUND_STATION)
    async with Mavsdk(configuration) as mavsdk:
        await mavsdk.add_any_connection(f"tcpout://127.0.0.1:{port}")
        system = await mavsdk.first_autopilot(timeout_s=PATIENCE)
        assert system is not None, "the vehicle was not seen"
        yield system


def with_vehicle(vehicle: Afloat, act: Callable[[Any], Awaitable[None]]) -> None:
    """Connect, and do what a test wants done."""

    async def whole() -> None:
        async with connected(vehicle.port) as system:
            await asyncio.wait_for(act(system), 2.0 * PATIENCE)

    asyncio.run(whole())


async def until(stream: AsyncGenerator[T, None], holds: Callable[[T], bool]) -> T:
    """The first of a stream of which something holds."""

    async def look() -> T:
        async for found in stream:
            if holds(found):
                return found
        raise AssertionError("the stream ended")

    return await asyncio.wait_for(look(), PATIENCE)


def test_telemetry_is_shown(vehicle: Afloat) -> None:
    async def look(system: Any) -> None:
        from mavsdk.asyncio.plugins.telemetry import TelemetryAsync
        from mavsdk.plugins.telemetry.telemetry import FixType, FlightMode

        telemetry = TelemetryAsync(system)
        place = await until(telemetry.subscribe_position(), lambda p: p.latitude_deg != 0.0)
        assert (place.latitude_deg, place.longitude_deg) == pytest.approx((29.0, 126.0), abs=0.01)
        assert place.relative_altitude_m == pytest.approx(0.0, abs=0.5)
        attitude = await until(telemetry.subscribe_attitude_euler(), lambda a: a.pitch_deg != 0.0)
        assert attitude.pitch_deg < -20.0  # nose down, the antenna aloft
        battery = await until(telemetry.subscribe_battery(), lambda b: b.current_battery_a == b.current_battery_a)
        truth = vehicle.system.plant.feel().readings
        assert battery.voltage_v == pytest.approx(float(truth.voltage), abs=0.5)
        assert 0.0 < battery.remaining_percent <= 100.0
        gps = await until(telemetry.subscribe_gps_info(), lambda g: g.num_satellites > 0)
        assert gps.fix_type == FixType.FIX_3D
        raw = await until(telemetry.subscribe_raw_gps(), lambda g: g.latitude_deg != 0.0)
        assert raw.latitude_deg == pytest.approx(29.0, abs=0.01)
        health = await until(telemetry.subscribe_health(), lambda h: h.is_magnetometer_calibration_ok)
        assert health.is_accelerometer_calibration_ok
        hud = await until(telemetry.subscribe_fixedwing_metrics(), lambda m: m.heading_deg != 0.0)
        assert hud.absolute_altitude_m == pytest.approx(0.0, abs=0.5)
        assert await until(telemetry.subscribe_armed(), lambda armed: armed)
        assert await until(telemetry.subscribe_flight_mode(), lambda _: True) == FlightMode.UNKNOWN

    with_vehicle(vehicle, look)


def test_told_to_hold_and_to_go_on_it_says_so_in_words(vehicle: Afloat) -> None:
    async def command(system: Any) -> None:
        from mavsdk.asyncio.plugins.action import ActionAsync
        from mavsdk.asyncio.plugins.telemetry import TelemetryAsync

        telemetry, action = TelemetryAsync(system), ActionAsync(system)
        words = telemetry.subscribe_status_text()
        hold = asyncio.create_task(until(words, lambda said: said.text.startswith("hold: ")))
        await asyncio.sleep(0.1)
        await action.disarm()
        assert "operator" in (await hold).text
        assert not await until(telemetry.subscribe_armed(), lambda armed: not armed)
        assert vehicle.view.executive.state is State.HOLD
        await action.arm()
        assert await until(telemetry.subscribe_armed(), lambda armed: armed)
        assert vehicle.view.executive.started

    with_vehicle(vehicle, command)


def test_parameters_are_listed_read_and_set(vehicle: Afloat) -> None:
    async def use(system: Any) -> None:
        from mavsdk.asyncio.plugins.param import ParamAsync

        parameters, own = ParamAsync(system), vehicle.own_parameter
        assert listed(await parameters.get_all_params()) == pytest.approx(vehicle.values(COORDINATOR_COMPONENT))
        assert await parameters.get_param_float(own.id) == vehicle.values(COORDINATOR_COMPONENT)[own.id]
        wanted = vehicle.values(COORDINATOR_COMPONENT)[own.id] + 100.5  # a shorter time at the surface would end it
        await parameters.set_param_float(own.id, wanted)
        assert vehicle.values(COORDINATOR_COMPONENT)[own.id] == wanted
        assert await parameters.get_param_float(own.id) == wanted
        with pytest.raises(Exception, match="OUT_OF_RANGE"):
            await parameters.set_param_float(own.id, float(own.low) - 1.0)
        assert vehicle.values(COORDINATOR_COMPONENT)[own.id] == wanted

    with_vehicle(vehicle, use)


def test_parameters_of_a_node_are_those_of_its_component(vehicle: Afloat) -> None:
    async def use(system: Any) -> None:
        from mavsdk.asyncio.plugins.param import ParamAsync
        from mavsdk.plugins.param.param import ParamError, ProtocolVersion

        parameters, held = ParamAsync(system), vehicle.values(MOTION_COMPONENT)
        with suppress(ParamError):  # 4.1.0 selects, and says that it has not
            await parameters.select_component(MOTION_COMPONENT, ProtocolVersion.V1)
        assert len(held) > 10
        found = listed(await parameters.get_all_params())
        for _ in range(3):  # on a busy machine it gives up on some before they come
            if len(found) < len(held):
                found = listed(await parameters.get_all_params())
        assert found == pytest.approx(held, rel=1e-6)

    with_vehicle(vehicle, use)


def listed(found: Any) -> dict[str, float]:
    return {each.name: each.value for each in [*found.float_params, *found.int_params]}


def rounded(places: Iterable[tuple[float, float]]) -> list[tuple[float, float]]:
    return [(round(latitude, 6), round(longitude, 6)) for latitude, longitude in places]


def raw_items(places: list[tuple[float, float]], z: float) -> list[Any]:
    from mavsdk.plugins.mission_raw.mission_raw import MissionItem

    return [
        MissionItem(k, 6, 16, int(k == 0), 1, 0.0, 500.0, 0.0, nan, round(1e7 * at[0]), round(1e7 * at[1]), z, 0)
        for k, at in enumerate(places)
    ]


def test_a_raw_mission_goes_up_and_comes_down(vehicle: Afloat) -> None:
    async def use(system: Any) -> None:
        from mavsdk.asyncio.plugins.mission_raw import MissionRawAsync
        from mavsdk.asyncio.plugins.telemetry import TelemetryAsync

        missions = MissionRawAsync(system)
        held, number = await missions.download_mission(), vehicle.system.coordinator.mission
        assert rounded((each.x / 1e7, each.y / 1e7) for each in held) == vehicle.waypoints
        await missions.upload_mission(raw_items(GOOD, -20.0))
        assert vehicle.waypoints == GOOD
        assert vehicle.system.coordinator.mission == number + 1
        held = await missions.download_mission()
        assert [(each.x / 1e7, each.y / 1e7, each.z) for each in held] == [(*at, -20.0) for at in GOOD]
        words = TelemetryAsync(system).subscribe_status_text()
        refused = asyncio.create_task(until(words, lambda said: said.text.startswith("waypoints refused")))
        await asyncio.sleep(0.1)
        with pytest.raises(Exception, match="INVALID"):
            await missions.upload_mission(raw_items([(29.0, 126.5)], -900.0))
        assert "must be between 900 and" in (await refused).text
        assert vehicle.waypoints == GOOD

    with_vehicle(vehicle, use)


def test_a_mission_of_the_plain_kind_goes_up_and_comes_down_and_tells_its_progress(vehicle: Afloat) -> None:
    async def use(system: Any) -> None:
        from mavsdk.asyncio.plugins.mission import MissionAsync
        from mavsdk.plugins.mission.mission import MissionItem, MissionPlan

        def item(latitude: float, longitude: float) -> MissionItem:
            return MissionItem(
                latitude, longitude, -20.0, nan, True, nan, nan, MissionItem.CameraAction.NONE, nan, nan, 500.0, nan,
                nan, MissionItem.VehicleAction.NONE,
            )  # fmt: skip

        places = [(29.4, 126.1), (29.5, 126.2), (29.6, 126.2)]
        missions = MissionAsync(system)
        await missions.upload_mission(MissionPlan([item(*at) for at in places]))
        assert vehicle.waypoints == places
        held = (await missions.download_mission()).mission_items
        assert rounded((each.latitude_deg, each.longitude_deg) for each in held) == places
        assert all(each.relative_altitude_m == -20.0 and each.is_fly_through for each in held)
        await missions.set_current_mission_item(1)
        await until(missions.subscribe_mission_progress(), lambda p: (p.current, p.total) == (1, 3))
        memory = vehicle.system.coordinator.pilot.memory
        assert memory is not None
        assert memory["waypoint"] == 1

    with_vehicle(vehicle, use)


def test_files_are_listed_fetched_and_sent(vehicle: Afloat, tmp_path: Path) -> None:
    content = bytes(range(256)) * 20
    (tmp_path / "note.bin").write_bytes(content)

    async def use(system: Any) -> None:
        from mavsdk.asyncio.plugins.ftp import FtpAsync

        ftp = FtpAsync(system)
        assert [each.name for each in (await ftp.list_directory("/")).entries] == ["inbox", "log", "missions"]
        listed = {each.name: each.size_bytes for each in (await ftp.list_directory("/missions")).entries}
        async for _ in ftp.download("/missions/active.orders", str(tmp_path), True):
            pass
        assert (tmp_path / "active.orders").stat().st_size == listed["active.orders"]
        assert await ftp.are_files_identical(str(tmp_path / "active.orders"), "/missions/active.orders")
        async for _ in ftp.upload(str(tmp_path / "note.bin"), "/inbox"):
            pass
        assert await ftp.are_files_identical(str(tmp_path / "note.bin"), "/inbox/note.bin")
        (tmp_path / "again").mkdir()
        async for _ in ftp.download("/inbox/note.bin", str(tmp_path / "again"), False):
            pass
        assert (tmp_path / "again" / "note.bin").read_bytes() == content
        ftp.destroy()

    with_vehicle(vehicle, use)


def test_the_vehicle_flies_what_was_uploaded(tmp_path: Path) -> None:
    """East, where the orders aboard lead north: there the dive after the upload heads and goes."""

    async def send(system: Any) -> None:
        from mavsdk.asyncio.plugins.mission_raw import MissionRawAsync

        await MissionRawAsync(system).upload_mission(raw_items([(29.0, 126.6)], -20.0))

    with afloat(tmp_path) as vehicle:
        with_vehicle(vehicle, send)
    headings, places = [], []
    for _ in range(4000):
        vehicle.system.step()
        if vehicle.view.executive.state is State.MISSION:
            headings.append(degrees(float(vehicle.system.plant.feel().readings.psi)) % 360.0)
            places.append(vehicle.place)
        elif headings:
            break
    assert headings, "it does not dive"
    assert headings[-30] == pytest.approx(90.0, abs=20.0)
    north, east = (end - begin for begin, end in zip(places[0], places[-1], strict=True))
    assert east > max(20.0, abs(north))
