"""Errors that a user can mend. The command line prints them as one line each and exits with status 2."""

from dataclasses import dataclass


class StommelError(Exception):
    """Base of every error that names its cause and what is allowed; anything else is a defect of stommel."""


_LONGEST_NAME = 300


@dataclass(frozen=True)
class Problem:
    """One thing wrong with a file from outside."""

    file: str
    key: str
    message: str

    def __str__(self) -> str:
        return f"{_shown(self.file)}: {self.message}"


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
