"""The configuration of a vehicle's software: what is written is read; what is wrong is named with key, value, range.

Oracle: the vehicle's file, and the settings by which the loop flies it.
"""

import json
import tomllib
from collections.abc import Iterator
from dataclasses import replace
from math import inf, radians
from pathlib import Path

import pytest
from pydantic import BaseModel

from stommel.control.dive_cycle import DRIFT, PHASES, RECOVERY, SURFACE
from stommel.errors import FileError
from stommel.files.docstrings import attribute_docstrings
from stommel.files.table_keys import models_in
from stommel.instruments.tcm.driver import CompassSettings
from stommel.messages.serial_port import BAUD_RATES
from stommel.onboard.coordination.compass.calibration import CompassCalibration
from stommel.onboard.coordination.config import ConfigurationFile, read_configuration
from stommel.onboard.coordination.config.text import configuration_text
from stommel.onboard.coordination.logbook.logbook import LogSettings
from stommel.onboard.coordination.navigation import NavigationErrors
from stommel.onboard.coordination.power import PowerSchedule
from stommel.simulation.scenario.loading import load_mission
from stommel.simulation.scenario.shipped import mission_path
from stommel.simulation.setup import prepare
from stommel.sitl.equipment import coordinator_settings
from stommel.vehicle import builtin_text, load_vehicle
from stommel.vehicle.fingerprint import untrimmed_fingerprint
from tests.support.command import Command, run_here
from tests.support.configuration import CALIBRATION, CONFIGURATION
from tests.support.mutations import mutations

ZJU = load_vehicle("zju")


@pytest.fixture(scope="module")
def text(tmp_path_factory: pytest.TempPathFactory) -> str:
    folder = tmp_path_factory.mktemp("configuration")
    done = run_here(folder, "vehicle", "config", "zju", "--output", "out", "--json")
    assert done.status == 0, done.err
    assert json.loads(done.out)["written"] == ["out/CONFIG.toml"]
    return (folder / "out" / "CONFIG.toml").read_text()


def written(folder: Path, text: str) -> Path:
    path = folder / "CONFIG.toml"
    path.write_text(text)
    return path


def test_limits_are_those_of_the_vehicle_s_file(text: str, tmp_path: Path) -> None:
    limits = read_configuration(written(tmp_path, text)).file.limits
    actuators, battery, hull = ZJU.description.actuators, ZJU.description.battery, ZJU.description.hull
    assert limits.vehicle_sha256 == untrimmed_fingerprint(ZJU)
    assert actuators.buoyancy is not None
    assert limits.ballast_ml == pytest.approx(actuators.buoyancy.range_ml)
    assert actuators.moving_mass is not None
    assert limits.moving_mass_mm == actuators.moving_mass.travel_mm
    assert actuators.rudder is not None
    assert limits.steering_deg == actuators.rudder.travel_deg
    assert hull is not None
    assert limits.depth_rating_m == hull.depth_rating_m
    assert battery is not None
    assert limits.battery_wh == battery.capacity_ah * battery.voltage_v


def test_coordinator_is_set_up_as_in_the_loop(text: str, tmp_path: Path) -> None:
    """But for what depends on the mission: how long a dive may take, and where its pitch has the mass."""
    found = read_configuration(written(tmp_path, text)).coordinator
    loop = coordinator_settings(prepare(load_mission(mission_path("pool_trial"))), 10.0, CompassCalibration())
    safety = loop.safety._replace(longest_submerged=found.safety.longest_submerged, hull_rating_depth=200.0)
    assert tuple(found.safety) == pytest.approx(tuple(safety), rel=0.02)  # its oil is warmer
    assert found.actuators[:4] == pytest.approx(loop.actuators[:4])
    assert found.actuators[-2:] == pytest.approx(loop.actuators[-2:])
    assert found.usable_energy == pytest.approx(0.9 * 3600.0 * 24.0 * 45.0)  # of 45 Ah at 24 V a tenth is kept
    assert found.schedule.decide == loop.schedule.decide
    same = {name: getattr(loop, name) for name in ("safety", "actuators", "declination", "usable_energy", "schedule")}
    assert replace(found, **same) == loop


def models(model: type[BaseModel]) -> Iterator[type[BaseModel]]:
    yield model
    for field in model.model_fields.values():
        for inner in models_in(field.annotation):
            yield from models(inner)


def test_every_key_is_written_with_what_it_means(text: str) -> None:
    """Above each is its docstring; those without a value are there as comments."""
    found = list(models(ConfigurationFile))
    assert len(found) == 15
    plain = " ".join(text.replace("\n# ", " ").split())
    for model in found:
        for key, meaning in attribute_docstrings(model).items():
            assert f"{' '.join(meaning.split())} {key} =" in plain.replace(" # ", " "), (model.__name__, key)


def test_what_is_written_is_read_back(text: str, tmp_path: Path) -> None:
    file = read_configuration(written(tmp_path, text)).file
    assert configuration_text(file) == text


def test_what_may_be_left_out(tmp_path: Path) -> None:
    """Defaults of the file are those of the parts that it sets up."""
    found = read_configuration(written(tmp_path, CONFIGURATION))
    assert found.navigation == NavigationErrors()
    assert found.log == LogSettings()
    assert found.usable_energy is None
    gps = tuple(phase in (SURFACE, RECOVERY) for phase in range(len(PHASES)))
    assert found.schedule == PowerSchedule(gps=gps)
    assert found.calibration == CompassCalibration()
    assert (found.adapter.interface, found.adapter.channel) == ("socketcan", "can0")
    assert (found.file.radio.key, found.file.radio.unsigned, found.file.bench.port) == ("radio.key", False, None)
    assert found.coordinator.masking.longest == 20.0
    assert found.compass == CompassSettings(polled=False)
    assert found.path(found.file.log.folder) == tmp_path / "log"


def test_units_of_the_file_become_si(tmp_path: Path) -> None:
    changed = (
        CONFIGURATION.replace('port = "/dev/a"', 'port = "/dev/a"\ndeclination_deg = -6.0\nhold_s = 7.0')
        + "[power]\nreserve = 0.25\nmean_over_hours = 2.0\ncompass_asleep_in = ['drift']\n"
        + "[power.decide_every_s]\ndrift = 30.0\n"
        + "[power.sample_every_s]\ndrift = 60.0\n"
        + "[node_parameters]\nmotion = { quiet_after = 8.0 }\nacquisition = { radio_left_alone = false }\n"
    ).replace("depth_rating_m = 200.0", "depth_rating_m = 200.0\nbattery_wh = 1000.0")
    found = read_configuration(written(tmp_path, changed))
    assert found.coordinator.declination == radians(-6.0)
    assert found.coordinator.masking.longest == 7.0
    assert found.usable_energy == pytest.approx(0.75 * 3.6e6)
    assert (found.schedule.decide[DRIFT], found.schedule.compass_rests[DRIFT]) == (30.0, True)
    assert (found.schedule.decide[SURFACE], found.schedule.compass_rests[SURFACE]) == (1.0, False)
    assert found.coordinator.compass.polled  # a compass that sends by itself cannot rest
    assert (found.schedule.ctd[DRIFT], found.schedule.ctd[SURFACE]) == (60.0, 10.0)
    assert found.coordinator.node_parameters == {2: {"quiet_after": 8.0}, 3: {"radio_left_alone": False}}
    assert found.coordinator.mean_power_over == 7200.0
    assert found.safety.longest_submerged == 90_000.0
    assert found.safety.vacuum_lost == 80_000.0
    assert found.actuators.r_px_surface == 0.49


def test_calibration_of_the_compass_is_read(tmp_path: Path) -> None:
    named = CONFIGURATION.replace('port = "/dev/a"', 'port = "/dev/a"\ncalibration = "compass.toml"')
    path = written(tmp_path, named)
    with pytest.raises(FileError) as refused:
        read_configuration(path)
    assert str(refused.value) == (
        f"{path}: compass.calibration = 'compass.toml': cannot be used, see below\n"
        f"{tmp_path / 'compass.toml'}: cannot be read: No such file or directory"
    )
    (tmp_path / "compass.toml").write_text(
        'format = 1\nkind = "compass calibration"\nhard_iron_ut = [1.0, 2.0, 3.0]\n'
        "[actuator_ut]\npump = [4.0, 5.0, 6.0]\n"
    )
    found = read_configuration(path).coordinator.calibration
    assert (found.hard_iron, found.pump, found.valve) == ((1.0, 2.0, 3.0), (4.0, 5.0, 6.0), None)
    assert found.strength == (0.0, inf)


def test_rates_of_the_ports_are_those_that_open() -> None:
    for table in ("compass", "gnss", "radio"):
        model = ConfigurationFile.model_fields[table].annotation
        assert isinstance(model, type)
        for rate in BAUD_RATES:
            assert model.model_validate({"port": "/dev/a", "baud": rate}).baud == rate


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("format = 1", "format = 2", "format = 2: must be 1"),
        ('kind = "vehicle configuration"', 'kind = "orders"', "kind = 'orders': must be 'vehicle configuration'"),
        ("vehicle_id = 3", "vehicle_id = 300", "vehicle_id = 300: must be between 1 and 250"),
        ("0" * 64, "0" * 63, "limits.vehicle_sha256 = '000"),
        ("[-250.0, 250.0]", "[250.0, -250.0]", "the first number must be less than the second"),
        ("steering_deg = 60.0", "steering_deg = 600.0",
         "limits.steering_deg = 600.0: must be between 0 and 180 degrees"),
        ("nose_up_mm = 100.0", "nose_up_mm = 900.0",
         "positions.nose_up_mm = 900: must be between -50 and 550 mm, the ends of limits.moving_mass_mm"),
        ('port = "/dev/b"', 'port = "/dev/a"', "compass.port = '/dev/a': is that of gnss too; each needs a port"),
        ('port = "/dev/b"', 'port = ""', "gnss.port = '': must not be empty"),
        ('port = "/dev/b"', 'port = "/dev\\u0000b"', "gnss.port = '/dev\\x00b': must not have control characters"),
        ("vehicle_id", 'missions = "a\\u0000"\nvehicle_id', "missions = 'a\\x00': must not have control characters"),
        ("[safety]", '[log]\nfolder = "\\n"\n[safety]', "log.folder = '\\n': must not have control characters"),
        ('port = "/dev/b"', 'port = "/dev/b"\nbaud = 9601', "gnss.baud = 9601: must be 1200, 2400"),
        ('port = "/dev/b"', 'port = "/dev/b"\nformat = "nmae"', "gnss.format = 'nmae': must be "),
        ('port = "/dev/c"', 'prot = "/dev/c"', "radio.prot: unknown key in [radio]; did you mean port?"),
        ("lowest_voltage_v = 17.0", "lowest_voltage_v = 20.0",
         "safety: lowest_voltage_v = 20: must be less than least_voltage_v = 19"),
        ("hull_flooding_kpa = 106.0", "hull_flooding_kpa = 106000.0",
         "safety.hull_flooding_kpa = 106000.0: must be between 0.1 and 1000 kPa"),
        ("turning_time_s = 220.0", "", "safety.turning_time_s is missing; add turning_time_s = <number in s>"),
        ("[radio]", "[radoi]", "the table [radio] is missing"),
        ("[safety]", "[log]\ntotal_mib = 5.0\n[safety]",
         "log.total_mib = 5: must be at least 24, six times log.file_mib"),
        ("[safety]", "[log]\nfolder = '..'\n[safety]", "log.folder = '..': must be a folder beside this file, no path"),
        ("[safety]", "[log]\nfolder = '/var/log'\n[safety]", "log.folder = '/var/log': must be a folder beside"),
        ("[safety]", "[log]\nfolder = 'a/../../b'\n[safety]", "log.folder = 'a/../../b': must be a folder beside"),
        ("[safety]", "[log]\nfolder = 'a\\..\\..'\n[safety]", ": must be a folder beside"),
        ("[safety]", "[log]\nfolder = 'C:log'\n[safety]", "log.folder = 'C:log': must be a folder beside"),
        ("vehicle_id", "missions = '../m'\nvehicle_id", "missions = '../m': must be a folder beside this file"),
        ("vehicle_id", "parameters = '/'\nvehicle_id", "parameters = '/': must be a folder beside this file"),
        ("[-250.0, 250.0]", "[50.0, 250.0]", "limits.ballast_ml = [50.0, 250.0]: must go from below 0 to above it"),
        ("[-250.0, 250.0]", "[-250.0, -50.0]", "limits.ballast_ml = [-250.0, -50.0]: must go from below 0 to above it"),
        ("[-50.0, 550.0]\nsteering_deg = 60.0\ndepth_rating_m = 200.0\n[positions]\n",
         "[95.0, 495.0]\nsteering_deg = 60.0\ndepth_rating_m = 200.0\n[positions]\ntolerance_mm = 41.0\n",
         "positions.tolerance_mm = 41: must be at most 40 mm, a tenth of the way between the ends"),
        ("depth_rating_m = 200.0", "depth_rating_m = 12000.0",
         "safety.turning_time_s = 220: must be at least 357 s, in which greatest_current_a at greatest_voltage_v"),
        ("depth_rating_m = 200.0", "depth_rating_m = 1.5",
         "safety.submerged_depth_m = 2: must be less than limits.depth_rating_m = 1.5"),
        ("turning_time_s = 220.0", "turning_time_s = 0.0",
         "safety.turning_time_s = 0.0: must be between 10 and 86400 s"),
        ("longest_submerged_hours = 25.0", "longest_submerged_hours = 0.1",
         "safety.longest_submerged_hours = 0.1: must be at least 0.117 h, turning_time_s and a rise from"),
        ("lowest_voltage_v = 17.0", "lowest_voltage_v = 6.0",
         "safety: lowest_voltage_v = 6: must be at least 7 V, a quarter of greatest_voltage_v"),
        ("depth_rating_m = 200.0", "depth_rating_m = 200.0\nbattery_wh = 1.08e6",
         "limits.battery_wh = 1.08e+06: must be between 33.6 and 1.68e+05 Wh, which last 0.2 to 1000 h at safety."),
        ("depth_rating_m = 200.0", "depth_rating_m = 200.0\nbattery_wh = 1.08", "limits.battery_wh = 1.08: must be "),
        ("depth_rating_m = 200.0", "depth_rating_m = 200.0\ninternal_pressure_kpa = 200.0",
         "limits.internal_pressure_kpa = 200: must be between 80 and 106 kPa, safety.vacuum_lost_kpa and"),
        ("depth_rating_m = 200.0", "depth_rating_m = 200.0\ninternal_pressure_kpa = 60.0",
         "limits.internal_pressure_kpa = 60: must be between 80 and 106 kPa"),
        ("[safety]", "[power]\ngps_in = ['surface']\n[safety]", "power.gps_in = ['surface']: must have recovery"),
        ("[safety]", "[power]\ngps_in = []\n[safety]", "power.gps_in = []: must have surface and recovery, where"),
        ("[safety]", "[power]\nreserve = 1.0\n[safety]", "power.reserve = 1.0: must be between 0 and 0.9"),
        ("[safety]\nsubmerged_depth_m = 2.0\nlongest_submerged_hours = 25.0\nturning_time_s = 220.0\n",
         "[power.decide_every_s]\ninflection = 30.0\n"
         "[safety]\nsubmerged_depth_m = 2.0\nlongest_submerged_hours = 25.0\nturning_time_s = 20.0\n",
         "power.decide_every_s.inflection = 30: must be less than safety.turning_time_s = 20"),
        ('port = "/dev/a"', 'port = "/dev/a"\nhold_s = 5.0\nsettle_s = 6.0',
         "compass.settle_s = 6: must be at most compass.hold_s = 5, for which a heading is held"),
        ('port = "/dev/a"', 'port = "/dev/a"\ninterval_s = 30.0',
         "compass.interval_s = 30.0: must be between 0.1 and 3 s"),
        ('port = "/dev/a"', 'port = "/dev/a"\ninterval_s = 0.1\nbaud = 1200',
         "compass.interval_s = 0.1: must be at least 0.75 s, in which compass.baud = 1200 carries 90 bytes"),
        ('port = "/dev/b"', 'port = "/dev/b"\ninterval_s = 30.0',
         "gnss.interval_s = 30.0: must be between 0.05 and 2 s"),
        ('port = "/dev/b"', 'port = "/dev/b"\ninterval_s = 0.2',
         "gnss.interval_s = 0.2: must be at least 0.27 s, in which gnss.baud = 9600 carries 256 bytes"),
        ("[safety]", '[can]\ninterface = "slcan"\nchannel = "/dev/c"\nbitrate = 500000\n[safety]',
         "radio.port = '/dev/c': is that of can too; each needs a port of its own"),
        ("[safety]", "[bench]\nport = '/dev/c'\n[safety]", "radio.port = '/dev/c': is that of bench too; each"),
        ('port = "/dev/c"', 'port = "/dev/c"\nunsigned = 1', "radio.unsigned = 1: must be true or false"),
        ("vehicle_id", "inbox = '.'\nvehicle_id", "inbox = '.': this file is there; received files need a folder of"),
        ("vehicle_id", "inbox = 'a/Log'\nmissions = './a/log'\nvehicle_id", "inbox = 'a/Log': missions is there; "),
        ("vehicle_id", "inbox = 'log'\nvehicle_id", "inbox = 'log': log.folder is there; received files need"),
        ('port = "/dev/c"', 'port = "/dev/c"\nkey = "inbox/radio.key"', "inbox = 'inbox': radio.key is there; rec"),
        ("[safety]", "[power.decide_every_s]\ndrift = 0.0\n[safety]",
         "power.decide_every_s.drift = 0.0: must be between 0.1 and 60"),
        ("[safety]", "[power]\ngps_in = ['surfaced']\n[safety]", "did you mean surface?"),
        ("[safety]", "[node_parameters]\nmotion = { quiet_aftr = 8.0 }\n[safety]",
         "node_parameters: motion.quiet_aftr = 8: is no parameter of the node; did you mean quiet_after? known: pump_"),
        ("[safety]", "[node_parameters]\nmotion = { quiet_after = 800.0 }\n[safety]",
         "node_parameters: motion.quiet_after = 800: must be between 1 and 60 s"),
        ("[safety]", "[node_parameters]\nmotion = { quiet_after = nan }\n[safety]",
         "node_parameters: motion.quiet_after = nan: must be between 1 and 60 s"),
        ("[safety]", "[node_parameters]\nmotion = { retries = 1.5 }\n[safety]",
         "node_parameters: motion.retries = 1.5: must be a whole number"),
        ("[safety]", "[node_parameters]\nacquisition = { radio_left_alone = 2 }\n[safety]",
         "node_parameters: acquisition.radio_left_alone = 2: must be between 0 and 1"),
        ("[safety]", "[power.sample_every_s]\ndrift = 4000.0\n[safety]",
         "power.sample_every_s.drift = 4000.0: must be between 0.1 and 3600"),
        ("[safety]", '[can]\ninterface = "slcam"\n[safety]', "did you mean slcan?"),
        ("[safety]", '[can]\ninterface = "udp_multicast"\nchannel = "10.0.0.1"\n[safety]',
         "can.channel = '10.0.0.1': must be a multicast address"),
    ],
)  # fmt: skip
def test_bad_configurations_are_refused_by_key(tmp_path: Path, old: str, new: str, sentence: str) -> None:
    assert old in CONFIGURATION
    path = written(tmp_path, CONFIGURATION.replace(old, new, 1))
    with pytest.raises(FileError) as refused:
        read_configuration(path)
    lines = str(refused.value).splitlines()
    assert all(line.startswith(f"{path}: ") for line in lines)
    assert any(sentence in line for line in lines), lines


def test_a_calibration_that_is_the_configuration_or_believes_no_field_is_refused(tmp_path: Path) -> None:
    path = written(tmp_path, CONFIGURATION.replace('port = "/dev/a"', 'port = "/dev/a"\ncalibration = "./CONFIG.toml"'))
    with pytest.raises(FileError) as refused:
        read_configuration(path)
    assert str(refused.value) == (
        f"{path}: compass.calibration = './CONFIG.toml': is this file itself; must be one of "
        "`stommel vehicle calibrate-compass`"
    )
    (tmp_path / "compass.toml").write_text(CALIBRATION.replace("[35.0, 60.0]", "[105.0, 120.0]"))
    written(tmp_path, CONFIGURATION.replace('port = "/dev/a"', 'port = "/dev/a"\ncalibration = "compass.toml"'))
    with pytest.raises(FileError, match="it believes fields of 105 to 120 uT; safety has 20 to 100: no heading"):
        read_configuration(path)


@pytest.mark.parametrize("kind", ["1e30", "1e308", "nan", "text", "negative"])
def test_no_number_may_be_anything(text: str, tmp_path: Path, kind: str) -> None:
    """Both ends of every field are stated; those that may be negative, or are zero, are named."""
    may = {"ballast_ml", "moving_mass_mm", "declination_deg", "nose_up_mm", "surface_mm", "calling_mm", "settle_s"}
    read = []
    for mutation in mutations(tomllib.loads(text)):
        name = next(part for part in reversed(mutation.key.split(".")) if not part.isdigit())
        numeric = not isinstance(mutation.value, str | bool)
        if mutation.kind != kind or not numeric or name == "format" or (kind == "negative" and name in may):
            continue
        try:
            ConfigurationFile.model_validate(mutation.document)
        except ValueError:
            continue
        read.append(mutation.key)
    assert read == []


@pytest.mark.parametrize("vehicle", ["rogue", "slocum", "seawing"])
def test_vehicles_that_cannot_fly_a_mission_are_refused(stommel: Command, tmp_path: Path, vehicle: str) -> None:
    done = stommel("vehicle", "config", vehicle, "--output", "out")
    assert (done.status, done.out) == (2, "")
    assert len(done.err.splitlines()) == 1
    assert not (tmp_path / "out").exists()


def test_a_vehicle_without_a_rating_is_refused(stommel: Command, tmp_path: Path) -> None:
    """Nothing would keep missions from going deeper than its hull bears. Oracle: zju.toml without its two depths."""
    before, _, after = builtin_text("zju").partition("[specification]\n")
    unrated = (before + after.partition("\n\n")[2]).replace("\ndepth_rating_m", "\n# depth_rating_m")
    (tmp_path / "unrated.toml").write_text(unrated)
    done = stommel("vehicle", "config", "unrated.toml", "--output", "out")
    assert (done.status, len(done.err.splitlines())) == (2, 1)
    assert "hull.depth_rating_m is missing: the limits of missions need it" in done.err
    assert not (tmp_path / "out").exists()


def test_an_old_configuration_is_not_replaced(stommel: Command, tmp_path: Path) -> None:
    (tmp_path / "CONFIG.toml").write_text("mine")
    done = stommel("vehicle", "config", "zju", "--output", ".")
    assert (done.status, done.err) == (2, "error: CONFIG.toml: already exists; --force replaces it\n")
    assert (tmp_path / "CONFIG.toml").read_text() == "mine"
