"""What the log book says of something that happened; of dives also what was known of them at a time."""

from typing import NamedTuple

from stommel.archive import DiveRow


class Told(NamedTuple):
    """Whoever did it, in which words, and what has become of it."""

    user: str | None
    words: str
    state: str | None
    dive: DiveRow | None = None


def told_of(dive: DiveRow) -> Told:
    """A dive, in words."""
    depth = "" if dive.greatest_depth_m is None else f" to {dive.greatest_depth_m:.0f} m"
    return Told(None, f"Dive {dive.dive}{depth}", "under way" if dive.t_end is None else "ended", dive)


def known_then(dive: DiveRow, t: float) -> DiveRow:
    """What was known of a dive at a time [s since 1970]: before its end, where and when it began."""
    if dive.t_end is not None and dive.t_end <= t:
        return dive
    return DiveRow(dive.dive, dive.t_begin, latitude_begin=dive.latitude_begin, longitude_begin=dive.longitude_begin)
