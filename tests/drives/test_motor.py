"""A motor on a supply; oracle: Kirchhoff's law and the balance of power, U I = R I2 + K omega I."""

import pytest

from stommel.machinery.drives.motor import Motor

MOTOR = Motor(K_t=0.025, R=0.5, I_0=0.2, U=24.0, J=1e-5, I_continuous=3.0)


@pytest.mark.parametrize("torque", [0.0, 0.05, 0.3])
def test_supply_feeds_heat_and_shaft(torque: float) -> None:
    found = MOTOR.running(torque)
    assert found.current == pytest.approx(torque / 0.025 + 0.2)
    assert pytest.approx(0.5 * found.current + 0.025 * found.speed) == 24.0
    shaft_and_friction = (torque + 0.025 * 0.2) * found.speed
    assert found.power == pytest.approx(0.5 * found.current**2 + shaft_and_friction)


@pytest.mark.parametrize("torque", [-0.01, -0.2])
def test_a_motor_that_its_load_drives_takes_nothing_and_gives_nothing_back(torque: float) -> None:
    found = MOTOR.running(torque)
    assert found.current < 0.0
    assert found.power == 0.0
    assert found.speed > MOTOR.no_load_speed


def test_beyond_its_stall_torque_it_stands_and_heats() -> None:
    stalled = MOTOR.running(1.01 * MOTOR.stall_torque)
    assert stalled.stalls
    assert stalled.power == pytest.approx(24.0**2 / 0.5)
    assert not MOTOR.running(0.99 * MOTOR.stall_torque).stalls
    assert MOTOR.stall_torque == pytest.approx(0.025 * (48.0 - 0.2))
