"""Drives of the moving mass and of the rudder (section 4.3.3 of the paper): speed, torque, current, energy, safety."""

from stommel.design.drives.failures import DriveError
from stommel.design.drives.pitch import PitchDrive, PitchPoint
from stommel.design.drives.rudder import RudderDrive, RudderStep, RudderTurn
from stommel.design.drives.study import DriveStudy, PitchStudy, RudderStudy, drive_study
from stommel.design.drives.trim_change import TrimChange

__all__ = [
    "DriveError",
    "DriveStudy",
    "PitchDrive",
    "PitchPoint",
    "PitchStudy",
    "RudderDrive",
    "RudderStep",
    "RudderStudy",
    "RudderTurn",
    "TrimChange",
    "drive_study",
]
