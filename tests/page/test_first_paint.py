"""How soon something useful is seen, and how much has to be fetched for it. The bars are those of the issue."""

import math
import subprocess
import sys
from typing import Any

import pytest

from tests.page.conftest import ROOT
from tests.page.paint import is_too_busy, useful_paint_s
from tests.page.waiting import all_asked, at_rest


def test_the_first_useful_paint_comes_within_a_second(browser: Any, station: str) -> None:
    """Issue: first useful paint on loopback at most 1 s; the best of some, as the machine may be busy."""
    best = math.inf
    for _ in range(10):
        best = min(best, useful_paint_s(browser, station))
        if best <= 1.0:
            break
    if best > 1.0 and is_too_busy():
        pytest.skip(f"{best:.1f} s on a machine that is too busy to tell")
    assert best <= 1.0


def test_the_page_weighs_at_most_a_megabyte(built: None) -> None:
    """Issue: page weight at most 1 MB compressed; the script that `make page` runs fails when it is more."""
    script = subprocess.run([sys.executable, ROOT / "page" / "weight.py"], check=False, capture_output=True, text=True)
    assert script.returncode == 0, script.stderr
    assert "at most 1000 kB" in script.stdout


def test_the_station_asks_no_other_host(page: Any, station: str) -> None:
    """Issue: no network needed at run time. Every request of the first view goes to the station."""
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    page.goto(f"{station}/#/vehicle/1")
    page.locator(".stage canvas").wait_for()
    at_rest(page)
    all_asked(page)
    assert asked
    assert [url for url in asked if not url.startswith((station, "data:", "blob:"))] == []
