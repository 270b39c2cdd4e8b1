"""A fault at work: its own random draws, which no other fault changes, and what it remembers."""

from typing import Any
from zlib import crc32

import numpy as np

from stommel.sitl.faults.fault import Fault


class Acting:
    """One fault of a flight.

    Its draws follow from the flight's seed and from the fault itself, so that it does the same when other faults are
    taken away.
    """

    def __init__(self, fault: Fault, seed: int) -> None:
        self.fault = fault
        self.kind, self.target, self.value = fault.kind, fault.target, fault.value
        self.draw = np.random.default_rng((seed, crc32(fault.words.encode())))
        self.kept: Any = None
        """What it remembers from its beginning on."""

    def strikes(self) -> bool:
        """Draw whether it strikes, its value being the probability."""
        return bool(self.draw.random() < self.value)
