"""The shore station under a steady load: `python benchmarks/station_ingest.py [--minutes 10] [--rate 2000]`.

Sends telemetry over TCP, with browsers that watch live; says whether all of it is stored, and whether the station's
memory stays flat. The exit status is 1 if a message is lost.
"""

import argparse
import sys

from figures.station_ingest import BAR, BROWSERS, ingest

WARM = 0.2
"""Share of the time after which memory is compared."""


def main() -> int:
    """Measure, and print what came of it."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--rate", type=float, default=BAR, help="messages a second")
    parser.add_argument("--browsers", type=int, default=BROWSERS)
    told = parser.parse_args()
    found = ingest(60.0 * told.minutes, told.rate, told.browsers)
    warm = found.memory_mib[int(WARM * len(found.memory_mib))]
    print(f"sent {found.sent}, stored {found.stored}, lost {found.sent - found.stored}")
    print(f"all stored {found.seconds:.1f} s after the first: {found.sent / found.seconds:.0f} messages/s")
    print(f"station: {found.cpu_s / found.seconds:.0%} of a core")
    print(f"memory: {warm:.0f} MiB after a fifth of the time, {found.memory_mib[-1]:.0f} MiB at the end")
    print(f"browsers had {found.seen} messages; the longest wait for new values was {found.slowest_s:.1f} s")
    return int(found.stored != found.sent)


if __name__ == "__main__":
    sys.exit(main())
