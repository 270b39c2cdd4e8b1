"""How a vehicle is, as the fleet shows it: what people ask first, and why what is missing is."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, Protocol

from stommel.archive import DiveRow
from stommel.archive.whereabouts.dive_ends import made_good, with_true_ends
from stommel.control.dive_cycle import PHASES, RECOVERY, SURFACE
from stommel.messages.mavlink import entry_words
from stommel.station.vehicles.whereabouts import Told, position_of

LAST_DIVES = 3
"""Whose mean duration tells when the vehicle surfaces next."""
AT_SURFACE = frozenset({PHASES[SURFACE], PHASES[RECOVERY]})
"""Words of phases in which the vehicle lies at the surface; in drift it hangs in the water."""
MOST_AHEAD = 3.2e7
"""A year: beyond, nobody waits [s]."""

Latest = Mapping[str, tuple[float, float]]


class Approach(NamedTuple):
    """How the distance to the waypoint changes."""

    since: float
    """From when on it was looked at [s since 1970]."""
    m_s: float
    """Distance that it loses [m/s]."""


class Usage(NamedTuple):
    """What the vehicle uses."""

    watts: float
    """In the mean."""
    dives: int
    """Over so many, each with the time at the surface after it."""


class Contact(Protocol):
    """Whether a vehicle is heard."""

    @property
    def heard(self) -> bool:
        """Whether it is."""

    @property
    def last_contact(self) -> float | None:
        """When it was last [s since 1970]."""

    @property
    def reason(self) -> str:
        """Why it is not."""


class Known(NamedTuple):
    """What a summary is made of."""

    vehicle: int
    name: str
    model: str
    simulated: bool
    speed: float
    now: float
    status: Contact
    latest: Latest
    dives: Sequence[DiveRow]
    """The last dives, the oldest first."""
    left_surface: float | None
    """When this dive began, where that was seen [s since 1970]."""
    approach: Approach | None
    place: tuple[Told | None, str] = (None, "")
    """Where it is, and why later positions are not believed."""
    usage: Usage | None = None
    """What the last dives used."""


def summary_of(known: Known) -> dict[str, Any]:
    """Return how a vehicle is; its alarms and who holds command are told by those who know them.

    next_surfacing
        The start of this dive, or of the next one, which follows after the time at the surface that the vehicle tells,
        and the mean duration of the last three dives.
    speed_made_good
        Distance between the positions at the begin and the end of the last dive, by its duration; over ground.
    current
        Depth-averaged current of the last dive that has one, as the vehicle found it from its drift.
    battery_lasts
        When the energy that the vehicle says is left is used up at the mean power of the last dives.
    eta
        The distance to the waypoint by the rate at which it has become less since the last dive began.

    A value that is not known is None, and `missing` has the reason by its name. `told` has when the vehicle told those
    that do not say it themselves.
    """
    latest, status = known.latest, known.status
    missing: dict[str, str] = {}
    found: dict[str, Any] = {
        "vehicle": known.vehicle, "name": known.name, "model": known.model, "simulated": known.simulated,
        "speed": known.speed, "now": known.now, "heard": status.heard,
        "last_contact": _last_contact(known), "link_reason": status.reason,
        "state": _words(latest, "state", "GLIDER_EXECUTIVE"), "phase": _words(latest, "phase", "GLIDER_PHASE"),
        "dive": _whole(latest, "dive"), "waypoint": _whole(latest, "waypoint"), "mission": _whole(latest, "mission"),
        "position": position_of(known.place), "battery": _battery(latest),
        "waypoint_distance_m": latest["waypoint_distance_m"][1] if "waypoint_distance_m" in latest else None,
    }  # fmt: skip
    found["next_surfacing"] = _next_surfacing(known, found["phase"], missing)
    found["speed_made_good"] = _speed_made_good(known.dives, missing)
    found["current"] = _current(known.dives, missing)
    found["eta"] = _eta(known, missing)
    found["battery_lasts"] = _battery_lasts(known, missing)
    found["missing"] = missing
    if found["position"] is None and known.place[1]:
        missing["position"] = known.place[1]
    found["told"] = {name: latest[name][0] for name in _WITHOUT_TIME if name in latest}
    for name, message in _TOLD.items():
        if found[name] is None and name not in missing:
            missing[name] = f"the vehicle has not told its {message} yet"
    if found["last_contact"] is None:
        missing["last_contact"] = "the vehicle was never heard"
    return found


_TOLD = {
    "state": "state", "phase": "phase", "dive": "dive", "waypoint": "waypoint", "mission": "mission",
    "position": "position", "battery": "battery", "waypoint_distance_m": "distance to the waypoint",
}  # fmt: skip
_WITHOUT_TIME = ("state", "phase", "dive", "waypoint", "mission", "waypoint_distance_m")
"""What is told as it is; when it was told stands beside it."""


def _last_contact(known: Known) -> float | None:
    times = [t for key, (t, _) in known.latest.items() if not key.startswith("link_") and t <= known.now + 60.0]
    if known.status.last_contact is not None:
        times.append(known.status.last_contact)
    return max(times, default=None)


def _whole(latest: Latest, key: str) -> int | None:
    return int(latest[key][1]) if key in latest else None


def _words(latest: Latest, key: str, enumeration: str) -> str | None:
    number = _whole(latest, key)
    return None if number is None else entry_words(enumeration).get(number, f"{key} {number}")


def _battery(latest: Latest) -> dict[str, Any] | None:
    share, voltage = latest.get("battery_left_share"), latest.get("voltage_v")
    if share is None and voltage is None:
        return None
    return {
        "share": None if share is None else share[1], "voltage_v": None if voltage is None else voltage[1],
        "t": max(pair[0] for pair in (share, voltage) if pair is not None),
    }  # fmt: skip


def _battery_lasts(known: Known, missing: dict[str, str]) -> dict[str, Any] | None:
    usage, name = known.usage, "battery_lasts"
    if "energy_left_kj" not in known.latest:
        missing[name] = "the vehicle has not told the energy that is left"
    elif usage is None:
        missing[name] = "fewer than two dives were seen to begin"
    else:
        t, left = known.latest["energy_left_kj"]
        lasts = 1e3 * left / usage.watts if usage.watts > 0.0 else math.inf
        if lasts <= MOST_AHEAD:
            dives = "dive" if usage.dives == 1 else f"{usage.dives} dives"
            return {
                "t": t + lasts,
                "why": f"at {usage.watts:.3g} W, the mean of the last {dives} and the time after each",
            }
        missing[name] = f"at {usage.watts:.2g} W, as it was of late, it would last more than a year"
    return None


def _duration(dive: DiveRow) -> float:
    return 0.0 if dive.t_end is None else dive.t_end - dive.t_begin


def _end(dive: DiveRow) -> float:
    return dive.t_begin if dive.t_end is None else dive.t_end


def _next_surfacing(known: Known, phase: str | None, missing: dict[str, str]) -> dict[str, Any] | None:
    times = [_duration(dive) for dive in known.dives[-LAST_DIVES:] if 0.0 < _duration(dive) < MOST_AHEAD]
    if not times:
        missing["next_surfacing"] = "no dive has ended yet, from which its duration could be told"
        return None
    mean = sum(times) / len(times)
    minutes = f"the last {len(times)} dives took {mean / 60.0:.0f} min" if len(times) > 1 else (
        f"the last dive took {mean / 60.0:.0f} min"
    )  # fmt: skip
    if phase in AT_SURFACE:
        left = known.latest.get("surface_time_left_s")
        at, _ = known.latest["phase"]
        if left is None or left[0] < at - 60.0:
            missing["next_surfacing"] = "it lies at the surface, and no dive is announced"
            return None
        return {"t": left[0] + left[1] + mean, "why": f"next dive in {left[1]:.0f} s, and {minutes}"}
    began = known.left_surface
    if began is None:
        missing["next_surfacing"] = "it was not seen when this dive began"
        return None
    return {"t": began + mean, "why": f"under way since it left the surface, and {minutes}"}


def _speed_made_good(dives: Sequence[DiveRow], missing: dict[str, str]) -> dict[str, Any] | None:
    for dive in map(with_true_ends, reversed(dives)):
        way = made_good(dive)
        if way is None or _duration(dive) <= 0.0:
            continue
        speed = way.distance_m / _duration(dive)
        return {"m_s": speed, "course_deg": way.bearing_deg, "dive": dive.dive, "t": _end(dive)}
    missing["speed_made_good"] = "no dive has ended yet with a position at both ends"
    return None


def _current(dives: Sequence[DiveRow], missing: dict[str, str]) -> dict[str, Any] | None:
    for dive in reversed(dives):
        if dive.current_north_m_s is not None and dive.current_east_m_s is not None:
            flow = {"north_m_s": dive.current_north_m_s, "east_m_s": dive.current_east_m_s}
            return flow | {"dive": dive.dive, "t": _end(dive)}
    missing["current"] = "no dive has ended yet whose drift tells the current"
    return None


def _eta(known: Known, missing: dict[str, str]) -> dict[str, float] | None:
    distance, approach = known.latest.get("waypoint_distance_m"), known.approach
    if distance is None:
        missing["eta"] = "the vehicle has told no distance to a waypoint"
    elif approach is None:
        missing["eta"] = "no dive has ended yet, from which its way could be told"
    elif approach.m_s * MOST_AHEAD <= distance[1]:
        missing["eta"] = "it has come no closer to the waypoint since the last dive began"
    else:
        return {"t": distance[0] + distance[1] / approach.m_s}
    return None
