"""Measure the speed of stommel: `python benchmarks/run.py [--only NAME[,NAME]]`.

Prints one line a figure and writes build/bench.json. A figure that misses its bar is a result, not a failure: the exit
status is 1 only if a figure crashed.
"""

import argparse
import hashlib
import json
import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / "build"


def fresh_cache() -> Path:
    """Folder of machine code for exactly these sources.

    Numba looks only at the file of a cached function, not at the files of what it inlines: after a change there it
    would measure the old code.
    """
    digest = hashlib.sha256()
    for source in sorted((ROOT / "src").rglob("*.py")):
        digest.update(source.read_bytes())
    return BUILD / "numba-cache" / digest.hexdigest()[:16]


def main() -> int:
    """Run the figures and return the exit status."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--only", metavar="NAME[,NAME]", help="names of figures, separated by commas")
    arguments = parser.parse_args()
    os.environ["NUMBA_CACHE_DIR"] = str(fresh_cache())  # read when Numba is imported

    from figures import registry  # noqa: PLC0415  # imports Numba

    try:
        chosen = registry.select(arguments.only.split(",") if arguments.only else None)
    except registry.UnknownFigureError as error:
        parser.error(str(error))
    results: dict[str, registry.Entry] = {}
    print(f"{'figure':32} {'value':>12} {'unit':6} {'bar':>8}  ok")
    for figure in chosen:
        results[figure.name] = entry = registry.measured(figure)
        print(registry.line(figure.name, entry), flush=True)
    BUILD.mkdir(exist_ok=True)
    (BUILD / "bench.json").write_text(json.dumps(results, indent=2) + "\n", encoding="utf-8")
    return int(any("error" in entry["detail"] for entry in results.values()))


if __name__ == "__main__":
    sys.exit(main())
