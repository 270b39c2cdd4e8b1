"""What an archive holds of a vehicle, sample by sample."""

from stommel.archive import Archive
from stommel.archive.sample_pieces import kept_channels, sample_pieces
from stommel.archive.times import seconds


def every_sample(archive: Archive, vehicle: int, begin: float, end: float) -> list[tuple[str, float, float]]:
    """Key, time and value from `begin` to `end`, channel by channel in order of their keys."""
    pieces = sample_pieces(archive, vehicle, kept_channels(archive, vehicle), begin, end)
    return [
        (key, seconds(t_us), value)
        for key, times, values in pieces
        for t_us, value in zip(times.tolist(), values.tolist(), strict=True)
    ]
