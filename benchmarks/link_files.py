"""All figures of files over the radio: `python benchmarks/link_files.py [SEEDS]`.

Goodput of 1 MB in every cell of loss and latency; the same file over surfacings of 60 s with both ends killed at
random; duplicates at a round trip of 2 s.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from figures.link_files import SIZE, cell

from stommel.link.channel.settings import ChannelSettings
from tests.link.files.fakes import noise
from tests.link.files.test_download import Transfer, surfacings

SURFACINGS_BIT_RATE = 14_400.0
"""At which 1 MB takes about twenty surfacings."""


def main() -> None:
    """Print everything."""
    seeds = range(int(sys.argv[1]) if len(sys.argv) > 1 else 1)
    print("loss  latency  goodput share: least of the seeds, then each")
    for loss in (0.0, 0.1, 0.2, 0.4):
        for latency in (0.05, 0.5):
            shares = [cell(latency, loss, seed)[0] for seed in seeds]
            print(
                f"{loss:4.1f}  {latency:7.2f}  {min(shares):.3f}  ", *(f"{share:.3f}" for share in shares), flush=True
            )
    data = noise(SIZE, 7)
    for seed in seeds:
        transfer, kills = surfacings(seed, data, SURFACINGS_BIT_RATE, power_cuts=False)
        again = (transfer.arrived - SIZE) / SIZE
        whole = bytes(transfer.disk.files.get("a.log", b"")) == data
        print(f"surfacings: {transfer.pair.t / 100.0:.1f}, kills: {kills}, whole: {whole}, sent again: {again:.4f}")
    for loss in (0.0, 0.2, 0.4):
        for seed in seeds:
            slow = Transfer(ChannelSettings(latency=1.0, loss=loss, whole_frames=True), data, seed)
            slow.run(10_000.0)
            counts = slow.download.counts
            print(f"round trip 2 s, loss {loss}: duplicates {counts.duplicate / counts.received:.4f}", flush=True)


if __name__ == "__main__":
    main()
