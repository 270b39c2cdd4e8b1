"""Energy of each consumer of a plain dive; oracles: the vehicle file's power times time, and `endurance`."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from stommel.control.dive_cycle import PHASES
from stommel.design.endurance import endurance
from stommel.design.endurance.dive_cycle import ANTENNA, DEFLATE, HEAT, INFLATE, PITCH
from stommel.design.endurance.sea import Sea
from stommel.machinery.drives.pitch import PitchDrive
from stommel.simulation.flight import Flown
from stommel.simulation.plant.parameters import CONSUMERS
from stommel.vehicle import FULL
from tests.simulation.conftest import EXACT, column, flown, stays

REGULATOR = 0.85
SESSION = 200.0
DEPTH, PITCH_DEG, SPEED = 150.0, 35.0, 0.35
PLAN = {"energy.rudder_turns_per_dive": 0.0, "energy.pitch_corrections_per_dive": 0.0,
        "energy.surface_session_s": SESSION}  # fmt: skip


@pytest.fixture(scope="module")
def plain() -> Flown:
    """Dives straight north through still water, without rudder, without corrections of the pitch."""
    return flown(
        ocean={"name": "still"},
        changes=PLAN,
        sensors=EXACT,
        waypoints=[{"latitude_deg": 19.0, "longitude_deg": 116.0}],
        dives={"depth_m": DEPTH, "pitch_deg": PITCH_DEG, "speed_m_s": SPEED},
        surface={"session_s": SESSION},
        heading_control={"limit_deg": 0.0},
        pitch_control={"gain_mm_per_deg": 0.0},
        output_every_s=1.0,
    )


class Account:
    """Rows from one descent to a later one: what is on in each second, and what each part took."""

    def __init__(self, found: Flown) -> None:
        begins = [begin for begin, _ in stays(found, "descent")]
        self.dives = len(begins) - 2
        self.found, self.rows = found, slice(round(begins[1]), round(begins[-1]))
        assert self.dives >= 4

    def column(self, name: str) -> np.ndarray:
        return column(self.found, name)[self.rows]

    def spent(self, part: str) -> float:
        """A row holds what is spent until the end of its own second [J]."""
        whole = column(self.found, f"energy_{part}")
        return float(whole[self.rows.stop - 1] - whole[self.rows.start - 1])

    def seconds(self, *phases: str) -> float:
        return float(np.isin(self.column("phase"), [PHASES.index(name) for name in phases]).sum())

    @property
    def whole(self) -> float:
        return float(self.rows.stop - self.rows.start)

    def change(self, name: str) -> np.ndarray:
        """What moves in each second."""
        whole = column(self.found, name)
        return np.asarray(whole[self.rows.start + 1 : self.rows.stop + 1] - whole[self.rows])

    @property
    def moving(self) -> float:
        moves = [np.abs(self.change(name)) > 1e-12 for name in ("moving_mass", "ballast", "rudder")]
        return float(np.any(moves, axis=0).sum())


@pytest.fixture(scope="module")
def account(plain: Flown) -> Account:
    return Account(plain)


UNDER = ("descent", "drift", "inflection", "ascent")


def test_the_controller_s_boards_are_on_as_the_file_says(account: Account) -> None:
    """1 W always; 0.3 W under water, 0.02 W else; 0.8 W while anything moves, 0.05 W else."""
    under, moving = account.seconds(*UNDER), account.moving
    assert 0.02 * account.whole < moving < 0.5 * account.whole
    expected = 1.0 * account.whole + 0.02 * account.whole + 0.28 * under + 0.05 * account.whole + 0.75 * moving
    assert account.spent("controller") == pytest.approx(expected / REGULATOR, rel=1e-3)


def test_sensors_are_on_as_the_file_says(account: Account) -> None:
    """The CTD's 0.175 W under water, a tenth of the altimeter's 1 W in descents alone."""
    expected = 0.175 * account.seconds(*UNDER) + 0.1 * account.seconds("descent")
    assert account.spent("sensors") == pytest.approx(expected / REGULATOR, rel=1e-6)


def test_navigation_and_radio_are_on_as_the_file_says(account: Account) -> None:
    """Compass 0.1 W under water and 3 mW else; at each surfacing GPS 90 s, radio 60 s at 5 W and 120 s at 1 W."""
    under, calls = account.seconds(*UNDER), account.dives
    compass = 0.003 * account.whole + 0.097 * under
    assert account.spent("navigation") == pytest.approx((compass + calls * 90.0 * 2.1) / REGULATOR, rel=1e-6)
    assert account.spent("communication") == pytest.approx(calls * (300.0 + 120.0) / REGULATOR, rel=1e-6)


def test_hotel_takes_its_power_without_the_regulator(account: Account) -> None:
    assert account.spent("hotel") == pytest.approx(0.1 * account.whole, rel=1e-6)


def test_the_rudder_that_does_not_move_takes_nothing(account: Account) -> None:
    assert account.spent("steering") == 0.0


def test_pitch_drive_takes_its_power_while_it_runs(account: Account) -> None:
    """Power of the drive itself over the travel, at the pitch of each second and the way that the mass goes."""
    drive = PitchDrive.of(account.found.mission.vehicle)
    expected = 0.0
    for moved, theta in zip(account.change("moving_mass"), account.column("pitch"), strict=True):
        if abs(moved) > 1e-12:
            per_metre = drive.point(float(theta), 1 if moved > 0.0 else -1).energy_per_metre
            assert per_metre is not None
            expected += per_metre * abs(moved)
    assert expected > 10.0
    assert account.spent("pitch_drive") == pytest.approx(expected, rel=0.02)


def test_the_store_s_heat_is_of_its_current(account: Account) -> None:
    current = account.column("current")
    assert account.spent("battery") == pytest.approx(0.15 * float(np.sum(current**2)), rel=1e-9)


def test_current_and_voltage_are_of_what_is_on(account: Account) -> None:
    """Mean power at the terminals is the sum of the parts."""
    power = float(np.sum(account.column("current") * account.column("voltage")))
    parts = sum(account.spent(name) for name in CONSUMERS if name != "battery")
    assert power == pytest.approx(parts, rel=1e-9)


def named(energies: Mapping[str, Any], *names: str) -> float:
    return float(sum(energies[name] for name in names))


def test_each_part_takes_what_endurance_says(plain: Flown, account: Account) -> None:
    """The same dives: each part within 2 %, the altimeter, which pings while oil is let in too, 3 %."""
    mission = plain.mission
    start = mission.scenario.start
    sea = Sea(mission.ocean, mission.scenario.start_seconds, start.latitude_deg, start.longitude_deg)
    found = endurance(
        mission.vehicle, speed_m_s=SPEED, pitch_deg=-PITCH_DEG, depth_m=DEPTH, sea=sea, physics=FULL
    )  # fmt: skip
    per_dive = found.cycle.energy_j
    assert account.whole / account.dives == pytest.approx(float(found.cycle.duration_s), rel=0.02)
    parts = {
        "controller": (named(per_dive, "coordination controller", "acquisition board", "motion-control board"), 0.02),
        "sensors": (named(per_dive, "CTD Sea-Bird GPCTD", "altimeter"), 0.03),
        "navigation": (named(per_dive, "compass PNI TCM5", "GPS NovAtel OEMV-3"), 0.02),
        "communication": (named(per_dive, "radio FGR-115, transmitting", "radio FGR-115, receiving"), 1e-6),
        "hotel": (named(per_dive, "leak detectors and power switching"), 0.02),
        "pump": (named(per_dive, INFLATE, ANTENNA, DEFLATE), 0.02),
    }
    whole = float(found.cycle.total_j)
    for part, (expected, within) in parts.items():
        assert account.spent(part) / account.dives == pytest.approx(expected, rel=within), part
    # the mission also moves the mass to raise the antenna, and warms the battery by more than the pump's current
    more = {name: account.spent(name) / account.dives - named(per_dive, at) for name, at in
            (("pitch_drive", PITCH), ("battery", HEAT))}  # fmt: skip
    assert 0.0 < more["pitch_drive"] < 0.02 * whole
    assert 0.0 < more["battery"] < 0.002 * whole
    total = sum(account.spent(part) for part in CONSUMERS) / account.dives
    assert total == pytest.approx(whole, rel=0.02)
