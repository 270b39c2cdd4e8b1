"""The table of commands. Oracle: `glider.xml`."""

import pytest

from stommel.link.commands.states import State, When
from stommel.link.commands.table import COMMANDS, PARAMETERS, command_named, command_numbered, packed, refusal
from stommel.messages.mavlink import enumeration


def test_numbers_are_those_of_the_dialect() -> None:
    told = {f"GLIDER_CMD_{row.name.replace('-', '_').upper()}": row.number for row in COMMANDS}
    assert told == enumeration("GLIDER_CMD")


@pytest.mark.parametrize(("kind", "name"), [(When, "GLIDER_COMMAND_WHEN"), (State, "GLIDER_COMMAND_STATE")])
def test_words_are_those_of_the_dialect(kind: type[When] | type[State], name: str) -> None:
    assert {f"{name}_{item.name}": int(item) for item in kind} == enumeration(name)


def test_rows_can_be_found_and_sent() -> None:
    for row in COMMANDS:
        assert command_named(row.name) is row
        assert command_numbered(row.number) is row
        assert len(row.parameters) <= PARAMETERS
        for values in ("low", "high"):
            sent = packed(row, {p.name: getattr(p, values) for p in row.parameters})
            assert refusal(row, sent) == ""
            assert len(sent) == PARAMETERS
        for number, parameter in enumerate(row.parameters):
            for outside in (parameter.low - 1.0, parameter.high * 1.01 + 1.0, float("inf"), float("nan")):
                sent = [p.low for p in row.parameters]
                sent[number] = outside
                assert parameter.allowed in refusal(row, sent)


def test_what_may_go_wrong_is_asked_for() -> None:
    """Everything that lets the vehicle dive, moves it, or stops its software."""
    asks = {row.name for row in COMMANDS if row.confirm}
    assert asks == {"abort", "start", "clear", "self-test", "switch-mission", "roll-back-mission", "restart"}
