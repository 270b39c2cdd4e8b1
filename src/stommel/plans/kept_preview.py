"""What of a preview is kept beside the mission that it foretold: its track in few points, its dives and its totals."""

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from stommel.files.ranges import DepthOrZero, Share, between
from stommel.files.sentences import validated
from stommel.geometry.geodesics import Place
from stommel.geometry.longitudes import wrapped_deg
from stommel.mission.plan import Latitude
from stommel.plans.predicted_track import thinned

MOST_DIVES = 2000
"""That a preview lists."""
MOST_GIVEN = 4000
"""Points of a track that is handed in."""
MOST_POINTS = 1000
"""Points of a track that is kept."""
WITHIN_M = 20.0
"""How far the kept track may lie from a point of the whole one, unless it has more points than `MOST_POINTS` then."""

Date = Annotated[float, between(-62_135_596_800, 253_402_300_800)]
"""In the years 1 to 9999 [s since 1970]."""
Longitude = Annotated[float, between(-360, 360), AfterValidator(wrapped_deg)]
"""A flight over the date line may count on [deg]."""
Current = Annotated[float, between(-100, 100)]
"""To north or east [m/s]."""
Energy = Annotated[float, between(0, 1e12)]
"""Out of the battery [J]."""


class TrackPoint(BaseModel):
    """A place of a track."""

    t: Date
    lat: Latitude
    lon: Longitude


class PlannedDive(BaseModel):
    """A predicted dive."""

    dive: Annotated[int, between(1, 1_000_000)]
    t_begin: Date
    t_end: Date
    latitude_begin: Latitude
    longitude_begin: Longitude
    latitude_end: Latitude
    longitude_end: Longitude
    greatest_depth_m: DepthOrZero
    current_north_m_s: Current | None
    current_east_m_s: Current | None
    energy_j: Energy | None


class Prediction(BaseModel):
    """What a preview foretold of a mission as a whole; null: it did not tell."""

    model_config = ConfigDict(extra="forbid")

    t_begin: Date | None = None
    duration_s: Annotated[float, between(0, 4e7)] | None = None
    energy_j: Energy | None = None
    battery_left_share: Share | None = None
    distance_m: Annotated[float, between(0, 1e9)] | None = None
    """Over ground, along the track [m]."""
    dive_count: Annotated[int, between(0, 1_000_000)] | None = None
    track: Annotated[list[TrackPoint], Field(max_length=MOST_GIVEN)] = []
    """Empty where it was not kept, as by stations of before."""
    track_within_m: Annotated[float, between(0, 1e8)] | None = None
    """No point of the whole track lies farther from this one, which has fewer points; null: it is the whole."""


class KeptPreview(Prediction):
    """A preview, as far as it is compared with what is flown."""

    dives: Annotated[list[PlannedDive], Field(max_length=MOST_DIVES)]

    def thinned(self) -> "KeptPreview":
        """The same, with no more points of the track than its line needs."""
        if len(self.track) <= 2:
            return self
        found = thinned([Place(point.lat, point.lon) for point in self.track], MOST_POINTS, WITHIN_M)
        if len(found.kept) == len(self.track):
            return self
        within = found.within_m + (self.track_within_m or 0.0)
        return self.model_copy(update={"track": [self.track[k] for k in found.kept], "track_within_m": within})


def kept_preview(told: Mapping[str, Any]) -> KeptPreview:
    """What is kept of a preview that the simulator told, or that was kept before.

    Raises
    ------
    FileError
        It is no preview.
    """
    return validated({name: told[name] for name in KeptPreview.model_fields if name in told}, KeptPreview, "preview")
