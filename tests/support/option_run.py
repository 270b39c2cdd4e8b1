"""Every option of every verb with bad and extreme values, in one process, and what came of it.

`python -m tests.support.option_run [--share 0.1] [--seconds 10]`; no part of the quick tests. The figures are those of
`tests.support.mutation_run`.
"""

import argparse
import random
import signal
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import typer

from stommel.cli.app import app
from tests.support.mutation_run import Tally, finite_answer, run_timed, stop
from tests.support.shipped_files import STUDY

FLIGHT = ("--speed", 0.4, "--pitch", -35)
CALLS: tuple[tuple[object, ...], ...] = (
    ("design", "rogue", "--no-report"),
    ("trim", "zju", *FLIGHT),
    ("table", "zju", *FLIGHT),
    ("steady", "seawing", "--moving-mass-mm", 421.67, "--ballast-ml", -292.7, "--roll-mass-deg", 45),
    ("turn", "seawing", *FLIGHT, "--turn-rate", 0.005),
    ("envelope", "zju"),
    ("flight-table", "zju"),
    ("orders", "pool_trial"),
    ("modes", "zju", *FLIGHT),
    ("root-locus", "zju", "--over", "wing_position", "--from", 0, "--to", 0.2, "--points", 3),
    ("derivative", "zju", "--states", "states.json"),
    ("hull", "zju"),
    ("drives", "zju"),
    ("engine", "zju", "--pressure-mpa", 1),
    ("endurance", "zju"),
    ("budget", "zju"),
    ("vehicle", "show", "rogue"),
    ("vehicle", "check", "rogue"),
    ("vehicle", "new", "mine.toml", "--force"),
    ("vehicle", "config", "zju", "--output", "begun", "--force"),
    ("bench", "generate", "zju", "--output", "made.csv", "--pressure-mpa", "0,1", "--speed-rpm", "5000,7000"),
    ("bench", "speed", "zju"),
    ("bench", "pressure", "fan2013-table5"),
    ("ocean", "show", "pool", "--at", "30,120"),
    ("simulate", "pool_trial"),
    ("study", "study.toml"),
    ("can", "dump", "--interface", "virtual", "--seconds", 0.1),
    ("can", "decode", "702#020000050000002A"),
    ("can", "send", "Sync", "vehicle_time=1", "--interface", "virtual", "--times", 1),
)
"""A sound call of every verb that takes options."""

VALUES = (
    "", " ", "/", ".", "..", "x" * 5000, "a/" * 3000, "nowhere", "nan", "inf", "-inf", "1e308", "-1e308", "1e-308",
    "1e30", "1e6", "1e-6", "0", "-0.0", "-1", "9" * 60, "7" * 5000, "1,2", "1:2", "0:1:1e-9", "0:1e308:1e300", "1:2:0",
    ",", ":", "\n", "\u2028", "--json", "true",
)  # fmt: skip
"""What is put behind every option, and in place of every argument."""


def cases() -> Iterator[tuple[object, ...]]:
    """Yield calls with one option or argument changed."""
    root: Any = typer.main.get_command(app)
    for call in CALLS:
        command, words = root, 0
        while hasattr(command, "commands"):
            command = command.commands[call[words]]
            words += 1
        for value in VALUES:
            if len(call) > words:
                yield (*call[:words], value, *call[words + 1 :])
            for parameter in command.params:
                if parameter.opts[0].startswith("--") and not getattr(parameter, "is_flag", False):
                    yield (*call, parameter.opts[0], value)


def main() -> None:
    """Run what the arguments ask for and print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--share", type=float, default=1.0, help="of the calls, drawn by a fixed seed")
    parser.add_argument("--verb", help="only calls of this verb")
    parser.add_argument("--seconds", type=float, default=10.0, help="limit of a run")
    asked = parser.parse_args()
    signal.signal(signal.SIGALRM, stop)
    tally, chance = Tally(), random.Random(0)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "study.toml").write_text(STUDY, encoding="utf-8")
        (folder / "states.json").write_text("[]", encoding="utf-8")
        for call in cases():
            if chance.random() < asked.share and asked.verb in (None, call[0]):
                _run_one(folder, (*call, "--json"), asked.seconds, tally)
    sys.stdout.write(tally.report() + "\n")


def _run_one(folder: Path, call: tuple[object, ...], seconds: float, tally: Tally) -> None:
    tally.runs += 1
    found, trouble, took = run_timed(folder, call, seconds)
    named = " ".join(repr(str(word)[:40]) if len(str(word)) > 40 or not str(word) else str(word) for word in call)
    if took > seconds:
        tally.slow.append(f"{named}: {took:.1f} s")
    if trouble:
        tally.defects.append(f"{named}: {trouble}")
        return
    if any(len(line) > 500 for line in found.err.splitlines()):
        tally.long_lines.append(f"{named}: {found.err[:200]}")
    if found.status == 2:
        tally.refused += 1
        if not found.err.startswith("error: "):
            tally.defects.append(f"{named}: refused with {found.err[:200]!r}")
    elif found.out.strip() and not finite_answer(found.out):
        tally.not_finite.append(named)


if __name__ == "__main__":
    main()
