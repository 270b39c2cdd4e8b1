"""What people changed at a vehicle, for the log book: who holds command, and what limits there are."""

import logging
from collections.abc import Callable
from typing import Literal

from sqlalchemy import insert

from stommel.archive import Archive, ArchiveError
from stommel.archive.doing_table import doings
from stommel.archive.times import microseconds

Kind = Literal["hold", "limit"]


class Doings:
    """The table of doings.

    Parameters
    ----------
    archive
        Where it is.
    now
        The clock of a vehicle [s since 1970].
    """

    def __init__(self, archive: Archive, now: Callable[[int], float]) -> None:
        self._archive, self._now = archive, now

    def add(self, vehicle: int, kind: Kind, user: str, words: str) -> None:
        """Write what was done just now; if the archive does not take it, it is done all the same."""
        t_us = microseconds(self._now(vehicle))
        row = {"vehicle_id": vehicle, "t_us": t_us, "kind": kind, "user": user, "words": words}
        try:
            with self._archive.writing() as connection:
                connection.execute(insert(doings).values(row))
        except ArchiveError:
            logging.getLogger(__name__).exception("not in the log book: %s", row)
