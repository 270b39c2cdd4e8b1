"""Settings of the data-acquisition node."""

from dataclasses import dataclass

from stommel.onboard.nodes.node_settings import NodeSettings, setting


@dataclass(frozen=True)
class AcquisitionSettings(NodeSettings):
    """What the node knows of its sensors and consumers; SI units. Settings with a number can be set over the bus.

    Raises
    ------
    SettingsError
        A value is beyond its limits, or a lower end is not below its upper end.
    """

    surface_depth: float = setting(2.0, 0.1, 100.0, "m", 1)
    """Depth, up or down, within which the pressure sensor must read at the surface to be proven."""
    vacuum_low: float = setting(3e4, 0.0, 2e5, "Pa", 2)
    """Least pressure in a closed hull."""
    vacuum_high: float = setting(1.06e5, 1e4, 3e5, "Pa", 3)
    """Greatest pressure in a closed hull."""
    voltage_low: float = setting(18.0, 0.0, 60.0, "V", 4)
    """Least voltage of a battery that can fly; below it a brown-out is told."""
    voltage_high: float = setting(34.0, 1.0, 65.0, "V", 5)
    """Greatest voltage of the battery."""
    current_at_rest: float = setting(3.0, 0.01, 30.0, "A", 6)
    """Greatest current, in or out, while nothing moves."""
    settling: float = setting(60.0, 0.0, 600.0, "s", 7)
    """Time after the start within which the sensors must pass their checks."""
    quiet_after: float = setting(5.0, 1.0, 60.0, "s", 8)
    """Time without Sync after which the bus is called quiet."""
    rest_after: float = setting(60.0, 5.0, 3600.0, "s", 9)
    """Time without Sync after which sampling stops and only the least is on."""
    least_loads: int = setting(0, 0, 255, "", 10)
    """Groups of consumers that are on when nobody says what shall be."""
    radio_left_alone: bool = setting(True, 0, 1, "", 11)
    """Whether GPS and radio have power when nobody says what shall be: it helps to find the vehicle."""
    ctd_patience: float = setting(10.0, 1.0, 600.0, "s", 12)
    """Time beyond two intervals after which a sampling CTD that says nothing is silent."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.require_order("vacuum_low", "vacuum_high")
        self.require_order("voltage_low", "voltage_high")
