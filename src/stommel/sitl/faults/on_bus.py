"""Faults of the CAN bus: what becomes of a frame on its way."""

from collections.abc import Iterable
from typing import cast

from stommel.messages.codec import Encoder, Values
from stommel.messages.database import ACQUISITION, COORDINATOR, MOTION, NODES, database, database_hash, message_of
from stommel.messages.frames import Frame
from stommel.sitl.faults import table
from stommel.sitl.faults.acting import Acting

NUMBERS = {table.COORDINATOR: COORDINATOR, table.MOTION: MOTION, table.ACQUISITION: ACQUISITION}
"""Numbers of the computers on the bus."""


class BusFaults:
    """Spoils frames by the faults that act now."""

    def __init__(self) -> None:
        self.acting: list[Acting] = []
        self.late: list[tuple[int, Frame]] = []
        """Senders and frames that come with the next step."""

    def off(self) -> set[int]:
        """Numbers of the computers that are off the bus."""
        return {NUMBERS[one.target] for one in self.acting if one.kind == "bus_off"}

    def spoil(self, sender: int, frame: Frame) -> Iterable[Frame]:
        """Return what comes of a frame."""
        frames = [frame]
        for one in self.acting:
            if one.target != table.ALL and NUMBERS.get(one.target) != sender:
                continue
            frames = [made for each in frames for made in self._spoilt(one, sender, each)]
        return frames

    def _spoilt(self, one: Acting, sender: int, frame: Frame) -> list[Frame]:
        if one.kind == "bus_off":
            return []
        if one.kind == "wrong_database":
            return [_of_another_version(one, frame)]
        if one.kind == "stranger" or not one.strikes():
            return [frame]
        if one.kind == "frames_lost":
            return []
        if one.kind == "frames_repeated":
            return [frame, frame]
        if one.kind == "frames_late":
            self.late.append((sender, frame))
            return []
        return [_flipped(one, frame)]

    def strangers(self) -> list[Frame]:
        """Frames of unknown identifiers in a step of a second."""
        known = {message.frame_id for message in database().messages}
        unknown = [identifier for identifier in range(0x10, 0x7F0) if identifier not in known]
        return [
            Frame(int(one.draw.choice(unknown)), one.draw.bytes(8))
            for one in self.acting if one.kind == "stranger" for _ in range(max(1, round(one.value)))
        ]  # fmt: skip


def _flipped(one: Acting, frame: Frame) -> Frame:
    """Flip one to three bits of the data, which the checksum must find."""
    data = bytearray(frame.data)
    for bit in one.draw.choice(8 * len(data), size=min(int(one.draw.integers(1, 4)), 8 * len(data)), replace=False):
        data[bit // 8] ^= 1 << int(bit % 8)
    return Frame(frame.identifier, bytes(data))


def _of_another_version(one: Acting, frame: Frame) -> Frame:
    """Let a node's information frame tell another database, whole and with the right counter."""
    message = message_of(frame.identifier)
    if message is None or message.name != f"{NODES[NUMBERS[one.target]]}Information":
        return frame
    # no multiplexed messages: names with numbers
    values = cast("Values", message.decode(frame.data, decode_choices=False))
    first = int(values.pop("alive_counter", 0))
    values.pop("checksum", None)
    values["database_hash"] = database_hash() ^ 1
    return Encoder(first).frame(message.name, **values)
