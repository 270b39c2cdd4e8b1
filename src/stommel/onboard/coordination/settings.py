"""What a coordinator is set up with."""

from dataclasses import dataclass, field

from stommel.instruments.gnss.driver import GnssSettings
from stommel.instruments.tcm.driver import CompassSettings
from stommel.messages.nodes import NodeKind
from stommel.onboard.coordination.compass.calibration import CompassCalibration
from stommel.onboard.coordination.compass.compensation import Masking
from stommel.onboard.coordination.limits import ActuatorLimits, SafetyLimits
from stommel.onboard.coordination.navigation import NavigationErrors
from stommel.onboard.coordination.node_parameters import Wanted
from stommel.onboard.coordination.power import PowerSchedule


@dataclass(frozen=True)
class CoordinatorSettings:
    """Numbers of the vehicle and of its instruments; SI units and radians."""

    safety: SafetyLimits
    actuators: ActuatorLimits
    has_drop_weight: bool = False
    has_altimeter: bool = True
    declination: float = 0.0
    """From magnetic to true north, east positive."""
    calibration: CompassCalibration = field(default_factory=CompassCalibration)
    masking: Masking = field(default_factory=Masking)
    compass: CompassSettings = field(default_factory=lambda: CompassSettings(polled=False))
    gnss: GnssSettings = field(default_factory=GnssSettings)
    navigation: NavigationErrors = field(default_factory=NavigationErrors)
    usable_energy: float | None = None
    """Energy of the charged battery that may be taken [J]; None where nobody said."""
    mean_power_over: float = 14_400.0
    """Time over which the mean power is taken [s]."""
    schedule: PowerSchedule = field(default_factory=PowerSchedule)
    node_parameters: Wanted = field(default_factory=dict)
    """What parameters of the nodes shall be, by number of the node and name; others are left as they are."""
    kind: NodeKind = field(default_factory=lambda: NodeKind(1, (0, 1, 0)))
    """Of this computer."""
    report_every: float = 60.0
    """Between two records of hull, battery and bus in the log."""
