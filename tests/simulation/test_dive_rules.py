"""Rules of the dive: surfacing every so often, turning at the bottom, breaking off what is too deep or too long."""

import numpy as np
import pytest

from tests.simulation.conftest import EXACT, column, events, flown, stays

SHALLOW = {"depth_m": 50.0, "pitch_deg": 35.0, "speed_m_s": 0.35, "turn_depth_m": 8.0}


def reasons(found: object) -> set[str]:
    return {reason for _, _, reason in events(found)} - {"nothing"}  # type: ignore[arg-type]


@pytest.mark.parametrize("hours", [1.0, 2.0])
def test_surfacing_every_so_many_hours(hours: float) -> None:
    """At the end of the dive that is under way then, whatever `per_surfacing` says."""
    found = flown(dives=SHALLOW | {"per_surfacing": 1000}, surface={"every_hours": hours}, sensors=EXACT)
    left = [end for _, end in stays(found, "surface")]
    back = [begin for begin, _ in stays(found, "surface")][1:]
    away = np.array(back) - left[: len(back)]
    one = max(np.diff([begin for begin, _ in stays(found, "descent")]))
    assert len(away) >= 2
    assert (away >= hours * 3600.0).all()
    assert (away < hours * 3600.0 + one).all()


def test_dives_between_surfacings() -> None:
    found = flown(dives=SHALLOW | {"per_surfacing": 3}, sensors=EXACT)
    order = [phase for _, phase, _ in events(found)]
    first = order.index("surface")
    assert order[:first].count("descent") == 3
    t, depth = column(found, "time"), column(found, "depth")
    begin, end = stays(found, "descent")[1][0], stays(found, "descent")[2][0]
    assert 3.0 < depth[(t >= begin - 60.0) & (t <= end)].min() <= 8.0


def test_too_deep_is_broken_off() -> None:
    found = flown(abort={"depth_m": 80.0}, sensors=EXACT)
    assert reasons(found) == {"abort: too deep"}
    assert 80.0 < column(found, "depth").max() < 86.0
    assert found.outcome == "time over"  # it only ends the dive
    assert len(stays(found, "descent")) > 3


def test_a_stuck_pressure_sensor_does_not_hide_the_depth() -> None:
    """A sensor that tells 15 m too little: the vehicle goes deeper by that, and breaks off by what it measures."""
    found = flown(sensors=EXACT | {"pressure_bias_m": -15.0}, abort={"depth_m": 95.0})
    assert 110.0 < column(found, "depth").max() < 115.0
    assert reasons(found) == {"abort: too deep"}


def test_too_long_is_broken_off_and_surfaces() -> None:
    found = flown(abort={"dive_hours": 0.1}, dives=SHALLOW | {"depth_m": 150.0, "per_surfacing": 10}, sensors=EXACT)
    assert reasons(found) == {"abort: dive too long"}
    begins = [begin for begin, _ in stays(found, "descent")]
    turns = [t for t, phase, _ in events(found) if phase == "inflection"]
    assert len(begins) > 3
    assert {turn - begin for begin, turn in zip(begins, turns, strict=False)} == {361.0}
    order = [phase for _, phase, _ in events(found)]
    assert order.count("surface") >= order.count("ascent") - 1


def test_altimeter_turns_the_vehicle_above_the_bottom() -> None:
    ocean = {"name": "still", "parameters": {"bottom_m": 105.0}}
    dives = {"depth_m": 100.0, "pitch_deg": 35.0, "speed_m_s": 0.35, "least_altitude_m": 20.0}
    found = flown(ocean=ocean, dives=dives, sensors=EXACT)
    assert reasons(found) == {"bottom ahead"}
    assert 85.0 <= column(found, "depth").max() < 89.0


def test_deaf_altimeter_touches_the_bottom_and_comes_off() -> None:
    ocean = {"name": "still", "parameters": {"bottom_m": 100.0}}
    dives = {"depth_m": 99.9, "pitch_deg": 35.0, "speed_m_s": 0.35, "least_altitude_m": 20.0}
    # it turns before its depth: only one that feels too shallow touches
    found = flown(ocean=ocean, dives=dives, sensors=EXACT | {"altimeter_range_m": 0.0, "pressure_bias_m": -2.8})
    assert column(found, "depth").max() == pytest.approx(100.0)
    assert len(stays(found, "surface")) > 3
    assert found.outcome == "time over"


def test_a_pressure_sensor_that_never_says_shallow_does_not_keep_it_from_calling() -> None:
    """With 5 m too much on the sensor the vehicle waits at the surface for the limit of a dive, not for ever."""
    found = flown(sensors=EXACT | {"pressure_bias_m": 5.0}, abort={"dive_hours": 0.5})
    begin, end = stays(found, "ascent")[0]
    assert end - begin == pytest.approx(1800.0, abs=2.0)
    assert len(found.surfacings) >= 2


@pytest.mark.parametrize("each", [1, 3])
def test_surfacings_carry_the_number_of_the_dive_before(each: int) -> None:
    """Descents begun until then, counted by the events; the first dive is number 1."""
    found = flown(dives=SHALLOW | {"per_surfacing": each}, sensors=EXACT)
    descents = np.array([t for t, phase, _ in events(found) if phase == "descent"])
    assert len(found.surfacings) >= 2
    # a row is written when the vehicle leaves, with the descent that begins then
    expected = [int(np.sum(descents < t)) for t in found.surfacings["time"]]
    assert found.surfacings["dive"].tolist() == expected
    assert expected[0] == each
