"""What a worker of a campaign is sent, and one run as it flies it."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import stommel
from stommel.errors import StommelError
from stommel.link.channel.settings import ChannelSettings
from stommel.simulation.scenario.loading import mission_from
from stommel.simulation.scenario.mission import Mission
from stommel.sitl.campaign.draw import draw_faults
from stommel.sitl.campaign.flight import EXPIRY_BEFORE_END, fly_with, with_seed
from stommel.sitl.campaign.shrink import fewest
from stommel.sitl.campaign.verdict import FAILED
from stommel.sitl.faults.fault import Fault, faults_from
from stommel.sitl.radio.radio_table import channel_from

_LATEST = 300.0
"""How long before the end of the mission's time the last fault begins [s]."""

RADIO = "radio"
"""Table of a scenario that a mission file has not."""

_missions: dict[str, Mission] = {}
"""The mission of this process, by its document and folder."""


@dataclass(frozen=True)
class CampaignKit:
    """A campaign's mission and what breaks in all of its flights."""

    document: Mapping[str, Any] = field(repr=False)
    """Of the scenario file, without its faults."""
    faults: tuple[Fault, ...]
    """Of the scenario file: in each flight, beside the random ones."""
    folder: Path
    """Where files that the mission names are sought."""
    origin: str
    """Mission file, for messages."""
    version: str
    """Of stommel."""

    @property
    def mission(self) -> Mission:
        """The mission; it is loaded once in each process."""
        key = json.dumps([self.document, str(self.folder)], sort_keys=True, default=str)
        if key not in _missions:
            _missions.clear()
            document = {name: value for name, value in self.document.items() if name != RADIO}
            _missions[key] = mission_from(document, self.origin, self.folder)
        return _missions[key]

    @property
    def radio(self) -> ChannelSettings:
        """The air of the radio."""
        return channel_from(self.document.get(RADIO, {}), self.origin)

    def faults_of(self, seed: int) -> tuple[Fault, ...]:
        """Faults of the flight with this seed."""
        seconds = self.mission.scenario.duration_days * 86400.0
        return self.faults + draw_faults(seed, max(1.0, seconds - EXPIRY_BEFORE_END - _LATEST))


def fly_seed(kit: CampaignKit, run: int, values: Sequence[Any]) -> dict[str, Any]:
    """Fly one run of a campaign and, if it fails, seek the fewest of its faults that still fail.

    The only value is the seed.
    """
    if kit.version != stommel.__version__:
        raise StommelError(f"a worker has stommel {stommel.__version__}, the campaign is of version {kit.version}")
    seed = int(values[0])
    mission, faults = with_seed(kit.mission, seed), kit.faults_of(seed)
    found = fly_with(mission, faults, kit.radio)
    record: dict[str, Any] = {
        "run": run, "seed": seed, "verdict": found.verdict, "why": found.why, "ending": found.ending,
        "faults": [fault.as_table() for fault in faults],
    }  # fmt: skip
    if found.verdict == FAILED:
        least = fewest(faults, lambda chosen: fly_with(mission, chosen, kit.radio).verdict == FAILED)
        record["fewest"] = [fault.as_table() for fault in least]
    return record


def faults_in(record: Mapping[str, Any], key: str = "faults") -> tuple[Fault, ...]:
    """Faults of a run's record."""
    return faults_from(record.get(key, ()), f"run {record['run']}")
