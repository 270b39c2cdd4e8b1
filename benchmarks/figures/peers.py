"""The 20-day mission side by side with what a user would pick instead, each on one core, in one run.

stommel flies the whole mission with eight degrees of freedom, actuators, sensors, stratified sea, control, energy and
output. The peers do part of that (`peer_gliderflight`, `peer_jsbsim` say which) and for a piece of it, since their time
grows with what they simulate and with nothing else. All take turns, so that a slow spell of the machine meets every one
of them, and the least of the repeats counts. Loading and compiling are left out on every side.
"""

import os
import tempfile
from collections.abc import Callable
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np

from figures import peer_gliderflight, peer_jsbsim
from figures.reference_flight import NAME, Leg, reference_flight
from figures.registry import Measurement, figure
from stommel.simulation.flight import fly_mission
from stommel.simulation.scenario.loading import load_mission
from stommel.simulation.scenario.shipped import mission_path

REPEATS = 3
JSBSIM_HOURS = 2
COARSE_RATE = 10
"""Steps a second at which JSBSim still flies these dives; at 5 it diverges at the turn."""
SAILPLANE_S = 1200

_Timed = Callable[[], tuple[float, float]]
"""Flies and returns simulated time and processor time [s]."""


def _missing(package: str) -> str | None:
    """Why a peer cannot be measured, or None."""
    if find_spec(package) is not None:
        return None
    return f"{package} is not installed: `make bench` installs it, or pip install 'stommel[bench]'"


def _stommel() -> _Timed:
    mission = load_mission(mission_path(NAME))
    fly_mission(mission)  # compiles

    def fly() -> tuple[float, float]:
        start = process_time()
        fly_mission(mission)
        return mission.scenario.duration_days * 86400.0, process_time() - start

    return fly


def _gliderflight(glider: Any, pieces: list[peer_gliderflight.Series]) -> _Timed:
    def solve() -> tuple[float, float]:
        start = process_time()
        for given in pieces:
            peer_gliderflight.solve(glider, given)
        return sum(float(np.ptp(given["time"])) for given in pieces), process_time() - start

    return solve


def _jsbsim(folder: Path) -> _Timed:
    plan, seconds = peer_jsbsim.plan_of(reference_flight()), 3600 * JSBSIM_HOURS
    return lambda: (float(seconds), peer_jsbsim.timed_flight(folder, plan, seconds)[0])


def _speed_up(timed: _Timed, repeats: int = 1) -> float:
    """Simulated time over processor time, the best of the repeats."""
    return max(simulated / processor for simulated, processor in (timed() for _ in range(repeats)))


@cache
def _speed_ups() -> dict[str, float]:
    """Simulated time over processor time of stommel and of the peers that are installed."""
    with tempfile.TemporaryDirectory() as name:
        folder, flight = Path(name), reference_flight()
        contenders = {"stommel": _stommel()}
        if not _missing("gliderflight"):
            dives = peer_gliderflight.dives(flight, peer_gliderflight.series(flight, measured=True))
            contenders["gliderflight"] = _gliderflight(peer_gliderflight.model(flight), dives)
        if not _missing("jsbsim"):
            peer_jsbsim.write_aircraft(flight, folder)
            contenders["jsbsim"] = _jsbsim(folder)
        rounds = [{name: _speed_up(timed) for name, timed in contenders.items()} for _ in range(REPEATS)]
    return {name: max(one[name] for one in rounds) for name in contenders}


@figure(unit="x", bar=200.0, at_least=True)
def ratio_to_gliderflight() -> Measurement:
    """How many times faster stommel flies the mission than gliderflight follows the record of its dives at 1 Hz.

    gliderflight's speed depends on its input. The figure is for what its users have: pitch and pressure as instruments
    measured them, under water. The detail has it with the stays at the surface, which cost gliderflight next to nothing
    and stommel as much as any other time; with true pitch and pressure, whose lack of noise lets it take longer steps;
    and on the recorded Slocum flight of its own example, where that file is at hand.
    """
    missing = _missing("gliderflight")
    if missing:
        return Measurement(None, {"skipped": missing})
    ours, flight, glider = _speed_ups()["stommel"], reference_flight(), peer_gliderflight.model(reference_flight())
    measured, true = (peer_gliderflight.series(flight, measured=one) for one in (True, False))
    others = {"without_sensor_noise": (glider, peer_gliderflight.dives(flight, true))}
    comet = peer_gliderflight.comet_series()
    if comet is not None:
        others["on_its_own_example"] = (peer_gliderflight.comet_model(), [comet])
    others["with_stays_at_the_surface"] = (glider, [measured])
    detail = _sides("gliderflight")
    for name, (model, pieces) in others.items():
        theirs = _speed_up(_gliderflight(model, pieces), REPEATS)
        detail[name] = {"gliderflight_speed_up": theirs, "ratio": ours / theirs}
    detail["rms_speed_difference_m_s"] = peer_gliderflight.speed_error(flight, glider)  # of the last: the whole record
    return Measurement(ours / detail["gliderflight_speed_up"], detail)


@figure(unit="x", bar=500.0, at_least=True)
def ratio_to_jsbsim() -> Measurement:
    """How many times faster stommel flies the mission than JSBSim flies its dives at JSBSim's own 120 steps a second.

    The detail has the speeds and pitch angles of both, what JSBSim reaches with the coarsest step at which it is stable
    and how far its depth is then from that at 120 steps, and the speed of the sailplane that comes with JSBSim.
    """
    missing = _missing("jsbsim")
    if missing:
        return Measurement(None, {"skipped": missing})
    found, flight = _speed_ups(), reference_flight()
    ours = found["stommel"]
    plan, seconds = peer_jsbsim.plan_of(flight), 3600 * JSBSIM_HOURS
    with tempfile.TemporaryDirectory() as name:
        peer_jsbsim.write_aircraft(flight, Path(name))
        _, rows = peer_jsbsim.timed_flight(Path(name), plan, seconds)
        processor, coarse = peer_jsbsim.timed_flight(Path(name), plan, seconds, COARSE_RATE)
    down, up = peer_jsbsim.legs_of(rows, plan.depth)
    sailplane = peer_jsbsim.sailplane_speed(SAILPLANE_S)
    detail = _sides("jsbsim") | {
        "steps_per_s": peer_jsbsim.DEFAULT_RATE,
        "descent": _compared(plan.down, down),
        "climb": _compared(plan.up, up),
        "coarse": {
            "steps_per_s": COARSE_RATE,
            "jsbsim_speed_up": seconds / processor,
            "ratio": ours * processor / seconds,
            "depth_difference_m": float(np.abs(rows[:, 1] - coarse[:, 1]).max()),
        },
        "its_own_sailplane": {"jsbsim_speed_up": sailplane, "ratio": ours / sailplane},
    }
    return Measurement(ours / found["jsbsim"], detail)


@figure(unit="x", bar=20.0, at_least=True)
def ratio_to_jsbsim_at_10_hz() -> Measurement:
    """As `ratio_to_jsbsim`, with JSBSim at 10 steps a second, the coarsest at which it flies these dives.

    stommel's own step is adapted: from about one to some ten steps a second where something moves.
    """
    missing = _missing("jsbsim")
    if missing:
        return Measurement(None, {"skipped": missing})
    found, flight = _speed_ups(), reference_flight()
    plan, seconds = peer_jsbsim.plan_of(flight), 3600 * JSBSIM_HOURS
    with tempfile.TemporaryDirectory() as name:
        peer_jsbsim.write_aircraft(flight, Path(name))
        theirs = max(
            seconds / peer_jsbsim.timed_flight(Path(name), plan, seconds, COARSE_RATE)[0] for _ in range(REPEATS)
        )
    detail = _sides("jsbsim") | {"jsbsim_speed_up": theirs, "steps_per_s": COARSE_RATE}
    return Measurement(found["stommel"] / theirs, detail)


def _sides(peer: str) -> dict[str, Any]:
    found = _speed_ups()
    return {
        "stommel_speed_up": found["stommel"],
        f"{peer}_speed_up": found[peer],
        "repeats": REPEATS,
        "load_average": os.getloadavg()[0],
    }


def _compared(ours: Leg, theirs: Leg) -> dict[str, list[float]]:
    """Mean speed and pitch in the middle half of the water, stommel's first."""
    return {
        "speed_m_s": [ours.speed, theirs.speed],
        "pitch_deg": [float(np.degrees(ours.pitch)), float(np.degrees(theirs.pitch))],
    }
