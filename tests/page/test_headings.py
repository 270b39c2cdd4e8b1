"""A heading goes around: it is never 360.0 deg, and no line runs across the plot where it passes north.

Oracle: the headings that the vehicle says, on the circle.
"""

import math
import re
from itertools import pairwise
from typing import Any

from tests.page.past import Past
from tests.page.test_plots import DRAWN
from tests.page.waiting import until


def say(page: Any, past: Past, headings: list[float]) -> None:
    for heading in headings:
        past.speaker.say("ATTITUDE", time_boot_ms=0, pitch=0.0, roll=0.0, yaw=math.radians(heading))
        page.wait_for_timeout(120)


def drawn(page: Any) -> list[float | None]:
    """Values of the heading as they are drawn, null in gaps."""
    panel = next(each for each in page.evaluate(DRAWN) if each["channels"] == ["heading_deg"])
    return [value for value in panel["data"][1] if value != "none"]


def joined(values: list[float | None]) -> list[tuple[float, float]]:
    """Ends of every line that is drawn."""
    return [(a, b) for a, b in pairwise(values) if a is not None and b is not None]


def upright(page: Any) -> list[int]:
    """Columns of the plot that are inked from top to bottom, and are no grid line."""
    found: list[int] = page.evaluate("""() => {
        const canvas = document.querySelector('[data-panel] canvas');
        const {width, height} = canvas;
        const ink = getComputedStyle(document.documentElement).getPropertyValue('--series-1').trim();
        const brush = document.createElement('canvas').getContext('2d');
        brush.fillStyle = ink; brush.fillRect(0, 0, 1, 1);
        const wanted = brush.getImageData(0, 0, 1, 1).data;
        const pixels = canvas.getContext('2d').getImageData(0, 0, width, height).data;
        const columns = [];
        for (let x = 0; x < width; x += 1) {
            let inked = 0;
            for (let y = 0; y < height; y += 1) {
                const at = 4 * (y * width + x);
                const far = [0, 1, 2].reduce((sum, part) => sum + Math.abs(pixels[at + part] - wanted[part]), 0);
                if (far < 150 && pixels[at + 3] > 60) inked += 1;
            }
            if (inked > height / 2) columns.push(x);
        }
        return columns;
    }""")
    return found


def test_a_heading_about_north_is_one_line(page: Any, past: Past, screenshot: Any) -> None:
    page.goto(f"{past.address}/#/vehicle/1/plots?show=own&channels=heading_deg&window=live-120")
    page.wait_for_selector("[data-panel] canvas")
    say(page, past, [(6.0 * math.sin(k / 3.0)) % 360.0 for k in range(30)] + [359.97])
    page.wait_for_function("() => document.querySelector('section.panel output')?.textContent.trim() === '0.0°'")
    until(page, lambda: len(joined(drawn(page))) >= 25)
    lines = joined(drawn(page))
    assert max(abs(b - a) for a, b in lines) < 6.0, "a line runs across"
    labels = page.locator("section.panel output").all_inner_texts()
    assert not [text for text in labels if "360" in text]
    screenshot("plots-heading-north")


def test_a_turn_leaves_at_one_edge_and_comes_in_at_the_other(page: Any, past: Past, screenshot: Any) -> None:
    page.goto(f"{past.address}/#/vehicle/1/plots?show=own&channels=heading_deg&window=live-30")
    page.wait_for_selector("[data-panel] canvas")
    say(page, past, [(25.0 * k) % 360.0 for k in range(40)])
    page.wait_for_function("() => document.querySelector('section.panel output')?.textContent.trim() === '255.0°'")
    values = drawn(page)
    assert max(abs(b - a) for a, b in joined(values)) < 100.0, "a line runs across"
    edges = [(a, b) for a, gap, b in zip(values, values[1:], values[2:], strict=False) if gap is None]
    assert (360.0, 0.0) in edges
    assert upright(page) == [], "a line is drawn across"
    screenshot("plots-heading-turns")


def test_the_tile_of_a_heading_never_says_360(page: Any, past: Past) -> None:
    page.goto(f"{past.address}/#/vehicle/1")
    tile = page.locator("[data-channel='Heading']").first
    for heading, wanted in ((359.97, "0.0"), (359.94, "359.9"), (0.04, "0.0")):
        say(page, past, [heading])
        page.wait_for_function(
            "([tile, wanted]) => tile.querySelector('.value')?.textContent.replace(/[^\\d.]/g, '') === wanted",
            arg=[tile.element_handle(), wanted],
        )
        assert not re.search("360", tile.inner_text())
