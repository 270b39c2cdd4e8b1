"""What can go wrong with a study as a whole; a run that cannot be flown is a result, not an error."""

from stommel.errors import StommelError


class StudyError(StommelError):
    """The study cannot be run, or cannot go on; runs that are finished are kept."""


class StudyInterruptedError(StudyError):
    """Ctrl-C; the runs that are finished are kept."""
