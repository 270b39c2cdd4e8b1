"""What a worker is sent: everything that a run is made of."""

import copy
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from stommel.studies.sampling import run_seed
from stommel.studies.study_file import Value
from stommel.vehicle import Vehicle

Target = tuple[str, ...]
"""Where a parameter lies in the mission's document."""


@dataclass(frozen=True)
class RunKit:
    """What a worker needs to fly any run of the study; it is sent once."""

    document: Mapping[str, Any] = field(repr=False)
    """Every value of the mission file, also those left out there."""
    vehicle: Vehicle | None = field(repr=False)
    """None: each run names its own."""
    folder: Path
    """Where files that the mission names are sought."""
    origin: str
    """Mission file, for messages."""
    targets: tuple[Target, ...]
    """Where the parameters lie."""
    seed: int
    same_noise: bool
    version: str
    """Of stommel."""

    def document_of(self, run: int, values: Sequence[Value]) -> dict[str, Any]:
        """Return the mission document of one run."""
        document = copy.deepcopy(dict(self.document))
        if ("seed",) not in self.targets:
            document["seed"] = run_seed(self.seed, 0 if self.same_noise else run)
        for target, value in zip(self.targets, values, strict=True):
            put(document, target, value)
        return document


def put(document: dict[str, Any], target: Target, value: Value) -> None:
    """Set one value of a mission document."""
    here: Any = document
    for part in target[:-1]:
        here = here[int(part)] if isinstance(here, list) else here[part]
    last: Any = int(target[-1]) if isinstance(here, list) else target[-1]
    before = here.get(last) if isinstance(here, dict) else here[last]
    whole = isinstance(before, int) and not isinstance(before, bool | float)
    here[last] = int(value) if whole and isinstance(value, float) and value.is_integer() else value
