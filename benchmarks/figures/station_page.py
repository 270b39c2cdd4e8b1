"""The page of the shore station: how heavy it is, and how soon it can be read."""

import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

from figures.registry import Measurement, figure

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT), str(ROOT / "page")]


@figure(unit="kB", bar=1000.0)
def station_page_kb() -> Measurement:
    """Weigh all files of the built page, each compressed as the station sends it."""
    from weight import weights  # noqa: PLC0415  # page/weight.py, which `make page` runs

    found = weights()
    if not found:
        return Measurement(None, {"skipped": "the page is not built: make page"})
    heaviest = sorted(found.items(), key=lambda item: -item[1])[:5]
    return Measurement(sum(found.values()), {"files": len(found), "heaviest": dict(heaviest)})


@figure(unit="s", bar=1.0)
def station_first_paint_s() -> Measurement:
    """Time from the start of the navigation to the first vehicle on the screen, in a new Chromium on loopback."""
    from playwright.sync_api import sync_playwright  # noqa: PLC0415

    from tests.page.paint import useful_paint_s  # noqa: PLC0415
    from tests.support.chromium import chromium  # noqa: PLC0415

    program = chromium()
    if program is None:
        return Measurement(None, {"skipped": "no Chromium: chromium-headless-shell or chromium of Debian"})
    with _station() as address, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=str(program), args=["--no-sandbox", "--disable-gpu"])
        times = [useful_paint_s(browser, address) for _ in range(9)]
        browser.close()
    return Measurement(median(times), {"best_s": min(times), "worst_s": max(times), "browser": program.name})


@contextmanager
def _station() -> Iterator[str]:
    """A station whose vehicle is out of reach: what is measured is the page."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        port = one.getsockname()[1]
    with TemporaryDirectory() as folder:
        code = "from stommel.cli import main; main()"
        arguments = ["--folder", folder, "--port", str(port), "--link", "tcp:127.0.0.1:9", "--unsigned"]
        process = subprocess.Popen([sys.executable, "-c", code, "station", *arguments], stdout=subprocess.DEVNULL)
        try:
            _await(f"http://127.0.0.1:{port}", process)
            yield f"http://127.0.0.1:{port}"
        finally:
            process.terminate()
            process.wait(timeout=20)


def _await(address: str, process: "subprocess.Popen[bytes]") -> None:
    until = time.monotonic() + 60.0
    while time.monotonic() < until and process.poll() is None:
        try:
            urllib.request.urlopen(f"{address}/api/station", timeout=5.0).close()
        except OSError:
            time.sleep(0.1)
        else:
            return
    raise RuntimeError(f"the station does not answer at {address}; its status is {process.poll()}")
