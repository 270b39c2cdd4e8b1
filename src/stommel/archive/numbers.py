"""Numbers as the archive keeps them."""

import math
from collections.abc import Iterator, Sequence

GREATEST_VALUE = 1e290
"""Of a sample, either sign; the sum of as many as ten minutes can have is still a number."""


def known(values: Sequence[float | None]) -> Iterator[float | None]:
    """Values, of which those that are no number are not known."""
    return (None if value is None or not math.isfinite(value) else value for value in values)
