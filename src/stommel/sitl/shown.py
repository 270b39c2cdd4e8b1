"""What a live view shows of a system: names and values as words, and which of them are no good news."""

from datetime import timedelta
from math import atan2, cos, degrees, hypot, isfinite
from typing import NamedTuple

from stommel.control.memory import MEMORY
from stommel.geometry.attitude import wrapped
from stommel.geometry.earth import MEAN_RADIUS
from stommel.onboard.coordination.failsafes import Reaction
from stommel.onboard.coordination.health import (
    ACQUISITION_NODE,
    ALTIMETER,
    BATTERY_GAUGE,
    COMPASS,
    CTD,
    GPS,
    MOTION_NODE,
    PRESSURE_SENSOR,
    RADIO,
    Condition,
    SourceHealth,
)
from stommel.onboard.coordination.view import View
from stommel.sitl.observer import Observer
from stommel.sitl.system import System

_MOST_HOURS = 1e5
"""A longer time is none that is known: at rest, or just switched on [h]."""
WELL, QUIET, ODD, BAD = "well", "quiet", "odd", "bad"
"""How a value is: as it should be, of no interest now, worth a look, wrong."""

HOW = {
    Condition.OFF: QUIET, Condition.WAITING: QUIET, Condition.WELL: WELL, Condition.LATE: ODD, Condition.SILENT: BAD,
    Condition.REFUSED: BAD,
}  # fmt: skip
_NODES = (MOTION_NODE, ACQUISITION_NODE)

assert {"latitude", "longitude", "waypoint", "heading_wanted", "energy_used"} <= set(MEMORY.names or ())


class Line(NamedTuple):
    """One named value."""

    name: str
    value: str
    how: str = WELL


class Slider(NamedTuple):
    """An actuator: where it stands between its ends, and where it shall."""

    name: str
    low: float
    high: float
    measured: float
    wanted: float
    unit: str
    runs: str
    """What moves it now, in a word; empty at rest."""


class Shown(NamedTuple):
    """All of a moment."""

    mission: str
    date: str
    elapsed: str
    state: str
    because: str
    state_how: str
    flight: tuple[Line, ...]
    actuators: tuple[Slider, ...]
    power: tuple[Line, ...]
    bus: tuple[Line, ...]
    instruments: tuple[Line, ...]
    place: tuple[Line, ...]
    alarms: tuple[tuple[str, str, str], ...]
    """Name, since when, how grave."""
    events: tuple[tuple[str, str, bool], ...]
    """When, what, whether it is grave."""
    depths: tuple[float, ...]
    """The last ones [m]."""
    depths_span: float
    """Time that they tell [s]."""


def shown(system: System, observer: Observer) -> Shown:
    """Look at a system that has made a step."""
    view = system.coordinator.view
    assert view is not None, "a step comes before the first look"
    scenario, t = system.mission.scenario, view.t
    executive = view.executive
    return Shown(
        mission=f"{scenario.name} · {system.mission.vehicle.name}",
        date=f"{scenario.start_time + timedelta(seconds=t):%Y-%m-%d %H:%M} UTC",
        elapsed=clock(t),
        state=executive.words,
        because=f"since {clock(executive.since)}: {executive.because}",
        state_how=BAD if executive.coming_up else WELL,
        flight=_flight(system, view),
        actuators=_actuators(system, view),
        power=_power(system, view),
        bus=_bus(system, view),
        instruments=_instruments(system, view),
        place=_place(system),
        alarms=tuple(_alarms(view)),
        events=tuple((clock(event.t), event.words, event.grave) for event in observer.events),
        depths=tuple(observer.depths),
        depths_span=observer.interval * max(0, len(observer.depths) - 1),
    )


def clock(t: float) -> str:
    """A time of the mission as days, hours, minutes and seconds."""
    minutes, seconds = divmod(int(t), 60)
    hours, minutes = divmod(minutes, 60)
    days, hours = divmod(hours, 24)
    return f"{days} d {hours:02}:{minutes:02}:{seconds:02}" if days else f"{hours:02}:{minutes:02}:{seconds:02}"


def _flight(system: System, view: View) -> tuple[Line, ...]:
    r, seen, memory = view.situation.readings, system.coordinator.perception, system.coordinator.pilot.memory
    attitude = seen.attitude
    wanted = "" if memory is None else f", wanted {_course(float(memory.heading_wanted))}"
    compass = BAD if view.situation.compass_silent else WELL
    roll = degrees(atan2(attitude.down_b2, attitude.down_b3))
    bottom = f"{r.altitude:.1f} m" if isfinite(r.altitude) else "out of reach"
    return (
        Line("depth", _number(r.depth, ".1f", "m"), BAD if view.situation.pressure_silent else WELL),
        Line("to the bottom", bottom, WELL if isfinite(r.altitude) else QUIET),
        Line("pitch, roll", f"{_number(degrees(r.theta), '+.1f', '°')}, {roll:+.1f}°", compass),
        Line("heading", f"{_course(r.psi)}{wanted}", compass),
    )


def _actuators(system: System, view: View) -> tuple[Slider, ...]:
    limits, r, c = system.coordinator.settings.actuators, view.situation.readings, view.commands
    says = system.coordinator.perception.says
    oil = "pump" if says("MotionDrives", "pump_running") else "valve" if says("MotionDrives", "valve_open") else ""
    mass = "runs" if says("MotionDrives", "mass_moving") else ""
    turns = "runs" if says("MotionDrives", "steering_moving") else ""
    most = degrees(limits.steering)
    return (
        Slider("oil", 1e6 * limits.V_b_least, 1e6 * limits.V_b_greatest, 1e6 * r.V_b, 1e6 * c.V_b, "ml", oil),
        Slider("mass", 1e3 * limits.r_px_aft, 1e3 * limits.r_px_fore, 1e3 * r.r_px, 1e3 * c.r_px, "mm", mass),
        Slider("steering", -most, most, degrees(r.steering), degrees(c.steering), "°", turns),
    )


def _power(system: System, view: View) -> tuple[Line, ...]:
    r, seen, memory = view.situation.readings, system.coordinator.perception, system.coordinator.pilot.memory
    used = 0.0 if memory is None else float(memory.energy_used) / 3600.0
    gauge = BAD if view.situation.battery_silent else WELL
    wet = view.situation.leak_fore or view.situation.leak_aft
    return (
        Line("battery", f"{_number(r.voltage, '.2f', 'V')}, {_number(r.current, '.2f', 'A')}", gauge),
        Line("used", f"{used:.2f} Wh{_left(view)}"),
        Line(
            "in the hull",
            f"{_number(r.internal_pressure / 1e3, '.1f', 'kPa')}, {seen.value('Hull', 'temperature'):.1f} °C",
        ),
        Line("leak", "water in the hull" if wet else "dry", BAD if wet else WELL),
    )


def _left(view: View) -> str:
    """How long the rest of the battery lasts, once a mean power is known."""
    if view.battery is None or view.battery.hours_left > _MOST_HOURS:
        return ""
    return f", {view.battery.hours_left / 24.0:.1f} days left"


def _bus(system: System, view: View) -> tuple[Line, ...]:
    decoder, watch = system.coordinator.perception.decoder, system.coordinator.perception.watch
    health = {source.name: source for source in view.health.sources}
    lost, rejected = decoder.lost.total(), decoder.rejected.total()
    lines = [
        Line("load", f"{system.bus.load(view.t + system.plant.step):.1%} of 250 kbit/s"),
        Line("frames", f"{decoder.received.total():,}"),
        Line("lost, rejected", f"{lost}, {rejected}", ODD if lost or rejected else WELL),
    ]
    for node, name in zip(watch.snapshot(view.t).nodes, _NODES, strict=True):
        source = health[name]
        heard = source.condition in (Condition.WELL, Condition.LATE)
        words = node.state if heard else node.refused or source.condition.value
        how = ODD if heard and node.state != "Operational" else HOW[source.condition]
        lines.append(Line(node.name.lower(), words.lower() + counts(source), how))
    return tuple(lines)


def _instruments(system: System, view: View) -> tuple[Line, ...]:
    """Of each instrument one word; those behind the acquisition node only where they are not well."""
    own = system.coordinator.instruments
    words = {COMPASS: str(own.compass.health(view.t).state), GPS: str(own.gnss.health(view.t).state), RADIO: "on"}
    words |= {CTD: "samples", ALTIMETER: "answers"}
    sources = {source.name: source for source in view.health.sources}
    behind = [name for name in (PRESSURE_SENSOR, BATTERY_GAUGE) if sources[name].condition is not Condition.WELL]
    lines = []
    for name in (*words, *behind):
        source, condition = sources[name], sources[name].condition
        speaks = condition in (Condition.WELL, Condition.WAITING) and name in words
        lines.append(Line(name, (words[name] if speaks else condition.value) + counts(source), HOW[condition]))
    return tuple(lines)


def counts(source: SourceHealth) -> str:
    """What of a source was lost and rejected, how often it was silent before and started anew: in words, no zeros."""
    before = source.silences - (source.condition is Condition.SILENT)
    told = (
        (source.lost, "lost"), (source.rejected, "rejected"), (before, "× silent"),
        (source.restarts, "× restarted"),
    )  # fmt: skip
    words = ", ".join(f"{count}{'' if what[0] == '×' else ' '}{what}" for count, what in told if count)
    return f" ({words})" if words else ""


def _place(system: System) -> tuple[Line, ...]:
    pilot = system.coordinator.pilot
    m, orders = pilot.memory, pilot.orders
    if m is None or orders is None:
        return (Line("position", "not known yet", ODD),)
    latitude, longitude, k = float(m.latitude), float(m.longitude), int(m.waypoint)
    lines = [
        Line("position", f"{_degrees(latitude, 'NS')} {_degrees(longitude, 'EW')}"),
        Line("dives", f"{int(m.dives)}"),
    ]
    if k < len(orders.waypoints):
        to_latitude, to_longitude = (float(angle) for angle in orders.waypoints[k])
        north = to_latitude - latitude
        east = wrapped(to_longitude - longitude) * cos(0.5 * (latitude + to_latitude))
        away = MEAN_RADIUS * hypot(north, east)
        bearing = _course(atan2(east, north))
        far = f"{away:.0f} m" if away < 3000.0 else f"{away / 1e3:.1f} km"
        lines.append(Line("waypoint", f"{k + 1} of {len(orders.waypoints)}, {far} at {bearing}"))
    else:
        lines.append(Line("waypoint", "all reached" if len(orders.waypoints) else "none"))
    return tuple(lines)


def _degrees(angle: float, letters: str) -> str:
    return f"{abs(degrees(angle)):.5f}° {letters[angle < 0.0]}"


def _alarms(view: View) -> list[tuple[str, str, str]]:
    alarms = [
        (alarm.name, f"since {clock(alarm.since)}", BAD if alarm.reaction >= Reaction.SURFACE else ODD)
        for alarm in view.safety.active
    ]
    if view.safety.unproven:
        alarms.append(("not proven yet", ", ".join(view.safety.unproven), ODD))
    return alarms


def _course(angle: float) -> str:
    return f"{round(degrees(angle)) % 360}°" if isfinite(angle) else "unknown"


def _number(value: float, form: str, unit: str) -> str:
    if not isfinite(value):
        return "unknown"
    return f"{value:{form}}{'' if unit == '°' else ' '}{unit}"
