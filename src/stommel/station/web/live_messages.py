"""What is said on the live socket, both ways: the one place that says its shape."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, RootModel

from stommel.station.alarms.limits import Limit
from stommel.station.live.hub import MOST_CHANNELS
from stommel.station.people.holders import Hold
from stommel.station.web.routes.alarms import AlarmRow
from stommel.station.web.routes.commands import Command
from stommel.station.web.routes.data import Dive
from stommel.station.web.routes.files import StoredLog, Transfer
from stommel.station.web.routes.missions import Mission
from stommel.station.web.routes.notes import NoteRow
from stommel.station.web.routes.parameters import ParameterWrite
from stommel.station.web.routes.replays import ReplayState
from stommel.station.web.routes.series import Sentence
from stommel.station.web.routes.vehicles import VehicleSummary

LONGEST_ID = 64
Identity = Annotated[str, Field(min_length=1, max_length=LONGEST_ID)]
"""Of a subscription, as the browser chose it."""
Vehicle = int | str
"""Number of a vehicle, or `replay:ID`."""


class Subscribe(BaseModel):
    """Ask for channels of a vehicle, or of a replay."""

    model_config = ConfigDict(extra="forbid")
    type: Literal["subscribe"]
    id: Identity
    vehicle: Annotated[int, Field(ge=1, le=250)] | Annotated[str, Field(max_length=100)]
    channels: Annotated[list[Annotated[str, Field(max_length=100)]], Field(max_length=MOST_CHANNELS)]
    every: bool = False
    """Every sample, not only the latest."""


class Unsubscribe(BaseModel):
    """Ask for no more."""

    model_config = ConfigDict(extra="forbid")
    type: Literal["unsubscribe"]
    id: Identity


class LiveRequest(RootModel[Annotated[Subscribe | Unsubscribe, Field(discriminator="type")]]):
    """What a browser may say."""


class _Said(BaseModel):
    model_config = ConfigDict(extra="forbid")


class HelloMessage(_Said):
    """The first word: how all vehicles are."""

    type: Literal["hello"]
    now: float
    """By the station's clock [s since 1970]."""
    vehicles: list[VehicleSummary]


class PingMessage(_Said):
    """The line stands."""

    type: Literal["ping"]


class SummaryMessage(_Said):
    """How a vehicle is, at most once a second."""

    type: Literal["summary"]
    vehicle: Vehicle
    summary: VehicleSummary


class ValuesMessage(_Said):
    """The latest value of each channel that has changed."""

    type: Literal["values"]
    id: str
    vehicle: Vehicle
    now: float
    """By the vehicle's clock [s since 1970]."""
    values: dict[str, tuple[float, float]]
    """By channel, its time and its value; what is no number is not told."""
    periods: dict[str, float]
    """Usual time between two values of a channel, at first and when it is another [s]."""


class SamplesMessage(_Said):
    """Every sample that came since the last time."""

    type: Literal["samples"]
    id: str
    vehicle: Vehicle
    now: float
    """By the vehicle's clock [s since 1970]."""
    samples: dict[str, tuple[list[float], list[float]]]
    """By channel, times and values."""
    periods: dict[str, float]
    """Usual time between two values of a channel, at first and when it is another [s]."""


class SamplesGapMessage(_Said):
    """A reader was too slow: some samples from a time on are missing."""

    type: Literal["gap"]
    id: str
    vehicle: Vehicle
    since: Annotated[float, Field(alias="from")]


class NewsGapMessage(_Said):
    """A reader was too slow: so many events are missing."""

    type: Literal["gap"]
    id: Literal[""]
    lost: int


class ErrorMessage(_Said):
    """A subscription has ended or was not begun; the others go on."""

    type: Literal["error"]
    id: str
    """Empty where it is not known which was meant."""
    reason: str


class _Event(_Said):
    type: Literal["event"]
    vehicle: Vehicle | None
    """Null: of the station itself."""


class AlarmEvent(_Event):
    """An alarm was raised, ended or acknowledged."""

    kind: Literal["alarm"]
    data: AlarmRow


class CommandEvent(_Event):
    """A command was given, or something became of it."""

    kind: Literal["command"]
    data: Command


class LimitChange(BaseModel):
    """The limit of a channel from now on, and who set it."""

    channel: str
    user: str
    limit: Limit | None
    """Null: it has none any more."""


class LimitEvent(_Event):
    """Somebody set the limit of a channel, or removed it."""

    kind: Literal["limit"]
    data: LimitChange


class MissionAboardChanged(BaseModel):
    """The vehicle told of the mission that it holds; the API has it."""

    aboard: bool


class MissionEvent(_Event):
    """Something became of a mission."""

    kind: Literal["mission"]
    data: Mission | MissionAboardChanged


class ParametersRefreshed(BaseModel):
    """The parameters are up to date; the API has them."""

    refreshed: bool


class ParameterEvent(_Event):
    """Something became of a parameter, or of all."""

    kind: Literal["parameter"]
    data: ParameterWrite | ParametersRefreshed


class TransferEvent(_Event):
    """Something became of a file on its way."""

    kind: Literal["transfer"]
    data: Transfer


class NoteEvent(_Event):
    """Somebody wrote into the log book."""

    kind: Literal["note"]
    data: NoteRow


class NoHolder(BaseModel):
    """Nobody holds command."""

    vehicle: int
    user: None


class HolderEvent(_Event):
    """Somebody took command, or gave it up."""

    kind: Literal["holder"]
    data: Hold | NoHolder


class TextEvent(_Event):
    """The vehicle said something in words."""

    kind: Literal["text"]
    data: Sentence


class DiveEvent(_Event):
    """The vehicle told of a dive."""

    kind: Literal["dive"]
    data: Dive


class LogChange(StoredLog):
    """A log that lies ashore, and how far it is in the archive."""

    name: str
    sha256: str


class LogEvent(_Event):
    """Something became of a log that goes into the archive."""

    kind: Literal["log"]
    data: LogChange


class ReplayEvent(_Event):
    """A replay began, changed or ended."""

    kind: Literal["replay"]
    data: ReplayState


LiveEvent = Annotated[
    AlarmEvent | CommandEvent | LimitEvent | MissionEvent | ParameterEvent | TransferEvent | NoteEvent | HolderEvent
    | TextEvent | DiveEvent | LogEvent | ReplayEvent,
    Field(discriminator="kind"),
]  # fmt: skip
GapMessage = SamplesGapMessage | NewsGapMessage


class LiveMessage(
    RootModel[
        HelloMessage | PingMessage | SummaryMessage | ValuesMessage | SamplesMessage | GapMessage | ErrorMessage
        | LiveEvent
    ]
):  # fmt: skip
    """What the station says."""
