"""A design by dynamic-model analysis: everything sections 2 and 3 of the paper conclude about a vehicle, in one value.

Each part is computed by `stommel.analysis`; this module only asks the questions and keeps the answers together, for the
terminal, the report and scripts alike.
"""

from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from functools import partial
from math import degrees
from typing import Any, TypeVar

import numpy as np

from stommel.analysis import (
    Authority,
    BestConditions,
    EnvelopeRow,
    Linearization,
    Modes,
    RangesNeeded,
    RootLocus,
    SteadyFlight,
    TrimRow,
    UnreachableFlightError,
    authority,
    best_conditions,
    flight_envelope,
    linearise,
    modes,
    ranges_needed,
    root_locus,
    specified_flights,
    trim,
    trim_table,
    turn,
)
from stommel.analysis.limits import Excess, excesses
from stommel.bench.speed_study import SpeedStudy, speed_study
from stommel.design.budget import BudgetStudy, budget_study
from stommel.design.checking import CrossCheck, cross_check
from stommel.design.drives import DriveStudy, drive_study
from stommel.design.endurance import EnergyStudy, energy_study
from stommel.design.engine.study import EngineStudy, engine_study
from stommel.design.hull.study import HullStudy, hull_study
from stommel.design.published import PublishedRow, published_tables
from stommel.design.specification import SpecificationRow, specification_check
from stommel.errors import StommelError
from stommel.vehicle import PAPER, Physics, Provenance, Vehicle, stated_numbers

Progress = Callable[[str], None]
_Answer = TypeVar("_Answer")


@dataclass(frozen=True)
class ComparedRow:
    """A trim beside what was published for it, where anything was."""

    trim: TrimRow
    published: PublishedRow | None

    def as_row(self) -> dict[str, object]:
        """Both in words with units."""
        return {**self.trim.as_row(), "published": None if self.published is None else asdict(self.published)}


@dataclass(frozen=True)
class ComparedTable:
    """A trim table with the published one beside it."""

    title: str
    source: str
    rows: tuple[ComparedRow, ...]

    def worst(self) -> tuple[float, float, float] | None:
        """Largest differences from the published rows: moving mass [mm], angle of attack [deg], ballast [ml]."""
        pairs = [(row.trim.flight, row.published) for row in self.rows if row.published is not None]
        if not pairs:
            return None
        return (
            max(abs(flight.r_px * 1e3 - printed.moving_mass_mm) for flight, printed in pairs),
            max(abs(degrees(flight.alpha) - printed.angle_of_attack_deg) for flight, printed in pairs),
            max(abs(flight.V_b * 1e6 - printed.ballast_ml) for flight, printed in pairs),
        )


@dataclass(frozen=True)
class DesignStudy:
    """What the equations of motion say about a vehicle. Parts that its file cannot answer are None."""

    vehicle: Vehicle
    physics: Physics
    design_flight: SteadyFlight
    """Flight at the design speed and pitch of the specification; modes and loci are about it."""
    specification: tuple[SpecificationRow, ...]
    tables: tuple[ComparedTable, ...]
    envelope: tuple[EnvelopeRow, ...] | None
    ranges: RangesNeeded | None
    best: BestConditions | None
    linear: Linearization
    modes: Modes
    authority: Authority
    loci: tuple[RootLocus, ...]
    turns: tuple[SteadyFlight, ...]
    """Steady turns at growing turn rate, steered by what the vehicle has."""
    hull: HullStudy | None
    """Pressure hull in every material."""
    engine: EngineStudy | None
    """Cycles of the buoyancy engine at the surface and at depth."""
    energy: EnergyStudy | None
    """Energy of a dive, endurance, best dives and sensitivities at the specification's dive."""
    motor_speed: SpeedStudy | None
    """Motor speeds of the buoyancy engine compared by its model."""
    drives: DriveStudy | None
    """Drives of moving mass and rudder."""
    budget: BudgetStudy | None
    """Masses and volumes of the parts, in the reference water."""
    check: CrossCheck
    """What the numbers of the file say against each other."""
    numbers: tuple[tuple[str, object, Provenance], ...]
    """Every number of the vehicle file with its origin."""
    notes: tuple[str, ...]
    """Known slips of the sources, and limits of the model."""
    unanswered: tuple[tuple[str, str], ...]
    """Parts of this study that could not be answered, each with the reason."""

    @property
    def design_flight_excesses(self) -> tuple[Excess, ...]:
        """Limits of the file that the design flight breaks: modes and loci are about it all the same."""
        return excesses(self.vehicle, self.design_flight)

    def as_json(self) -> dict[str, Any]:
        """What `stommel design` answers, in words with units; its other parts have verbs of their own."""
        return {
            "vehicle": self.vehicle.name,
            "design_flight": self.design_flight.as_row()
            | {"beyond": [str(excess) for excess in self.design_flight_excesses]},
            "specification": [asdict(row) for row in self.specification],
            "tables": [{"title": table.title, "rows": [row.as_row() for row in table.rows]} for table in self.tables],
            "envelope": None if self.envelope is None else [row.as_row() for row in self.envelope],
            "ranges": None if self.ranges is None else self.ranges.as_row(),
            **({"best_glide": None, "fastest": None} if self.best is None else self.best.as_row()),
            **self.modes.as_row(),
            "authority": self.authority.as_row(),
            "turns": [flight.as_turn() for flight in self.turns],
            "vehicle_check": self.check.as_row(),
            "notes": list(self.notes),
            "unanswered": dict(self.unanswered),
        }


DEFAULT_SPEED_M_S, DEFAULT_PITCH_DEG = 0.4, 35.0
_MOST_TURNS = 60
_LOCI = (("wing_position", 0.0, 0.2), ("rudder_position", 0.5, 1.0))
"""Number of the vehicle file, and where its root locus begins and ends [hull lengths]."""


def _silent(part: str) -> None:
    """Show no progress of `part`."""


@dataclass
class _Interview:
    """Asks a vehicle one question after the other, and keeps what it could not answer."""

    vehicle: Vehicle
    progress: Progress
    unanswered: list[tuple[str, str]] = field(default_factory=list)

    def ask(self, part: str, question: Callable[[], _Answer]) -> _Answer | None:
        self.progress(part)
        try:
            return question()
        except StommelError as error:
            self.unanswered.append((part, str(error).removeprefix(f"{self.vehicle.name}: ")))
            return None


def design_study(vehicle: Vehicle, *, physics: Physics = PAPER, progress: Progress = _silent) -> DesignStudy:
    """Analyse a vehicle: trim tables, envelope, ranges, best conditions, modes, root loci, turns, specification.

    Parameters
    ----------
    vehicle
        The glider.
    physics
        The paper's model, or what the vehicle file adds to it.
    progress
        Called with the name of each part as it begins.

    Raises
    ------
    UnreachableFlightError
        The vehicle cannot fly at its design speed and pitch.
    """
    spec = vehicle.description.specification
    speed = (spec.design_speed_m_s if spec else None) or DEFAULT_SPEED_M_S
    pitch = (spec.design_pitch_deg if spec else None) or DEFAULT_PITCH_DEG
    interview = _Interview(vehicle, progress)
    ask = interview.ask
    progress("design flight")
    flight = trim(vehicle, speed_m_s=speed, pitch_deg=-pitch, physics=physics, within_limits=False)
    linear = linearise(vehicle, flight, physics=physics)
    tables = ask("trim tables", lambda: _tables(vehicle, physics, speed, pitch)) or ()
    envelope = ask("flight envelope", lambda: tuple(flight_envelope(vehicle, physics=physics)))
    ranges = ask("actuator ranges", lambda: ranges_needed(vehicle, specified_flights(vehicle), physics=physics))
    engine = vehicle.description.actuators.buoyancy
    ballast_ml = engine.range_ml[0] if engine else flight.V_b * 1e6
    best = ask("best conditions", lambda: best_conditions(vehicle, ballast_ml=ballast_ml, physics=physics))
    loci = _loci(interview, physics, speed, pitch)
    turns = ask("turns", lambda: _turns(vehicle, physics, speed, pitch)) or ()
    hull = ask("pressure hull", lambda: hull_study(vehicle))
    oil = ask("buoyancy engine", lambda: engine_study(vehicle))
    energy = ask("endurance", lambda: energy_study(vehicle, physics=physics))
    motor_speed = ask("motor speed", lambda: speed_study(vehicle))
    drives = ask("drives", lambda: drive_study(vehicle))
    budget = ask("budget", lambda: budget_study(vehicle))
    return DesignStudy(
        vehicle=vehicle,
        physics=physics,
        design_flight=flight,
        specification=specification_check(vehicle, physics),
        tables=tables,
        envelope=envelope,
        ranges=ranges,
        best=best,
        linear=linear,
        modes=modes(linear),
        authority=authority(linear),
        loci=loci,
        turns=turns,
        hull=hull,
        engine=oil,
        energy=energy,
        motor_speed=motor_speed,
        drives=drives,
        budget=budget,
        check=cross_check(vehicle),
        numbers=tuple(stated_numbers(vehicle)),
        notes=vehicle.description.notes,
        unanswered=tuple(interview.unanswered),
    )


def _tables(vehicle: Vehicle, physics: Physics, speed: float, pitch: float) -> tuple[ComparedTable, ...]:
    """Published tables where there are any, otherwise the same two questions at the vehicle's own design flight."""
    published = published_tables(vehicle.builtin)
    if published:
        return tuple(
            ComparedTable(
                table.title,
                table.source,
                tuple(ComparedRow(_row(vehicle, physics, row.speed_m_s, row.pitch_deg), row) for row in table.rows),
            )
            for table in published
        )
    pitches = [-float(p) for p in range(10, 65, 5)]
    speeds = [round(speed * share, 6) for share in np.arange(0.25, 2.01, 0.25)]
    at_speed = trim_table(vehicle, speeds_m_s=[speed], pitches_deg=pitches, physics=physics)
    at_pitch = trim_table(vehicle, speeds_m_s=speeds, pitches_deg=[-pitch], physics=physics)
    return tuple(
        ComparedTable(title, "", tuple(ComparedRow(row, None) for row in rows))
        for title, rows in (
            (f"Fixed speed of {speed:g} m/s", at_speed),
            (f"Fixed pitch of {-pitch:g} deg", at_pitch),
        )
    )


def _loci(interview: _Interview, physics: Physics, speed: float, pitch: float) -> tuple[RootLocus, ...]:
    """Root loci of the design flight, of those numbers that the vehicle has."""

    def of(over: str, start: float, stop: float) -> RootLocus:
        return root_locus(interview.vehicle, over, start, stop, speed_m_s=speed, pitch_deg=-pitch, physics=physics)

    asked = (
        interview.ask(f"root locus over {over.replace('_', ' ')}", partial(of, over, start, stop))
        for over, start, stop in _LOCI
    )
    return tuple(locus for locus in asked if locus)


def _row(vehicle: Vehicle, physics: Physics, speed: float, pitch: float) -> TrimRow:
    (row,) = trim_table(vehicle, speeds_m_s=[speed], pitches_deg=[pitch], physics=physics)
    return row


def _turns(vehicle: Vehicle, physics: Physics, speed: float, pitch: float) -> tuple[SteadyFlight, ...]:
    """Turns from gentle to the tightest that the limits allow."""

    def at(rate: float) -> SteadyFlight | None:
        try:
            return turn(vehicle, speed_m_s=speed, pitch_deg=-pitch, turn_rate_rad_s=rate, physics=physics)
        except UnreachableFlightError:
            return None

    rate = 0.001
    turns: list[SteadyFlight] = []
    while len(turns) < _MOST_TURNS and (flight := at(rate)) is not None:
        turns.append(flight)
        rate *= 1.25
    low, high = rate / 1.25, rate
    while turns and len(turns) < _MOST_TURNS and high - low > 1e-3 * high:
        middle = 0.5 * (low + high)
        flight = at(middle)
        if flight is None:
            high = middle
        else:
            low = middle
            turns.append(flight)
    return tuple(turns)
