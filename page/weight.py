"""How much the built page weighs, compressed as the station sends it; exit status 1 if it is over 1 MB."""

import gzip
import sys
from pathlib import Path

BUILT = Path(__file__).resolve().parent.parent / "src" / "stommel" / "station" / "built"
MOST_KB = 1000.0
FIRST = ("index.html", "theme.js", "assets/index-")
"""Begins of the names of what is fetched before the first paint."""


def weights(folder: Path = BUILT) -> dict[str, float]:
    """Weight of each file of the page [kB], compressed."""
    files = sorted(path for path in folder.rglob("*") if path.is_file() and path.suffix != ".gz")
    return {path.relative_to(folder).as_posix(): len(gzip.compress(path.read_bytes(), 6)) / 1e3 for path in files}


def main() -> int:
    """Print the weight; 1 if it is over the bar or nothing is built."""
    found = weights()
    if not found:
        print(f"page: nothing is built in {BUILT}", file=sys.stderr)
        return 1
    total = sum(found.values())
    first = sum(weight for name, weight in found.items() if name.startswith(FIRST))
    print(f"page: {total:.0f} kB compressed, {first:.0f} kB of it before the first paint; at most {MOST_KB:.0f} kB")
    if total <= MOST_KB:
        return 0
    for name, weight in sorted(found.items(), key=lambda item: -item[1])[:10]:
        print(f"  {weight:7.1f} kB  {name}", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
