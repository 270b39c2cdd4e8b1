"""Pressure hull: wall, mass and collapse depth in any material, by the paper's formulas and by the classical ones."""

from stommel.design.hull.materials import Material, MaterialError, find_material, load_materials
from stommel.design.hull.study import HullStudy, hull_study
from stommel.design.hull.tube import Tube

__all__ = ["HullStudy", "Material", "MaterialError", "Tube", "find_material", "hull_study", "load_materials"]
