"""Commands: what a vehicle can be told, what it was told by whom, and what became of it."""

from typing import Annotated, Literal

from fastapi import APIRouter, Path, Query
from pydantic import BaseModel, ConfigDict, Field

from stommel.archive.times import GREATEST_TIME
from stommel.link.commands.client import LEAST_VALID, MOST_VALID
from stommel.link.commands.states import When
from stommel.link.commands.table import COMMANDS
from stommel.station.vehicles.command_rows import CommandRow
from stommel.station.web.access import Holder, Pilot, Viewer
from stommel.station.web.found import Line, TheStation

router = APIRouter(prefix="/api", tags=["commands"])

Occasion = Literal["at_once", "at_next_surfacing", "until_expiry"]
CommandId = Annotated[str, Path(pattern="^[0-9a-f]{16}$", description="Id of the command, 16 hexadecimal digits.")]
FIRST, LAST = 0.0, GREATEST_TIME
LONGEST_TABLE = 500


class CommandParameter(BaseModel):
    """A number that a command carries."""

    name: str
    unit: str
    low: float
    high: float
    words: str
    whole: bool


class CommandKind(BaseModel):
    """Something that a vehicle can be told."""

    name: str
    words: str
    confirm: str
    """What may go wrong; a person is asked before it is given. Empty where nothing may."""
    parameters: list[CommandParameter]


class NewCommand(BaseModel):
    """A command to give."""

    model_config = ConfigDict(extra="forbid")

    name: Annotated[str, Field(max_length=40)]
    parameters: Annotated[dict[str, float], Field(max_length=8)] = {}
    valid_for_s: Annotated[float, Field(ge=LEAST_VALID, le=MOST_VALID, allow_inf_nan=False)] = 600.0
    """After this it is never executed."""
    when: Occasion = "until_expiry"


class Command(BaseModel):
    """A command that was given; times are of the vehicle's clock [s since 1970]."""

    id: str
    vehicle: int
    user: str
    given: float
    expires: float
    name: str
    parameters: dict[str, float]
    when: Occasion
    state: str
    """given, queued, received, waiting, in_progress; and at the end done, failed, refused, expired, cancelled,
    outcome_unknown, forgotten or not_sent."""
    words: str
    changed: float
    is_last: bool
    """Whether nothing comes after this state."""
    percent: int | None


class CommandState(BaseModel):
    """What a command was at a time."""

    t: float
    state: str
    words: str


class CommandDetail(Command):
    """A command, and all that became of it."""

    history: list[CommandState]


@router.get("/command-types")
def list_command_types(_user: Viewer) -> list[CommandKind]:
    """Return what vehicles can be told, with the range of each parameter."""
    return [
        CommandKind(
            name=kind.name, words=kind.words, confirm=kind.confirm,
            parameters=[CommandParameter.model_validate(each._asdict()) for each in kind.parameters],
        )
        for kind in COMMANDS
    ]  # fmt: skip


@router.get("/vehicles/{vehicle}/commands")
def list_commands(
    _user: Viewer,
    line: Line,
    station: TheStation,
    limit: Annotated[int, Query(ge=1, le=LONGEST_TABLE)] = 100,
    before: Annotated[float | None, Query(ge=FIRST, le=LAST, allow_inf_nan=False)] = None,
) -> list[Command]:
    """Return the last commands of a vehicle, the newest first."""
    return [_told(station, row) for row in station.commands.list(line.vehicle, limit, before)]


@router.get("/vehicles/{vehicle}/commands/{id}")
def show_command(_user: Viewer, line: Line, station: TheStation, id: CommandId) -> CommandDetail:
    """Return a command with all that became of it."""
    row = station.commands.find(line.vehicle, id)
    history = [CommandState(t=t, state=state, words=words) for t, state, words in station.commands.history(id)]
    return CommandDetail.model_validate(station.commands.told(row) | {"history": history})


@router.post("/vehicles/{vehicle}/commands", status_code=201)
def give_command(user: Holder, line: Line, station: TheStation, command: NewCommand) -> Command:
    """Give a command: it is written down and queued when this answers, and followed until the vehicle's last word."""
    row = station.commands.give(
        line.vehicle, user.name, command.name, command.parameters, valid_for_s=command.valid_for_s,
        when=When[command.when.upper()],
    )  # fmt: skip
    return _told(station, row)


@router.delete("/vehicles/{vehicle}/commands/{id}")
def cancel_command(_user: Holder, line: Line, station: TheStation, id: CommandId) -> Command:
    """Take a command back: for good if it was not sent, else if the vehicle has not begun it; its state tells."""
    return _told(station, station.commands.cancel(line.vehicle, id))


@router.post("/vehicles/{vehicle}/abort", status_code=201)
def abort(user: Pilot, line: Line, station: TheStation) -> Command:
    """Abort the mission: the vehicle comes up. Needs no hold of the vehicle, and goes out whatever else is wrong."""
    return _told(station, station.commands.abort(line.vehicle, user.name))


def _told(station: TheStation, row: CommandRow) -> Command:
    return Command.model_validate(station.commands.told(row))
