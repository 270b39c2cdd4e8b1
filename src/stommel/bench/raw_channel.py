"""A column of a log before it is trusted."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from stommel.bench.column_map import Channel
from stommel.bench.failures import BenchFileError, refuse

Series = NDArray[np.float64]


@dataclass(frozen=True)
class RawChannel:
    """A column as it stands in the file: numbers in the file's unit, with the line of each."""

    file: str
    quantity: str
    channel: Channel
    values: Series
    lines: NDArray[np.int_]

    @property
    def column(self) -> str:
        """Name of the column, or of the quantity that is a constant."""
        return self.channel.column or self.quantity

    def part(self, where: NDArray[np.bool_] | slice) -> "RawChannel":
        """Some of the rows."""
        return RawChannel(self.file, self.quantity, self.channel, self.values[where], self.lines[where])

    def refuse(self, k: int, message: str) -> BenchFileError:
        """Return the error for row `k`."""
        return refuse(self.file, self.column, message, int(self.lines[k]))
