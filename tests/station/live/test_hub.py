"""The hub and its readers. Oracle: what was published, in the order in which it was."""

import asyncio
import threading
import time

import pytest

from stommel.station.live.events import Happening, Samples, Summary
from stommel.station.live.hub import MOST_CHANNELS, Hub, SubscriptionError
from stommel.station.live.mailbox import Message
from stommel.station.live.subscription import MOST_HAPPENINGS, MOST_SAMPLES, Subscription
from tests.support.waiting import WITHIN


def hub_of(*vehicles: int) -> Hub:
    hub = Hub()
    for vehicle in vehicles or (1,):
        hub.open(vehicle, lambda: 100.0, {"depth_m": (50.0, 7.0)})
    return hub


def samples(key: str, *pairs: tuple[float, float], vehicle: int = 1) -> Samples:
    return Samples(vehicle, 100.0, [(key, t, value) for t, value in pairs])


async def collected(reader: Subscription, count: int, within: float = WITHIN) -> list[Message]:
    """The next messages of a reader."""
    found: list[Message] = []

    async def read() -> None:
        async for message in reader:
            found.append(message)
            if len(found) == count:
                return

    await asyncio.wait_for(read(), within)
    return found


def test_a_new_reader_has_the_latest_archived_value_at_once() -> None:
    """akhenry/openmct-yamcs#133: after a reconnect a rarely sent value is there at once, with its own time."""
    reader = hub_of().subscribe("a", 1, ["depth_m", "pitch_deg"])
    (first,) = asyncio.run(collected(reader, 1))
    assert first == {
        "type": "values", "id": "a", "vehicle": 1, "now": 100.0, "values": {"depth_m": [50.0, 7.0]},
        "periods": {"depth_m": 2.0},
    }  # fmt: skip


@pytest.mark.parametrize("every", [False, True])
def test_how_often_values_come_is_told_when_it_changes(every: bool) -> None:
    hub, period = Hub(), [8.0]
    hub.open(1, lambda: 100.0, {}, lambda _: period[0])
    reader = hub.subscribe("a", 1, ["depth_m"], every)
    found: list[dict[str, float]] = []
    for k, told in enumerate((8.0, 8.0, 9.0, 12.0, 2.0)):
        period[0] = told
        hub.publish(samples("depth_m", (60.0 + k, 0.0)))
        message = reader.collect()
        assert message is not None
        found.append(message["periods"])
    assert found == [{"depth_m": 8.0}, {}, {}, {"depth_m": 12.0}, {"depth_m": 2.0}], "a tenth more is no news"


def test_a_slow_reader_of_values_skips_and_has_the_latest() -> None:
    hub = hub_of()
    reader = hub.subscribe("a", 1, ["depth_m"])

    async def read() -> list[Message]:
        await collected(reader, 1)
        for k in range(10_000):
            hub.publish(samples("depth_m", (60.0 + k, float(k))))
        return await collected(reader, 1)

    (message,) = asyncio.run(read())
    assert message["values"]["depth_m"] == [10_059.0, 9999.0]


def test_values_come_at_most_five_times_a_second_and_only_what_changed() -> None:
    hub = hub_of()
    reader = hub.subscribe("a", 1, ["depth_m", "pitch_deg"])
    ends = threading.Event()

    def bring() -> None:
        k = 0
        while not ends.wait(0.002):
            k += 1
            hub.publish(samples("pitch_deg", (60.0 + k, float(k))))

    async def read() -> tuple[list[Message], float]:
        await collected(reader, 1)
        began = time.monotonic()
        return await collected(reader, 5), time.monotonic() - began

    thread = threading.Thread(target=bring)
    thread.start()
    try:
        messages, took = asyncio.run(read())
    finally:
        ends.set()
        thread.join()
    assert took >= 0.79
    assert all(set(message["values"]) == {"pitch_deg"} for message in messages)
    assert [message["values"]["pitch_deg"][1] for message in messages] == sorted(
        message["values"]["pitch_deg"][1] for message in messages
    )


def test_a_reader_of_every_sample_misses_none_and_a_slow_one_is_told() -> None:
    hub = hub_of()
    reader = hub.subscribe("a", 1, ["depth_m"], every=True)
    for k in range(100):
        hub.publish(samples("depth_m", (60.0 + k, float(k)), (60.5 + k, 0.5)))
    (message,) = asyncio.run(collected(reader, 1))
    times, values = message["samples"]["depth_m"]
    assert times == [60.0 + 0.5 * k for k in range(200)]
    assert values[::2] == [float(k) for k in range(100)]
    slow = hub.subscribe("b", 1, ["depth_m"], every=True)
    for k in range(MOST_SAMPLES + 10):
        hub.publish(samples("depth_m", (1000.0 + k, 1.0)))
    gap, rest = asyncio.run(collected(slow, 2))
    assert gap == {"type": "gap", "id": "b", "vehicle": 1, "from": 1000.0}
    assert len(rest["samples"]["depth_m"][0]) == MOST_SAMPLES


def test_a_failing_subscription_ends_itself_only() -> None:
    """akhenry/openmct-yamcs#220: a subscription that fails takes nothing else with it."""
    hub = hub_of(1, 2)
    good = hub.subscribe("good", 1, ["depth_m"])
    for wrong in (lambda: hub.subscribe("x", 9, ["depth_m"]), lambda: hub.subscribe("x", 1, ["a"] * 10_000)):
        with pytest.raises(SubscriptionError):
            wrong()
    other = hub.subscribe("other", 2, ["depth_m"])
    other.close()

    async def read() -> list[Message]:
        await collected(good, 1)
        hub.publish(samples("depth_m", (70.0, 1.0)))
        hub.publish(samples("depth_m", (70.0, 1.0), vehicle=2))
        return await collected(good, 1)

    (message,) = asyncio.run(read())
    assert message["values"]["depth_m"] == [70.0, 1.0]
    assert MOST_CHANNELS < 10_000


def test_a_reader_whose_loop_has_gone_does_not_hold_up_who_brings() -> None:
    hub = hub_of()
    reader = hub.subscribe("a", 1, ["depth_m"])
    asyncio.run(collected(reader, 1))  # the loop has ended
    for k in range(1000):
        hub.publish(samples("depth_m", (70.0 + k, 1.0)))
    assert reader.is_closed


def test_news_are_the_latest_summary_and_all_that_happened() -> None:
    hub = hub_of(1, 2)
    hub.publish(Summary(1, {"dive": 1}))
    news = hub.watch()
    for k in range(5):
        hub.publish(Summary(1, {"dive": k}))
        hub.publish(Happening("text", 1, {"k": k}))
    messages = asyncio.run(collected(news, 6))
    assert [message["data"]["k"] for message in messages[:5]] == [0, 1, 2, 3, 4]
    assert messages[5] == {"type": "summary", "vehicle": 1, "summary": {"dive": 4}}


def test_a_reader_of_news_that_is_too_slow_is_told_how_many_it_missed() -> None:
    hub = hub_of()
    news = hub.watch()
    for k in range(MOST_HAPPENINGS + 3):
        hub.publish(Happening("text", 1, {"k": k}))
    gap, first = asyncio.run(collected(news, 2))
    assert gap["lost"] == 3
    assert first["data"]["k"] == 3


def test_readers_of_a_replay_that_ends_end() -> None:
    hub = Hub()
    hub.open("replay:1", lambda: 5.0)
    reader = hub.subscribe("a", "replay:1", ["depth_m"])
    hub.forget("replay:1")

    async def read() -> list[Message]:
        return [message async for message in reader]

    assert asyncio.run(asyncio.wait_for(read(), WITHIN)) == []


def test_many_readers_cost_who_brings_little() -> None:
    """Oracle: the processor's time where nobody reads; whoever asked for other channels looks once at a batch."""
    batch = [(f"channel_{k}", 60.0, 1.0) for k in range(500)]

    def cost(readers: int) -> float:
        hub = hub_of()
        asked = [hub.subscribe(str(k), 1, ["depth_m"]) for k in range(readers)]
        began = time.thread_time()
        for _ in range(100):
            hub.publish(Samples(1, 100.0, batch))
        assert len(asked) == readers
        return time.thread_time() - began

    assert min(cost(200) for _ in range(3)) < 20.0 * max(cost(0) for _ in range(3))


def test_a_clock_that_was_set_back_leaves_no_value_standing() -> None:
    """A simulated glider that is started anew begins its world again: what it tells now is the latest."""
    hub = hub_of()
    hub.open(1, lambda: 100.0, {"depth_m": (3000.0, 7.0)})
    hub.publish(samples("depth_m", (99.0, 1.0)))
    assert hub.values(1)["depth_m"] == (99.0, 1.0)
    hub.publish(samples("depth_m", (98.0, 2.0)))
    assert hub.values(1)["depth_m"] == (99.0, 1.0), "what comes late is not the latest"


def test_nobody_waits_for_a_vehicle_that_is_forgotten_while_they_subscribe(monkeypatch: pytest.MonkeyPatch) -> None:
    """A replay that ends in the middle of a subscription closes it, or it is refused; it is not left waiting."""
    hub = hub_of(1)
    sweep = hub._sweep

    def forget() -> None:
        sweep()
        hub.forget(1)

    monkeypatch.setattr(hub, "_sweep", forget)
    with pytest.raises(SubscriptionError, match="none of that number"):
        hub.subscribe("a", 1, ["depth_m"])
    assert hub.listeners(1) == 0
