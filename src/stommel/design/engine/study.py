"""The buoyancy engine in a design study: one cycle at the surface, one at the specified depth."""

from dataclasses import dataclass

from stommel.machinery.engine.cycle import simulate
from stommel.machinery.engine.files import engine_of
from stommel.machinery.engine.results import EngineRun
from stommel.machinery.engine.stall import stall_pressure
from stommel.vehicle import Vehicle

DEFAULT_DEPTH_M = 200.0


@dataclass(frozen=True)
class EngineStudy:
    """What the engine does over its whole working range."""

    depth_m: float
    surface: EngineRun
    deep: EngineRun
    stall_pressure_pa: float | None
    """Pressure up to which it inflates [Pa]; None if that of any sea."""

    @property
    def runs(self) -> tuple[tuple[str, EngineRun], ...]:
        """Both cycles with their places in words."""
        return ("at the surface", self.surface), (f"at {self.depth_m:g} m", self.deep)

    @property
    def losses(self) -> tuple[tuple[str, float], ...]:
        """Losses of the deep inflation as shares of its energy, the largest first."""
        phase = self.deep.phases[0]
        shares = [(name.replace("_", " "), joules / phase.energy_j) for name, joules in phase.losses_j.items()]
        return tuple(sorted((item for item in shares if item[1] >= 0.0005), key=lambda item: -item[1]))


def engine_study(vehicle: Vehicle) -> EngineStudy:
    """Simulate inflating and deflating the whole working range at the surface and at the specified depth.

    Raises
    ------
    NoEngineError
        The vehicle's file has no table [engine].
    CircuitError, SimulationError
        Its circuit cannot work.
    """
    named = engine_of(vehicle)
    spec, water = vehicle.description.specification, vehicle.description.water
    depth = spec.depth_m if spec is not None else DEFAULT_DEPTH_M
    volume = named.engine.measured_piston.working_volume_ml / 1e6

    def cycle(pressure_pa: float) -> EngineRun:
        return simulate(
            named.engine, pressure_pa=pressure_pa, inflate_m3=volume, deflate_m3=volume, name=named.name
        )  # fmt: skip

    return EngineStudy(
        depth_m=depth,
        surface=cycle(0.0),
        deep=cycle(water.density_kg_m3 * water.gravity_m_s2 * depth),
        stall_pressure_pa=stall_pressure(named.engine),
    )
