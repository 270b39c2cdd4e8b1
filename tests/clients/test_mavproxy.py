"""The simulated glider in the hands of MAVProxy. Oracle: the program as it is, and what the vehicle did aboard."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.clients.afloat import Afloat, afloat
from tests.clients.mavproxy import MavProxy

WAYPOINTS = """QGC WPL 110
0 0 6 16 0 500 0 0 29.2 126.1 -20 1
1 0 6 16 0 500 0 0 29.3 126.2 -20 1
2 0 6 16 0 500 0 0 29.4 126.2 -20 1
""".replace(" ", "\t").replace("QGC\tWPL\t", "QGC WPL ")


@pytest.fixture(scope="module")
def vehicle(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Afloat]:
    with afloat(tmp_path_factory.mktemp("vehicle")) as found:
        yield found


@pytest.fixture
def proxy(vehicle: Afloat, tmp_path: Path) -> Iterator[MavProxy]:
    with MavProxy(vehicle.port, tmp_path) as found:
        found.wait_for("Detected vehicle 1:1")
        found.wait_for(f"Received {len(vehicle.values(1))} parameters")  # it asks for them by itself
        yield found


def number(words: str) -> str:
    return rf"{words} : (-?[0-9.e-]+)"


def test_status_shows_a_submarine_that_lies_at_the_surface(vehicle: Afloat, proxy: MavProxy) -> None:
    assert "ARMED" in proxy.said
    assert "Mode Mode(102)" in proxy.wait_for("Mode Mode("), "a state of ours by the name of a mode of others"
    proxy.ask_again("status HEARTBEAT", r"type : 12, autopilot : 0, base_mode : 129, custom_mode : 102")
    place = proxy.ask_again("status GLOBAL_POSITION_INT", number("lat") + ", " + number("lon") + ", " + number("alt"))
    assert float(place[1]) / 1e7 == pytest.approx(29.0, abs=0.01)
    assert float(place[2]) / 1e7 == pytest.approx(126.0, abs=0.01)
    assert float(place[3]) / 1e3 == pytest.approx(0.0, abs=0.5)
    proxy.ask_again("status GPS_RAW_INT", r"fix_type : 3, lat : 2")
    assert float(proxy.ask_again("status ATTITUDE", number("pitch"))[1]) < -0.3, "nose down, the antenna aloft"
    assert 0.0 <= float(proxy.ask_again("status VFR_HUD", number("heading"))[1]) < 360.0
    voltage = float(proxy.ask_again("status SYS_STATUS", number("voltage_battery"))[1]) / 1e3
    assert voltage == pytest.approx(float(vehicle.system.plant.feel().readings.voltage), abs=0.5)
    assert "100%" in proxy.ask("bat", "Flight battery")


def test_parameters_are_shown_set_and_fetched(vehicle: Afloat, proxy: MavProxy) -> None:
    own, held = vehicle.own_parameter, vehicle.values(1)
    shown = proxy.ask("param show *", list(held)[-1])
    assert re.search(rf"{own.id} +{held[own.id]}", shown)
    wanted = float(held[own.id]) + 100.5  # a shorter time at the surface would end it
    proxy.say(f"param set {own.id} {wanted}")
    proxy.ask(f"param fetch {own.id}", f"{own.id} = {wanted}")
    proxy.ask("param fetch", f"Received {len(held)} parameters")
    assert str(wanted) in proxy.ask(f"param show {own.id}", f"{own.id}  ")
    assert vehicle.values(1)[own.id] == wanted


def test_a_mission_is_listed_loaded_and_listed_again(vehicle: Afloat, proxy: MavProxy, tmp_path: Path) -> None:
    before = vehicle.waypoints
    listed = proxy.ask("wp list", "Saved waypoints")
    assert f"{before[0][0]:.4f}" in listed
    number = vehicle.system.coordinator.mission
    (tmp_path / "new.txt").write_text(WAYPOINTS)
    proxy.ask("wp load new.txt", "MISSION_ACK: TYPE_MISSION: ACCEPTED")
    assert vehicle.waypoints == [(29.2, 126.1), (29.3, 126.2), (29.4, 126.2)]
    assert vehicle.system.coordinator.mission == number + 1
    listed = proxy.ask("wp list", "Saved waypoints")
    for latitude, longitude in vehicle.waypoints:
        assert f"{latitude:.10f} {longitude:.10f} -20.000000" in listed


def test_a_mission_that_cannot_be_flown_is_refused_in_words(vehicle: Afloat, proxy: MavProxy, tmp_path: Path) -> None:
    before = vehicle.waypoints
    (tmp_path / "deep.txt").write_text(WAYPOINTS.replace("-20", "-900"))
    proxy.say("wp load deep.txt")
    proxy.wait_for("MISSION_ACK: TYPE_MISSION: INVALID")
    assert "waypoints refused" in proxy.wait_for("must be between 900 and")
    assert vehicle.waypoints == before


def test_files_are_listed_and_fetched(vehicle: Afloat, proxy: MavProxy, tmp_path: Path) -> None:
    assert "D missions" in proxy.ask("ftp list /", "Total size")
    assert "active.orders" in proxy.ask("ftp list missions", "Total size")
    proxy.ask("ftp get missions/active.orders got.orders", "Wrote ")
    assert (tmp_path / "got.orders").read_bytes() == vehicle.orders_text
