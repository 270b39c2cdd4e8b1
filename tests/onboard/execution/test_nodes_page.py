"""The example of the guide's page runs, and its comments say what it gives; its tables are those of the code."""

from stommel.onboard.execution.node_states import STATES, TRANSITIONS, Mode
from stommel.onboard.nodes.motion_settings import MotionSettings
from stommel.onboard.nodes.node_settings import parameters_of
from tests.support.pages import blocks, guide


def test_the_example_prints_what_its_comment_says(capsys):
    (example,) = blocks(guide("vehicle-nodes"), "python")
    exec(example, {})
    assert capsys.readouterr().out.strip() == "1.0 1.0"
    assert "print(outputs.pump, outputs.mass)  # 1.0 1.0" in example


def test_each_mode_has_a_state_and_each_pair_of_mode_and_event_one_row():
    assert set(STATES) == set(Mode)
    assert len({(row.mode, row.event) for row in TRANSITIONS}) == len(TRANSITIONS)
    assert {row.mode for row in TRANSITIONS} == set(Mode)


def test_numbers_of_parameters_are_given_once():
    numbers = [parameter.number for parameter in parameters_of(MotionSettings())]
    assert len(set(numbers)) == len(numbers)
