"""What the station keeps: every frame as it came, what it says, and what people did."""

from stommel.archive.archive import Archive
from stommel.archive.errors import (
    ArchiveBrokenError,
    ArchiveBusyError,
    ArchiveError,
    ArchiveFullError,
    ArchiveRequestError,
)
from stommel.archive.rows import Batch, CtdRow, DiveRow, FrameRow, TextRow
from stommel.archive.series import Series

__all__ = [
    "Archive",
    "ArchiveBrokenError",
    "ArchiveBusyError",
    "ArchiveError",
    "ArchiveFullError",
    "ArchiveRequestError",
    "Batch",
    "CtdRow",
    "DiveRow",
    "FrameRow",
    "Series",
    "TextRow",
]
