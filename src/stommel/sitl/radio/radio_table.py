"""The table `[radio]` of a scenario: what the air does to the link."""

import math
from typing import Annotated, Any

from stommel.files.fields import Table
from stommel.files.kinds import Flag
from stommel.files.ranges import Share, between
from stommel.files.sentences import validated
from stommel.link.channel.settings import ChannelSettings


class RadioTable(Table):
    """The radio between vehicle and shore; left out, it is that of the paper on a calm day, close by."""

    bit_rate_kbit_s: Annotated[float, between(0.1, 1000)] = 115.2
    """Of the line, start and stop bits among them."""
    latency_ms: Annotated[float, between(0, 60_000)] = 50.0
    """One way."""
    jitter_ms: Annotated[float, between(0, 60_000)] = 0.0
    """Up to so much more."""
    half_duplex: Flag = True
    """Whether only one end speaks at a time."""
    turn_round_ms: Annotated[float, between(0, 60_000)] = 10.0
    """Silence before the other end speaks."""
    loss: Share = 0.0
    """Share of packets that are lost, each by itself."""
    fade_every_s: Annotated[float, between(0.01, 1e6)] | None = None
    """Mean time between fades; without it there are none."""
    fade_length_s: Annotated[float, between(0.001, 3600)] = 1.0
    """Mean duration of a fade."""
    bit_error_rate: Annotated[float, between(0, 0.5)] = 0.0
    """Share of bits that arrive flipped."""
    tethered: Flag = False
    """Whether a cable holds the antenna above the water and feeds the radio: the vehicle is heard under water too. For
    trials and first looks."""

    def settings(self) -> ChannelSettings:
        """Return the channel that this says."""
        fades = self.fade_every_s is not None
        return ChannelSettings(
            bit_rate=1e3 * self.bit_rate_kbit_s,
            latency=1e-3 * self.latency_ms,
            jitter=1e-3 * self.jitter_ms,
            half_duplex=self.half_duplex,
            turn_round=1e-3 * self.turn_round_ms,
            loss=self.loss,
            fade_every=self.fade_every_s if self.fade_every_s is not None else math.inf,
            fade_length=self.fade_length_s if fades else 0.0,
            bit_error_rate=self.bit_error_rate,
            tethered=self.tethered,
        )


class _Tables(Table):
    radio: RadioTable = RadioTable()


def channel_from(table: Any, origin: str) -> ChannelSettings:
    """Channel of a scenario's `[radio]`; `origin` names the file in messages.

    Raises
    ------
    FileError
        Something in it is impossible; each problem names the key, the value and what is allowed.
    """
    return validated({"radio": table}, _Tables, origin).radio.settings()
