"""Every one-key mutation of every shipped TOML file through its verbs, in one process, and what came of it.

`python -m tests.support.mutation_run [--kind vehicle] [--share 0.1] [--seconds 10]`; no part of the quick tests. It
prints four figures: runs that ended as a defect, runs beyond the limit, answers that were not finite, and the share of
numbers times a thousand (and of sizes over a thousand) that were answered without a new warning.
"""

import argparse
import json
import math
import random
import signal
import sys
import tempfile
import time
import tomllib
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
from typing import Any

from stommel.files.units import unit_of
from tests.support.command import run_here
from tests.support.mutations import Mutation, mutations, toml_text
from tests.support.shipped_files import SHIPPED, Shipped

SIZES = {"m", "mm", "km", "ml", "l", "kg", "A h"}
"""Units of lengths, volumes, masses and capacities."""


class TooLongError(BaseException):
    """A run went beyond its time."""


@dataclass
class Tally:
    """What came of the runs."""

    runs: int = 0
    refused: int = 0
    defects: list[str] = field(default_factory=list)
    slow: list[str] = field(default_factory=list)
    not_finite: list[str] = field(default_factory=list)
    long_lines: list[str] = field(default_factory=list)
    scaled: Counter[str] = field(default_factory=Counter)
    silent: dict[str, list[str]] = field(default_factory=lambda: {"x1000": [], "/1000": []})

    def report(self) -> str:
        """The figures, and each run that misses one."""
        lines = [f"{self.runs} runs, {self.refused} refused"]
        for name, found in (
            ("defects", self.defects),
            ("beyond the limit", self.slow),
            ("not finite", self.not_finite),
            ("lines of more than 500 characters", self.long_lines),
        ):
            lines += [f"{name}: {len(found)}", *(f"    {one}" for one in found[:40])]
        for kind, found in self.silent.items():
            share = 100.0 * len(found) / max(1, self.scaled[kind])
            lines += [f"{kind} without a word: {len(found)} of {self.scaled[kind]}, {share:.1f} %"]
            lines += [f"    {one}" for one in found]
        return "\n".join(lines)


def counts(mutation: Mutation) -> bool:
    """Whether a scaled number is one of which a warning is asked: not zero, and over a thousand only of sizes."""
    if mutation.kind == "x1000":
        return bool(mutation.value) and unit_of(mutation.key) is not None
    size = unit_of(mutation.key) in SIZES and "moment" not in mutation.key
    return mutation.kind == "/1000" and bool(mutation.value) and size


def run_file(shipped: Shipped, share: float, seconds: float, tally: Tally, seed: int = 0) -> None:
    """Run the mutations of one file through its verbs."""
    chance = random.Random(seed)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for path, content in shipped.beside.items():
            (folder / path).write_bytes(content)
        document = tomllib.loads(shipped.text)
        (folder / shipped.name).write_text(shipped.text, encoding="utf-8")
        usual = [_warnings(run_timed(folder, verb, seconds)[0]) for verb in shipped.verbs]
        for mutation in mutations(document):
            if chance.random() >= share:
                continue
            (folder / shipped.name).write_text(toml_text(mutation.document), encoding="utf-8")
            _run_one(shipped, mutation, folder, usual, seconds, tally)


def _run_one(
    shipped: Shipped, mutation: Mutation, folder: Path, usual: list[Counter[str]], seconds: float, tally: Tally
) -> None:
    named = f"{shipped.name} {mutation.key} {mutation.kind}"
    spoken = False
    for k, verb in enumerate(shipped.verbs):
        tally.runs += 1
        found, trouble, took = run_timed(folder, verb, seconds)
        where = f"{named}: {' '.join(map(str, verb[:2]))}"
        if took > seconds:
            tally.slow.append(f"{where}: {took:.1f} s")
        if trouble:
            tally.defects.append(f"{where}: {trouble}")
            continue
        if any(len(line) > 500 for line in found.err.splitlines()):
            tally.long_lines.append(f"{where}: {found.err[:200]}")
        spoken = spoken or bool(_warnings(found) - usual[k])
        if found.status == 2:
            tally.refused += 1
            spoken = True
            if k == 0:
                break  # the file itself is refused
        elif not finite_answer(found.out):
            tally.not_finite.append(where)
    if counts(mutation):
        tally.scaled[mutation.kind] += 1
        if not spoken:
            tally.silent[mutation.kind].append(f"{shipped.name} {mutation.key} = {mutation.value}")


def run_timed(folder: Path, verb: tuple[object, ...], seconds: float) -> tuple[Any, str, float]:
    """Outcome, what went wrong, and the time that the processor took."""
    began = time.process_time()
    signal.setitimer(signal.ITIMER_REAL, 3.0 * seconds)
    found, trouble = None, ""
    try:
        found = run_here(folder, *verb)
    except TooLongError:
        trouble = "stopped"
    except (AssertionError, Exception) as error:  # noqa: BLE001 - counted
        trouble = f"{type(error).__name__}: {error}".replace("\n", " ")[:400]
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
    return found, trouble, time.process_time() - began


def _warnings(found: Any) -> Counter[str]:
    """Warnings of an answer by name, wherever they stand in it, and lines of warnings on standard error."""
    if found is None:
        return Counter()
    said = Counter(line for line in found.err.splitlines() if line.startswith("warning"))
    try:
        answer = json.loads(found.out)
    except ValueError:
        return said
    return said + Counter(_named(answer))


def _named(answer: Any) -> Iterator[str]:
    if isinstance(answer, dict):
        for key, value in answer.items():
            if key == "warnings" and isinstance(value, list):
                yield from (one["name"] if isinstance(one, dict) else str(one) for one in value)
            else:
                yield from _named(value)
    elif isinstance(answer, list):
        for value in answer:
            yield from _named(value)


def finite_answer(text: str) -> bool:
    """Whether a text is JSON without NaN and infinity."""

    def refuse(name: str) -> float:
        raise ValueError(name)

    try:
        return all(map(math.isfinite, _numbers(json.loads(text, parse_constant=refuse))))
    except ValueError:
        return False


def _numbers(answer: Any) -> Iterator[float]:
    if isinstance(answer, dict):
        answer = list(answer.values())
    if isinstance(answer, list):
        for value in answer:
            yield from _numbers(value)
    elif isinstance(answer, int | float):
        yield float(answer)


def stop(_signal: int, _frame: FrameType | None) -> None:
    """End a run that went beyond its time."""
    raise TooLongError


def main() -> None:
    """Run what the arguments ask for and print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kind", help="only files of this kind")
    parser.add_argument("--share", type=float, default=1.0, help="of the mutations, drawn by a fixed seed")
    parser.add_argument("--seconds", type=float, default=10.0, help="limit of a run")
    asked = parser.parse_args()
    signal.signal(signal.SIGALRM, stop)
    tally = Tally()
    for shipped in SHIPPED:
        if asked.kind in (None, shipped.kind):
            run_file(shipped, asked.share, asked.seconds, tally)
    sys.stdout.write(tally.report() + "\n")


if __name__ == "__main__":
    main()
