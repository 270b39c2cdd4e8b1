"""What the shore makes of what it hears. Oracle: the rules of STATUSTEXT in the common dialect, and what was said."""

import json
import math
from types import SimpleNamespace

import pytest

from stommel.link.outbox import Outbox
from stommel.link.service import Received
from stommel.link.shore.heard import Heard
from stommel.link.shore.status import status_of, status_words
from stommel.messages.mavlink import Fields, message_named
from stommel.onboard.radio.telemetry import WARNING, Telemetry


def said(telemetry: Telemetry) -> list[Received]:
    outbox, found = Outbox(100_000), []
    telemetry.poll(0.0, outbox)
    while (message := outbox.next()) is not None:
        found.append(Received(1, 1, message.name, message_named(message.name).unpack(message.payload)))
    return found


@pytest.mark.parametrize("words", ["x", "y" * 50, "z" * 51, "a" * 100, "b" * 150, "d" * 49 + "ö" * 30, "ä" * 75])
def test_a_sentence_of_any_length_is_heard_as_one(words: str) -> None:
    """The end is a chunk that is not full, also where the last one would be; a letter may lie across two chunks."""
    telemetry, heard = Telemetry(), Heard(1)
    telemetry.tell(WARNING, words)
    for message in said(telemetry):
        heard.take(message, 1.0)
    assert len(heard.texts) == 1
    if words.isascii():
        assert heard.texts[0].words == words


def test_a_text_whose_end_was_lost_leaves_nothing_in_the_next_of_its_number() -> None:
    heard = Heard(1)
    told = [(0, "o" * 50), (1, "o" * 50), (2, "o" * 50), (0, "n" * 50), (1, "new")]
    for chunk, text in told:
        values: Fields = {"severity": 4, "text": text, "id": 1, "chunk_seq": chunk}
        heard.take(Received(1, 1, "STATUSTEXT", values), 1.0)
    assert [text.words for text in heard.texts] == ["n" * 50 + "new"]


def test_what_is_no_number_is_not_known() -> None:
    """A silent compass tells no angles; JSON has no word for them."""
    heard = Heard(1)
    heard.take(Received(1, 1, "ATTITUDE", {"roll": math.nan, "pitch": -0.1, "yaw": math.nan}), 1.0)
    status = status_of(heard)
    assert status["heading_deg"] is status["roll_deg"] is None
    assert status["pitch_deg"] == pytest.approx(-5.7296, abs=1e-4)
    json.dumps(status, allow_nan=False)
    assert status_words(status) == {"pitch": "-5.7 deg"}


def test_one_message_that_cannot_be_made_ends_no_other() -> None:
    """As a session asks: what it raises is noted, and it is asked again."""
    telemetry, outbox = Telemetry(), Outbox(100_000)
    nothing = SimpleNamespace(raised=(), cleared=())
    view = SimpleNamespace(safety=nothing, executive=SimpleNamespace(words="", because=""))
    telemetry.observe(SimpleNamespace(t=5.0, utc=9.0, view=view))  # type: ignore[arg-type]
    for _ in range(40):
        try:
            telemetry.poll(5.0, outbox)
        except AttributeError:
            continue
    assert outbox.next().name == "SYSTEM_TIME"  # type: ignore[union-attr]
