"""Trim weight and foam: what makes the vehicle neutral and level in a given water.

Places are found by linear programming: lead may lie at the ends of every sealed bay, foam at the ends of every flooded
bay, and trim weights that are there may be taken out. Of all ways to balance force and moments the one that adds
the least mass and displaces the least water wins. Two weights at the ends of a stretch are as good as one in between,
so that weights are joined again afterwards.
"""

from dataclasses import dataclass
from math import pi, sqrt
from typing import Any, Literal

import numpy as np

from stommel.design.budget.failures import BudgetError
from stommel.design.budget.mass_properties import Vector3
from stommel.design.budget.totals import Budget
from stommel.vehicle import Vehicle
from stommel.vehicle.missing_table import missing_table
from stommel.vehicle.schema.budget import Part

FOAM_DENSITY = 200.0
"""[kg/m3]. Assumption: syntactic or cross-linked foam for some hundred metres of depth, 150 to 300."""
LEAD_DENSITY = 11340.0
"""[kg/m3]."""
FILL = 0.5
"""Part of a flooded bay, as a cylinder of the hull's diameter, that parts may fill. Assumption: it tapers."""
REACH = 0.8
"""Distance of weight and foam from the axis, over the radius. Assumption: room for the block itself."""
REMOVAL_COST = 0.01
"""Of a kilogram taken out, where a kilogram of lead put in costs 1: cheap, but not done and undone for nothing."""
NEGLIGIBLE = 1e-3
"""Blocks below a gram are left out [kg]."""


Material = Literal["lead", "foam", "removed"]


@dataclass(frozen=True)
class AddedBody:
    """A block of lead inside, of foam outside, or a part of a trim weight that is taken out."""

    material: Material
    bay: str
    mass: float
    """[kg]; negative where it is taken out."""
    volume: float
    """Of the block itself [m3]; only foam displaces water."""
    position: tuple[float, float, float]
    """[m]."""
    part: str = ""
    """Name of the trim weight that is reduced."""

    @property
    def displaced(self) -> float:
        """Water that it displaces [m3]."""
        return self.volume if self.material == "foam" else 0.0

    def as_row(self) -> dict[str, Any]:
        """The block in words with units."""
        return {
            "material": self.material,
            "part": self.part or None,
            "bay": self.bay,
            "mass_kg": self.mass,
            "volume_ml": self.volume * 1e6,
            "position_m": list(self.position),
        }


@dataclass(frozen=True)
class Trimming:
    """What to add for neutral buoyancy and level attitude in one water."""

    rho: float
    """[kg/m3]."""
    surplus: float
    """Buoyancy over weight of the vehicle as it is [kg]; negative sinks."""
    moment: tuple[float, float]
    """Static moment of weight less buoyancy as it is, along and across the hull [kg m]."""
    added: tuple[AddedBody, ...]
    mass: float
    """Of the vehicle with it [kg]."""
    volume: float
    """Displaced with it [m3]."""
    stability_arm: float
    """Centre of mass below centre of buoyancy with it [m]."""

    @property
    def added_mass(self) -> float:
        """[kg]."""
        return sum(body.mass for body in self.added)

    def as_row(self) -> dict[str, Any]:
        """The trimming in words with units."""
        return {
            "density_kg_m3": self.rho,
            "surplus_buoyancy_kg": self.surplus,
            "moment_kg_m": list(self.moment),
            "added": [body.as_row() for body in self.added],
            "mass_kg": self.mass,
            "displaced_volume_ml": self.volume * 1e6,
            "stability_arm_mm": self.stability_arm * 1e3,
        }


@dataclass(frozen=True)
class _Station:
    """A place where something can be put, or a trim weight that can be taken out."""

    bay: str
    material: Material
    x: float
    y: float
    net: float
    """Weight less buoyancy of a kilogram of it [kg]."""
    cost: float
    """Of a kilogram of it."""
    most: float | None = None
    """Greatest mass [kg]; None for no limit."""
    part: Part | None = None

    @property
    def foam(self) -> bool:
        return self.material == "foam"


def trimming(vehicle: Vehicle, budget: Budget, rho: float, foam_density: float = FOAM_DENSITY) -> Trimming | None:
    """Find trim weight and foam for water of density `rho` [kg/m3]; None where no place for them is enough.

    Raises
    ------
    BudgetError
        The file lacks [hull], or the foam does not float in this water.
    """
    hull = vehicle.description.hull
    if hull is None:
        raise BudgetError(
            f"{vehicle.origin}: has no table [hull]; its radius says where weight and foam can lie; "
            f"{missing_table('hull')}"
        )
    if not 0.0 < foam_density < rho:
        raise BudgetError(f"foam density = {foam_density:g} kg/m3: must be greater than 0 and less than {rho:g}")
    radius = REACH * (hull.inner_diameter_mm or hull.outer_diameter_mm) / 2e3
    surplus = rho * budget.volume - budget.total.mass
    s = budget.total.mass * budget.total.centre - rho * budget.volume * budget.centre_of_buoyancy  # (eq-w5)
    stations = _stations(vehicle, radius, rho, foam_density)
    masses = _least_addition(stations, _capacities(vehicle, foam_density), surplus, s)
    if masses is None:
        return None
    added = tuple(_joined(vehicle, stations, masses, radius, foam_density))
    mass = budget.total.mass + sum(body.mass for body in added)
    volume = budget.volume + sum(body.displaced for body in added)
    z_mass = budget.total.mass * budget.total.centre[2] + sum(body.mass * body.position[2] for body in added)
    z_volume = budget.volume * budget.centre_of_buoyancy[2] + sum(b.displaced * b.position[2] for b in added)
    return Trimming(
        rho, surplus, (float(s[0]), float(s[1])), added, mass, volume, float(z_mass / mass - z_volume / volume)
    )


def _stations(vehicle: Vehicle, radius: float, rho: float, rho_foam: float) -> list[_Station]:
    """Both ends of every bay on either side of the axis, and the trim weights that are there."""
    # a kilogram of foam displaces rho / rho_foam kilograms of water
    foam_net, foam_cost = 1.0 - rho / rho_foam, 1.0 + rho / rho_foam
    ends = [
        _Station(bay.name, "foam", x, y, foam_net, foam_cost)
        if bay.flooded
        else _Station(bay.name, "lead", x, y, 1.0, 1.0)
        for bay in vehicle.description.bays
        for x in (bay.from_m, bay.to_m)
        for y in (-0.5 * radius, 0.5 * radius)
    ]
    present = [
        _Station(part.bay, "removed", part.position_m[0], part.position_m[1], -1.0, REMOVAL_COST, part.mass_kg, part)
        for part in vehicle.description.parts
        if part.trim_weight
    ]
    return ends + present


def _capacities(vehicle: Vehicle, rho_foam: float) -> dict[str, float]:
    """Foam that fits into each flooded bay [kg]."""
    d = vehicle.description
    assert d.hull is not None
    section = pi / 4.0 * (d.hull.outer_diameter_mm / 1e3) ** 2
    free = {}
    for bay in d.bays:
        if bay.flooded:
            taken = sum(part.volume_m3 for part in d.parts if part.bay == bay.name)
            free[bay.name] = rho_foam * max(0.0, FILL * section * (bay.from_m - bay.to_m) - taken)
    return free


def _least_addition(
    stations: list[_Station], capacities: dict[str, float], surplus: float, s: Vector3
) -> Vector3 | None:
    """Masses at the stations [kg] that balance force and moments (eq-w6); None where none do."""
    from scipy.optimize import linprog  # noqa: PLC0415 - slow to import, only wanted here

    net = np.array([station.net for station in stations])
    along = np.array([station.x for station in stations])
    across = np.array([station.y for station in stations])
    rows = [[float(station.foam and station.bay == name) for station in stations] for name in capacities]
    found = linprog(
        np.array([station.cost for station in stations]),
        A_eq=np.array([net, net * along, net * across]),
        b_eq=np.array([surplus, -s[0], -s[1]]),
        A_ub=np.array(rows) if rows else None,
        b_ub=np.array(list(capacities.values())) if rows else None,
        bounds=[(0.0, station.most) for station in stations],
        method="highs",
    )
    return np.asarray(found.x) if found.status == 0 else None


def _joined(
    vehicle: Vehicle, stations: list[_Station], masses: Vector3, radius: float, rho_foam: float
) -> list[AddedBody]:
    """One block of lead where a sealed bay is at its place, otherwise one a bay; foam one a bay."""
    placed = [(station, float(m)) for station, m in zip(stations, masses, strict=True)]
    lead = [(station, m) for station, m in placed if station.material == "lead"]
    foam = [(station, m) for station, m in placed if station.material == "foam"]
    out = [_taken(station, m) for station, m in placed if station.material == "removed" and m > NEGLIGIBLE]
    whole, x, y = _middle(lead)
    around = [bay for bay in vehicle.description.bays if not bay.flooded and bay.to_m <= x <= bay.from_m]
    if whole > NEGLIGIBLE and around:
        blocks = [_block("lead", around[0].name, whole, x, y, radius, LEAD_DENSITY)]
    else:
        blocks = _by_bay("lead", lead, radius, LEAD_DENSITY)
    return out + blocks + _by_bay("foam", foam, radius, rho_foam)


def _middle(placed: list[tuple[_Station, float]]) -> tuple[float, float, float]:
    """Sum of masses and their centre along and across."""
    mass = sum(m for _, m in placed)
    if mass <= 0.0:
        return 0.0, 0.0, 0.0
    return mass, sum(m * at.x for at, m in placed) / mass, sum(m * at.y for at, m in placed) / mass


def _taken(station: _Station, mass: float) -> AddedBody:
    assert station.part is not None
    return AddedBody("removed", station.bay, -mass, mass / LEAD_DENSITY, station.part.position_m, station.part.name)


def _by_bay(material: Material, placed: list[tuple[_Station, float]], radius: float, density: float) -> list[AddedBody]:
    blocks = []
    for name in dict.fromkeys(station.bay for station, _ in placed):
        mass, x, y = _middle([(station, m) for station, m in placed if station.bay == name])
        if mass > NEGLIGIBLE:
            blocks.append(_block(material, name, mass, x, y, radius, density))
    return blocks


def _block(material: Material, bay: str, mass: float, x: float, y: float, radius: float, density: float) -> AddedBody:
    """Lead lies low and foam high: both steady the vehicle."""
    height = sqrt(max(radius**2 - y**2, 0.0))
    z = height if material == "lead" else -height
    return AddedBody(material, bay, mass, mass / density, (x, y, z))
