"""Enumerations of NovAtel's logs: the number of the binary format and the word of the ASCII format."""

from collections.abc import Mapping


class Words:
    """An enumeration both ways."""

    def __init__(self, by_number: Mapping[int, str]) -> None:
        self._words = dict(by_number)
        self._numbers = {word: number for number, word in by_number.items()}

    def word(self, number: int) -> str:
        """Return the word of a number, the number itself where it has none."""
        return self._words.get(number) or str(number)

    def number(self, word: str) -> int:
        """Return the number of a word.

        Raises
        ------
        ValueError
            It is neither a word of the enumeration nor a number.
        """
        number = self._numbers.get(word)
        return int(word) if number is None else number


SOLUTION = Words(
    dict(
        enumerate(
            (
                *("SOL_COMPUTED", "INSUFFICIENT_OBS", "NO_CONVERGENCE", "SINGULARITY", "COV_TRACE", "TEST_DIST"),
                *("COLD_START", "V_H_LIMIT", "VARIANCE", "RESIDUALS", "DELTA_POS", "NEGATIVE_VAR"),
            )
        )
    )
    | {13: "INTEGRITY_WARNING", 18: "PENDING", 19: "INVALID_FIX", 20: "UNAUTHORIZED"}
)
COMPUTED, INSUFFICIENT_OBS = 0, 1

SOLUTION_TYPE = Words(
    {
        **{0: "NONE", 1: "FIXEDPOS", 2: "FIXEDHEIGHT", 8: "DOPPLER_VELOCITY", 16: "SINGLE", 17: "PSRDIFF", 18: "WAAS"},
        **{19: "PROPAGATED", 20: "OMNISTAR", 32: "L1_FLOAT", 33: "IONOFREE_FLOAT", 34: "NARROW_FLOAT"},
        **{48: "L1_INT", 49: "WIDE_INT", 50: "NARROW_INT", 64: "OMNISTAR_HP", 65: "OMNISTAR_XP"},
    }
)
NO_TYPE, DOPPLER, SINGLE = 0, 8, 16

DATUM = Words({61: "WGS84"})
WGS84 = 61

TIME_STATUS = Words(
    {
        **{20: "UNKNOWN", 60: "APPROXIMATE", 80: "COARSEADJUSTING", 100: "COARSE", 120: "COARSESTEERING"},
        **{130: "FREEWHEELING", 140: "FINEADJUSTING", 160: "FINE", 170: "FINEBACKUPSTEERING", 180: "FINESTEERING"},
        **{200: "SATTIME"},
    }
)
UNKNOWN, FINESTEERING = 20, 180

CLOCK = Words({0: "VALID", 1: "CONVERGING", 2: "ITERATING", 3: "INVALID"})
UTC = Words({0: "INVALID", 1: "VALID", 2: "WARNING"})
PORT = Words({0: "NO_PORTS", 32: "COM1", 64: "COM2", 96: "COM3", 192: "THISPORT"})
COM1 = 32
