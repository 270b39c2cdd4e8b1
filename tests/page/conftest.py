"""The page in Chromium: a station to look at, a browser, pictures under build/screenshots.

`STOMMEL_PAGE_SLOW=8` makes the browser's processor eight times slower: tests that do not wait for what they ask fail.
`STOMMEL_PAGE_JITTER=400` holds each answer back for up to that many milliseconds, so that they come in any order: what
a view shows for a moment only, before or after something else, is met then.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections.abc import Callable, Generator, Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

import stommel
from tests.page.waiting import PATIENCE_S, Traffic, until
from tests.support.chromium import chromium

if TYPE_CHECKING:
    from tests.page.past import Past
    from tests.page.played_station import PlayedStation
    from tests.page.quay import Quay

ROOT = Path(__file__).resolve().parents[2]
BUILT = Path(stommel.__file__).parent / "station" / "built" / "index.html"
ARGUMENTS = [
    "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync", "--js-flags=--expose-gc",
    "--enable-precise-memory-info",
]  # fmt: skip
AXE = ROOT / "page" / "node_modules" / "axe-core" / "axe.min.js"
SPEED = "60" if "STOMMEL_PAGE_SOAK" in os.environ else "20"
"""Of the simulated glider, times real time."""
SLOW = float(os.environ.get("STOMMEL_PAGE_SLOW", "1"))
JITTER_MS = float(os.environ.get("STOMMEL_PAGE_JITTER", "0"))
HELD_BACK = """(most => {
    const ask = window.fetch;
    window.heldBack = 0;
    window.fetch = async (...asked) => {
        window.heldBack += 1;
        try {
            await new Promise(done => setTimeout(done, most * Math.random()));
            return await ask(...asked);
        } finally {
            window.heldBack -= 1;
        }
    };
})"""
Screenshot = Callable[[str], Path]


def answers(said: Path, process: "subprocess.Popen[bytes]", seconds: float = 240.0) -> str:
    """The address that a server says, once it answers there; fail with its words if it ends before."""
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        words = said.read_text(encoding="utf-8", errors="replace")
        assert process.poll() is None, f"the server ended with status {process.returncode}: {words}"
        try:
            if found := re.search(r"http://[\d.]+:\d+", words):
                urllib.request.urlopen(f"{found[0]}/api/station", timeout=60.0).close()
                return found[0]
        except OSError:
            pass
        time.sleep(0.1)
    pytest.fail(f"the server does not answer within {seconds} s")


def serve(command: list[str]) -> "Iterator[tuple[subprocess.Popen[bytes], str]]":
    """A server while it is needed, and its address; it is ended as Ctrl-C would, and killed if that does not help.

    It takes a port of its own, which nobody else can have taken before, and says which.
    """
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(Path(stommel.__file__).parents[1]), str(ROOT)])}
    with tempfile.NamedTemporaryFile() as said:
        process = subprocess.Popen(command, cwd=ROOT, env=environment, stdout=said)
        try:
            yield process, answers(Path(said.name), process)
        finally:
            process.terminate()
            try:
                process.wait(timeout=60)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Tell with a failure what the page showed and what the station knew, and keep a picture: CI is not run again."""
    report = yield
    if report.when == "call" and report.failed:
        found = getattr(item, "funcargs", {})
        for title, told in seen_at_failure(item.name, found.get("page"), found.get("station")):
            report.sections.append((title, told))
    return report


def keep_picture(page: Any, name: str) -> Path:
    """Keep a picture of the page in build/screenshots; where it is."""
    folder = ROOT / "build" / "screenshots"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.png"
    page.screenshot(path=path)
    return path


def seen_at_failure(name: str, page: Any, station: object) -> Iterator[tuple[str, str]]:
    """Words of the page, and vehicle, commands and alarms of the station, as far as either still answers."""
    if page is not None:
        try:
            keep_picture(page, f"failed-{re.sub(r'[^A-Za-z0-9_]+', '-', name)}")
            yield f"page {page.url}", page.locator("body").inner_text(timeout=5_000)
        except Exception as error:  # noqa: BLE001 - a closed page, a browser that died: the failure is told all the same
            yield "page", f"it does not answer: {error}"
    if isinstance(station, str):
        for path in ("/vehicles/1", "/vehicles/1/commands", "/alarms"):
            try:
                with urllib.request.urlopen(f"{station}/api{path}", timeout=10.0) as answer:
                    yield f"station {path}", answer.read(20_000).decode()
            except OSError as error:
                yield f"station {path}", f"it does not answer: {error}"


@pytest.fixture(scope="package")
def built() -> None:
    """The page, which `make page` builds; `make test` does so before."""
    if not BUILT.exists():
        pytest.skip("the page is not built: make page")


@pytest.fixture(scope="package")
def fake_station(built: None) -> Iterator[str]:
    """Address of a stand-in whose answers are made up: quick, with every state of the page on demand."""
    for _, address in serve([sys.executable, "-m", "tests.page.fake_station", "0"]):
        yield address


def station_command(folder: Path, *arguments: str) -> list[str]:
    """Command line of the real station."""
    code = "from stommel.cli import main; main()"
    return [sys.executable, "-c", code, "station", "--folder", str(folder), "--port", "0", *arguments]


@pytest.fixture(scope="package")
def station(built: None, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Address of the real station with a simulated glider beside it, as `make run` starts it."""
    folder = tmp_path_factory.mktemp("station") / "flight"
    for _, address in serve(station_command(folder, "--sitl", "east_china_sea", "--speed", SPEED)):
        heard(address)
        yield address


def heard(address: str, seconds: float = 600.0) -> None:
    """Wait until the first vehicle has told its state: a cold simulator compiles for a minute."""
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        with urllib.request.urlopen(f"{address}/api/vehicles/1", timeout=60.0) as answer:
            if json.load(answer)["state"] is not None:
                return
        time.sleep(0.5)
    pytest.fail(f"the simulated glider told nothing within {seconds} s")


@pytest.fixture(scope="package")
def browser() -> "Iterator[object]":
    """Debian's Chromium without a window; while it is there, no other event loop runs in this thread."""
    sync_api = pytest.importorskip("playwright.sync_api")
    program = chromium()
    if program is None:
        pytest.skip("no Chromium: chromium-headless-shell or chromium of Debian")
    sync_api.expect.set_options(timeout=1e3 * PATIENCE_S)
    with sync_api.sync_playwright() as playwright:
        launched = playwright.chromium.launch(executable_path=str(program), args=ARGUMENTS)
        yield launched
        launched.close()


@pytest.fixture
def page(browser, request: pytest.FixtureRequest):
    """A page whose browser has seen the tour; what it throws fails the test. Options of the context by parameter."""
    options = getattr(request, "param", {})
    context = browser.new_context(**{"viewport": {"width": 1440, "height": 900}, "reduced_motion": "reduce", **options})
    context.add_init_script("localStorage.setItem('stommel-tour', 'done')")
    if JITTER_MS > 0.0:
        context.add_init_script(f"{HELD_BACK}({JITTER_MS})")
    tab = context.new_page()
    tab.set_default_timeout(1e3 * PATIENCE_S)
    Traffic(tab)
    if SLOW > 1.0:
        context.new_cdp_session(tab).send("Emulation.setCPUThrottlingRate", {"rate": SLOW})
    thrown: list[str] = []
    tab.on("pageerror", lambda error: thrown.append(str(error)))
    yield tab
    context.close()
    assert not thrown, f"the page threw: {thrown}"


@pytest.fixture
def screenshot(page) -> Screenshot:
    """Keeps a picture of the page in build/screenshots, which CI keeps and people look at."""
    return partial(keep_picture, page)


@pytest.fixture
def serious(page) -> Callable[[], list[str]]:
    """Serious and critical findings of axe-core on the page as it is now."""
    if not AXE.exists():
        pytest.skip("axe-core is not installed: make page")

    source = AXE.read_text(encoding="utf-8") + ";0"

    def find() -> list[str]:
        page.evaluate(source)  # not a script tag: the station's content security policy forbids foreign scripts
        found = page.evaluate("axe.run(document, {resultTypes: ['violations']})")["violations"]
        return [
            f"{one['id']}: {node['target']} {node['failureSummary']}"
            for one in found
            if one["impact"] in ("serious", "critical")
            for node in one["nodes"]
        ]

    return find


@pytest.fixture(scope="package")
def past(built: None, tmp_path_factory: pytest.TempPathFactory) -> "Iterator[Past]":
    """A real station with six hours of the past, and a vehicle that says what a test wants."""
    from tests.page.past import past_station

    with past_station(tmp_path_factory.mktemp("past")) as found:
        yield found


@pytest.fixture(scope="package")
def quay(built: None, tmp_path_factory: pytest.TempPathFactory) -> "Iterator[Quay]":
    """A real station whose vehicle has files, parameters and missions over a slow line, and whose disk may be full."""
    from tests.page.quay import quay_station

    with quay_station(tmp_path_factory.mktemp("quay")) as found:
        yield found


@pytest.fixture(scope="package")
def manned(built: None, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Address of a real station at which the people of `tests.page.manned` log in."""
    from tests.page.manned import manned_station

    with manned_station(tmp_path_factory.mktemp("manned")) as address:
        yield address


@pytest.fixture
def played(page: Any, fake_station: str) -> "PlayedStation":
    """A station whose socket the test plays, and a vehicle view that has asked it for values."""
    from tests.page.played_station import PlayedStation

    station = PlayedStation(page)
    page.goto(f"{fake_station}/#/vehicle/1")
    page.wait_for_function("document.querySelectorAll('.tile').length > 20")
    until(page, lambda: bool(station.ids("temperature_degc")))
    return station
