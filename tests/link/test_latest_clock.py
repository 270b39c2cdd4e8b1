"""The bound of the clock ashore, over real TIMESYNC messages. Oracle: that clock itself."""

import random

import pytest

from stommel.link.outbox import Outbox
from stommel.link.service import Received
from stommel.link.time_sync import TimeSync
from stommel.messages.mavlink import message_named
from tests.link.commands.quay import EPOCH, SHORE, VEHICLE, sayings


@pytest.mark.parametrize("drift", [-90e-6, 0.0, 90e-6])
def test_the_clock_ashore_never_shows_more_than_the_bound(drift: float) -> None:
    """Answers take up to 4 s each way, half are lost; neither end knows how long any took."""
    draw = random.Random(3)

    def ashore(t: float) -> float:
        return EPOCH + t * (1.0 + drift)

    aboard, shore = TimeSync(clock=lambda t: float("nan")), TimeSync(clock=ashore)
    assert aboard.latest(SHORE, 0.0) is None
    flying = []
    bounds = []
    for step in range(4000):
        t = step * 0.5
        for sync, source in ((aboard, VEHICLE), (shore, SHORE)):
            outbox = Outbox()
            sync.poll(t, outbox)
            flying += [(t + draw.uniform(0.0, 4.0), r, source) for r in sayings(outbox, source) if draw.random() < 0.5]
        for _, received, source in [one for one in flying if one[0] <= t]:
            (shore if source == VEHICLE else aboard).take(received, t)
        flying = [one for one in flying if one[0] > t]
        if (latest := aboard.latest(SHORE, t)) is not None:
            bounds.append(latest - ashore(t))
        if step == 0:
            # somebody must have been heard before anybody asks
            for sync, source in ((aboard, SHORE), (shore, VEHICLE)):
                sync.take(Received(*source, "HEARTBEAT", message_named("HEARTBEAT").unpack(b"\0")), 0.0)
    assert len(bounds) > 3000
    assert min(bounds) >= 0.0
    assert sorted(bounds)[len(bounds) // 2] < 5.0
