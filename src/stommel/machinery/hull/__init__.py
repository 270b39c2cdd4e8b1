"""The pressure hull as metal: materials, elastic tubes and end caps, yielding and buckling (docs/theory/hull)."""

from stommel.machinery.hull.materials import Material, MaterialError, find_material, load_materials
from stommel.machinery.hull.tube import Tube

__all__ = ["Material", "MaterialError", "Tube", "find_material", "load_materials"]
