"""Names of samples: each variable once, with its CF standard name, its unit and the range that it can have."""

from typing import Any, NamedTuple


class Variable(NamedTuple):
    """A variable of a data set."""

    name: str
    long_name: str
    units: str
    standard_name: str = ""
    low: float | None = None
    high: float | None = None
    more: tuple[tuple[str, Any], ...] = ()
    """Further attributes."""

    @property
    def attributes(self) -> dict[str, Any]:
        """As CF wants them beside the values."""
        found: dict[str, Any] = {"long_name": self.long_name, "units": self.units}
        if self.standard_name:
            found["standard_name"] = self.standard_name
        if self.low is not None and self.high is not None:
            found["valid_min"], found["valid_max"] = self.low, self.high
        return found | dict(self.more)


VARIABLES = (
    Variable("latitude", "latitude", "degrees_north", "latitude", -90.0, 90.0),
    Variable("longitude", "longitude", "degrees_east", "longitude", -180.0, 180.0),
    Variable("depth", "depth below the surface", "m", "depth", -5.0, 12_000.0,
             (("positive", "down"), ("axis", "Z"))),
    Variable("pressure", "pressure of the sea, the atmosphere taken off", "dbar", "sea_water_pressure_due_to_sea_water",
             -5.0, 12_000.0),
    Variable("temperature", "in-situ temperature, ITS-90", "degree_Celsius", "sea_water_temperature", -5.0, 42.0),
    Variable("conductivity", "electrical conductivity", "S m-1", "sea_water_electrical_conductivity", 0.0, 9.0),
    Variable("practical_salinity", "practical salinity, PSS-78", "1", "sea_water_practical_salinity", 0.0, 42.0),
    Variable("absolute_salinity", "Absolute Salinity, TEOS-10", "g kg-1", "sea_water_absolute_salinity", 0.0, 42.0),
    Variable("conservative_temperature", "Conservative Temperature, TEOS-10", "degree_Celsius",
             "sea_water_conservative_temperature", -5.0, 42.0),
    Variable("density", "in-situ density", "kg m-3", "sea_water_density", 990.0, 1100.0),
    Variable("potential_density_anomaly", "potential density less 1000 kg m-3, to 0 dbar", "kg m-3",
             "sea_water_sigma_theta", -10.0, 40.0),
    Variable("sound_speed", "speed of sound", "m s-1", "speed_of_sound_in_sea_water", 1300.0, 1800.0),
)  # fmt: skip
"""What is measured and derived."""

BY_NAME = {variable.name: variable for variable in VARIABLES}
