"""Why a frame is not let through, and how often that was so."""

from collections import Counter
from enum import StrEnum


class Refusal(StrEnum):
    """Reasons, in the words of a status line."""

    UNSIGNED = "unsigned"
    WRONGLY_SIGNED = "wrongly signed"
    OTHER_KEY = "signed with another vehicle's key"
    REFLECTED = "our own, sent back to us"
    REPLAYED = "not newer than one heard before"
    STALE = "too old"
    FAR_FUTURE = "too far in the future"
    OUT_OF_STEP = "rightly signed, but said before its sender had heard us"
    UNPROVED = "not proved to be new, since our own stamps are lost"
    TOO_MANY = "from more senders than are kept"
    NO_KEY = "not to be checked, since there is no key"
    KEY_IN_CLEAR = "a key in clear, which is taken on the bench alone"


_UNSIGNED = (Refusal.UNSIGNED, Refusal.KEY_IN_CLEAR)
_OUT_OF_STEP = (Refusal.OUT_OF_STEP, Refusal.UNPROVED)
_WRONGLY_SIGNED = (Refusal.WRONGLY_SIGNED, Refusal.OTHER_KEY, Refusal.NO_KEY)


class Refusals:
    """Counts by reason."""

    def __init__(self) -> None:
        self.by_reason: Counter[Refusal] = Counter()

    def add(self, refusal: Refusal) -> None:
        """Count one."""
        self.by_reason[refusal] += 1

    @property
    def unsigned(self) -> int:
        """As LINK_STATISTICS tells it."""
        return sum(self.by_reason[reason] for reason in _UNSIGNED)

    @property
    def wrongly_signed(self) -> int:
        """As LINK_STATISTICS tells it."""
        return sum(self.by_reason[reason] for reason in _WRONGLY_SIGNED)

    @property
    def out_of_step(self) -> int:
        """Rightly signed, by an end that had not heard this one yet, or while this one's own stamps were lost."""
        return sum(self.by_reason[reason] for reason in _OUT_OF_STEP)

    @property
    def replayed(self) -> int:
        """All others."""
        return self.by_reason.total() - self.unsigned - self.wrongly_signed - self.out_of_step

    @property
    def sentences(self) -> list[str]:
        """One for each reason that occurred, the most frequent first."""
        return [f"{count} refused: {reason}" for reason, count in self.by_reason.most_common()]
