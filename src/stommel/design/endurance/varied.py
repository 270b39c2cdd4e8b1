"""The same dive with some of its numbers changed, each found anew as far as the change reaches."""

from dataclasses import dataclass, replace

from stommel.design.endurance.dive_cycle import fed
from stommel.design.endurance.endurance import (
    Endurance,
    Wanted,
    balance,
    ballast_in,
    check_dive,
    quick_flights_of,
    spent,
)
from stommel.machinery.power.model import EnergyModel
from stommel.vehicle import Physics, Vehicle


@dataclass(frozen=True)
class Case:
    """A dive of a vehicle; `reached` is what is known of it before the changes."""

    vehicle: Vehicle
    model: EnergyModel
    wanted: Wanted
    physics: Physics
    reached: Endurance
    flight: bool = False
    """Whether the flights must be found anew."""
    movements: bool = False
    """Whether the energies of the actuators must be found anew."""

    def changed(self, key: str, value: float) -> "Case":
        """Change one number by its key, as `Assumption.key` spells it; unvalidated."""
        table, _, name = key.partition(".")
        if table == "dive":
            return replace(self, wanted=replace(self.wanted, **{name: value}), flight=True)
        if table == "hydrodynamics":
            d = self.vehicle.description
            coefficients = d.hydrodynamics.model_copy(update={name: value})
            changed = replace(self.vehicle, description=d.model_copy(update={table: coefficients}))
            return replace(self, vehicle=changed, flight=True)
        moves = table in {"works", "battery"} or (table == "energy" and name != "regulator_efficiency")
        return replace(self, model=self.model.changed(key, value), movements=self.movements or moves)

    def endurance(self) -> Endurance:
        """Fly the dive.

        Raises
        ------
        StommelError
            It cannot be flown.
        """
        known = self.reached
        if self.flight:
            check_dive(self.vehicle, self.model, self.wanted)
            dive, climb = quick_flights_of(self.vehicle, self.wanted, self.physics)
            ballast = ballast_in(known.sea, self.vehicle, self.wanted, self.physics)
            return balance(self.model, self.wanted, dive, climb, ballast)
        if self.movements:
            return balance(self.model, self.wanted, known.dive, known.climb, known.ballast)
        return spent(self.model, self.wanted, known.dive, known.climb, fed(known.cycle, self.model))
