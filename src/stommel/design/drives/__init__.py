"""Do the drives do what the design asks: pitch, rudder, trim change, and the figure."""

from stommel.design.drives.study import DriveStudy, PitchStudy, RudderStudy, drive_study
from stommel.design.drives.trim_change import TrimChange

__all__ = ["DriveStudy", "PitchStudy", "RudderStudy", "TrimChange", "drive_study"]
