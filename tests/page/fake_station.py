"""A stand-in for the station that answers the page with made-up values. For tests and work on the page only.

`python -m tests.page.fake_station 8080` serves the built page with it; 0 is a port that is free.
What has no oracle in the real station is not tested with it.
"""

import asyncio
import contextlib
import sys
import time
from pathlib import Path
from socket import create_server
from typing import Any

from fastapi import FastAPI, HTTPException, WebSocket, WebSocketDisconnect
from fastapi.staticfiles import StaticFiles

import stommel
from tests.page import fake_glider as glider

BUILT = Path(stommel.__file__).parent / "station" / "built"
SPEED = 20.0
PAST_S = 6.0 * 3600.0
_began = time.monotonic()


def now() -> float:
    """UTC of the made-up world."""
    return glider.EPOCH + PAST_S + (time.monotonic() - _began) * SPEED


def known(vehicle: int) -> None:
    """Answer 404 for other vehicles."""
    if vehicle not in (1, 2):
        raise HTTPException(404, {"reason": f"No vehicle {vehicle} is attached.", "allowed": "1, 2"})


def summaries() -> list[dict[str, Any]]:
    """Of both vehicles."""
    return [glider.summary(vehicle, now(), SPEED if vehicle == 1 else 1.0) for vehicle in (1, 2)]


def channels() -> list[dict[str, Any]]:
    """The table of channels as the page gets it."""
    return [
        {"key": key, "words": words, "unit": unit, "group": group, "standard_name": None, "period_s": period,
         "low": None, "high": None,
         **({"values": {str(k): v for k, v in (glider.STATES if key == "state" else glider.PHASES).items()}}
            if key in ("state", "phase") else {})}
        for key, words, unit, group, period in glider.CHANNELS
    ]  # fmt: skip


SHAPE = {
    "length_m": 1.8, "diameter_m": 0.2,
    "profile": [[0.0, 0.0], [0.05, 0.05], [0.12, 0.082], [0.25, 0.1], [1.35, 0.1], [1.55, 0.08], [1.7, 0.045],
                [1.8, 0.0]],
    "wings": {"span_m": 1.2, "chord_m": 0.14, "x_m": 0.85, "sweep_deg": 20.0},
    "rudder": {"height_m": 0.22, "chord_m": 0.1, "x_m": 1.62}, "moving_mass_range_m": [-0.06, 0.06],
    "bladder_range_ml": [-400.0, 400.0],
}  # fmt: skip
LIMITS = [
    {"channel": "depth_m", "low": None, "high": 200.0, "hysteresis": 2.0, "delay_s": 0.0, "severity": "warning"},
    {"channel": "voltage_v", "low": 24.0, "high": None, "hysteresis": 0.2, "delay_s": 60.0, "severity": "caution"},
    {"channel": "position_sigma_m", "low": None, "high": 200.0, "hysteresis": 20.0, "delay_s": 0.0,
     "severity": "caution"},
]  # fmt: skip
app = FastAPI()


@app.get("/api/station")
def station() -> dict[str, Any]:
    """Who answers."""
    return {"name": "Shore station", "version": "fake", "now": time.time(), "user": None, "login_required": False,
            "demo": True}  # fmt: skip


@app.get("/api/vehicles")
def vehicles() -> list[dict[str, Any]]:
    """All."""
    return summaries()


@app.get("/api/vehicles/{vehicle}")
def detail(vehicle: int) -> dict[str, Any]:
    """One, with what hardly changes."""
    known(vehicle)
    return {**summaries()[vehicle - 1], "channels": channels(), "limits": LIMITS, "shape": SHAPE}


@app.get("/api/vehicles/{vehicle}/latest")
def latest(vehicle: int) -> dict[str, Any]:
    """Latest values."""
    known(vehicle)
    t = now()
    found = {key: {"t": t - 1, "value": v, "age_s": 1, "period_s": 5, "stale": False}
             for key, v in glider.values(t).items()}  # fmt: skip
    return {"now": t, "values": found if vehicle == 1 else {}}


@app.get("/api/vehicles/{vehicle}/series")
def series(vehicle: int, channels: str, begin: float, end: float, points: int = 2000) -> dict[str, Any]:
    """Samples of the formula, at most so many."""
    begin, last = max(begin, glider.EPOCH), min(end, now())
    count = max(0, min(points, int((last - begin) / 2.0))) if vehicle == 1 else 0
    times = [begin + (last - begin) * i / max(1, count - 1) for i in range(count)]
    found = [glider.values(t) for t in times]
    return {
        "begin": begin,
        "end": end,
        "channels": {
            key: {"t": times, "value": [row.get(key) for row in found], "samples": count, "reduced": False}
            for key in channels.split(",")
        },
    }


@app.get("/api/vehicles/{vehicle}/track")
def track(vehicle: int, begin: float = 0.0, end: float = 1e12, points: int = 500) -> dict[str, Any]:
    """Where it was."""
    known(vehicle)
    last = min(end, now())
    first = max(begin, glider.EPOCH)
    times = [first + (last - first) * i / 199 for i in range(200)] if vehicle == 1 else []
    rows = [glider.values(t) for t in times]
    return {
        "begin": first, "end": last, "left_out": 0, "t": times, "latitude": [r["latitude_deg"] for r in rows],
        "longitude": [r["longitude_deg"] for r in rows], "sigma_m": [r["position_sigma_m"] for r in rows],
        "source": ["estimate"] * len(rows),
    }  # fmt: skip


@app.get("/api/vehicles/{vehicle}/dives")
def dives(vehicle: int) -> list[dict[str, Any]]:
    """Past dives with their currents."""
    count = int((now() - glider.EPOCH) // glider.CYCLE_S) if vehicle == 1 else 0
    rows = []
    for i in range(count):
        begin = glider.EPOCH + i * glider.CYCLE_S
        a, b = glider.values(begin), glider.values(begin + glider.DIVE_S)
        rows.append({
            "dive": i + 1, "begin": begin, "end": begin + glider.DIVE_S, "latitude_begin": a["latitude_deg"],
            "longitude_begin": a["longitude_deg"], "latitude_end": b["latitude_deg"],
            "longitude_end": b["longitude_deg"], "greatest_depth_m": glider.DEPTH_M, "current_north_m_s": 0.06,
            "current_east_m_s": 0.17, "energy_j": 8100.0,
        })  # fmt: skip
    return rows


@app.get("/api/vehicles/{vehicle}/mission")
def mission(vehicle: int) -> dict[str, Any]:
    """Waypoints aboard."""
    rows = [{"latitude": a, "longitude": b, "radius_m": 500.0} for a, b in ((30.72, 126.2), (30.64, 126.38),
                                                                          (30.55, 126.3))]  # fmt: skip
    return {"name": "east china sea", "waypoints": rows if vehicle == 1 else [], "geofence": []}


@app.get("/api/vehicles/{vehicle}/states")
def states(vehicle: int) -> dict[str, Any]:
    """The state machine."""
    return {
        "states": list(glider.STATES.values()),
        "transitions": [
            ["start-up", "hold", "ready"], ["hold", "mission", "mission is begun"], ["mission", "communicate",
             "at the surface"], ["communicate", "mission", "next dive"], ["mission", "ascend", "alarm"],
            ["ascend", "communicate", "at the surface"], ["mission", "abort", "abort"], ["abort", "recover",
             "at the surface"], ["communicate", "recover", "last waypoint"],
        ],
    }  # fmt: skip


@app.get("/api/alarms")
def alarms() -> list[dict[str, Any]]:
    """None that waits."""
    return []


@app.get("/api/vehicles/{vehicle}/limits")
def limits(vehicle: int) -> list[dict[str, Any]]:
    """Limits."""
    return LIMITS


@app.get("/api/layers")
def layers() -> list[dict[str, Any]]:
    """No chart of one's own."""
    return []


@app.post("/api/vehicles/{vehicle}/abort")
def abort(vehicle: int) -> dict[str, Any]:
    """Takes it."""
    known(vehicle)
    return {"id": "a1", "name": "abort", "state": "queued"}


async def _tell(socket: WebSocket, wanted: dict[str, dict[str, Any]]) -> None:
    while True:
        await asyncio.sleep(0.25)
        for key, subscription in list(wanted.items()):
            if subscription["vehicle"] == 1:
                await socket.send_json({"id": key, "vehicle": 1, **told(subscription)})
        if int(time.monotonic() * 4) % 4 == 0:
            for one in summaries():
                await socket.send_json({"type": "summary", "vehicle": one["vehicle"], "summary": one})


def told(subscription: dict[str, Any]) -> dict[str, Any]:
    """Values or samples of one subscription."""
    t = now()
    found = glider.values(t)
    names = [name for name in subscription["channels"] if name in found]
    if subscription.get("every"):
        return {"type": "samples", "now": t, "samples": {name: [[t], [found[name]]] for name in names}, "periods": {}}
    return {"type": "values", "now": t, "values": {name: [t, found[name]] for name in names}, "periods": {}}


@app.websocket("/api/live")
async def live(socket: WebSocket) -> None:
    """Live values four times a second."""
    await socket.accept()
    wanted: dict[str, dict[str, Any]] = {}
    await socket.send_json({"type": "hello", "now": time.time(), "vehicles": summaries()})
    teller = asyncio.create_task(_tell(socket, wanted))
    with contextlib.suppress(WebSocketDisconnect):
        while True:
            message = await socket.receive_json()
            if message["type"] == "subscribe":
                wanted[message["id"]] = message
            else:
                wanted.pop(message["id"], None)
    teller.cancel()


@app.api_route("/api/{path:path}", methods=["GET", "POST", "PUT", "DELETE"])
def unknown(path: str) -> None:
    """Say what the fake does not know."""
    raise HTTPException(404, {"reason": f"The fake station has no /{path}."})


app.mount("/", StaticFiles(directory=BUILT, html=True))


if __name__ == "__main__":
    import uvicorn

    with create_server(("127.0.0.1", int(sys.argv[1]))) as taken:
        sys.stdout.write(f"http://127.0.0.1:{taken.getsockname()[1]}\n")
        sys.stdout.flush()
        uvicorn.Server(uvicorn.Config(app, log_level="warning")).run(sockets=[taken])
