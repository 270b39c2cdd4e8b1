"""Figure: with a million samples in range the plots pan and zoom at 30 frames a second or better.

CI has a share of the samples; `STOMMEL_PLOT_SAMPLES=1000000` is the whole figure.
"""

import math
import os
import time
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from stommel.archive import Archive, Batch
from tests.page.paint import is_too_busy
from tests.page.past import station
from tests.page.waiting import at_rest
from tests.station.speaker import speaker

pytestmark = pytest.mark.timeout(600)
SAMPLES = int(os.environ.get("STOMMEL_PLOT_SAMPLES", "100000"))
FRAMES_PER_S = 30.0
MEASURE = """
    ([zoom, seconds]) => new Promise((done) => {
        const area = document.querySelector('[data-panel=path] .u-over');
        const box = area.getBoundingClientRect();
        const times = [];
        const step = (now) => {
            times.push(now);
            if (now - times[0] > 1000 * seconds) return done(times.slice(1).map((t, k) => t - times[k]));
            const way = Math.floor(times.length / 20) % 2 ? 1 : -1;
            area.dispatchEvent(new WheelEvent('wheel', {
                deltaX: zoom ? 0 : 25 * way, deltaY: zoom ? 25 * way : 0, clientX: box.left + box.width / 3,
                clientY: box.top + 20, bubbles: true, cancelable: true }));
            requestAnimationFrame(step);
        };
        requestAnimationFrame(step);
    })
"""


@pytest.fixture(scope="module")
def long_past(built: None, tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, float, float]]:
    """A station with many samples at 1 Hz of one channel, and as many hundredths of others."""
    folder = tmp_path_factory.mktemp("long")
    database = f"sqlite:///{folder / 'archive.sqlite'}"
    end = math.floor(time.time()) - 60.0
    t = end - np.arange(SAMPLES, 0, -1.0)
    depth = 100.0 - 100.0 * np.cos(t / 600.0)
    with Archive.open(database) as archive:
        archive.know(1, "Donghai", "zju")
        for k in range(0, SAMPLES, 50_000):
            part = slice(k, k + 50_000)
            rows = [("depth_m", *row) for row in zip(t[part].tolist(), depth[part].tolist(), strict=True)]
            archive.store(1, Batch(samples=rows))
        for key in ("pitch_deg", "roll_deg", "heading_deg", "ballast_ml", "ballast_setpoint_ml"):
            rows = [(key, *row) for row in zip(t[::100].tolist(), np.sin(t[::100] / 700.0).tolist(), strict=True)]
            archive.store(1, Batch(samples=rows))
    with speaker() as vehicle, station(folder, database, vehicle.address) as address:
        yield address, float(t[0]), float(t[-1])


@pytest.mark.parametrize("zoom", [False, True], ids=["pan", "zoom"])
def test_plots_move_at_thirty_frames_a_second(
    page: Any, long_past: tuple[str, float, float], zoom: bool, record_property: Any
) -> None:
    address, begin, end = long_past
    with page.expect_response("**/series?*") as answered:
        page.goto(f"{address}/#/vehicle/1/plots?window={begin}-{end}")
    drawn = answered.value.json()["channels"]["depth_m"]
    assert drawn["samples"] == SAMPLES
    assert len(drawn["t"]) <= 4000, "reduced by the server"
    page.locator("[data-panel] canvas").first.wait_for()
    at_rest(page)
    best = 0.0
    for _ in range(8):  # the best of some: other work of this machine can only make frames fewer
        best = max(best, 1000.0 / float(np.mean(page.evaluate(MEASURE, [zoom, 1.5]))))
        if best >= FRAMES_PER_S:
            break
    record_property("frames_per_s", best)
    if best < FRAMES_PER_S and is_too_busy():
        pytest.skip(f"{best:.0f} frames/s on a machine that is too busy to tell")
    assert best >= FRAMES_PER_S
