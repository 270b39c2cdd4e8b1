"""The bus on virtual time. Oracle: the longest classic frame of n bytes has 55 + 10 n bits (Davis et al. 2007)."""

import pytest

from stommel.messages.frames import Frame
from stommel.sitl.can_bus import SimulatedBus, bits_of


@pytest.mark.parametrize("count", range(9))
def test_bits_of_the_longest_frame(count: int) -> None:
    assert bits_of(Frame(1, bytes(count))) == 55 + 10 * count


def test_everyone_else_hears_the_most_urgent_first() -> None:
    bus = SimulatedBus((1, 2, 3))
    late, early = Frame(0x300, b"b"), Frame(0x010, b"a")
    bus.send(1, [late, early])
    assert bus.receive(2) == [early, late]
    assert bus.receive(2) == []
    assert bus.receive(3) == [early, late]
    assert bus.receive(1) == []
