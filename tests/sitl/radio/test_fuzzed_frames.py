"""Valid frames of every message with any content, at a vehicle that believes everybody.

Oracle: nothing aboard raises, and what is sensible is obeyed afterwards.
"""

import math
import os
import random
from pathlib import Path

from stommel.link.channel.settings import ChannelSettings
from stommel.link.commands.states import State
from stommel.link.frames import frame_bytes
from stommel.messages.mavlink import FieldValue, MessageError, MessageType, message_types
from stommel.sitl.scenario import load_scenario
from stommel.sitl.system import System
from tests.clients.afloat import scenario_in
from tests.sitl.shores import LoopShore

FRAMES = int(os.environ.get("STOMMEL_FUZZED_FRAMES", "8000"))
"""The whole count is 200 000."""
WIDE = ChannelSettings(bit_rate=1e7, latency=0.0, half_duplex=False, turn_round=0.0, buffer=1 << 16)
REALS = (0.0, 1.0, -1.0, math.nan, math.inf, -1e38, 1e-40)
WHOLES = (0, 1, 2, 3, 25, 26, 100, 101, 190)
NAMES = ("", "/", "log", "inbox/a", "missions/active.orders", "../x", "a" * 250, "\N{GREEK SMALL LETTER ALPHA}", "TRIM")


class Fuzz:
    """Ashore: frames with a sound checksum, and nothing sensible in them; then a shore that is sensible."""

    def __init__(self, shore: LoopShore, seed: int = 1) -> None:
        self.shore, self.draw, self.left, self.t = shore, random.Random(seed), FRAMES, 0.0
        self.kinds = list(message_types().values())

    def take(self, data: bytes, t: float) -> None:
        self.shore.take(data, t)

    def poll(self, t: float, room: int) -> bytes:
        self.t = t
        if not self.left:
            return self.shore.poll(t, room)
        said = b""
        while self.left and len(said) < min(room, 8000) - 300:
            said += self.frame()
            self.left -= 1
        return said

    def frame(self) -> bytes:
        draw = self.draw
        kind = draw.choice(self.kinds)
        system, component = draw.choice((255, 255, 254, draw.randrange(256))), draw.choice((190, 1, 25))
        return frame_bytes(kind, self.payload(kind), system, component, draw.randrange(256))

    def payload(self, kind: MessageType) -> bytes:
        draw, size = self.draw, kind.layout.size
        if draw.random() < 0.4:
            return draw.choice((b"\xff" * size, bytes(1), draw.randbytes(draw.randint(1, max(size, 1))))) or b"\0"
        values = {name: self.value(name, value) for name, value in kind.unpack(draw.randbytes(size)).items()}
        try:
            return kind.pack(values)
        except MessageError:  # too long for its field
            return draw.randbytes(max(size, 1))

    def value(self, name: str, value: FieldValue) -> FieldValue:
        draw = self.draw
        if name in ("target_system", "target_component"):
            return draw.choice((0, 1))
        if isinstance(value, float):
            return draw.choice((*REALS, value))
        if isinstance(value, int):
            return draw.choice((draw.choice(WHOLES), value)) if value >= 0 else value
        return draw.choice(NAMES) if isinstance(value, str) else value


def test_no_content_of_a_message_is_unbearable(tmp_path: Path) -> None:
    mission = load_scenario(scenario_in(tmp_path)).mission
    shore = LoopShore(mission)
    fuzz = Fuzz(shore)
    system = System(mission, shore=fuzz, radio=WIDE)
    while fuzz.left:
        assert system.running
        system.step()
    session = system.link.session
    assert not session.failures, list(session.notes)
    for _ in range(30):
        system.step()
    now = shore.start + fuzz.t
    held = shore.end.commands.give("hold", {}, now, valid_for=100.0)
    for _ in range(60):
        system.step()
    assert shore.end.commands.report(held, shore.start + fuzz.t).state is State.DONE
    assert not session.failures, list(session.notes)
    assert not shore.end.session.failures, list(shore.end.session.notes)
