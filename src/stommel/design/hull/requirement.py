"""What a hull must stand: read from a vehicle file and from what the user asks."""

from dataclasses import dataclass

from stommel.errors import StommelError
from stommel.machinery.hull.buckling import RingSection
from stommel.vehicle import Vehicle
from stommel.vehicle.missing_table import missing_table
from stommel.vehicle.schema import Hull


class HullError(StommelError):
    """A question about a hull that has no answer as it stands."""


@dataclass(frozen=True)
class Requirement:
    """Loads, sizes and safety factors that walls are sized for, in SI units."""

    P: float
    """Working pressure [Pa]: P_max."""
    depth: float
    """Depth that it stands for [m]."""
    D_o: float
    """Outer diameter [m]."""
    D_i: float | None
    """Inner diameter that must remain free [m]; None where the wall decides."""
    L: float
    """Longest length between reinforced joints [m]."""
    length: float
    """Whole length of the tube [m]."""
    C: float
    """Additional wall [m]."""
    phi_s: float
    """Weld joint efficiency [1]."""
    m_c: float
    m_a: float
    n_y: float
    """Yield over permissible stress [1]."""
    n_t: float
    """Tensile over permissible stress [1]."""
    knock_down: float
    """Share of a perfect tube's buckling pressure that out-of-roundness leaves [1]."""
    rings: RingSection | None
    notes: tuple[str, ...]
    """How sizes and loads were found where the file does not say them."""

    @property
    def pressure_per_metre(self) -> float:
        """Pressure per metre of depth [Pa/m]."""
        return self.P / self.depth

    @property
    def frame_length(self) -> float:
        """Length between neighbouring supports of the wall [m]: the rings' spacing, or L without rings."""
        return min(self.L, self.rings.spacing) if self.rings else self.L


def requirement(
    vehicle: Vehicle,
    *,
    depth_m: float | None = None,
    pressure_mpa: float | None = None,
    knock_down: float | None = None,
) -> Requirement:
    """Read a vehicle's requirement; its rated depth, pressure and knock-down unless others are given.

    Raises
    ------
    HullError
        The file has no hull or no depth, depth or pressure is not greater than zero, or the knock-down is not a share.
    """
    hull = vehicle.description.hull
    if hull is None:
        raise HullError(f"{vehicle.name}: its file has no table [hull] to size; {missing_table('hull')}")
    notes: list[str] = []
    P, depth = _load(vehicle, hull, depth_m, pressure_mpa, notes)
    L = _checked_length(vehicle, hull, notes)
    share = _knock_down(hull, knock_down, notes)
    rings = hull.rings
    return Requirement(
        P=P, depth=depth,
        D_o=hull.outer_diameter_mm / 1e3,
        D_i=hull.inner_diameter_mm / 1e3 if hull.inner_diameter_mm is not None else None,
        L=L, length=hull.length_m,
        C=hull.wall_allowance_mm / 1e3, phi_s=hull.weld_efficiency,
        m_c=hull.circumferential_safety_factor, m_a=hull.axial_safety_factor,
        n_y=hull.yield_safety_factor, n_t=hull.tensile_safety_factor,
        knock_down=share,
        rings=RingSection(rings.spacing_mm / 1e3, rings.height_mm / 1e3, rings.width_mm / 1e3) if rings else None,
        notes=tuple(notes),
    )  # fmt: skip


def _load(
    vehicle: Vehicle, hull: Hull, depth_m: float | None, pressure_mpa: float | None, notes: list[str]
) -> tuple[float, float]:
    """Pressure [Pa] and depth [m]."""
    if depth_m is not None and pressure_mpa is not None:
        raise HullError("give a depth or a pressure, not both")
    for name, value, unit in (("depth", depth_m, "m"), ("pressure", pressure_mpa, "MPa")):
        if value is not None and not 0.0 < value < float("inf"):
            raise HullError(f"{name} = {value:g} {unit}: must be a finite number greater than 0")
    water = vehicle.description.water
    per_metre = water.density_kg_m3 * water.gravity_m_s2
    if hull.design_pressure_mpa is not None and hull.depth_rating_m is not None:
        per_metre = hull.design_pressure_mpa * 1e6 / hull.depth_rating_m
        notes.append(
            f"pressure: {per_metre / 1e3:.4g} kPa per metre of depth, from hull.design_pressure_mpa over "
            "hull.depth_rating_m"
        )
    else:
        notes.append(f"pressure: {per_metre / 1e3:.4g} kPa per metre of depth, the weight of the reference water")
    if pressure_mpa is not None:
        return pressure_mpa * 1e6, pressure_mpa * 1e6 / per_metre
    if depth_m is None:
        depth_m = hull.depth_rating_m
    if depth_m is None and hull.design_pressure_mpa is not None:
        return hull.design_pressure_mpa * 1e6, hull.design_pressure_mpa * 1e6 / per_metre
    if depth_m is None:
        raise HullError(
            f"{vehicle.name}: its file has neither hull.depth_rating_m nor hull.design_pressure_mpa; give a depth"
        )
    return per_metre * depth_m, depth_m


def _knock_down(hull: Hull, asked: float | None, notes: list[str]) -> float:
    """Share of the perfect tube's buckling pressure that the built one keeps."""
    if asked is not None and not 0.0 < asked <= 1.0:
        raise HullError(f"knock-down = {asked:g}: must be greater than 0 and at most 1")
    share = hull.knock_down if asked is None else asked
    if share < 1.0:
        notes.append(f"knock-down for imperfections: {share:g} of the buckling pressure of a perfect tube")
    else:
        notes.append(
            "knock-down for imperfections: none; all buckling pressures are those of a perfect tube, and the safety "
            f"factor of {hull.circumferential_safety_factor:g} alone answers for one that is out of round"
        )
    return share


def _checked_length(vehicle: Vehicle, hull: Hull, notes: list[str]) -> float:
    """L of the paper [m]."""
    if hull.checked_length_m is not None:
        return hull.checked_length_m
    dry = [bay.from_m - bay.to_m for bay in vehicle.description.bays if not bay.flooded]
    if dry and max(dry) <= hull.length_m:
        notes.append("length between reinforced joints: that of the longest dry bay")
        return max(dry)
    notes.append("length between reinforced joints: the whole hull, as the file names no bay")
    return hull.length_m
