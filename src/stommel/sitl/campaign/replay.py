"""Flying one flight of a campaign again, exactly."""

from pathlib import Path
from typing import Any, NamedTuple

from stommel.sitl.campaign.flight import FaultFlight, with_seed
from stommel.sitl.campaign.run import load_kit
from stommel.sitl.campaign.verdict import Verdict
from stommel.sitl.faults.fault import Fault


class Replay(NamedTuple):
    """A flight that was flown again."""

    seed: int
    faults: tuple[Fault, ...]
    verdict: Verdict
    digest: str
    """SHA-256 over the log and the state at the end: the same for the same flight."""

    def as_json(self) -> dict[str, Any]:
        """The flight in words."""
        return {
            "seed": self.seed,
            "faults": [fault.words for fault in self.faults],
            "verdict": self.verdict.verdict,
            "why": self.verdict.why,
            "ending": self.verdict.ending,
            "sha256": self.digest,
        }


def replay(scenario: Path, seed: int | None = None) -> Replay:
    """Fly a scenario with its own faults, or a seed of a campaign that was flown with it.

    Raises
    ------
    FileError
        The file cannot be read, or something in it is impossible.
    """
    kit = load_kit(scenario)
    mission = kit.mission
    faults = kit.faults if seed is None else kit.faults_of(seed)
    flown = FaultFlight(mission if seed is None else with_seed(mission, seed), faults, kit.radio)
    verdict = flown.fly()
    return Replay(flown.mission.scenario.seed, faults, verdict, flown.digest())
