"""`stommel link` against a simulated glider that lies at the surface."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tests.clients.afloat import Afloat
from tests.support.command import Outcome, run_here


def new_key(folder: Path, name: str, vehicle: int = 1) -> None:
    """Make a key in a folder."""
    made = run_here(folder, "link", "key", "new", name, "--vehicle", vehicle)
    assert made.status == 0, made.err


@dataclass(frozen=True)
class Shore:
    """Calls verbs of `stommel link` in a folder, with the address of a glider."""

    folder: Path
    vehicle: Afloat

    @property
    def line(self) -> tuple[str, ...]:
        """The options that lead to the glider."""
        return "--to", f"tcp:127.0.0.1:{self.vehicle.port}", "--unsigned", "--state", "state"

    def call(self, *arguments: object) -> Outcome:
        return run_here(self.folder, "link", *arguments, *self.line)

    def json(self, *arguments: object) -> Any:
        """What a verb that must go well answers."""
        found = self.call(*arguments, "--json")
        assert found.status == 0, found.err
        return found.json
