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

    ballast_low: float = setting("least ballast volume", -2.5e-4, -3e-3, 3e-3, "m3")
    ballast_high: float = setting("greatest ballast volume", 2.5e-4, -3e-3, 3e-3, "m3")
    mass_low: float = setting("aft end of the moving mass's way", -0.05, -0.6, 0.6, "m")
    mass_high: float = setting("fore end of the moving mass's way", 0.55, -0.6, 0.6, "m")
    steering_limit: float = setting("greatest angle of the steering to either side", 1.0472, 0.01, 1.6, "rad")
    has_drop_weight: bool = False
    """Whether the vehicle has a drop weight and its release."""

    pump_flow: float = setting("flow of the pump, until the node has seen it", 8.3e-6, 1e-9, 1e-2, "m3/s", 1, 5.0)
    valve_flow: float = setting(
        "flow of the open valve; a twentieth of it is the least that is no fault", 1e-5, 1e-9, 1e-2, "m3/s", 2, 5.0
    )
    valve_fastest: float = setting(
        "flow of the open valve at full depth, for a movement of unknown speed", 5e-5, 1e-9, 1e-1, "m3/s", 3, 5.0
    )
    mass_speed: float = setting(
        "speed of the moving mass, until the node has seen it", 5.25e-3, 1e-6, 1.0, "m/s", 4, 5.0
    )
    steering_speed: float = setting(
        "speed of the steering, until the node has seen it", 0.349, 1e-4, 20.0, "rad/s", 5, 5.0
    )
    oil_tolerance: float = setting(
        "difference of ballast volume from which the engine works", 1e-7, 1e-10, 1e-3, "m3", 6, 10.0
    )
    mass_tolerance: float = setting(
        "distance from which the mass moves; it then stops within a quarter of it", 1e-3, 1e-9, 1.0, "m", 7, 10.0
    )
    steering_tolerance: float = setting("angle from which the steering moves", 1.75e-3, 1e-6, 1.0, "rad", 8, 10.0)
    pump_current_limit: float = setting(
        "current of the pump's motor above which it is stopped", 8.0, 0.01, 20.0, "A", 9, 2.0
    )
    mass_current_limit: float = setting(
        "current of the pitch drive's motor above which it is stopped", 4.0, 0.01, 20.0, "A", 10, 2.0
    )
    steering_current_limit: float = setting(
        "current of the steering motor above which it is stopped", 4.0, 0.01, 20.0, "A", 11, 2.0
    )
    stuck_after: float = setting(
        "running time of a drive within which it must be seen to follow", 5.0, 1.0, 30.0, "s", 12
    )
    pause: float = setting("time between a drive's failure and the next try", 5.0, 0.1, 60.0, "s", 13)
    retries: int = setting("further tries before a drive is given up until a fault is cleared", 2, 0, 100, "", 14)
    quiet_after: float = setting("time without Sync after which all stops", 5.0, 1.0, 60.0, "s", 15)
    blow_after: float = setting("time without Sync after which the node blows ballast", 60.0, 5.0, 600.0, "s", 16)
    switch_margin: float = setting(
        "how far from an end of its way the mass may be when that end's switch closes", 5e-3, 1e-4, 0.1, "m", 17
    )
    switch_patience: float = setting(
        "how long a switch must contradict before it is called broken", 1.0, 0.0, 60.0, "s", 18
    )
    release_time: float = setting("how long the release of the drop weight has current", 10.0, 0.1, 600.0, "s", 19)
    drop_after: float = setting(
        "time without Sync after which a vehicle that cannot pump drops its weight", 3600.0, 60.0, 86400.0, "s", 20
    )

    oil_crept: float = setting(
        "oil that crept away from reached set points and was brought back; counts on from here", 0.0, 0.0, 1.0, "m3", 30
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        self.require_order("ballast_low", "ballast_high")
        self.require_order("mass_low", "mass_high")
