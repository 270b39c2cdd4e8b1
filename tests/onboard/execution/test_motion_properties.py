"""What must hold for any frames, readings and times."""

import random
from math import inf, nan

from hypothesis import given, settings
from hypothesis import strategies as st

from stommel.messages.codec import Decoder, Encoder, Received
from stommel.messages.database import database
from stommel.messages.frames import Frame
from stommel.onboard.execution.motion_io import MotionReadings
from stommel.onboard.execution.motion_node import MotionNode
from stommel.onboard.nodes.motion_settings import MotionSettings
from tests.messages.sayings import sayable
from tests.onboard.execution.motion_bench import HIGH, MotionPlant

NAMES = [
    "Sync", "MotionSetpoint", "Abort", "CoordinatorCommand", "BenchCommand", "CoordinatorInformation",
    "MotionParameterRequest", "CoordinatorHeartbeat", "Switch", "Depth",
]  # fmt: skip
FRAMES = st.one_of(
    st.tuples(st.sampled_from(NAMES), st.integers(0, 2**32)),
    st.builds(Frame, st.integers(0, 0x7FF), st.binary(max_size=8)),
)
ODD = st.one_of(st.floats(), st.sampled_from([nan, inf, -inf]))
READINGS = st.builds(
    MotionReadings,
    st.floats(-3e-4, 3e-4) | ODD, st.floats(-0.06, 0.56) | ODD, st.floats(-1.1, 1.1) | ODD, st.booleans(),
    st.booleans(), st.floats(0.0, 12.0) | ODD, st.floats(0.0, 12.0) | ODD, st.floats(0.0, 12.0) | ODD,
)  # fmt: skip
STEPS = st.lists(
    st.tuples(
        st.sampled_from([0.0, 0.1, 1.0, 1.0, 7.0, -3.0]),
        st.lists(FRAMES, max_size=4),
        READINGS,
        st.sampled_from([0.05, 0.1, 0.5, 1.0, 10.0]),
    ),
    max_size=25,
)


def frame_of(encoder: Encoder, said) -> Frame:
    if isinstance(said, Frame):
        return said
    name, seed = said
    message = next(one for one in database().messages if one.name == name)
    return encoder.frame(name, **sayable(message, random.Random(seed)))


def check(out, readings: MotionReadings) -> None:
    assert 0.0 <= out.pump <= 1.0
    assert 0.0 <= out.valve <= 1.0
    assert -1.0 <= out.mass <= 1.0
    assert -1.0 <= out.steering <= 1.0
    assert out.pump == 0.0 or out.valve == 0.0
    assert not (readings.limit_fore and out.mass > 0.0)
    assert not (readings.limit_aft and out.mass < 0.0)
    assert out.brake == (out.steering == 0.0)


@settings(max_examples=200, deadline=None)
@given(STEPS, st.booleans())
def test_outputs_stay_in_range_and_after_a_quiet_bus_the_vehicle_blows(steps, alone):
    node, encoder, decoder = MotionNode(MotionSettings(has_drop_weight=True)), Encoder(), Decoder()
    t = 0.0
    if not alone:
        node.step(t, [], MotionPlant().readings(), 1.0)
        node.step(t, [encoder.frame("Sync", vehicle_time=0.0)], MotionPlant().readings(), 1.0)
        start = encoder.frame("CoordinatorCommand", target=2, command=1, sequence=1, argument=0)
        node.step(t, [start], MotionPlant().readings(), 1.0)
    for passed, said, readings, interval in steps:
        t += passed
        frames, out = node.step(t, [frame_of(encoder, one) for one in said], readings, interval)
        check(out, readings)
        for frame in frames:
            if alone or frame.identifier >= 512:
                assert isinstance(decoder.take(frame), Received)
    plant = MotionPlant(V_b=-1e-4)
    for k in range(900):
        readings = plant.readings()
        frames, out = node.step(t + 1.0 + k, [], readings, 1.0)
        check(out, readings)
        plant.move(out, 1.0)
    assert abs(plant.V_b - HIGH) < 1.1e-6  # the largest tolerance that can be set is 1 ml
    assert plant.r_px < 0.0
