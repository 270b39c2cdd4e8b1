"""Hours of use: neither memory nor WebGL contexts grow.

nasa/openmct#8387, #5419, #7074: plots leaked memory, WebGL contexts ran out. The whole of it, 8 h at 60 times real time
with 200 view changes, takes 8 min: STOMMEL_PAGE_SOAK=200.
"""

import itertools
import json
import os
from typing import Any, NamedTuple

from tests.page.test_every_view import STATION_VIEWS, VEHICLE_VIEWS, address_of
from tests.page.waiting import at_rest, passes

CHANGES = int(os.environ.get("STOMMEL_PAGE_SOAK", "28"))
WHOLE = CHANGES >= 200
STAY_MS = 2400 if WHOLE else 0
"""In a view, once it is drawn: 200 times 2.4 s are 8 min, 8 h at 60 times real time."""
ROUNDS_BEFORE = 5
"""Every view is opened so often before the first measurement: code is fetched, and compiled as it gets warm."""
ALLOWED = 1.05
COUNTING = """
  window.contexts = [];
  const get = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    const found = get.call(this, kind, ...rest);
    if (found && kind.startsWith('webgl') && !window.contexts.includes(found)) window.contexts.push(found);
    return found;
  };
"""


class Use(NamedTuple):
    """What the page holds after the garbage is collected."""

    heap: float
    nodes: int
    listeners: int
    contexts: int


def held(client: Any) -> float:
    """Bytes of the heap but for compiled code, of which V8 makes more as functions get hot, up to its own bound."""
    chunks: list[str] = []
    client.on("HeapProfiler.addHeapSnapshotChunk", lambda event: chunks.append(event["chunk"]))
    client.send("HeapProfiler.takeHeapSnapshot", {"reportProgress": False})
    snapshot = json.loads("".join(chunks))
    meta = snapshot["snapshot"]["meta"]
    fields, kinds = meta["node_fields"], meta["node_types"][0]
    step, sizes = len(fields), snapshot["nodes"][fields.index("self_size") :: len(fields)]
    code = kinds.index("code")
    types = snapshot["nodes"][fields.index("type") :: step]
    return float(sum(size for kind, size in zip(types, sizes, strict=True) if kind != code))


def used(page: Any) -> Use:
    """Measure when no request is under way; what waits for an answer is still needed. Lost contexts do not count."""
    at_rest(page)
    page.evaluate("window.contexts = window.contexts.filter((one) => !one.isContextLost())")
    client = page.context.new_cdp_session(page)
    for _ in range(4):
        client.send("HeapProfiler.collectGarbage")
        passes(page, 200)
    counters = client.send("Memory.getDOMCounters")
    use = Use(held(client), counters["nodes"], counters["jsEventListeners"], page.evaluate("window.contexts.length"))
    client.detach()
    return use


def test_view_changes_leave_nothing_behind(page: Any, station: str, record_property: Any) -> None:
    """Issue: 8 h of page use at 60 times speed, 200 view changes: heap and WebGL contexts flat within 5 %."""
    page.add_init_script(COUNTING)
    page.goto(f"{station}/#/fleet")
    page.locator("main > *").first.wait_for()
    views = [address_of(view) for view in (*STATION_VIEWS, *VEHICLE_VIEWS)]

    def look(address: str, stay: int) -> None:
        page.evaluate("(address) => { location.hash = address; }", address)
        at_rest(page)
        passes(page, stay)

    for address in views * ROUNDS_BEFORE:
        look(address, 900 if WHOLE else 0)
    look("#/vehicle/1", 1500)
    before = used(page)
    for address in itertools.islice(itertools.cycle(views), CHANGES):
        look(address, STAY_MS)
    look("#/vehicle/1", 1500)
    after = used(page)
    record_property("use", f"{CHANGES} view changes: {before} -> {after}")
    assert before.contexts == after.contexts == 1
    assert after.heap <= ALLOWED * before.heap, (before, after)
    assert after.nodes <= ALLOWED * before.nodes + 200, (before, after)
