"""Every option of every verb changes what it should, and is what it says: its number comes back under its own name.

The table below names for each option a call that differs from another one by that option alone, and what the JSON must
say then: a number where the option states it, `CHANGED` where it only has to be another one than before. An option that
is not in the table fails.
"""

import json
import re
from functools import reduce
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import typer

from stommel.cli.app import app
from stommel.onboard.coordination.logbook.framing import LogIdentity, encoder, header
from stommel.onboard.coordination.logbook.records import CTD, ESSENTIAL
from stommel.vehicle import builtin_text
from tests.cli.test_terminal_equals_json import leaves
from tests.onboard.coordination.magnetic_vehicle import MagneticVehicle, samples_text
from tests.support.command import Outcome, run_here

CHANGED = object()
"""Another value than without the option."""

Expected = dict[str, Any]
Case = tuple[str, str, Expected]
"""What the option is put behind, the option, and what the JSON says of it, by dotted keys."""

PHYSICS = "--physics full"
PLOT = ("--plot p.svg", {"written": ["p.svg"]})

CASES: dict[str, dict[str, Case]] = {
    "design": {
        "--output": ("rogue", "--output r.html", {"written": ["r.html"]}),
        "--physics": ("zju --no-report", PHYSICS, {"design_flight.moving_mass_position_mm": CHANGED}),
        "--no-report": ("rogue", "--no-report", {"written": []}),
    },
    "trim": {
        "--speed": ("zju", "--speed 0.31", {"speed_m_s": 0.31, "ballast_volume_ml": CHANGED}),
        "--pitch": ("zju", "--pitch 22", {"pitch_deg": 22.0}),
        "--glide-path": ("zju", "--glide-path -27", {"glide_path_deg": -27.0, "pitch_deg": CHANGED}),
        "--physics": ("zju", PHYSICS, {"moving_mass_position_mm": CHANGED}),
        "--ignore-limits": ("zju --pitch -60", "--ignore-limits", {"pitch_deg": -60.0}),
    },
    "table": {
        "--speed": ("zju", "--speed 0.3,0.5", {"rows.0.speed_m_s": 0.3, "rows.1.speed_m_s": 0.5}),
        "--pitch": ("zju", "--pitch -20:-30:-10", {"rows.0.pitch_deg": -20.0, "rows.1.pitch_deg": -30.0}),
        "--physics": ("zju", PHYSICS, {"rows.0.moving_mass_position_mm": CHANGED}),
    },
    "steady": {
        "--moving-mass-mm": (
            "zju --ballast-ml -100", "--moving-mass-mm 400", {"moving_mass_position_mm": 400.0, "pitch_deg": CHANGED},
        ),
        "--ballast-ml": (
            "zju --moving-mass-mm 410", "--ballast-ml -90", {"ballast_volume_ml": -90.0, "speed_m_s": CHANGED},
        ),
        "--rudder-deg": (
            "zju --moving-mass-mm 410 --ballast-ml -100", "--rudder-deg 10",
            {"rudder_deg": 10.0, "turn_rate_rad_s": CHANGED},
        ),
        "--roll-mass-deg": (
            "seawing --moving-mass-mm 421 --ballast-ml -292", "--roll-mass-deg 30",
            {"roll_mass_deg": 30.0, "turn_rate_rad_s": CHANGED},
        ),
        "--physics": ("zju --moving-mass-mm 410 --ballast-ml -100", PHYSICS, {"pitch_deg": CHANGED}),
        "--ignore-limits": (
            "zju --moving-mass-mm 410 --ballast-ml -300", "--ignore-limits", {"ballast_volume_ml": -300.0},
        ),
    },
    "turn": {
        "--speed": ("zju --turn-rate 0.005", "--speed 0.31", {"speed_m_s": 0.31}),
        "--pitch": ("zju --turn-rate 0.005", "--pitch -22", {"pitch_deg": -22.0}),
        "--turn-rate": ("zju", "--turn-rate -0.004", {"turn_rate_rad_s": -0.004}),
        "--radius": ("zju", "--radius 60", {"radius_m": 60.0}),
        "--by": (
            "seawing --speed 0.4 --pitch -30 --turn-rate 0.005", "--by rudder", {"refused": "rudder"},
        ),
        "--physics": ("zju --turn-rate 0.005", PHYSICS, {"moving_mass_position_mm": CHANGED}),
        "--ignore-limits": ("zju --turn-rate 0.001 --pitch -60", "--ignore-limits", {"pitch_deg": -60.0}),
    },
    "envelope": {
        "--speed": ("zju", "--speed 0.4 --pitch -35", {"needs.most_volume_at.speed_m_s": 0.4}),
        "--pitch": (
            "zju", "--pitch -20 --speed 0.5",
            {"needs.most_travel_at.pitch_deg": -20.0, "needs.ballast_volume_ml": CHANGED},
        ),
        "--physics": ("zju", PHYSICS, {"needs.moving_mass_travel_mm": CHANGED, "reach.10.maximum_speed_m_s": CHANGED}),
    },
    "flight-table": {
        "--output": ("zju", "--output t.toml", {"written": ["t.toml"]}),
        "--physics": ("zju", "--physics paper", {"physics": "paper", "flights.0.moving_mass_mm": CHANGED}),
    },
    "orders": {
        "--output": ("pool_trial", "--output o.toml", {"written": ["o.toml"]}),
        "--expires-hours": ("pool_trial", "--expires-hours 5.5", {"expires_hours": 5.5}),
    },
    "plan check": {"--output": ("plan.json", "--output checked.toml", {"written": ["checked.toml"]})},
    "plan preview": {"--output": ("plan.json", "--output flown.json", {"written": ["flown.json"]})},
    "plan open": {
        "--vehicle": ("orders.toml --start 18,115", "--vehicle zju", {"plan.vehicle": "zju"}),
        "--start": (
            "orders.toml --vehicle zju", "--start 18.5,115.25",
            {"plan.start.latitude_deg": 18.5, "plan.start.longitude_deg": 115.25},
        ),
        "--ocean": (
            "orders.toml --vehicle zju --start 18,115", "--ocean uniform",
            {"plan.water.ocean": "uniform", "plan.dives.ballast_ml": CHANGED},
        ),
        "--output": ("orders.toml --vehicle zju --start 18,115", "--output plan2.json", {"written": ["plan2.json"]}),
    },
    "modes": {
        "--speed": ("zju", "--speed 0.31", {"flight.speed_m_s": 0.31, "longitudinal.0.real": CHANGED}),
        "--pitch": ("zju", "--pitch -22", {"flight.pitch_deg": -22.0, "longitudinal.0.real": CHANGED}),
        "--physics": ("zju", PHYSICS, {"longitudinal.0.real": CHANGED, "flight.moving_mass_position_mm": CHANGED}),
    },
    "root-locus": {
        "--over": (
            "zju --from 0.5 --to 0.6 --points 2", "--over rudder_position",
            {"over": "rudder_position", "points.0.value": 0.5},
        ),
        "--from": (
            "zju --over wing_position --to 0.2 --points 2", "--from 0.12",
            {"points.0.value": 0.12, "points.1.value": 0.2},
        ),
        "--to": (
            "zju --over wing_position --from 0.1 --points 2", "--to 0.17",
            {"points.0.value": 0.1, "points.1.value": 0.17},
        ),
        "--points": (
            "zju --over wing_position --from 0.1 --to 0.2", "--points 3",
            {"points.1.value": 0.15, "points.2.value": 0.2},
        ),
        "--speed": (
            "zju --over wing_position --from 0.1 --to 0.2 --points 2", "--speed 0.31",
            {"speed_m_s": 0.31, "points.0.longitudinal.0.real": CHANGED},
        ),
        "--pitch": (
            "zju --over wing_position --from 0.1 --to 0.2 --points 2", "--pitch -22",
            {"pitch_deg": -22.0, "points.0.longitudinal.0.real": CHANGED},
        ),
        "--physics": (
            "zju --over wing_position --from 0.1 --to 0.2 --points 2", PHYSICS,
            {"points.0.longitudinal.0.real": CHANGED},
        ),
        "--plot": ("zju --over wing_position --from 0.1 --to 0.2 --points 2", *PLOT),
    },
    "derivative": {
        "--states": ("zju", "--states states.json", {"0.velocity_rate_m_s2.0": CHANGED}),
        "--actuators": ("zju --states states.json", "--actuators free", {"0": CHANGED}),
        "--physics": ("zju --states states.json", PHYSICS, {"0": CHANGED}),
    },
    "hull": {
        "--material": ("zju", "--material LY12", {"materials.0.name": "LY12"}),
        "--depth": ("zju --material TC4", "--depth 300", {"depth_m": 300.0, "materials.0.wall_mm": CHANGED}),
        "--pressure-mpa": (
            "zju --material TC4", "--pressure-mpa 3", {"pressure_mpa": 3.0, "materials.0.wall_mm": CHANGED},
        ),
        "--wall": ("zju --material TC4", "--wall 7", {"materials.0.wall_mm": 7.0, "materials.0.mass_kg": CHANGED}),
        "--knock-down": (
            "zju --material TC4", "--knock-down 0.7",
            {"knock_down": 0.7, "materials.0.knock_down": 0.7, "materials.0.circumferential_wall_mm": CHANGED},
        ),
        "--materials": ("zju --material mine", "--materials mine.toml", {"materials.0.name": "mine"}),
        "--plot": ("zju --material TC4", *PLOT),
    },
    "drives": {
        "--steepest": (
            "zju", "--steepest 20", {"pitch.points.0.pitch_deg": -20.0, "pitch.hardest_start.pitch_deg": -20.0},
        ),
        "--speed": (
            "zju", "--speed 0.4",
            {"rudder.speed_through_water_m_s": 0.4, "rudder.hinge_moment_mn_m": 69.47031431417223 / 4.0},
        ),
        "--rudder": ("zju", "--rudder 30", {"rudder.turn.angle_deg": 30.0, "rudder.turn.motor_energy_j": CHANGED}),
        "--hold": ("zju", "--hold 12", {"rudder.turn.hold_s": 12.0}),
        "--plot": ("zju", *PLOT),
    },
    "engine": {
        "--pressure-mpa": (
            "zju --inflate-ml 50", "--pressure-mpa 1.5", {"pressure_mpa": 1.5, "sea_work_j": CHANGED},
        ),
        "--inflate-ml": ("zju", "--inflate-ml 40", {"phases.0.phase": "inflate", "volume_ml": CHANGED}),
        "--deflate-ml": (
            "zju --pressure-mpa 1 --inflate-ml 50", "--deflate-ml 20",
            {"phases.1.phase": "deflate", "phases.0.phase": "inflate"},
        ),
        "--hold-s": (
            "zju --inflate-ml 50", "--hold-s 9", {"phases.1.phase": "hold", "phases.1.duration_s": 9.0},
        ),
        "--motor-speed-rpm": (
            "zju --inflate-ml 50", "--motor-speed-rpm 5000", {"duration_s": CHANGED, "peak_current_a": CHANGED},
        ),
        "--ideal": ("zju --inflate-ml 50", "--ideal", {"ideal": True, "energy_j": CHANGED}),
        "--engine": ("zju --inflate-ml 50", "--engine slocum-1000m", {"engine": CHANGED, "energy_j": CHANGED}),
        "--plot": ("zju --inflate-ml 50", *PLOT),
    },
    "endurance": {
        "--depth": ("zju", "--depth 90", {"depth_m": 90.0, "endurance_days": CHANGED}),
        "--speed": ("zju", "--speed 0.31", {"speed_m_s": 0.31, "endurance_days": CHANGED}),
        "--pitch": ("zju", "--pitch -22", {"pitch_deg": -22.0, "endurance_days": CHANGED}),
        "--temperature": (
            "zju", "--temperature 2", {"battery.temperature_c": 2.0, "endurance_days": CHANGED},
        ),
        "--ocean": (
            "zju", "--ocean south_china_sea --at 18,115",
            {"ocean": "south_china_sea", "cycle.ballast_swing_ml": CHANGED, "endurance_days": CHANGED},
        ),
        "--at": (
            "zju --ocean east_china_sea --at 28.2,126.6", "--at 27.2,127.6", {"endurance_days": CHANGED},
        ),
        "--time": ("zju", "--time 2026-07-01", {"refused": "--time: needs --ocean"}),
        "--physics": ("zju", PHYSICS, {"endurance_days": CHANGED}),
        "--plot": ("zju", *PLOT),
    },
    "budget": {
        "--density": ("zju", "--density 1001:1002", {"density_kg_m3.0": 1001.0, "density_kg_m3.1": 1002.0}),
        "--foam-density": (
            "fixed.toml --density 995", "--foam-density 300", {"density_kg_m3.0": 995.0, "trimming.added": CHANGED},
        ),
        "--apply": ("zju", "--apply a.toml", {"written": ["a.toml"]}),
        "--force": ("zju --apply old.toml", "--force", {"written": ["old.toml"]}),
        "--plot": ("zju", *PLOT),
    },
    "simulate": {
        "--output": ("short.toml", "--output o.nc", {"written": ["o.nc"]}),
        "--plots": ("short.toml", "--plots pictures", {"written.0": "pictures/trial.png"}),
        "--track": ("short.toml", "--track t.geojson", {"written": ["t.geojson"]}),
        "--seed": ("short.toml", "--seed 77", {"seed": 77, "energy_wh": CHANGED}),
        "--speed-up": ("short.toml", "--speed-up", {"speed_up": CHANGED, "flight_s": CHANGED}),
        "--list": ("", "--list", {"pool_trial": "Pool trial"}),
    },
    "vehicle log": {
        "--kind": ("torn.log", "--kind ctd", {"rows.0.t": 0.0, "rows.0.temperature": 10.0}),
        "--salvage": ("torn.log", "--salvage", {"records": 3, "skipped_bytes": CHANGED}),
    },
    "vehicle show": {"--toml": ("zju", "--toml", {})},
    "vehicle new": {
        "--from": ("a.toml --force", "--from seawing", {"from": "seawing", "written": ["a.toml"]}),
        "--with": ("a.toml --force", "--with hull,engine", {"sections": ["hull", "engine"]}),
        "--force": ("old.toml", "--force", {"written": ["old.toml"]}),
    },
    "vehicle config": {
        "--output": ("zju", "--output begun", {"written": ["begun/CONFIG.toml"]}),
        "--force": ("zju --output begun-before", "--force", {"written": ["begun-before/CONFIG.toml"]}),
    },
    "vehicle calibrate-compass": {
        "--output": ("turned.csv", "--output c.toml", {"written": ["c.toml"]}),
        "--iron": ("turned.csv", "--iron hard", {"correction.0.0": 1.0, "residual_ut": CHANGED}),
        "--name": ("turned.csv --output c.toml --force", "--name north", {"name": "north"}),
        "--force": ("turned.csv --output old.toml", "--force", {"written": ["old.toml"]}),
    },
    "bench generate": {
        "--output": ("zju --pressure-mpa 0 --speed-rpm 7000", "--output g.csv", {"written": ["g.csv", "g.toml"]}),
        "--seed": ("zju --pressure-mpa 0 --speed-rpm 7000 --output g.csv", "--seed 5", {"seed": 5}),
        "--pressure-mpa": ("zju --speed-rpm 7000 --output g.csv", "--pressure-mpa 0,1", {"runs": 2}),
        "--speed-rpm": ("zju --pressure-mpa 1 --output g.csv", "--speed-rpm 5000,6000,7000", {"runs": 3}),
        "--period-s": ("zju --pressure-mpa 1 --speed-rpm 7000 --output g.csv", "--period-s 2", {"g.csv": CHANGED}),
        "--noise": ("zju --pressure-mpa 1 --speed-rpm 7000 --output g.csv", "--noise 0", {"g.csv": CHANGED}),
    },
    "bench analyse": {
        "--vehicle": (
            "bench.csv", "--vehicle thick.toml",
            {"refused": "piston_diameter_mm = 50 in the column map, 60 in the vehicle file"},
        ),
        "--map": ("bare.csv", "--map bench.toml", {"runs.3.motor_speed_rpm": 7000.0}),
        "--column": ("bench.csv", "--column current=voltage_v:A", {"runs.0.average_current_a": 24.0}),
        "--constant": ("bench.csv", "--constant voltage=12:V", {"runs.0.voltage_v": 12.0}),
        "--time-limit-s": ("bench.csv", "--time-limit-s 130", {"choice.time_limit_s": 130.0}),
        "--inflate-ml": ("bench.csv", "--inflate-ml 250", {"inflate_ml": 250.0, "runs.0.inflating_time_s": CHANGED}),
        "--limit-pressure-mpa": ("bench.csv", "--limit-pressure-mpa 0.5", {"choice.limit_pressure_mpa": 0.5}),
        "--margin-percent": ("bench.csv", "--margin-percent 30", {"choice.margin_percent": 30.0}),
        "--plots": ("bench.csv", "--plots q", {"written.0": "q/performance.png"}),
    },
    "bench fit": {
        "--vehicle": (
            "bench.csv --parameter displacement_m3_rev", "--vehicle thick.toml", {"refused": "60 in the vehicle file"},
        ),
        "--parameter": (
            "bench.csv --parameter displacement_m3_rev", "--parameter leakage_m3_s_pa",
            {"parameters.1.name": "leakage_m3_s_pa"},
        ),
        "--map": (
            "bare.csv --parameter displacement_m3_rev", "--map bench.toml",
            {"parameters.0.name": "displacement_m3_rev"},
        ),
        "--column": (
            "bench.csv --parameter displacement_m3_rev", "--column motor_speed=time_s:r/s",
            {"refused": "the unit of travel, time or motor speed is wrong"},
        ),
        "--constant": (
            "bench.csv --parameter displacement_m3_rev", "--constant motor_speed=6000:r/min",
            {"parameters.0.value": CHANGED},
        ),
        "--plots": ("bench.csv --parameter displacement_m3_rev", "--plots q", {"written.0": "q/fit.png"}),
    },
    "bench speed": {
        "--speed-rpm": ("zju", "--speed-rpm 6000,7000", {"choice.candidates.0.motor_speed_rpm": 6000.0}),
        "--pressure-mpa": ("zju", "--pressure-mpa 1,2", {"choice.pressures_mpa.0": 1.0, "choice.pressures_mpa.1": 2.0}),
        "--time-limit-s": (
            "zju", "--time-limit-s 130", {"choice.time_limit_s": 130.0, "choice.candidates.1.admissible": True},
        ),
        "--inflate-ml": (
            "zju", "--inflate-ml 250", {"choice.inflate_ml": 250.0, "choice.candidates.0.inflating_time_s": CHANGED},
        ),
        "--limit-pressure-mpa": (
            "zju", "--limit-pressure-mpa 1",
            {"choice.limit_pressure_mpa": 1.0, "choice.candidates.0.inflating_time_s": CHANGED},
        ),
        "--margin-percent": (
            "zju --time-limit-s 130", "--margin-percent 10",
            {"choice.margin_percent": 10.0, "choice.motor_speed_rpm": 5250.0},
        ),
    },
    "bench pressure": {
        "--description": ("table.csv", "--description strict.toml", {"limits.largest_loss_mpa": 0.05, "passed": False}),
        "--plot": ("fan2013-table5", *PLOT),
    },
    "ocean show": {
        "--at": ("uniform", "--at 30,125", {"sample.temperature_c": 15.0}),
        "--time": ("tide --at 30,125", "--time 2026-07-01T03:00:00Z", {"sample.current_east_m_s": CHANGED}),
        "--depth": ("east_china_sea --at 28.2,126.6", "--depth 80", {"sample.temperature_c": CHANGED}),
        "--set": ("uniform --at 30,125", "--set current_east_m_s=0.7", {"sample.current_east_m_s": 0.7}),
        "--name": ("cast.csv --set latitude_deg=30 --set longitude_deg=125 --at 30,125",
                   "--name temperature_c=odd_temperature_c", {"sample.temperature_c": CHANGED}),
        "--plot": ("east_china_sea", *PLOT),
    },
    "link key new": {
        "--vehicle": ("a.key --force", "--vehicle 9", {"vehicle": 9}),
        "--force": ("old.key", "--force", {"written": ["old.key"]}),
    },
    "can dump": {
        "--interface": ("--seconds 0.1", "--interface virtual", {"interface": "virtual", "channel": "vehicle"}),
        "--channel": ("--interface virtual --seconds 0.1", "--channel bench", {"channel": "bench"}),
        "--bitrate": (
            "--interface slcan --channel /dev/none --seconds 0.1", "--bitrate 500000",
            {"refused": "--channel = '/dev/none': there is no such adapter"},
        ),
        "--seconds": ("--interface virtual --seconds 0.1", "--seconds 0.3", {"listened_s": 0.3}),
    },
    "can send": {
        "--interface": ("Sync vehicle_time=1", "--interface virtual", {"interface": "virtual", "channel": "vehicle"}),
        "--channel": ("Sync vehicle_time=1 --interface virtual", "--channel bench", {"channel": "bench"}),
        "--bitrate": (
            "Sync vehicle_time=1 --interface slcan --channel /dev/none", "--bitrate 500000",
            {"refused": "--channel = '/dev/none': there is no such adapter"},
        ),
        "--times": ("Sync vehicle_time=1 --interface virtual", "--times 1", {"frames": CHANGED}),
        "--period": ("Sync vehicle_time=1 --interface virtual", "--period 0.01", {"period_s": 0.01}),
    },
}  # fmt: skip

LINE = "--to, --key, --unsigned, --vehicle, --state, --within"
"""What every verb of `stommel link` that speaks to a vehicle takes, and reads in one place."""

ELSEWHERE = {
    "sitl fly": "tests/sitl: --log, --output, --plots, --track, --seed, --separate-nodes, --speed, --no-live, "
    "--parameters; tests/cli/test_link_with_keys: --link, --key",
    **{
        f"link {verb}": f"tests/cli/test_link_story and test_link_refusals: {LINE}{own}"
        for verb, own in {
            "status": ", --seconds",
            "params list": "",
            "params get": "",
            "params set": "",
            "mission show": "",
            "mission upload": ", --only-check",
            "mission download": ", --force",
            "mission roll-back": "",
            "files list": "",
            "files get": ", --release",
            "files put": "",
            "command send": ", --when, --expires, --yes",
            "command follow": ", --cancel",
        }.items()
    },
    "sitl stand-in": "tests/sitl/test_real_ports.py: --ports, --channel, --seconds, --parameters; "
    "tests/sitl/test_link_on_real_ports.py: --link",
    "vehicle run": "tests/sitl/test_real_ports.py: --mission, --start, --seconds; "
    "tests/sitl/test_link_on_real_ports.py: --supervised",
    "sitl campaign": "tests/sitl/test_campaign_command: --output, --runs, --seed, --workers, --scheduler, --restart",
    "sitl replay": "tests/sitl/test_campaign_command: --seed",
    "study": "tests/studies: --output, --workers, --scheduler, --restart, --plots",
    "station backup": "tests/archive/test_commands: --database, --settings, --folder",
    "station check": "tests/archive/test_commands: --database, --settings, --folder",
    "station migrate": "tests/archive/test_commands: --database, --settings, --folder",
    "station export": "tests/archive/test_commands: --database, --settings, --folder, --vehicle, --output, --what, "
    "--begin, --end",
    "station import": "tests/archive/logs/test_import_command: --database, --settings, --folder, --vehicle",
    "station serve": "tests/cli/test_station_simulated: --sitl; "
    "tests/cli/test_station_serve: --database, --folder, --link, --vehicle, --key, --unsigned, "
    "--model, --speed, --settings, --name, --host, --port, --certificate, --key-file, --behind-proxy, --login",
    **{
        f"station {verb}": f"tests/cli/test_station_people: --database, --settings, --folder{own}"
        for verb, own in {
            "user add": ", --role",
            "user list": "",
            "user change": ", --role, --keep-out, --let-in",
            "user password": "",
            "user remove": "",
            "token add": ", --role, --days",
            "token list": "",
            "token remove": "",
        }.items()
    },
    "ocean show": "tests/ocean: --unit, --bounds, --between, --outside, --outside-time, --climatology, --at-rest",
}

BASES_THAT_ARE_REFUSED = {
    ("trim", "--ignore-limits"), ("steady", "--ignore-limits"), ("steady", "--moving-mass-mm"),
    ("steady", "--ballast-ml"), ("turn", "--ignore-limits"), ("turn", "--turn-rate"), ("turn", "--radius"),
    ("root-locus", "--over"), ("root-locus", "--from"), ("root-locus", "--to"), ("derivative", "--states"),
    ("hull", "--materials"), ("budget", "--force"), ("simulate", "--list"), ("vehicle new", "--force"),
    ("vehicle config", "--output"), ("vehicle config", "--force"), ("vehicle calibrate-compass", "--force"),
    ("bench generate", "--output"), ("bench analyse", "--map"), ("bench fit", "--map"),
    ("can dump", "--interface"), ("can send", "--interface"),
    ("link key new", "--force"), ("plan open", "--vehicle"), ("plan open", "--start"),
}  # fmt: skip
"""Without the option there is no answer at all."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Every file that a call of the table reads."""
    path = tmp_path_factory.mktemp("options")
    made = run_here(path, "bench", "generate", "zju", "--output", "bench.csv", "--pressure-mpa", "0.5,2",
                    "--speed-rpm", "5250,7000")  # fmt: skip
    assert made.status == 0, made.err
    (path / "bare.csv").write_text((path / "bench.csv").read_text())
    thick = builtin_text("zju").replace("bore_mm = { value = 50", "bore_mm = { value = 60", 1)
    assert thick != builtin_text("zju")
    (path / "thick.toml").write_text(thick)
    (path / "fixed.toml").write_text(builtin_text("zju").replace("trim_weight = true\n", ""))
    (path / "old.toml").write_text("in the way")
    (path / "old.key").write_text("in the way")
    state = {"velocity_m_s": [0.3, 0.0, 0.01], "angular_velocity_rad_s": [0.0, 0.1, 0.0],
             "attitude_deg": [0.0, -30.0, 0.0], "moving_mass_position_m": 0.4, "ballast_volume_m3": -1e-4}  # fmt: skip
    (path / "states.json").write_text(json.dumps([state]))
    (path / "torn.log").write_bytes(TORN)
    (path / "turned.csv").write_text(TURNED)
    (path / "begun-before").mkdir()
    (path / "begun-before" / "CONFIG.toml").write_text("in the way")
    (path / "short.toml").write_text(MISSION)
    (path / "mine.toml").write_text(MATERIAL)
    (path / "cast.csv").write_text(CAST)
    (path / "plan.json").write_text(PLAN)
    assert run_here(path, "plan", "check", "plan.json", "--output", "orders.toml").status == 0
    examples = Path(__file__).parents[2] / "src/stommel/bench/examples"
    text = (examples / "fan2013-table5.toml").read_text()
    (path / "table.csv").write_text((examples / "fan2013-table5.csv").read_text())
    (path / "strict.toml").write_text(text.replace("largest_loss_mpa = 0.1", "largest_loss_mpa = 0.05"))
    return path


TURNED = samples_text(MagneticVehicle(60.0), np.random.default_rng(1))
SAMPLE = encoder(CTD)
TORN = header(LogIdentity("0", 1), 0, ESSENTIAL, 0) + b"".join(
    SAMPLE(i, (float(i), 3.5, 10.0, 5.0)) if i != 1 else b"damaged" for i in range(4)
)
"""A log of four samples, of which the second is damaged."""

MISSION = """
format = 1
name = "a hop"
vehicle = "zju"
start_time = 2026-07-01T00:00:00Z
duration_days = 0.02
seed = 1
[start]
latitude_deg = 18.0
longitude_deg = 115.0
[[waypoints]]
latitude_deg = 18.5
longitude_deg = 115.0
[surface]
session_s = 60
[sensors]
first_fix_s = 20
[dives]
depth_m = 20
pitch_deg = 35
ballast_ml = 200
[ocean]
name = "uniform"
"""

PLAN = """{"name": "a hop", "vehicle": "zju", "start_time": "2026-07-01T00:00:00Z", "duration_days": 0.1,
"start": {"latitude_deg": 18.0, "longitude_deg": 115.0}, "waypoints": [{"latitude_deg": 18.5, "longitude_deg": 115.0}],
"dives": {"depth_m": 50, "pitch_deg": 35, "ballast_ml": 100}, "water": {"ocean": "south_china_sea"}}
"""

MATERIAL = """
[mine]
title = "a material"
source = "made up"
elastic_modulus_mpa = 7e4
poisson_ratio = 0.3
density_kg_m3 = 2800
yield_stress_mpa = 400
tensile_stress_mpa = 450
thermal_expansion_per_k = 23e-6
corrosion_grade = 2
corrosion = "some"
machinability_grade = 2
machinability = "some"
"""

CAST = """depth_m,temperature_c,odd_temperature_c,salinity_psu
0,20,24,34
50,15,18,34.2
100,10,12,34.5
"""


def at(answer: Any, key: str) -> Any:
    """The value below a dotted key."""
    return reduce(
        lambda found, part: found[int(part)] if isinstance(found, list) else found[part], key.split("."), answer
    )


def call(folder: Path, verb: str, *arguments: str) -> Outcome:
    return run_here(folder, *verb.split(), *(word for text in arguments for word in text.split()))


EACH = [
    (verb, option) for verb, cases in CASES.items() for option in cases if (verb, option) != ("vehicle show", "--toml")
]


@pytest.mark.parametrize(("verb", "option"), EACH, ids=[" ".join(each) for each in EACH])
def test_an_option_changes_what_it_should(folder: Path, verb: str, option: str) -> None:
    behind, given, expected = CASES[verb][option]
    base = call(folder, verb, behind, "--json")
    before = {name: (folder / name).read_bytes() for name in expected if (folder / name).is_file()}
    found = call(folder, verb, behind, given, "--json")
    if "refused" in expected:
        assert found.status == 2
        assert expected["refused"] in found.err
        return
    assert found.status == 0, found.err
    answer = json.loads(found.out)
    assert (base.status == 2) == ((verb, option) in BASES_THAT_ARE_REFUSED), base.err
    for key, value in expected.items():
        if key in before:
            assert (folder / key).read_bytes() != before[key]
        elif value is not CHANGED:
            assert at(answer, key) == (pytest.approx(value, rel=1e-3) if isinstance(value, float) else value), key
            if key == "written":
                assert all((folder / name).stat().st_size for name in value)
        elif base.status == 0:
            assert at(answer, key) != at(json.loads(base.out), key), key


def test_a_vehicle_file_is_printed_as_it_is(folder: Path) -> None:
    assert call(folder, "vehicle show", "zju", "--toml").out == builtin_text("zju")


def test_the_seed_is_in_what_the_file_says_of_itself(folder: Path) -> None:
    import xarray as xr

    done = call(folder, "simulate", "short.toml --seed 4242 --output seed.nc")
    assert done.status == 0, done.err
    assert re.search(r"(?m)^  seed +4242$", done.out)
    with xr.open_dataset(folder / "seed.nc") as found:
        assert found.attrs["seed"] == "4242"
        assert json.loads(found.attrs["mission"])["seed"] == 4242


def test_the_seed_of_a_log_is_written_beside_it(folder: Path) -> None:
    plan = "zju --pressure-mpa 1 --speed-rpm 7000"
    for seed, name in ((1, "one.csv"), (5, "five.csv"), (5, "again.csv")):
        assert call(folder, "bench generate", plan, f"--seed {seed} --output {name}").status == 0
    one, five, again = ((folder / name).read_text() for name in ("one.csv", "five.csv", "again.csv"))
    assert five == again
    assert five != one


def test_every_option_is_in_the_table() -> None:
    for path, command in leaves(typer.main.get_command(app)):
        verb = " ".join(path)
        options = {
            opt.secondary_opts[0] if opt.secondary_opts else opt.opts[0]
            for opt in command.params
            if opt.opts[0].startswith("--") and opt.opts[0] not in ("--json", "--help")
        }
        missing = {option for option in options - set(CASES.get(verb, {})) if option not in ELSEWHERE.get(verb, "")}
        assert not missing, (verb, missing)
        assert set(CASES.get(verb, {})) <= options, verb
