"""Settings of the motion-control node."""

from dataclasses import dataclass

from stommel.onboard.nodes.node_settings import NodeSettings, setting


@dataclass(frozen=True)
class MotionSettings(NodeSettings):
    """What the node knows of its drives; SI units and radians.

    The defaults are the paper's glider's. Settings with a number can be set over the bus.

    Raises
    ------
    SettingsError
        A value is beyond its limits, or a lower end is not below its upper end.
    """

    ballast_low: float = setting(-2.5e-4, -3e-3, 3e-3, "m3")
    """Least ballast volume."""
    ballast_high: float = setting(2.5e-4, -3e-3, 3e-3, "m3")
    """Greatest ballast volume."""
    mass_low: float = setting(-0.05, -0.6, 0.6, "m")
    """Aft end of the moving mass's way."""
    mass_high: float = setting(0.55, -0.6, 0.6, "m")
    """Fore end."""
    steering_limit: float = setting(1.0472, 0.01, 1.6, "rad")
    """Greatest angle of the steering to either side."""
    has_drop_weight: bool = False
    """Whether the vehicle has a drop weight and its release."""

    pump_flow: float = setting(8.3e-6, 1e-9, 1e-2, "m3/s", 1, 5.0)
    """Of the pump, until the node has seen it."""
    valve_flow: float = setting(1e-5, 1e-9, 1e-2, "m3/s", 2, 5.0)
    """Of the open valve; a twentieth of it is the least that is no fault."""
    valve_fastest: float = setting(5e-5, 1e-9, 1e-1, "m3/s", 3, 5.0)
    """Of the open valve at the greatest depth: what a movement of unknown speed reckons with."""
    mass_speed: float = setting(5.25e-3, 1e-6, 1.0, "m/s", 4, 5.0)
    """Of the moving mass, until the node has seen it."""
    steering_speed: float = setting(0.349, 1e-4, 20.0, "rad/s", 5, 5.0)
    """Of the steering, until the node has seen it."""
    oil_tolerance: float = setting(1e-7, 1e-10, 1e-3, "m3", 6, 10.0)
    """Difference of ballast volume from which the engine works."""
    mass_tolerance: float = setting(1e-3, 1e-9, 1.0, "m", 7, 10.0)
    """Distance from which the mass moves; it then stops within a quarter of it."""
    steering_tolerance: float = setting(1.75e-3, 1e-6, 1.0, "rad", 8, 10.0)
    """Angle from which the steering moves."""
    pump_current_limit: float = setting(8.0, 0.01, 20.0, "A", 9, 2.0)
    """Of the pump's motor; above it the motor is stopped."""
    mass_current_limit: float = setting(4.0, 0.01, 20.0, "A", 10, 2.0)
    """Of the pitch drive's motor."""
    steering_current_limit: float = setting(4.0, 0.01, 20.0, "A", 11, 2.0)
    """Of the steering motor."""
    stuck_after: float = setting(5.0, 1.0, 30.0, "s", 12)
    """Running time of a drive within which it must be seen to follow."""
    pause: float = setting(5.0, 0.1, 60.0, "s", 13)
    """Between a drive's failure and the next try."""
    retries: int = setting(2, 0, 100, "", 14)
    """Further tries before a drive is given up until a fault is cleared."""
    quiet_after: float = setting(5.0, 1.0, 60.0, "s", 15)
    """Time without Sync after which all stops."""
    blow_after: float = setting(60.0, 5.0, 600.0, "s", 16)
    """Time without Sync after which the node blows ballast."""
    switch_margin: float = setting(5e-3, 1e-4, 0.1, "m", 17)
    """How far from an end of its way the mass may be where that end's switch tells it."""
    switch_patience: float = setting(1.0, 0.0, 60.0, "s", 18)
    """How long a switch must contradict before it is called broken."""
    release_time: float = setting(10.0, 0.1, 600.0, "s", 19)
    """How long the release of the drop weight has current."""
    drop_after: float = setting(3600.0, 60.0, 86400.0, "s", 20)
    """Time without Sync after which a vehicle that could not pump its oil out drops its weight."""

    oil_crept: float = setting(0.0, 0.0, 1.0, "m3", 30)
    """What crept away from a reached set point and was brought back so far; the node counts on from the value set."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.require_order("ballast_low", "ballast_high")
        self.require_order("mass_low", "mass_high")
