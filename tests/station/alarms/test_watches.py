"""Limits of a vehicle, its own alarms, and its contact, each as an engine without a clock."""

from math import inf
from xml.etree import ElementTree

import pytest
from pydantic import ValidationError

from stommel.messages.mavlink import DIALECT
from stommel.station.alarms.contact_watch import LINK_SILENT, SURFACING_MISSED, Contact, ContactWatch
from stommel.station.alarms.limit_watch import LimitWatch
from stommel.station.alarms.limits import ChannelWords, Limit
from stommel.station.alarms.vehicle_alarms import VehicleAlarmWatch, known_alarms


def naming(channel: str) -> ChannelWords:
    return ChannelWords("depth", "m") if channel == "depth_m" else ChannelWords(channel, "")


def depth(low: float | None = None, high: float | None = 200.0, **rest: object) -> Limit:
    return Limit.model_validate({"channel": "depth_m", "low": low, "high": high, **rest})


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({}, "give low, high, or both"),
        ({"low": 5.0, "high": 5.0}, "must be less than high = 5"),
        ({"low": 1.0, "high": 2.0, "hysteresis": 1.5}, "must be at most high - low"),
        ({"high": inf}, "finite"),
        ({"high": 1e10}, "less than or equal to 1000000000"),
        ({"high": 1.0, "hysteresis": -1.0}, "greater than or equal to 0"),
        ({"high": 1.0, "delay_s": 1e6}, "86400"),
        ({"high": 1.0, "severity": "awful"}, "'notice', 'warning' or 'critical'"),
    ],
)
def test_a_limit_that_cannot_be_kept_is_refused(values: dict[str, object], words: str) -> None:
    with pytest.raises(ValidationError, match=words):
        Limit.model_validate({"channel": "depth_m", **values})


def test_each_side_has_an_alarm_of_its_own_with_words_for_people() -> None:
    watch = LimitWatch(naming)
    watch.put(depth(low=1.0, severity="critical"), 0.0)
    told = watch.take([("depth_m", 2.0, 0.5), ("depth_m", 1.0, 210.0), ("other", 1.0, 1e9)])
    assert [(change.key, change.raised) for change in told] == [
        ("limit:depth_m:high", True), ("limit:depth_m:low", True), ("limit:depth_m:high", False),
    ]  # fmt: skip
    assert told[0].words == "Depth greater than 200 m"
    assert {change.words for change in told if change.key.endswith("low")} == {"Depth less than 1 m"}
    assert {change.severity for change in told} == {"critical"}


def test_a_wider_limit_ends_the_alarm_and_a_narrower_one_raises_it() -> None:
    watch = LimitWatch(naming)
    watch.put(depth(), 0.0)
    assert [change.raised for change in watch.take([("depth_m", 1.0, 250.0)])] == [True]
    assert [change.raised for change in watch.put(depth(high=300.0), 2.0)] == [False]
    assert [change.raised for change in watch.put(depth(high=100.0), 3.0)] == [True]
    assert [change.raised for change in watch.put(depth(high=150.0), 4.0)] == []
    assert [(change.key, change.raised) for change in watch.put(depth(low=2.0, high=None), 5.0)] == [
        ("limit:depth_m:high", False)
    ]


def test_a_limit_that_is_removed_ends_its_alarm() -> None:
    watch = LimitWatch(naming, ["limit:depth_m:high"])
    watch.put(depth(), 0.0)
    assert [(change.key, change.raised) for change in watch.remove("depth_m", 9.0)] == [("limit:depth_m:high", False)]
    assert watch.take([("depth_m", 10.0, 999.0)]) == []
    assert watch.limits == []


def test_an_open_alarm_goes_on_after_a_restart() -> None:
    watch = LimitWatch(naming, ["limit:depth_m:high"])
    watch.put(depth(hysteresis=10.0), 0.0)
    assert watch.take([("depth_m", 1.0, 205.0)]) == []
    assert [change.raised for change in watch.take([("depth_m", 2.0, 190.0)])] == [False]


def test_every_alarm_of_the_messages_has_words_and_a_severity() -> None:
    """Oracle: glider.xml, read by another reader."""
    root = ElementTree.parse(DIALECT).getroot()
    entries = root.findall("./enums/enum[@name='GLIDER_ALARM']/entry")
    assert [alarm.bit for alarm in known_alarms()] == sorted(int(entry.attrib["value"]) for entry in entries)
    by_bit = {alarm.bit: alarm for alarm in known_alarms()}
    assert by_bit[1].key == "vehicle:leak"
    assert by_bit[1].severity == "critical"
    assert by_bit[1 << 34] == (1 << 34, "vehicle:silent GPS", "Silent GPS", "warning")
    assert len({alarm.key for alarm in known_alarms()}) == len(entries)


def test_every_named_severity_is_that_of_an_alarm() -> None:
    from stommel.station.alarms import vehicle_alarms

    names = {alarm.key.removeprefix("vehicle:") for alarm in known_alarms()}
    assert {*vehicle_alarms._CRITICAL, *vehicle_alarms._NOTICES} <= names


def test_bits_become_alarms_that_begin_and_end() -> None:
    watch = VehicleAlarmWatch()
    assert watch.take(0.0, 0) == []
    assert [(c.key, c.raised, c.t) for c in watch.take(1.0, 1 | 1 << 51)] == [
        ("vehicle:leak", True, 1.0), ("vehicle:radio key", True, 1.0),
    ]  # fmt: skip
    assert watch.take(2.0, 1 | 1 << 51) == []
    assert [(c.key, c.raised) for c in watch.take(3.0, 1)] == [("vehicle:radio key", False)]
    assert watch.take(2.5, 1 | 1 << 51) == []  # late: told already
    assert [(c.key, c.words) for c in watch.take(4.0, 1 | 1 << 60)] == [("vehicle:bit 60", "Alarm 60")]


def test_own_alarms_from_before_a_restart_end_when_the_bit_is_gone() -> None:
    watch = VehicleAlarmWatch(["vehicle:leak", "vehicle:bit 60"])
    assert watch.take(0.0, 1 | 1 << 60) == []
    assert [(c.key, c.raised) for c in watch.take(1.0, 0)] == [("vehicle:leak", False), ("vehicle:bit 60", False)]


def contacts(watch: ContactWatch, *looks: tuple[float, Contact]) -> list[tuple[str, bool, float]]:
    return [(change.key, change.raised, change.t) for now, contact in looks for change in watch.look(now, contact)]


def test_a_surfacing_is_missed_after_its_margin_and_ends_when_the_vehicle_is_heard() -> None:
    watch = ContactWatch(900.0, 600.0, 43_200.0)
    told = contacts(
        watch,
        (1000.0, Contact(heard=1000.0)),
        (1001.0, Contact(heard=1000.0, expected=5000.0)),
        (5900.0, Contact(heard=1000.0, expected=5000.0)),
        (5901.0, Contact(heard=1000.0, expected=5000.0)),
        (5902.0, Contact(heard=1000.0, expected=5000.0)),
        (6500.0, Contact(heard=6499.0)),
    )
    assert told == [(SURFACING_MISSED, True, 5901.0), (SURFACING_MISSED, False, 6499.0)]


def test_an_expectation_that_is_put_off_while_nobody_hears_moves_nothing() -> None:
    watch = ContactWatch(100.0, 600.0, 43_200.0)
    looks = [(float(now), Contact(heard=0.0, expected=now + 3000.0)) for now in range(0, 7000, 100)]
    assert contacts(watch, *looks) == [(SURFACING_MISSED, True, 3200.0)]


def test_a_silence_that_no_dive_explains_is_a_silent_link() -> None:
    watch = ContactWatch(900.0, 600.0, 43_200.0)
    assert contacts(watch, (0.0, Contact()), (600.0, Contact())) == []
    (raised,) = watch.look(601.0, Contact(trouble="connection refused"))
    assert (raised.key, raised.raised) == (LINK_SILENT, True)
    assert raised.words == "Nothing heard for 10 min and no dive is known: connection refused"
    assert contacts(watch, (700.0, Contact(heard=650.0)), (701.0, Contact(heard=700.5))) == [
        (LINK_SILENT, False, 700.5)
    ]


def test_a_dive_is_no_silent_link() -> None:
    watch = ContactWatch(900.0, 600.0, 43_200.0)
    looks = [(float(now), Contact(heard=0.0, expected=7200.0)) for now in range(0, 8100, 60)]
    assert contacts(watch, *looks) == []


def test_a_missed_surfacing_from_before_a_restart_is_not_told_twice() -> None:
    watch = ContactWatch(900.0, 600.0, 43_200.0, frozenset({SURFACING_MISSED}))
    overdue = Contact(heard=100.0, expected=2000.0)
    assert contacts(watch, (9000.0, overdue), (9001.0, overdue)) == []
    assert contacts(watch, (9100.0, Contact(heard=9099.0))) == [(SURFACING_MISSED, False, 9099.0)]


def test_a_first_dive_whose_end_nobody_knows_is_silent_for_longer() -> None:
    watch = ContactWatch(900.0, 600.0, 7200.0)
    dive = Contact(heard=0.0, is_diving=True)
    assert contacts(watch, *((float(now), dive) for now in range(0, 7201, 60))) == []
    (raised,) = watch.look(7201.0, dive)
    assert raised.words == "Nothing heard for 120 min and its dive should have ended"
