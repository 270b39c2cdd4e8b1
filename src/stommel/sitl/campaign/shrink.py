"""From many faults to the fewest that still do harm: delta debugging."""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TypeVar

Part = TypeVar("Part")


def fewest(parts: Sequence[Part], fails: Callable[[tuple[Part, ...]], bool]) -> tuple[Part, ...]:
    """Return a smallest selection of parts that still fails: none of them can be left out.

    Parameters
    ----------
    parts
        A selection that fails.
    fails
        Whether a selection fails; the same answer each time.

    Notes
    -----
    The algorithm ddmin of Zeller and Hildebrandt, "Simplifying and isolating failure-inducing input" (2002).
    """
    known: dict[tuple[int, ...], bool] = {}

    def tried(chosen: tuple[int, ...]) -> bool:
        if chosen not in known:
            known[chosen] = fails(tuple(parts[k] for k in chosen))
        return known[chosen]

    left, pieces = tuple(range(len(parts))), 2
    if not left or tried(()):
        return ()
    while len(left) >= 2:
        cuts = [round(k * len(left) / pieces) for k in range(pieces + 1)]
        chunks = [left[a:b] for a, b in pairwise(cuts)]
        rests = [tuple(k for k in left if k not in chunk) for chunk in chunks]
        smaller = next((each for each in chunks if tried(each)), None)
        if smaller is not None:
            left, pieces = smaller, 2
            continue
        smaller = next((each for each in rests if tried(each)), None)
        if smaller is not None:
            left, pieces = smaller, max(pieces - 1, 2)
        elif pieces >= len(left):
            break
        else:
            pieces = min(2 * pieces, len(left))
    return tuple(parts[k] for k in left)
