"""Drives of the moving mass and of the rudder (section 4.3.3 of the paper): speed, torque, current, energy."""

from stommel.machinery.drives.failures import DriveError
from stommel.machinery.drives.pitch import PitchDrive, PitchPoint
from stommel.machinery.drives.rudder import RudderDrive, RudderStep, RudderTurn

__all__ = ["DriveError", "PitchDrive", "PitchPoint", "RudderDrive", "RudderStep", "RudderTurn"]
