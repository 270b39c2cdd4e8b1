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

    surface_depth: float = setting(
        "depth within which the pressure sensor must read at the surface to be proven", 2.0, 0.1, 100.0, "m", 1
    )
    vacuum_low: float = setting("least pressure in a closed hull", 3e4, 0.0, 2e5, "Pa", 2)
    vacuum_high: float = setting("greatest pressure in a closed hull", 1.06e5, 1e4, 3e5, "Pa", 3)
    voltage_low: float = setting(
        "least voltage of a battery that can fly; below it a brown-out is told", 18.0, 0.0, 60.0, "V", 4
    )
    voltage_high: float = setting("greatest voltage of the battery", 34.0, 1.0, 65.0, "V", 5)
    current_at_rest: float = setting("greatest current, in or out, while nothing moves", 3.0, 0.01, 30.0, "A", 6)
    settling: float = setting(
        "time after the start within which the sensors must pass their checks", 60.0, 0.0, 600.0, "s", 7
    )
    quiet_after: float = setting("time without Sync after which the bus is called quiet", 5.0, 1.0, 60.0, "s", 8)
    rest_after: float = setting(
        "time without Sync after which sampling stops and only the least is on", 60.0, 5.0, 3600.0, "s", 9
    )
    least_loads: int = setting("groups of consumers that are on when nobody says what shall be", 0, 0, 255, "", 10)
    radio_left_alone: bool = setting(
        "whether GPS and radio have power when nobody says what shall be, to be found", True, 0, 1, "", 11
    )
    ctd_patience: float = setting(
        "time beyond two intervals after which a sampling CTD that says nothing is silent", 10.0, 1.0, 600.0, "s", 12
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        self.require_order("vacuum_low", "vacuum_high")
        self.require_order("voltage_low", "voltage_high")
