"""The peers of the benchmark fly what the mission flies, and without them the bench says so and goes on."""

import sys
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import replace
from importlib import import_module
from math import degrees, inf, radians
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from stommel.analysis.trim import trim
from stommel.vehicle import FULL

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"
NEEDS_EXTRA = "needs the extra bench: pip install 'stommel[bench]'"


@pytest.fixture(scope="module", autouse=True)
def _importable() -> Iterator[None]:
    sys.path.insert(0, str(BENCHMARKS))
    yield
    sys.path.remove(str(BENCHMARKS))


@pytest.fixture(scope="module")
def flight() -> Any:
    return import_module("figures.reference_flight").reference_flight()


@pytest.fixture
def peer_jsbsim() -> Any:
    pytest.importorskip("jsbsim", reason=NEEDS_EXTRA)
    return import_module("figures.peer_jsbsim")


@pytest.fixture
def peer_gliderflight() -> Any:
    pytest.importorskip("gliderflight", reason=NEEDS_EXTRA)
    return import_module("figures.peer_gliderflight")


@pytest.mark.parametrize("name", ["ratio_to_gliderflight", "ratio_to_jsbsim", "ratio_to_jsbsim_at_10_hz"])
def test_without_the_extra_a_figure_says_so(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    registry, peers = import_module("figures.registry"), import_module("figures.peers")
    monkeypatch.setattr(peers, "find_spec", lambda _: None)
    (figure,) = registry.select([name])
    entry = registry.measured(figure)
    assert (entry["value"], entry["ok"]) == (None, None)
    assert "error" not in entry["detail"]
    printed = registry.line(name, entry)
    assert "skipped: " + name.removeprefix("ratio_to_").removesuffix("_at_10_hz") in printed
    assert "stommel[bench]" in printed


def test_the_aircraft_has_the_mass_of_the_vehicle(flight: Any, tmp_path: Path) -> None:
    import_module("figures.peer_jsbsim").write_aircraft(flight, tmp_path)
    aircraft = ET.parse(tmp_path / "aircraft" / "glider" / "glider.xml").getroot()
    body = float(aircraft.findtext("mass_balance/emptywt", ""))
    points = {one.get("name"): float(one.findtext("weight", "")) for one in aircraft.iter("pointmass")}
    added = points.pop("added mass")
    assert body + sum(points.values()) == pytest.approx(float(flight.vehicle.m))
    assert added == pytest.approx(float(flight.vehicle.M_f[0]))
    assert "$" not in ET.tostring(aircraft, encoding="unicode")


@pytest.mark.parametrize("pitch", [-35.0, -20.0])
def test_jsbsim_glides_as_the_trim_solver_says(flight: Any, peer_jsbsim: Any, tmp_path: Path, pitch: float) -> None:
    steady = trim(flight.mission.vehicle, speed_m_s=0.4, pitch_deg=pitch, physics=FULL)
    plan = peer_jsbsim.plan_of(flight)
    begun = {"speed": 0.3, "pitch": radians(pitch), "sinking": 0.15}
    leg = replace(plan.down, ballast=steady.V_b, moving_mass=steady.r_px, **begun)
    peer_jsbsim.write_aircraft(flight, tmp_path, uniform=True)
    fdm = peer_jsbsim.executive(tmp_path)
    peer_jsbsim.begin(fdm, leg, 0.0)
    last = dict(zip(peer_jsbsim.COLUMNS, peer_jsbsim.fly(fdm, replace(plan, depth=inf), 500)[-1], strict=True))
    assert last["speed"] == pytest.approx(0.4, rel=1e-3)
    assert degrees(last["pitch"]) == pytest.approx(pitch, abs=0.01)


def test_jsbsim_flies_the_dives_of_the_mission(flight: Any, peer_jsbsim: Any, tmp_path: Path) -> None:
    plan = peer_jsbsim.plan_of(flight)
    peer_jsbsim.write_aircraft(flight, tmp_path)
    seconds, rows = peer_jsbsim.timed_flight(tmp_path, plan, 3600)
    assert seconds > 0.0
    for ours, theirs in zip((plan.down, plan.up), peer_jsbsim.legs_of(rows, plan.depth), strict=True):
        assert theirs.speed == pytest.approx(ours.speed, rel=0.01)
        assert theirs.sinking == pytest.approx(ours.sinking, rel=0.01)
        assert degrees(theirs.pitch) == pytest.approx(degrees(ours.pitch), abs=0.5)
    column = dict(zip(peer_jsbsim.COLUMNS, rows.T, strict=True))
    assert plan.depth < column["depth"].max() < plan.depth + 10.0
    assert degrees(column["heading"][0]) > 10.0
    assert abs(np.sin(column["heading"][-1])) < np.sin(radians(1.0))


def test_gliderflight_finds_the_speed_of_the_mission(flight: Any, peer_gliderflight: Any) -> None:
    glider = peer_gliderflight.model(flight)
    peer_gliderflight.solve(glider, peer_gliderflight.series(flight, measured=True))
    under = flight.column("depth") > 20.0
    assert glider.U.shape == under.shape
    assert peer_gliderflight.speed_error(flight, glider) < 0.02 * flight.speed()[under].mean()


def test_the_series_is_cut_into_dives(flight: Any, peer_gliderflight: Any) -> None:
    measured, true = (peer_gliderflight.series(flight, measured=one) for one in (True, False))
    dives = peer_gliderflight.dives(flight, true)
    assert len(dives) > 5
    for dive in dives:
        assert np.diff(dive["time"]) == pytest.approx(np.ones(len(dive["time"]) - 1))
        # bar; the dive turns in time not to be deeper than this
        assert dive["pressure"].max() > flight.mission.scenario.dives.depth_m / 10.2
        assert dive["pressure"].min() > 0.05
    deep = (true["pressure"] > 3.0) & (true["pressure"] < 18.0)
    noise = np.std((measured["pitch"] - true["pitch"])[deep])
    assert noise == pytest.approx(radians(flight.mission.scenario.sensors.attitude_noise_deg), rel=0.1)
