"""The data-acquisition node: what it sends of its readings, what it proves, and what it does when nobody speaks."""

from math import inf, nan

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from stommel.messages.codec import Decoder, Encoder, Received
from stommel.messages.database import database_hash, value_named, word_of
from stommel.messages.frames import Frame
from stommel.onboard.execution.acquisition_io import AcquisitionReadings
from stommel.onboard.execution.acquisition_node import AcquisitionNode
from stommel.onboard.execution.node_states import Mode
from stommel.onboard.nodes.acquisition_settings import AcquisitionSettings
from stommel.onboard.nodes.node_settings import SettingsError
from tests.onboard.execution.test_motion_properties import FRAMES, frame_of

WELL = AcquisitionReadings(
    depth=0.3, altitude=inf, leak_fore=False, leak_aft=False, leak_loop=True, internal_pressure=8.0e4,
    hull_temperature=18.5, voltage=25.2, current=0.4, battery_temperature=17.0,
)  # fmt: skip


class Ctd:
    """A CTD whose bytes are its pressure in whole decibars."""

    def __init__(self) -> None:
        self.asked: list[tuple[bool, float]] = []

    def take(self, data: bytes, t: float):
        return [(float(byte), 12.5, 3.5) for byte in data] if data != b"bad" else [(nan, 12.5, 3.5)]

    def poll(self, t: float, sampling: bool, interval: float) -> bytes:
        self.asked.append((sampling, interval))
        return b"go" if sampling else b""


class Bench:
    def __init__(self, ctd=None, store=None, **given) -> None:
        self.node = AcquisitionNode(AcquisitionSettings(**given), ctd=ctd, store=store)
        self.coordinator, self.decoder = Encoder(), Decoder()
        self.readings = WELL
        self.t = 0.0
        self.heard: list[Received] = []
        self.out = None

    def run(self, seconds=1, interval=1.0, *, sync=True, frames=(), ctd=b"") -> None:
        waiting = list(frames)
        for _ in range(round(seconds / interval)):
            said, _ = self.node.step(self.t, [], self.readings, ctd)
            beat = [self.coordinator.frame("Sync", vehicle_time=self.t)] if sync else []
            more, self.out = self.node.step(self.t, beat + waiting, self.readings, b"")
            waiting = []
            for frame in said + more:
                received = self.decoder.take(frame)
                assert isinstance(received, Received), received
                self.heard.append(received)
            self.t += interval

    def command(self, word: str) -> None:
        number = value_named("CoordinatorCommand", "command", word)
        self.run(
            frames=[
                self.coordinator.frame("CoordinatorCommand", target=3, command=number, sequence=int(self.t), argument=0)
            ]
        )

    def switch(self, loads=3, sampling=1, radio=0, interval=2.0) -> Frame:
        return self.coordinator.frame(
            "Switch", loads=loads, sampling=sampling, surface_radio=radio, sample_interval=interval
        )

    def messages(self, name: str) -> list[dict[str, float]]:
        return [received.values for received in self.heard if received.name == name]

    def emergencies(self) -> list[tuple[str, bool, int]]:
        name = "AcquisitionEmergency"
        return [
            (word_of(name, "code", int(v["code"])), bool(v["active"]), int(v["detail"])) for v in self.messages(name)
        ]

    def result(self) -> tuple[str, int]:
        values = self.messages("AcquisitionAcknowledgement")[-1]
        return word_of("AcquisitionAcknowledgement", "result", int(values["result"])), int(values["detail"])


def test_each_second_all_readings_are_sent():
    bench = Bench()
    bench.readings = WELL._replace(depth=123.456, altitude=17.25, leak_aft=True)
    bench.run(5, 0.1)
    for name in ("Depth", "Hull", "Battery", "AcquisitionHeartbeat"):
        assert len(bench.messages(name)) == 5
    depth, hull, battery = (bench.messages(name)[-1] for name in ("Depth", "Hull", "Battery"))
    assert (depth["depth"], depth["altitude"]) == pytest.approx((123.456, 17.25))
    assert (depth["pressure_measured"], depth["altimeter_answers"], depth["bottom_heard"]) == (1, 1, 1)
    assert (hull["internal_pressure"], hull["temperature"]) == pytest.approx((8.0e4, 18.5))
    assert (hull["leak_fore"], hull["leak_aft"], hull["leak_measured"], hull["pressure_measured"]) == (0, 1, 1, 1)
    assert (battery["voltage"], battery["current"], battery["temperature"]) == pytest.approx((25.2, 0.4, 17.0))
    assert battery["battery_measured"] == 1


def test_voltage_and_current_are_means_since_the_last_frame():
    bench = Bench()
    for current, voltage in [(0.4, 25.0), (2.0, 24.0), (6.0, 23.0), (nan, nan), (1.0, 25.0)]:
        bench.readings = WELL._replace(current=current, voltage=voltage)
        bench.run(0.5, 0.5)
    # frames at 0, 1 and 2 s take the readings since the frame before, and their own
    told = bench.messages("Battery")
    assert [one["current"] for one in told] == pytest.approx([0.4, (2.0 + 6.0) / 2, 1.0])
    assert [one["voltage"] for one in told] == pytest.approx([25.0, (24.0 + 23.0) / 2, 25.0])


@pytest.mark.parametrize(("wrong", "message", "expected", "bit"), [
    ({"depth": nan}, "Depth", {"pressure_measured": 0, "depth": 0.0}, 1),
    ({"depth": 99999.0}, "Depth", {"pressure_measured": 0}, 1),
    ({"altitude": nan}, "Depth", {"altimeter_answers": 0, "bottom_heard": 0}, 2),
    ({"altitude": -1.0}, "Depth", {"altimeter_answers": 0, "bottom_heard": 0}, 2),
    ({"altitude": inf}, "Depth", {"altimeter_answers": 1, "bottom_heard": 0}, 0),
    ({"internal_pressure": nan}, "Hull", {"pressure_measured": 0}, 4),
    ({"internal_pressure": -5.0}, "Hull", {"pressure_measured": 0}, 4),
    ({"leak_loop": False}, "Hull", {"leak_measured": 0}, 8),
    ({"hull_temperature": nan}, "Hull", {"temperature": 18.5}, 0),
    ({"voltage": nan}, "Battery", {"battery_measured": 0}, 16),
    ({"current": -inf}, "Battery", {"battery_measured": 0}, 16),
])  # fmt: skip
def test_a_sensor_without_a_reading_is_told(wrong, message, expected, bit):
    bench = Bench()
    bench.run(5)
    bench.readings = WELL._replace(**wrong)
    bench.run(2)
    told = bench.messages(message)[-1]
    assert {name: told[name] for name in expected} == expected
    assert [one for one in bench.emergencies() if one[0] == "SensorRange"] == (
        [("SensorRange", True, bit)] if bit else []
    )


@pytest.mark.parametrize(("wrong", "message", "proof", "bit"), [
    ({"depth": 2.5}, "Depth", "pressure_proven", 1), ({"depth": nan}, "Depth", "pressure_proven", 1),
    ({"leak_loop": False}, "Hull", "leak_proven", 2), ({"internal_pressure": 1.1e5}, "Hull", "vacuum_proven", 4),
    ({"internal_pressure": nan}, "Hull", "vacuum_proven", 4), ({"voltage": 5.0}, "Battery", "voltage_proven", 8),
    ({"current": 9.0}, "Battery", "voltage_proven", 8), ({"voltage": nan}, "Battery", "voltage_proven", 8),
])  # fmt: skip
def test_each_safety_input_is_proven_at_the_start_or_by_a_self_test_and_else_not(wrong, message, proof, bit):
    bench = Bench(settling=3.0)
    bench.readings = WELL._replace(**wrong)
    bench.run(5)
    assert bench.messages(message)[-1][proof] == 0
    bench.readings = WELL
    bench.run(5)
    assert bench.messages(message)[-1][proof] == 0  # settling is over
    bench.command("SelfTest")
    assert bench.result() == ("Done", 0)
    bench.run(2)
    assert bench.messages(message)[-1][proof] == 1
    bench.readings = WELL._replace(**wrong)
    bench.run(3)
    assert bench.messages(message)[-1][proof] == 1  # proven at the surface, at rest
    bench.command("SelfTest")
    assert bench.result() == ("Failed", bit)
    bench.run(2)
    assert bench.messages(message)[-1][proof] == 0


def test_a_sensor_that_needs_a_moment_is_proven_while_it_settles():
    bench = Bench()
    bench.readings = WELL._replace(depth=nan)
    bench.run(2)
    bench.readings = WELL
    bench.run(2)
    assert bench.messages("Depth")[-1]["pressure_proven"] == 1


def test_leak_vacuum_and_voltage_are_told_at_once_and_when_they_are_over():
    bench = Bench()
    bench.run(2)
    bench.readings = WELL._replace(leak_fore=True, internal_pressure=1.2e5, voltage=15.0)
    bench.run(1)
    assert sorted(bench.emergencies()) == [("Brownout", True, 0), ("Leak", True, 1), ("VacuumLoss", True, 0)]
    bench.readings = WELL._replace(leak_fore=True, leak_aft=True)
    bench.run(1)
    assert ("Leak", True, 3) in bench.emergencies()
    bench.readings = WELL
    bench.run(1)
    assert {one[0] for one in bench.emergencies() if not one[1]} == {"Leak", "VacuumLoss", "Brownout"}


def test_switches_are_followed_and_the_ctd_is_told():
    ctd = Ctd()
    bench = Bench(ctd)
    bench.run(2)
    assert bench.out == (0, False, 1.0, False, b"")
    bench.run(2, frames=[bench.switch(5, 1, 1, 4.0)])
    assert bench.out == (5, True, 4.0, True, b"go")
    assert ctd.asked[-1] == (True, 4.0)
    bench.command("Stop")
    assert bench.out == (0, False, 4.0, True, b"")
    bench.run(2, frames=[bench.switch()])
    assert bench.out.sampling is False
    bench.command("Start")
    bench.run(1, frames=[bench.switch(1, 0, 0)])
    assert bench.out == (1, False, 2.0, False, b"")


def test_samples_of_the_ctd_are_sent_and_its_error_values_are_not():
    bench = Bench(Ctd())
    bench.run(1, frames=[bench.switch()])
    bench.run(1, ctd=bytes((7, 8)))
    bench.run(1, ctd=b"bad")
    assert [(v["pressure"], v["temperature"], v["conductivity"]) for v in bench.messages("CtdSample")] == [
        pytest.approx((7.0, 12.5, 3.5)), pytest.approx((8.0, 12.5, 3.5))
    ]  # fmt: skip


def test_a_ctd_that_should_sample_and_says_nothing_is_silent():
    bench = Bench(Ctd(), ctd_patience=10.0)
    bench.run(100)
    assert bench.emergencies() == []  # it is not to sample
    bench.run(14, frames=[bench.switch(interval=2.0)])
    assert bench.emergencies() == []
    bench.run(2)
    assert bench.emergencies() == [("CtdSilent", True, 0)]
    bench.run(2, ctd=b"\x05")
    assert bench.emergencies()[-1] == ("CtdSilent", False, 0)


@pytest.mark.parametrize("radio", [True, False])
def test_a_quiet_bus_ends_sampling_after_a_minute_and_the_node_goes_on_sending(radio):
    bench = Bench(Ctd(), least_loads=2, radio_left_alone=radio)
    bench.run(5, frames=[bench.switch(7, 1, 0)])
    bench.run(5, sync=False)
    assert bench.node.link.modes.mode is Mode.QUIET
    assert bench.out == (7, True, 2.0, False, b"go")
    bench.run(54, sync=False)
    assert bench.out.sampling
    bench.run(2, sync=False)
    assert bench.node.link.modes.mode is Mode.LEFT_ALONE
    assert bench.out == (2, False, 2.0, radio, b"")
    before = len(bench.messages("Depth"))
    bench.run(20, sync=False)
    assert len(bench.messages("Depth")) == before + 20
    assert bench.emergencies()[0] == ("BusQuiet", True, 0)
    bench.run(2, frames=[bench.switch(7, 1, 0)])
    assert bench.out.loads == 7
    assert ("BusQuiet", False, 0) in bench.emergencies()


def test_an_abort_ends_sampling_and_leaves_the_rest_to_the_coordinator():
    bench = Bench()
    bench.run(2, frames=[bench.switch(7, 1, 1)])
    bench.run(1, frames=[bench.coordinator.frame("Abort", reason=2, drop_weight=0)])
    assert bench.out == (7, False, 2.0, True, b"")
    bench.run(1, frames=[bench.switch(8, 0, 1)])
    assert bench.out == (8, False, 2.0, True, b"")


def test_commands_of_drives_are_refused_and_a_restart_is_counted_and_proves_anew():
    bench = Bench()
    bench.run(5)
    for word in ("Blow", "Brake", "DropWeight"):
        bench.command(word)
        assert bench.result() == ("Refused", 0)
    bench.readings = WELL._replace(depth=40.0)
    bench.command("Restart")
    assert bench.result() == ("Done", 0)
    bench.run(2)
    assert bench.messages("AcquisitionHeartbeat")[-1]["restarts"] == 1
    assert bench.messages("Depth")[-1]["pressure_proven"] == 0


def test_a_coordinator_of_another_database_is_refused():
    bench = Bench()
    bench.run(2)
    other = bench.coordinator.frame(
        "CoordinatorInformation", hardware=1, version_major=1, version_minor=0, version_patch=0,
        database_hash=database_hash() ^ 1,
    )  # fmt: skip
    bench.run(2, frames=[other, bench.switch()])
    assert bench.out.loads == 0
    assert bench.emergencies() == [("WrongVersion", True, 0)]
    bench.command("Start")
    assert bench.result() == ("Refused", 0)


@pytest.mark.parametrize(("key", "value", "says"), [
    ("least_loads", 256, "between 0 and 255"), ("vacuum_low", 2e5, "less than vacuum_high"),
    ("voltage_low", 34.0, "less than voltage_high"), ("quiet_after", nan, "between 1 and 60 s"),
])  # fmt: skip
def test_settings_beyond_their_limits_are_refused_by_name(key, value, says):
    with pytest.raises(SettingsError, match=rf"AcquisitionSettings.{key} = {value}: must be {says}"):
        AcquisitionSettings(**{key: value})


NUMBERS = st.one_of(st.floats(), st.sampled_from([nan, inf, -inf, 0.0, 1e5]))
READINGS = st.builds(
    AcquisitionReadings, NUMBERS, NUMBERS, st.booleans(), st.booleans(), st.booleans(), NUMBERS, NUMBERS, NUMBERS,
    NUMBERS, NUMBERS,
)  # fmt: skip


@settings(max_examples=100, deadline=None)
@given(
    st.lists(
        st.tuples(st.sampled_from([0.0, 0.1, 1.0, 9.0, -2.0]), st.lists(FRAMES, max_size=4), READINGS), max_size=20
    )
)
def test_any_frames_and_readings_leave_the_switches_in_range_and_alone_the_payload_rests(steps):
    node, encoder = AcquisitionNode(AcquisitionSettings(), ctd=Ctd()), Encoder()
    t = 0.0
    for passed, said, readings in steps:
        t += passed
        _, out = node.step(t, [frame_of(encoder, one) for one in said], readings, b"\x07\xff")
        assert 0 <= out.loads <= 255
        assert isinstance(out.sampling, bool)
        assert isinstance(out.radio, bool)
    for k in range(1, 3):
        # the first of these sees the silence begin, whatever stood in the frames
        frames, out = node.step(t + 4000.0 * k, [], WELL, b"")
    assert not out.sampling
    assert out.loads == node.settings.least_loads
    assert {frame.identifier for frame in frames} >= {0x303, 0x304, 0x305, 0x703}
