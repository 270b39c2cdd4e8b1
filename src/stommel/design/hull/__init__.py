"""Pressure hull: wall, mass and collapse depth in any material, by the paper's formulas and by the classical ones."""

from stommel.design.hull.study import HullStudy, hull_study

__all__ = ["HullStudy", "hull_study"]
