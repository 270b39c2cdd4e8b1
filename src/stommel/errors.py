"""Errors that a user can mend. The command line prints them as one line each and exits with status 2."""

from dataclasses import dataclass


class StommelError(Exception):
    """Base of every error that names its cause and what is allowed; anything else is a defect of stommel."""


_LONGEST_NAME = 300
_LONGEST_MESSAGE = 420
"""Characters of a sentence about a file; the longest that stommel makes itself lists the keys of a table."""


@dataclass(frozen=True)
class Problem:
    """One thing wrong with a file from outside."""

    file: str
    key: str
    message: str

    def __str__(self) -> str:
        return f"{_shown(self.file)}: {one_line(self.message, _LONGEST_MESSAGE)}"


def one_line(text: str, longest: int) -> str:
    """A text on one line of at most `longest` characters, cut in its middle."""
    plain = " ".join(text.split()) if "\n" in text else text
    if len(plain) <= longest:
        return plain
    half = (longest - 5) // 2
    return f"{plain[:half]} ... {plain[-half:]}"


def _shown(name: str) -> str:
    """Name of a file on one line of a sensible length, whatever it holds."""
    plain = name if name.isprintable() else repr(name)[1:-1]
    return plain if len(plain) <= _LONGEST_NAME else f"{plain[:_LONGEST_NAME]}..."


class FileError(StommelError):
    """A file from outside that cannot be used; `problems` holds everything found wrong with it, not only the first."""

    def __init__(self, problems: list[Problem]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(str(problem) for problem in problems))


class OutputError(StommelError):
    """A result cannot be written where the user asked for it."""
