"""A plain tube: its size, mass and displacement."""

from dataclasses import dataclass
from math import pi

from stommel.machinery.hull.elasticity import tube_compressibility
from stommel.machinery.hull.materials import Material


@dataclass(frozen=True)
class Tube:
    """A tube of one wall and one material; its outer diameter is what the water sees."""

    material: Material
    D_o: float
    """Outer diameter [m]."""
    delta: float
    """Wall [m]."""
    length: float
    """Whole length [m]."""

    @property
    def D_i(self) -> float:
        """Inner diameter [m]."""
        return self.D_o - 2.0 * self.delta

    @property
    def R(self) -> float:
        """Radius of the middle surface [m]."""
        return 0.5 * (self.D_o - self.delta)

    @property
    def mass(self) -> float:
        """Mass of the tube without ends [kg]."""
        return self.material.rho * pi / 4.0 * (self.D_o**2 - self.D_i**2) * self.length

    @property
    def displaced_volume(self) -> float:
        """Volume that the tube displaces between its ends [m3]."""
        return pi / 4.0 * self.D_o**2 * self.length

    @property
    def compressibility(self) -> float:
        """Relative loss of displaced volume per unit of pressure [1/Pa]."""
        return tube_compressibility(self.D_i, self.D_o, self.material.E, self.material.nu)
