"""Stations for tests: a folder, some vehicles, until the block ends."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from stommel.station.settings import load_settings
from stommel.station.station import Station


@contextmanager
def station(folder: Path, *links: str, start: bool = True, **told: Any) -> Iterator[Station]:
    """A station with vehicles 1, 2, ... at these links; `vehicle` has more settings of each."""
    more = told.pop("vehicle", {})
    vehicles = [{"vehicle": k, "link": link, "unsigned": True, **more} for k, link in enumerate(links, 1)]
    found = Station(load_settings(None, {"folder": folder, "vehicles": vehicles, **told}))
    try:
        if start:
            found.start()
        yield found
    finally:
        found.stop()
