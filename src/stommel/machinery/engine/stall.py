"""The pressure beyond which an engine moves no oil."""

from stommel.machinery.engine.cycle import simulate
from stommel.vehicle.schema import Engine

RESOLUTION = 1e-3
"""Relative to the pressure found."""
_BEGIN_PA = 1e6
_BEYOND_ANY_SEA_PA = 2e8


def stall_pressure(engine: Engine, *, motor_speed_rpm: float | None = None) -> float | None:
    """Least sea pressure at which the engine no longer inflates [Pa], by simulating the beginning of inflations.

    Parameters
    ----------
    engine
        The circuit.
    motor_speed_rpm
        Speed of the motor instead of the file's [r/min].

    Returns
    -------
    float or None
        Zero if it inflates at no pressure, None if it does so at the pressure of any sea.
    """
    little = 0.02 * engine.measured_piston.working_volume_ml / 1e6

    def stalls(pressure: float) -> bool:
        run = simulate(engine, pressure_pa=pressure, inflate_m3=little, motor_speed_rpm=motor_speed_rpm)
        return run.stalled

    if stalls(0.0):
        return 0.0
    low, high = 0.0, _BEGIN_PA
    while not stalls(high):
        low, high = high, 2.0 * high
        if high > _BEYOND_ANY_SEA_PA:
            return None
    while high - low > RESOLUTION * high:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if stalls(middle) else (middle, high)
    return high
