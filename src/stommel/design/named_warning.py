"""Something about a design that its builder should know, by name, so that a script can look for it."""

from dataclasses import dataclass


@dataclass(frozen=True)
class NamedWarning:
    """A finding that does not stop a computation."""

    name: str
    """For scripts: it does not change between versions."""
    message: str

    def __str__(self) -> str:
        return f"{self.name}: {self.message}"

    def as_row(self) -> dict[str, str]:
        """The warning for JSON."""
        return {"name": self.name, "message": self.message}
