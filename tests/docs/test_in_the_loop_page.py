"""The page of the loop. Oracle: its example of a radio, read as a scenario's, and the options of the command."""

import re
import tomllib
from pathlib import Path
from typing import Any

from typer.main import get_command

from stommel.cli.app import app
from stommel.link.channel.settings import ChannelSettings
from stommel.sitl.radio.radio_table import RadioTable, channel_from

PAGE = (Path(__file__).parents[2] / "docs/guide/in-the-loop.md").read_text(encoding="utf-8")


def test_the_example_of_a_radio_is_one_and_shows_every_key() -> None:
    (text,) = re.findall(r"```toml\n(.*?)```", PAGE, re.S)
    table = tomllib.loads(text)["radio"]
    assert set(table) == set(RadioTable.model_fields)
    found = channel_from(table, "page")
    assert (found.bit_rate, found.latency, found.loss, found.fade_every) == (9600.0, 0.5, 0.1, 30.0)
    assert channel_from({}, "page") == ChannelSettings()


def test_every_option_of_a_flight_is_in_its_table() -> None:
    program: Any = get_command(app)
    options = {
        name for each in program.commands["sitl"].commands["fly"].params for name in each.opts if name.startswith("--")
    }
    assert {name for name in options if f"`{name}" not in PAGE} == {"--help"} & options
