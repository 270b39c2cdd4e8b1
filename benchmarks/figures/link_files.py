"""Files over the radio: goodput over the bound that losses and headers leave; the worst of two latencies."""

import hashlib
import sys
from pathlib import Path

from figures.registry import Measurement, figure
from stommel.link.channel.settings import ChannelSettings
from stommel.link.files.loss import MOST_SEGMENT

SIZE = 1_000_000
LATENCIES = (0.05, 0.5)
FRAME = 280
"""Bytes of a signed FILE_DATA with a whole segment."""
BAR = 0.85


def cell(latency: float, loss: float, seed: int = 0) -> tuple[float, dict[str, float]]:
    """Return goodput over `(1 - loss) payload share bit rate` for 1 MB at 115.2 kbit/s half-duplex, and details."""
    sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
    from tests.link.files.test_download import Transfer, share_of_bound  # noqa: PLC0415  # the same ends as in the tests

    data = b"".join(hashlib.sha256(str(k).encode()).digest() for k in range(SIZE // 32))
    settings = ChannelSettings(latency=latency, loss=loss, whole_frames=True)
    transfer = Transfer(settings, data, seed)
    transfer.run(10_000.0)
    if transfer.kept != data:
        raise AssertionError("the file that came is not the one that was sent")
    share = share_of_bound(len(data), transfer.pair.t, loss, settings.bytes_a_second)
    counts = transfer.download.counts
    return share, {
        "seconds": round(transfer.pair.t, 1),
        "duplicate_share": counts.duplicate / counts.received,
        "requests": counts.requests,
        "time_outs": counts.time_outs,
    }


def _worst(loss: float) -> Measurement:
    cells = {latency: cell(latency, loss) for latency in LATENCIES}
    detail = {f"latency {latency} s": {"share": share} | more for latency, (share, more) in cells.items()}
    return Measurement(min(share for share, _ in cells.values()), detail | {"payload_share": MOST_SEGMENT / FRAME})


@figure(unit="1", bar=BAR, at_least=True)
def link_goodput_share_loss0() -> Measurement:
    """Measure without loss."""
    return _worst(0.0)


@figure(unit="1", bar=BAR, at_least=True)
def link_goodput_share_loss20() -> Measurement:
    """Measure with a fifth of all frames lost."""
    return _worst(0.2)


@figure(unit="1", bar=BAR, at_least=True)
def link_goodput_share_loss40() -> Measurement:
    """Measure with two fifths of all frames lost."""
    return _worst(0.4)
