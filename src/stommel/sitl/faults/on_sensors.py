"""Faults of sensors and serial ports: what the electronics feels in place of what there is."""

from collections.abc import Iterable
from math import cos, nan, radians
from typing import Any

from stommel.geometry.earth import MEAN_RADIUS
from stommel.instruments.gpctd.device import CtdTruth
from stommel.sitl.faults import table
from stommel.sitl.faults.acting import Acting
from stommel.sitl.plant import Felt

READINGS = {
    "pressure": ("depth", 1.0), "altimeter": ("altitude", 1.0), "vacuum": ("internal_pressure", 1.0),
    "voltage": ("voltage", 1.0), "current": ("current", 1.0), "displacement": ("V_b", 1e-6),
    "mass_position": ("r_px", 1e-3), "steering_angle": ("steering", radians(1.0)),
}  # fmt: skip
"""Sensors of one number: the reading of the plant, and their unit in SI."""

_ATTITUDE = ("down_b2", "down_b3", "theta", "psi")


def felt_with(acting: Iterable[Acting], felt: Felt) -> Felt:
    """Return what the electronics feels, by the faults that act now."""
    for one in acting:
        if one.kind == "gps_jump":
            felt = _moved(felt, 1e3 * one.value, 1e3 * one.value)
        elif one.kind == "current_spike":
            felt = felt._replace(currents=_spiked(felt, one))
        elif one.kind == "limit_switch_pressed":
            fore = one.target == table.FORE
            felt = felt._replace(limit_fore=felt.limit_fore or fore, limit_aft=felt.limit_aft or not fore)
        elif one.kind.startswith("sensor_"):
            felt = _through_sensor(one, felt)
    return felt


def _spiked(felt: Felt, one: Acting) -> Any:
    now = getattr(felt.currents, one.target)
    return felt.currents._replace(**{one.target: now + one.value})


def _through_sensor(one: Acting, felt: Felt) -> Felt:
    if one.target in READINGS:
        name, unit = READINGS[one.target]
        return _with(felt, **{name: _through(one, getattr(felt.readings, name), unit)})
    if one.target == table.LEAK_DETECTOR and one.kind == "sensor_stuck":
        return _with(felt, leak=_stuck(one, felt.readings.leak))
    if one.target == table.COMPASS:
        return _through_compass(one, felt)
    return _through_gps(one, felt) if one.target == table.GPS else felt


def _through(one: Acting, truth: float, unit: float) -> float:
    """A number as a broken sensor says it."""
    if one.kind == "sensor_stuck":
        return float(_stuck(one, truth))
    if one.kind == "sensor_silent":
        return nan
    if one.kind == "sensor_biased":
        return truth + unit * one.value
    return truth + unit * one.value * float(one.draw.standard_normal())


def _stuck(one: Acting, truth: Any) -> Any:
    if one.kept is None:
        one.kept = truth
    return one.kept


def _through_compass(one: Acting, felt: Felt) -> Felt:
    """Silence is that of its port."""
    r = felt.readings
    if one.kind == "sensor_stuck":
        attitude, field = _stuck(one, ({name: getattr(r, name) for name in _ATTITUDE}, felt.field))
        return _with(felt, **attitude)._replace(field=field)
    return felt if one.kind == "sensor_silent" else _with(felt, psi=_through(one, r.psi, radians(1.0)))


def _through_gps(one: Acting, felt: Felt) -> Felt:
    r = felt.readings
    if one.kind == "sensor_stuck" and r.fixed:
        latitude, longitude = _stuck(one, (r.fix_latitude, r.fix_longitude))
        return _with(felt, fix_latitude=latitude, fix_longitude=longitude)
    if one.kind in ("sensor_biased", "sensor_noisy"):
        return _moved(felt, _through(one, 0.0, 1.0), 0.0)
    return felt


def _moved(felt: Felt, north: float, east: float) -> Felt:
    r = felt.readings
    latitude = r.fix_latitude + north / MEAN_RADIUS
    return _with(felt, fix_latitude=latitude, fix_longitude=r.fix_longitude + east / (MEAN_RADIUS * cos(latitude)))


def _with(felt: Felt, **readings: Any) -> Felt:
    return felt._replace(readings=felt.readings._replace(**readings))


def ctd_with(acting: Iterable[Acting], truth: CtdTruth) -> CtdTruth:
    """Return what the CTD measures, by the faults that act now."""
    for one in acting:
        if one.target == table.CTD and one.kind.startswith("sensor_") and one.kind != "sensor_silent":
            stuck = one.kind == "sensor_stuck"
            pressure = truth.pressure if stuck else _through(one, truth.pressure, 1.0)
            truth = _stuck(one, truth) if stuck else truth._replace(pressure=pressure)
    return truth


def bytes_with(acting: Iterable[Acting], port: str, data: bytes) -> bytes:
    """Return what comes of the bytes of an instrument on their way."""
    for one in acting:
        if one.target != port or not data:
            continue
        if one.kind == "sensor_silent":
            data = b""
        elif one.kind == "bytes_lost":
            data = bytes(byte for byte in data if not one.strikes())
        elif one.kind == "bytes_garbled":
            data = bytes(byte ^ int(one.draw.integers(1, 256)) if one.strikes() else byte for byte in data)
    return data


def loop_whole(acting: Iterable[Acting]) -> bool:
    """Whether the test resistors of the leak detectors are felt."""
    return not any(one.kind == "sensor_silent" and one.target == table.LEAK_DETECTOR for one in acting)
