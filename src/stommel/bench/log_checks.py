"""Why an engine log is refused: each check returns quietly or raises with file, column, row and value."""

from collections.abc import Mapping
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from stommel.bench.column_map import Checks
from stommel.bench.failures import refuse
from stommel.bench.quantities import QUANTITIES, unit_ratios
from stommel.bench.raw_channel import RawChannel

Channels = Mapping[str, RawChannel]

TURNING_SHARE = 0.05
"""The motor turns while its speed is above this share of the greatest of the run."""
SUDDEN = 8.0
"""A step of this many usual steps is looked at."""
ONE_WAY_SHARE = 0.9
"""Share of the piston's whole travel that must lie between its first and its last reading."""


def check_run(name: str, channels: Channels, checks: Checks) -> dict[str, RawChannel]:
    """Check one run, and return its rows from the start of the motor to its stop.

    Raises
    ------
    BenchFileError
        The run cannot be trusted.
    """
    _time_runs_forward(channels["time"])
    _no_gap(channels["time"], checks.longest_gap)
    for channel in channels.values():
        _plausible(channel)
        _inside_its_range(channel)
    working = _while_the_motor_turns(name, channels, checks.fewest_rows)
    for channel in working.values():
        _not_saturated(channel, checks.saturated_rows)
        _one_unit(channel)
    _not_stuck(working, checks.stuck_rows)
    _one_way(working["piston_travel"])
    return working


def _time_runs_forward(time: RawChannel) -> None:
    step = np.diff(time.values)
    if np.any(step <= 0.0):
        k = int(np.argmax(step <= 0.0)) + 1
        what = "stands still" if step[k - 1] == 0.0 else "runs backwards"
        raise time.refuse(k, f"time {what}: {time.values[k]:g} {time.channel.unit} after {time.values[k - 1]:g}")


def _no_gap(time: RawChannel, longest: float) -> None:
    step = np.diff(time.values)
    if len(step) == 0:
        return
    usual = float(np.median(step))
    # a hair above, for times rounded in the file
    if np.any(step > longest * usual * (1.0 + 1e-6)):
        k = int(np.argmax(step)) + 1
        unit = time.channel.unit
        raise time.refuse(
            k,
            f"gap in time: {time.values[k]:g} {unit} is {step[k - 1]:g} {unit} after the row before, usual are "
            f"{usual:g} {unit}; allowed are {longest:g} times as much",
        )


def _plausible(channel: RawChannel) -> None:
    quantity = QUANTITIES[channel.quantity]
    factor = quantity.factor(channel.channel.unit)
    low, high = (end / factor for end in quantity.plausible)
    wrong = (channel.values < low) | (channel.values > high)
    if np.any(wrong):
        k = int(np.argmax(wrong))
        unit = channel.channel.unit
        raise channel.refuse(
            k,
            f"{channel.values[k]:g} {unit} is no {quantity.words} of a bench ({low:g} to {high:g} {unit}): wrong unit?",
        )


def _inside_its_range(channel: RawChannel) -> None:
    if channel.channel.range is None:
        return
    low, high = channel.channel.range
    wrong = (channel.values < low) | (channel.values > high)
    if np.any(wrong):
        k = int(np.argmax(wrong))
        raise channel.refuse(
            k, f"{channel.values[k]:g} {channel.channel.unit} is beyond the range of the sensor, {low:g} to {high:g}"
        )


def _while_the_motor_turns(name: str, channels: Channels, fewest: int) -> dict[str, RawChannel]:
    """Rows from the first to the last in which the motor turns; it must not rest in between."""
    speed = channels["motor_speed"]
    turning = speed.values > TURNING_SHARE * np.max(speed.values, initial=0.0)
    if np.count_nonzero(turning) < fewest:
        raise refuse(
            speed.file,
            speed.column,
            f"too few samples: run {name} has {np.count_nonzero(turning)} rows of a turning motor; at least {fewest}",
        )
    first, last = int(np.argmax(turning)), len(turning) - int(np.argmax(turning[::-1]))
    if not turning[first:last].all():
        k = first + int(np.argmin(turning[first:last]))
        raise speed.refuse(
            k, f"{speed.values[k]:g} {speed.channel.unit}: the motor rests in the middle of run {name}; split the run"
        )
    return {quantity: channel.part(slice(first, last)) for quantity, channel in channels.items()}


def _stretches(values: NDArray[np.float64]) -> list[tuple[int, int]]:
    """First row and row count of each stretch of equal readings."""
    edges = np.flatnonzero(np.concatenate(([True], np.diff(values) != 0.0, [True])))
    return [(int(a), int(b - a)) for a, b in pairwise(edges)]


def _not_saturated(channel: RawChannel, rows: int) -> None:
    """Refuse readings that lie flat at an end of the range, stated or not.

    Without a stated range, a sensor that never repeats itself for long elsewhere has lost the tops, or the bottoms, of
    its signal where it lies flat at its greatest or least reading.
    """
    if channel.channel.column is None or channel.channel.setting:
        return
    values, stated = channel.values, channel.channel.range
    low, high = stated or (float(np.min(values)), float(np.max(values)))
    stretches = _stretches(values)
    elsewhere = max((count for k, count in stretches if low < values[k] < high), default=len(values))
    fewest = rows if stated else max(rows, 2 * elsewhere)
    where = "at the end of its range" if stated else "at its greatest or least reading, and nowhere else"
    if channel.quantity == "piston_travel":
        where += " (or the piston at its stop: cut these rows)"
    for k, count in stretches:
        if values[k] in (low, high) and count >= fewest:
            unit = channel.channel.unit
            raise channel.refuse(k, f"saturated sensor: {values[k]:g} {unit} for {count} rows {where}")


def _not_stuck(channels: Channels, rows: int) -> None:
    """Refuse a sensor that shows one reading while another one moves, or a logger that shows nothing new at all."""
    sensors = [c for n, c in channels.items() if n != "time" and c.channel.column and not c.channel.setting]
    for channel in sensors:
        for k, count in _stretches(channel.values):
            if count < rows:
                continue
            here = slice(k, k + count)
            moving = [other.column for other in sensors if np.ptp(other.values[here]) > 0.0]
            what = f"while {moving[0]} moves" if moving else "and no other sensor moves: the logger hangs"
            raise channel.refuse(
                k,
                f"stuck sensor: {channel.values[k]:g} {channel.channel.unit} for {count} rows {what} "
                f"(fewer than {rows} are allowed; a value that was set and not measured has setting = true)",
            )


def _one_unit(channel: RawChannel) -> None:
    """Refuse a column whose readings change in one step by the ratio of two units.

    What is steady in a run is compared by medians over a few rows, which noise about zero does not fool; what moves, by
    neighbouring rows.
    """
    values, quantity = channel.values, QUANTITIES[channel.quantity]
    if channel.quantity == "time" or len(values) < 4:
        return
    step = np.abs(np.diff(values))
    usual = float(np.median(step))
    width = 5 if quantity.steady else 1
    for k in np.flatnonzero(step > SUDDEN * usual + 1e-12) + 1:
        before, after = (float(np.median(part)) for part in (values[max(0, k - width) : k], values[k : k + width]))
        if max(abs(before), abs(after)) < 2.0 * SUDDEN * usual:
            continue
        unit = _unit_of_jump(channel, before, after, 0.0 if quantity.steady else usual)
        if unit:
            raise channel.refuse(
                int(k),
                f"mixed units: {values[k]:g} after {values[k - 1]:g}, the ratio of {unit} to {channel.channel.unit}, "
                f"in a column that its map says is in {channel.channel.unit}",
            )


def _unit_of_jump(channel: RawChannel, before: float, after: float, motion: float) -> str:
    """Unit whose ratio to the column's explains a jump, or nothing; `motion` is what the quantity moves in a row."""
    for unit, ratio in unit_ratios(QUANTITIES[channel.quantity], channel.channel.unit):
        for factor in (ratio, 1.0 / ratio):
            off = abs(after - factor * before)
            if not 0.5 < factor < 2.0 and off < 0.05 * abs(factor * before) + motion * max(factor, 1.0):
                return unit
    return ""


def _one_way(travel: RawChannel) -> None:
    """Refuse a piston that stands still but for noise, or turns round."""
    values = travel.values
    net, whole = float(values[-1] - values[0]), float(np.ptp(values))
    if abs(net) < ONE_WAY_SHARE * whole:
        unit = travel.channel.unit
        raise travel.refuse(
            len(values) - 1,
            f"{values[-1]:g} {unit} after {values[0]:g} {unit} at the start, and {whole:g} {unit} between the farthest "
            "readings: the piston stands still or turns round; a run is one motion one way",
        )
