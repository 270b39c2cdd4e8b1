"""The CTD at its serial port, apart from the plant: a node in a process of its own loads no compiled physics."""

import math
from collections.abc import Sequence

from stommel.instruments.gpctd.device import CtdDevice, CtdTruth
from stommel.instruments.gpctd.driver import CtdDriver


class CtdPort:
    """The CTD with its driver, as the data-acquisition node wants it."""

    def __init__(self) -> None:
        self.device, self.driver = CtdDevice(), CtdDriver()
        self._due = -math.inf
        self._out = b""
        self._interval = 1.0

    def take(self, data: bytes, t: float) -> Sequence[tuple[float, float, float]]:
        """Samples that are complete with these bytes, one each interval."""
        samples = []
        for reading in self.driver.take(data, t):
            if t >= self._due - 1e-6:
                self._due = t + self._interval
                samples.append((reading.pressure, reading.temperature, reading.conductivity))
        return samples

    def poll(self, t: float, sampling: bool, interval: float) -> bytes:
        """Bytes to send, so that it samples or rests."""
        self._interval = interval
        self.driver.sample(sampling)
        return self.driver.poll(t)

    def exchange(self, data: bytes, truth: CtdTruth, t: float) -> bytes:
        """Bytes that the instrument sends until a time [s]."""
        return self.device.take(data, truth, t)
