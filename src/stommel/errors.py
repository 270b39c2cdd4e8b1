"""Errors that a user can mend. The command line prints them as one line each and exits with status 2."""

from dataclasses import dataclass


class StommelError(Exception):
    """Base of every error that names its cause and what is allowed; anything else is a defect of stommel."""


@dataclass(frozen=True)
class Problem:
    """One thing wrong with a file from outside."""

    file: str
    key: str
    message: str

    def __str__(self) -> str:
        return f"{self.file}: {self.message}"


class FileError(StommelError):
    """A file from outside that cannot be used; `problems` holds everything found wrong with it, not only the first."""

    def __init__(self, problems: list[Problem]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(str(problem) for problem in problems))


class OutputError(StommelError):
    """A result cannot be written where the user asked for it."""
