"""A process that writes to an archive is killed at random moments: what it reported as stored is there, whole.

Run `python -m tests.archive.writer_killed 200` for the full count.
"""

import random
import sys
import tempfile
import time
from pathlib import Path

from sqlalchemy import func, select

from stommel.archive import Archive, Batch, FrameRow
from stommel.archive.schema import frames, minutes, samples
from stommel.archive.soundness import soundness_of
from tests.support.lives import life

ROWS = 50
"""Frames, and samples, of a batch."""


def write(url: str, number: int) -> None:
    """Store batch after batch, and say the number of each that is stored."""
    say("begun")
    archive = Archive.open(url)
    while True:
        t = 1.7e9 + number
        rows = [FrameRow(t, "in", 1, 1, number, k, True, bytes(40)) for k in range(ROWS)]
        values = [(f"channel_{k % 10}", t + k / ROWS, float(number)) for k in range(ROWS)]
        archive.store(1, Batch(rows, values))
        say(str(number))
        number += 1


def say(words: str) -> None:
    """Say a line that a death cannot take back."""
    sys.stdout.write(f"{words}\n")
    sys.stdout.flush()


class LostError(AssertionError):
    """Something that was reported as stored is not there, or half of something is."""


def killed_and_looked_at(url: str, next_number: int, delay: float, *, stored: int = 0) -> int:
    """Let a process write for a while, kill it, and look at the archive; the number of the next batch.

    The while begins when its imports are over, or when it has reported so many batches as stored.
    """
    with life(write, url, next_number) as (writer, said):
        told = [said.readline() for _ in range(1 + stored)][1:]
        time.sleep(delay)
        writer.kill()
        told += said.read().splitlines()
    last_told = int(told[-1]) if told else next_number - 1
    return looked_at(url, last_told)


def looked_at(url: str, last_told: int) -> int:
    with Archive.open(url) as archive, archive.reading() as connection:
        of = frames.c.message_id
        counted = dict(connection.execute(select(of, func.count()).group_by(of)).all())
        begun_us = samples.c.t_us.op("/")(1_000_000)
        valued = dict(connection.execute(select(begun_us, func.count()).group_by(begun_us)).all())
        in_minutes = connection.execute(select(func.sum(minutes.c.count))).scalar() or 0
    if missing := set(range(last_told + 1)) - counted.keys():
        raise LostError(f"reported as stored and not there: {sorted(missing)}")
    if halves := {number: count for number, count in counted.items() if count != ROWS}:
        raise LostError(f"half a batch: {halves}")
    if {number + 1_700_000_000: count for number, count in counted.items()} != valued:
        raise LostError("the samples are not those of the frames")
    if in_minutes != sum(valued.values()):
        raise LostError("the minutes do not count the samples")
    return max(counted, default=-1) + 1


def run(url: str, kills: int, seed: int) -> int:
    """Kill so often; how many batches were stored in all."""
    chance = random.Random(seed)
    number = 0
    for _ in range(kills):
        number = killed_and_looked_at(url, number, chance.uniform(0.0, 0.3), stored=chance.choice((0, 1, 3)))
    found = soundness_of(url)
    if found.problems:
        raise LostError("; ".join(found.problems))
    return number


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        stored = run(str(Path(folder) / "archive.sqlite"), int(sys.argv[1]), seed=1)
    print(f"{sys.argv[1]} kills, {stored} batches stored, none lost, none half")  # noqa: T201
