"""Missions that cannot be flown are refused in one line with key, value and what is allowed; nothing half-written."""

import resource
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from stommel.dynamics.packing import pack
from stommel.errors import StommelError
from stommel.simulation.scenario.loading import mission_from
from stommel.vehicle import FULL, load_vehicle
from tests.ocean.conftest import Writer, sea_file
from tests.simulation.conftest import Document, flown, made, mission_document
from tests.support.command import Command

__all__ = ["sea_file"]

DIVES: Document = {"depth_m": 100.0, "pitch_deg": 35.0, "speed_m_s": 0.35}


def refusal(document: Document, folder: Path = Path()) -> str:
    with pytest.raises(StommelError) as caught:
        mission_from(document, "test.toml", folder)
    text = str(caught.value)
    assert "\n" not in text
    return text


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"dives": DIVES | {"depth_m": 250.0}}, ["dives.depth_m = 250", "hull's rating, 200 m"]),
        ({"ocean": {"name": "pool"}}, ["dives.depth_m = 100", "below the bottom at the start, 3.5 m"]),
        ({"dive": 3}, ["dive"]),
        ({"dives": DIVES | {"dept_m": 3.0}}, ["dives.dept_m"]),
        ({"surface": {"sesion_s": 90.0}}, ["surface.sesion_s"]),
        ({"ctd": {"lag_s": 1.0}}, ["ctd.lag_s"]),
        ({"waves": {"height_m": 1.0}}, ["waves.height_m"]),
        ({"leak": {"rate": 1.0}}, ["leak.rate"]),
        ({"hull_air": {"pressure_pa": 1.0}}, ["hull_air.pressure_pa"]),
        ({"sensors": {"attitude_latency_s": 16.0}}, ["sensors.attitude_latency_s = 16", "15 or less"]),
        ({"sensors": {"pressure_latency_s": 8.0}, "integration": {"control_step_s": 0.5}}, ["latency_s = 8", "7.5 or"]),
        ({"sampling": {"every_s": 2.5}}, ["sampling.every_s = 2.5", "multiple of integration.control_step_s = 1"]),
        ({"sampling": {"every_s": 0.5}}, ["sampling.every_s = 0.5", "multiple"]),
        ({"sampling": {"phases": ["climb"]}}, ["sampling.phases", "climb"]),
        ({"output_every_s": 0.3}, ["output_every_s = 0.3", "multiple"]),
        ({"abort": {"battery_share": 1.5}}, ["abort.battery_share = 1.5"]),
        ({"sensors": {"first_fix_s": 400.0}}, ["sensors.first_fix_s = 400", "less than surface.session_s = 300"]),
        ({"surface": {"longest_s": 100.0}}, ["surface.longest_s = 100", "surface.session_s = 300"]),
        ({"waves": {"significant_height_m": -1.0}}, ["waves.significant_height_m = -1"]),
        ({"waves": {"peak_period_s": 0.1}}, ["waves.peak_period_s = 0.1"]),
        ({"ctd": {"cell_lag_s": 0.0}}, ["ctd.cell_lag_s = 0"]),
        ({"dives": DIVES | {"drift_hours": -1.0}}, ["dives.drift_hours = -1"]),
        ({"start_time": "2026-07-01T00:00:00"}, ["start_time", "time zone"]),
        ({"duration_days": float("inf")}, ["duration_days"]),
        ({"seed": -1}, ["seed = -1"]),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)  # fmt: skip
def test_refused(changes: Document, words: list[str]) -> None:
    text = refusal(mission_document(**changes))
    assert text.startswith("test.toml")
    for word in words:
        assert word in text


def test_more_drive_than_the_engine_has_is_refused() -> None:
    with pytest.raises(StommelError, match=r"test\.toml: dives: .* the engine needs .* ml and has -250 to 250 ml"):
        flown(dives={"depth_m": 100.0, "pitch_deg": 35.0, "ballast_ml": 300.0})


def test_more_ballast_at_the_surface_than_the_engine_has_is_refused() -> None:
    with pytest.raises(StommelError, match=r"surface\.ballast_ml = 400: more than the buoyancy engine has, 250 ml"):
        made(mission_document(surface={"ballast_ml": 400.0}))


def test_trim_far_from_the_water_of_the_dives_is_refused() -> None:
    """Neutral at 300 m in a stratified sea, the vehicle would sink with 87 ml of oil outside."""
    with pytest.raises(
        StommelError, match=r"test\.toml: ballasting\.neutral_depth_m: .* dive with 87 and climb with 194"
    ):
        flown(ballasting={"neutral_depth_m": 300.0})


AT_SEA: Document = {"latitude_deg": 72.0, "longitude_deg": 10.0}
SPITSBERGEN: Document = {"latitude_deg": 78.5, "longitude_deg": 17.0}


def arctic(path: Path, **changes: object) -> Document:
    return mission_document(
        **{
            "start_time": "2016-02-02T00:00:00Z",
            "start": AT_SEA,
            "waypoints": [{"latitude_deg": 72.5, "longitude_deg": 10.0}],
            "duration_days": 2.0,
            "ocean": {"file": str(path)},
        }
        | changes
    )


def test_arctic_mission_is_accepted(arctic20: Path) -> None:
    assert made(arctic(arctic20)).scenario.duration_days == 2.0


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"waypoints": [AT_SEA, SPITSBERGEN]}, ["waypoints.1 = (78.5, 17)", "on land"]),
        ({"start": SPITSBERGEN}, ["start = (78.5, 17)", "on land"]),
        ({"waypoints": [AT_SEA | {"latitude_deg": 40.0}]}, ["waypoints.0 = (40, 10)", "outside the ocean"]),
        ({"start_time": "2016-02-01T00:00:00Z"}, ["time 2016-02-01T00:00:00Z is outside", "2016-02-01T12:00:00Z to"]),
        ({"duration_days": 3.6}, ["2016-02-05T12:00:00Z"]),
        ({"start_time": "2020-01-01T00:00:00Z"}, ["no times in the wanted interval", "2016-02-05T12:00:00Z"]),
    ],
    ids=["waypoint on land", "start on land", "waypoint outside", "begins too early", "ends too late", "years late"],
)  # fmt: skip
def test_place_and_time_in_a_file(arctic20: Path, changes: Document, words: list[str]) -> None:
    text = refusal(arctic(arctic20, **changes))
    for word in words:
        assert word in text


def test_file_that_holds_its_last_values_may_be_left_in_time(arctic20: Path) -> None:
    held = {"file": str(arctic20), "outside_time": "hold"}
    assert made(arctic(arctic20, duration_days=30.0, ocean=held)).scenario.ocean.outside_time == "hold"


def test_missing_ocean_file_is_named(tmp_path: Path) -> None:
    text = refusal(mission_document(ocean={"file": "nowhere.nc"}), tmp_path)
    assert "nowhere.nc" in text


def test_ocean_without_units_is_refused(sea_file: Writer, tmp_path: Path) -> None:
    path = sea_file(lambda data: data["to"].attrs.pop("units") and None)
    place = {"latitude_deg": 13.0, "longitude_deg": 179.0}
    document = mission_document(ocean={"file": path.name}, start=place, waypoints=[place],
                                start_time="2020-03-01T00:00:00Z")  # fmt: skip
    assert "units" in refusal(document, tmp_path)


PLAN = """
name = "short"
vehicle = "zju"
start_time = 2026-07-01T00:00:00Z
duration_days = 0.05
output_every_s = 1
start = { latitude_deg = 18.0, longitude_deg = 116.0 }
dives = { depth_m = 100, pitch_deg = 35, speed_m_s = 0.35 }
waypoints = [{ latitude_deg = 19.0, longitude_deg = 116.0 }]
ocean = { name = "still" }
"""


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    path = tmp_path / "plan.toml"
    path.write_text(PLAN)
    return path


def refused_in_one_line(status: int, err: str, *words: str) -> None:
    assert status == 2, err
    (line,) = err.strip().splitlines()
    assert line.startswith("error: ")
    for word in words:
        assert word in line


def test_full_device(stommel: Command, plan: Path, tmp_path: Path) -> None:
    """/dev/full answers every write as a full disk does."""
    if not Path("/dev/full").exists():
        pytest.skip("no /dev/full on this system")
    (tmp_path / "m.nc").symlink_to("/dev/full")
    done = stommel("simulate", plan, "--output", "m.nc")
    refused_in_one_line(done.status, done.err, "m.nc", "No space left on device")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["m.nc", "plan.toml"]


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of 256 kB."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mounted = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=256k", "tmpfs", folder], capture_output=True, check=False
    )
    if mounted.returncode != 0:
        pytest.skip("a small file system cannot be mounted here")
    yield folder
    subprocess.run(["umount", folder], check=True)


def test_full_disk(stommel: Command, plan: Path, small_disk: Path) -> None:
    (small_disk / "m.nc").write_text("of an earlier mission")
    done = stommel("simulate", plan, "--output", small_disk / "m.nc")
    refused_in_one_line(done.status, done.err, "m.nc", "No space left on device")
    assert [p.name for p in small_disk.iterdir()] == ["m.nc"]
    assert (small_disk / "m.nc").read_text() == "of an earlier mission"


def test_limit_on_the_size_of_files(plan: Path, tmp_path: Path) -> None:
    """The same by a limit of the process, where no file system can be mounted."""
    (tmp_path / "m.nc").write_text("of an earlier mission")
    done = subprocess.run(
        [Path(sys.executable).with_name("stommel"), "simulate", plan, "--output", "m.nc"],
        cwd=tmp_path, capture_output=True, text=True, check=False, timeout=300,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (300_000, 300_000)),
    )  # fmt: skip
    refused_in_one_line(done.returncode, done.stderr, "m.nc: cannot be written: File too large")
    assert (tmp_path / "m.nc").read_text() == "of an earlier mission"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["m.nc", "plan.toml"]


def test_trimming_for_a_mission_leaves_the_vehicle_file_as_it_is() -> None:
    """Neutral half way down: the file's water keeps its density, the trim is a number of its own."""
    trimmed = made(mission_document(ballasting={"neutral_depth_m": 50.0})).vehicle
    zju = load_vehicle("zju")
    assert trimmed.description == zju.description
    assert trimmed.trimmed_for_kg_m3 is not None
    assert trimmed.trimmed_for_kg_m3 != zju.neutral_density_kg_m3
    water = made(mission_document()).ocean.at(made(mission_document()).scenario.start_seconds, 18.0, 116.0, 50.0)
    hull = 1.0 - pack(zju, FULL).kappa * water.pressure + pack(zju, FULL).alpha_T * (water.temperature - 15.0)
    assert trimmed.neutral_density_kg_m3 == pytest.approx(water.density * hull, rel=1e-6)
