"""The answers that a designer wants first."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from math import degrees
from typing import Literal

from stommel.analysis import EnvelopeRow, RangesNeeded, SteadyFlight
from stommel.analysis.limits import excesses
from stommel.design.study import DesignStudy
from stommel.report.wording import fixed, short, why_unanswered

Tone = Literal["good", "bad", "plain", "unknown"]


@dataclass(frozen=True)
class Answer:
    """One box: a question, its answer, and what stands behind it."""

    question: str
    value: str
    detail: str
    tone: Tone


def verdict(study: DesignStudy) -> list[Answer]:
    """Answer the questions in the order that a design raises them."""
    questions: tuple[Callable[[DesignStudy], Answer], ...] = (
        _moving_mass, _ballast, _stability, _speed, _pitch, _glide, _turn,
    )  # fmt: skip
    return [question(study) for question in questions]


def summary(study: DesignStudy) -> tuple[str, Tone]:
    """One sentence on the specification."""
    rows = study.specification
    if not rows:
        return "The vehicle file states no specification to hold the vehicle against.", "unknown"
    met, failed = sum(row.met is True for row in rows), [row.name for row in rows if row.met is False]
    unclear = [row.name for row in rows if row.met is None]
    words = f"{met} of {len(rows)} requirements met"
    if failed:
        words += f"; not met: {', '.join(failed)}"
    if unclear:
        words += f"; cannot be told: {', '.join(unclear)}"
    return words + ".", "bad" if failed else "good"


def _at(flight: SteadyFlight) -> str:
    return f"{short(flight.V, 3)} m/s at pitch {fixed(degrees(flight.theta), 1)}°"


def _unknown(study: DesignStudy, question: str, part: str) -> Answer:
    reason = re.sub(r" \(missing: .*", "", why_unanswered(study, part))  # the section itself lists the missing keys
    return Answer(question, "no answer", f"Because {reason}.", "unknown")


def _stalled(needed: RangesNeeded) -> str:
    """What no range reaches, as a sentence."""
    if not needed.stalled:
        return ""
    return f" Beyond the stall angle, so out of reach of any range: {'; '.join(map(_at, needed.stalled))}."


def _moving_mass(study: DesignStudy) -> Answer:
    question = "Moving-mass range"
    needed = study.ranges
    if needed is None:
        return _unknown(study, question, "actuator ranges")
    d = study.vehicle.description
    neutral = d.moving_mass.neutral_position_m * 1e3
    detail = (
        f"Needed: ±{fixed(needed.moving_mass_mm, 1)} mm about neutral at {short(neutral)} mm, the most for "
        f"{_at(needed.furthest)}."
    )
    detail += _stalled(needed)
    drive = d.actuators.moving_mass
    if drive is None:
        return Answer(question, f"±{short(needed.moving_mass_choice_mm)} mm", detail, "plain")
    low, high = drive.travel_mm
    enough = min(high - neutral, neutral - low) >= needed.moving_mass_mm - 1e-9
    detail += f" The file gives {short(low)} to {short(high)} mm: {'enough' if enough else 'not enough'}."
    return Answer(question, f"±{short(needed.moving_mass_choice_mm)} mm", detail, "good" if enough else "bad")


def _ballast(study: DesignStudy) -> Answer:
    question = "Ballast volume"
    needed = study.ranges
    if needed is None:
        return _unknown(study, question, "actuator ranges")
    detail = f"Needed: ±{fixed(needed.ballast_ml, 1)} ml, the most for {_at(needed.heaviest)}."
    engine = study.vehicle.description.actuators.buoyancy
    if engine is None:
        return Answer(question, f"±{short(needed.ballast_choice_ml)} ml", detail, "plain")
    low, high = engine.range_ml
    enough = min(high, -low) >= needed.ballast_ml - 1e-9
    detail += f" The file gives {short(low)} to {short(high)} ml: {'enough' if enough else 'not enough'}."
    return Answer(question, f"±{short(needed.ballast_choice_ml)} ml", detail, "good" if enough else "bad")


def _stability(study: DesignStudy) -> Answer:
    known = (*study.modes.longitudinal, *(study.modes.lateral or ()))
    planes = "both planes" if study.modes.lateral else "the vertical plane (the lateral plane is unknown)"
    slowest = max(known, key=lambda mode: mode.eigenvalue.real)
    flight = _at(study.design_flight)
    if study.modes.stable:
        detail = (
            f"All {len(known)} eigenvalues of {planes} die out at {flight}; the slowest, {slowest.name}, "
            f"halves in {fixed(slowest.time_to_half, 1)} s."
        )
        return Answer("Stability, actuators fixed", "stable", detail, "good")
    growing = sorted({mode.name for mode in known if not mode.stable})
    detail = f"At {flight}: {', '.join(growing)}"
    detail += f"; the fastest doubles in {fixed(-slowest.time_to_half, 1)} s." if slowest.eigenvalue.real > 0 else "."
    return Answer("Stability, actuators fixed", "unstable", detail, "bad")


def _speed(study: DesignStudy) -> Answer:
    question = "Greatest speed"
    if study.envelope is None:
        return _unknown(study, question, "flight envelope")
    flights = [(row.fastest, row) for row in study.envelope if row.fastest is not None]
    if not flights:
        return Answer(question, "none", "No steady flight is within the limits of the vehicle file.", "bad")
    # diving and climbing often tie but for rounding: then name the dive
    fastest, row = max(flights, key=lambda pair: (round(pair[0].V, 9), -pair[1].pitch_deg))
    detail = (
        f"At pitch {fixed(row.pitch_deg, 0)}°, horizontally {fixed(fastest.horizontal_speed)} m/s; limited by "
        f"{row.limited_by}."
    )
    required = next((row for row in study.specification if row.name == "Speed" and row.met is not None), None)
    if required is not None:
        at_pitch = "none" if required.found is None else f"{short(required.found, 3)} m/s"
        detail += f" At the design pitch: {at_pitch}; wanted {short(required.required)} m/s."
    tone: Tone = "plain" if required is None else "good" if required.met else "bad"
    return Answer(question, f"{fixed(fastest.V)} m/s", detail, tone)


def _pitch(study: DesignStudy) -> Answer:
    question = "Steepest pitch"
    rows = [row for row in study.specification if row.name.startswith("Pitch") and row.met is not None]
    if rows:
        least = min(rows, key=lambda row: row.found or 0.0)
        detail = "; ".join(
            f"{row.name.removeprefix('Pitch, ')}: {'none' if row.found is None else fixed(row.found, 1) + '°'}"
            for row in rows
        )
        detail = f"At the design speed, {detail}; wanted ±{short(least.required)}°."
        tone: Tone = "good" if all(row.met for row in rows) else "bad"
        value = "none" if least.found is None else f"±{fixed(least.found, 1)}°"
        return Answer(question, value, detail, tone)
    if study.envelope is None:
        return _unknown(study, question, "flight envelope")
    dive, climb = (_steepest_row(study.envelope, side) for side in (-1.0, 1.0))
    words = [f"{name} {fixed(row.pitch_deg, 0)}°" for name, row in (("dive", dive), ("climb", climb)) if row]
    if not words:
        return Answer(question, "none", "No steady flight is within the limits of the vehicle file.", "bad")
    return Answer(
        question, ", ".join(words), "At some speed, in the steps of the envelope; no pitch is asked.", "plain"
    )


def _steepest_row(rows: tuple[EnvelopeRow, ...], side: float) -> EnvelopeRow | None:
    reached = [row for row in rows if row.fastest is not None and row.pitch_deg * side > 0]
    return max(reached, key=lambda row: abs(row.pitch_deg), default=None)


def _glide(study: DesignStudy) -> Answer:
    question = "Best glide"
    if study.best is None:
        return _unknown(study, question, "best conditions")
    flight = study.best.best_glide
    detail = f"{_at(flight)}, path {fixed(degrees(flight.gamma), 1)}°, ballast {fixed(flight.V_b * 1e6, 1)} ml."
    beyond = excesses(study.vehicle, flight)
    broken = {str(excess) for excess in beyond}
    for remark in study.best.glide_remarks:
        detail += f" Out of reach: {remark}." if remark in broken else f" It lies {remark}."
    return Answer(question, f"{fixed(flight.glide_ratio, 1)} : 1", detail, "bad" if beyond else "plain")


def _turn(study: DesignStudy) -> Answer:
    question = "Tightest turn"
    if not study.turns:
        return _unknown(study, question, "turns")
    flight = study.turns[-1]
    angle, name = (flight.delta_r, "rudder") if flight.delta_r != 0.0 else (flight.mu, "rolled mass")
    detail = (
        f"{fixed(degrees(flight.turn_rate), 2)} deg/s at {_at(flight)} with {name} at {fixed(degrees(angle), 1)}°, "
        f"roll {fixed(degrees(flight.phi), 1)}°. {nearest_limit(study, flight)}"
    )
    return Answer(question, f"{fixed(flight.radius, 1)} m radius", detail, "plain")


def nearest_limit(study: DesignStudy, flight: SteadyFlight) -> str:
    """Which limit a turn comes nearest to, and how near."""
    d = study.vehicle.description
    stall = d.hydrodynamics.stall_begins_deg
    used = [
        ("sideslip", "the stall angle", abs(degrees(flight.beta)) / stall),
        ("angle of attack", "the stall angle", abs(degrees(flight.alpha)) / stall),
    ]
    if d.actuators.rudder is not None:
        used.append(("rudder", "its travel", abs(degrees(flight.delta_r)) / d.actuators.rudder.travel_deg))
    if d.actuators.roll is not None:
        used.append(("rolled mass", "its travel", abs(degrees(flight.mu)) / d.actuators.roll.travel_deg))
    if d.actuators.buoyancy is not None:
        used.append(("ballast", "its limit", abs(flight.V_b) / max(map(abs, d.actuators.buoyancy.volume_m3))))
    if d.actuators.moving_mass is not None:
        low, high = d.actuators.moving_mass.travel_m
        used.append(("moving mass", "its travel", abs(flight.r_px - 0.5 * (low + high)) / (0.5 * (high - low))))
    name, limit, share = max(used, key=lambda entry: entry[2])
    return f"Nearest limit: {name}, at {fixed(100 * share, 0)} % of {limit}."
