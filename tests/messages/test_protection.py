"""Every frame with up to three flipped bits, a repeat or a swap is detected.

Oracle: a CRC is linear. The checksums of a frame and of the frame with flipped bits differ by the remainder of the
flips alone, whatever the frame says. So flips go undetected where the remainders of the flipped bits, and the flips of
the checksum itself, cancel: that is counted over all positions, and sampled through the decoder. The remainder of each
bit comes from division of polynomials, not from the table of the code.
"""

import random
from itertools import combinations, permutations

import pytest

from stommel.messages.codec import Decoder, Encoder, Received, Rejected
from stommel.messages.database import database, guard_of
from stommel.messages.frames import Frame
from stommel.messages.protection import checksum, crc8
from tests.messages.sayings import sayable

PROTECTED = [message for message in database().messages if guard_of(message.frame_id).checked]
COUNTED = [message for message in database().messages if guard_of(message.frame_id).counted]
GENERATOR = 0x12F
"""x^8 + x^5 + x^3 + x^2 + x + 1, AUTOSAR's CRC8H2F."""
DATA_BITS = 64
IDENTIFIER_BITS = 11


def divided(power: int) -> int:
    """Remainder of x^power by the generator."""
    value = 1 << power
    while value.bit_length() > 8:
        value ^= GENERATOR << (value.bit_length() - 9)
    return value


def syndromes() -> list[int]:
    """What a flip of each bit changes: of the 64 data bits, then of the 11 of the identifier."""
    data = [divided(63 - bit) for bit in range(56)]
    last = [1 << (7 - bit) for bit in range(8)]
    # identifier: low byte first, before 7 bytes of data
    low = [divided(8 + 56 + 8 + bit) for bit in range(8)]
    high = [divided(56 + 8 + bit) for bit in range(3)]
    return data + last + low + high


def test_check_value_of_the_standard() -> None:
    """AUTOSAR SWS CRC Library, CRC8H2F."""
    assert crc8(b"123456789") == 0xDF
    assert crc8(bytes(4)) == 0x12
    assert crc8(bytes((0x33, 0x22, 0x55, 0xAA, 0xBB, 0xCC, 0xDD, 0xEE, 0xFF))) == 0x11


def test_the_protection_is_linear_with_these_syndromes() -> None:
    """What the count below stands on, for frames at random."""
    chosen = random.Random(1)
    single = syndromes()
    for _ in range(300):
        identifier, data = chosen.randrange(1 << 11), chosen.randbytes(8)
        whole = checksum(identifier, data)
        for position in range(DATA_BITS - 8):
            flipped = bytearray(data)
            flipped[position // 8] ^= 0x80 >> position % 8
            assert whole ^ checksum(identifier, bytes(flipped)) == single[position]
        for bit in range(IDENTIFIER_BITS):
            assert whole ^ checksum(identifier ^ 1 << bit, data) == single[DATA_BITS + bit]


@pytest.mark.parametrize("flips", [1, 2, 3])
def test_no_flips_of_data_and_identifier_go_undetected(flips: int) -> None:
    undetected = 0
    for flipped in combinations(syndromes(), flips):
        total = 0
        for syndrome in flipped:
            total ^= syndrome
        undetected += total == 0
    assert undetected == 0


def test_four_flips_can_go_undetected() -> None:
    """The count above can fail."""
    single = syndromes()
    pairs: dict[int, int] = {}
    for a, b in combinations(single, 2):
        pairs[a ^ b] = pairs.get(a ^ b, 0) + 1
    assert max(pairs.values()) > 1


@pytest.mark.parametrize("message", PROTECTED, ids=lambda message: message.name)
def test_the_decoder_rejects_each_of_them(message: object) -> None:
    """All flips of one and two bits, and 3000 of three, of a frame at random."""
    chosen = random.Random(message.frame_id)  # type: ignore[attr-defined]
    frame = Encoder().frame(message.name, **sayable(message, chosen))  # type: ignore[attr-defined,arg-type]
    assert isinstance(Decoder().take(frame), Received)
    positions = [*combinations(range(DATA_BITS), 1), *combinations(range(DATA_BITS), 2)]
    positions += [tuple(chosen.sample(range(DATA_BITS), 3)) for _ in range(3000)]
    word = int.from_bytes(frame.data, "big")
    for flips in positions:
        mask = sum(1 << bit for bit in flips)
        answer = Decoder().take(Frame(frame.identifier, (word ^ mask).to_bytes(8, "big")))
        assert answer == Rejected(frame.identifier, "checksum")


def test_a_frame_under_anothers_identifier_is_rejected() -> None:
    """All pairs of protected messages whose identifiers differ by up to three bits; of the others one in 256 passes."""
    chosen = random.Random(3)
    passed = of_any = 0
    for true, false in permutations(PROTECTED, 2):
        frame = Encoder().frame(true.name, **sayable(true, chosen))
        answer = Decoder().take(Frame(false.frame_id, frame.data))
        caught = isinstance(answer, Rejected) and answer.reason == "checksum"
        if (true.frame_id ^ false.frame_id).bit_count() <= 3:
            assert caught
        passed += not caught
        of_any += 1
    assert passed <= of_any // 100


@pytest.mark.parametrize("message", COUNTED, ids=lambda message: message.name)
def test_every_repeat_and_every_swap_is_detected(message: object) -> None:
    chosen = random.Random(5)
    encoder = Encoder()
    name: str = message.name  # type: ignore[attr-defined]
    frames = [encoder.frame(name, **sayable(message, chosen)) for _ in range(40)]  # type: ignore[arg-type]
    for at in range(1, 38):
        decoder = Decoder()
        repeated = [decoder.take(frame) for frame in [*frames[:at], frames[at - 1], *frames[at:]]]
        reasons = [a.reason if isinstance(a, Rejected) else a.lost for a in repeated]
        assert reasons == [0] * at + ["repeated"] + [0] * (40 - at)
        decoder = Decoder()
        swapped = [decoder.take(frame) for frame in [*frames[:at], frames[at + 1], frames[at], *frames[at + 2 :]]]
        reasons = [a.reason if isinstance(a, Rejected) else a.lost for a in swapped]
        assert reasons == [0] * at + [1, "overtaken"] + [0] * (38 - at)


@pytest.mark.parametrize("lost", range(1, 15))
def test_lost_frames_are_counted_and_reception_goes_on(lost: int) -> None:
    """Up to seven in a row by their number; after more, or a restart, one frame is not taken, or two in one case."""
    encoder, decoder = Encoder(), Decoder()
    frames = [encoder.frame("Sync", vehicle_time=k) for k in range(40)]
    for frame in frames[:10]:
        decoder.take(frame)
    answers = [decoder.take(frame) for frame in frames[10 + lost :]]
    assert decoder.lost["Sync"] == (lost if lost < 8 else 0)
    not_taken = 0 if lost < 8 else 1 if lost < 14 else 2
    assert [isinstance(answer, Received) for answer in answers[: not_taken + 5]] == [False] * not_taken + [True] * 5


def test_only_the_payload_goes_without_a_checksum() -> None:
    """Commands, states and safety inputs are protected, as the file says of each message."""
    assert [m.name for m in database().messages if not guard_of(m.frame_id).checked] == ["CtdSample"]
    assert [m.name for m in database().messages if not guard_of(m.frame_id).counted] == [
        "CoordinatorInformation", "MotionInformation", "AcquisitionInformation",
    ]  # fmt: skip
    for message in database().messages:
        said = message.dbc.attributes.get("Protected") if message.dbc else None
        assert guard_of(message.frame_id).checked == bool(said.value if said else 0)
