"""Oracle of the engine's proof afloat: oil, pump and valve by hand, a look a second."""

from dataclasses import dataclass

import pytest

from stommel.control.dive_cycle import ASCENT, DESCENT, SURFACE
from stommel.onboard.coordination.engine_proof import EngineProof, Oil, Stage

LEAST, GREATEST, CLIMB, DIVE = -250e-6, 250e-6, 65e-6, -66e-6
STROKE = 1e-6  # a five-hundredth of the engine's 500 ml


@dataclass
class Vehicle:
    """Valve of 3 ml/s, pump of 8.3 ml/s; it obeys for a second after each look."""

    oil: float = GREATEST
    pump: float = 8.3e-6
    leak: float = 0.0
    told: bool = True
    stuck: bool = False
    t: float = 0.0
    least: float = GREATEST
    volume: float = GREATEST
    told_at: float = 0.0

    def __post_init__(self) -> None:
        self.proof = EngineProof(LEAST, GREATEST)
        self.stages: list[Stage] = []

    def look(self, phase: int = DESCENT, wanted: float = DIVE, climb: float = CLIMB) -> float:
        if self.told:
            self.volume, self.told_at = self.oil, self.t
        goal = self.proof.allowed(self.t, phase, wanted, climb, Oil(self.volume, self.told_at, self.stuck))
        self.stages.append(self.proof.stage)
        assert goal >= wanted
        moved = min(self.pump, goal - self.oil) if goal > self.oil else -min(3e-6, self.oil - goal)
        self.oil += moved - self.leak
        self.least = min(self.least, self.oil)
        self.t += 1.0
        return goal

    def run(self, looks: int) -> None:
        for _ in range(looks):
            self.look()


def test_a_sound_engine_costs_a_stroke_and_a_second() -> None:
    vehicle = Vehicle()
    vehicle.run(130)
    assert vehicle.oil == pytest.approx(DIVE)
    assert vehicle.stages.count(Stage.STROKE) == 1
    assert {Stage.LIFTING, Stage.STAYING}.isdisjoint(vehicle.stages)
    without = (GREATEST - DIVE) / 3e-6
    reached = next(k for k, stage in enumerate(vehicle.stages) if stage is Stage.PROVEN)
    assert reached <= (GREATEST - CLIMB) / 3e-6 + 3
    assert without == pytest.approx(105.3, abs=0.1)


@pytest.mark.parametrize("died_at", [0, 10, 40, 60])
def test_a_dead_pump_leaves_it_afloat(died_at: int) -> None:
    """Oracle: never lower than the four strokes past the climb's ballast at which the valve stops."""
    vehicle = Vehicle()
    vehicle.run(died_at)
    vehicle.pump = 0.0
    vehicle.run(600)
    assert vehicle.proof.stage is Stage.LIFTING
    assert vehicle.least >= CLIMB - 4e-6 - 1e-12


def test_a_leaking_valve_leaves_it_afloat_once_the_node_has_told() -> None:
    """Oracle: 0.7 ml/s of a stroke of 1 ml is seen at once; the rest, the node tells: the pump is stronger."""
    vehicle = Vehicle()
    vehicle.run(55)
    vehicle.leak = 0.7e-6
    vehicle.run(20)
    assert vehicle.proof.stage is Stage.STAYING
    vehicle.stuck = True
    vehicle.run(600)
    assert Stage.PROVEN not in vehicle.stages
    assert vehicle.least >= CLIMB - 5e-6


def test_a_weak_pump_that_keeps_the_oil_may_dive_a_little_later() -> None:
    vehicle = Vehicle(pump=0.5e-6)
    vehicle.run(200)
    assert vehicle.proof.stage is Stage.PROVEN
    assert Stage.STAYING in vehicle.stages


def test_what_is_not_told_proves_nothing() -> None:
    """Oracle: lost frames; an old word of the oil is no stroke that failed, and none that came."""
    vehicle = Vehicle()
    vehicle.run(58)
    while vehicle.proof.stage is not Stage.STROKE:
        vehicle.look()
    vehicle.told = False
    vehicle.run(30)
    assert vehicle.proof.stage is Stage.STROKE
    vehicle.told = True
    vehicle.run(1)
    assert vehicle.proof.stage is Stage.PROVEN


def test_each_descent_is_proven_anew_also_below_the_surface() -> None:
    vehicle = Vehicle()
    vehicle.run(130)
    assert vehicle.look(ASCENT, CLIMB) == CLIMB
    vehicle.oil = CLIMB
    assert vehicle.look() == pytest.approx(CLIMB + STROKE)
    assert vehicle.proof.stage is Stage.STROKE


def test_other_phases_are_left_alone() -> None:
    vehicle = Vehicle()
    for phase in (SURFACE, ASCENT):
        assert vehicle.look(phase, DIVE) == DIVE


def test_a_climb_with_all_oil_still_leaves_room_for_the_stroke() -> None:
    vehicle = Vehicle()
    for _ in range(130):
        vehicle.look(climb=GREATEST)
    assert Stage.STROKE in vehicle.stages
    assert vehicle.proof.stage is Stage.PROVEN
