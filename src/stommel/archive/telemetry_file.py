"""Samples of a vehicle as CSV: one line a sample, channel by channel."""

import csv
import io
from collections.abc import Iterable
from itertools import repeat
from pathlib import Path

from stommel.archive.sample_pieces import SamplePiece
from stommel.files.whole import whole_file

HEAD = "time [UTC],channel,value\n"


def lines_of(piece: SamplePiece) -> str:
    """A line for each sample, as they stand below `HEAD`; its unit is the end of the channel's name."""
    text = io.StringIO()
    stamps = ((piece.t_us + 500) // 1000).astype("datetime64[ms]").astype(str)
    rows = zip((f"{stamp}Z" for stamp in stamps), repeat(piece.key), map(repr, piece.value.tolist()), strict=False)
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


def write_telemetry(pieces: Iterable[SamplePiece], file: Path) -> int:
    """Write samples that come in pieces, of which one is held at a time, whole or not at all; how many.

    Raises
    ------
    OutputError
        The file cannot be written.
    """
    count = 0
    with whole_file(file) as made, made.open("w", encoding="utf-8", newline="") as out:
        out.write(HEAD)
        for piece in pieces:
            out.write(lines_of(piece))
            count += piece.t_us.size
    return count
