"""MAVLink FTP aboard. Oracle: pymavlink's own words (`mavftp_op`), and the specification at mavlink.io."""

import random
import zlib

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymavlink import mavftp_op as oracle

from stommel.link.files.ftp_server import FtpServer
from stommel.link.files.ftp_sessions import IDLE, MOST_SESSIONS
from stommel.link.files.ftp_words import MESSAGE, MOST_DATA, Opcode, Words, packed, unpacked
from stommel.link.files.paths import plain_path
from stommel.link.files.port import FileRefusalError, FtpError
from stommel.link.outbox import Outbox
from stommel.link.service import Received
from stommel.messages.mavlink import message_named
from tests.link.files.fakes import MemoryFiles, noise
from tests.link.files.pair import SHORE, VEHICLE

LOG = noise(1000, 1)


class Station:
    """A ground station that says what it is told to."""

    def __init__(self, files: MemoryFiles, system: int = SHORE[0]) -> None:
        self.files, self.system = files, system
        self.server, self.outbox = FtpServer(*VEHICLE, files), Outbox()
        self.sequence = 0
        self.t = 0.0

    def say(self, payload: bytes) -> None:
        values = {"target_system": 1, "target_component": 1, "payload": payload}
        self.server.take(Received(self.system, SHORE[1], MESSAGE, values), self.t)

    def hear(self) -> list[Words]:
        heard = []
        while True:
            self.server.poll(self.t, self.outbox)
            outgoing = self.outbox.next()
            if outgoing is None:
                return heard
            values = message_named(MESSAGE).unpack(outgoing.payload)
            assert (values["target_system"], values["target_component"]) == (self.system, SHORE[1])
            words = unpacked(values["payload"])  # type: ignore[arg-type]
            assert words is not None
            heard.append(words)

    def ask(
        self, opcode: int, data: bytes = b"", *, session: int = 0, offset: int = 0, size: int | None = None
    ) -> list[Words]:
        self.sequence += 1
        size = len(data) if size is None else size
        self.say(bytes(oracle.FTP_OP(self.sequence, session, opcode, size, 0, 0, offset, bytearray(data)).pack()))
        return self.hear()

    def one(self, opcode: int, data: bytes = b"", **more: int) -> Words:
        (answer,) = self.ask(opcode, data, **more)  # type: ignore[arg-type]
        assert answer.asked == opcode
        assert answer.sequence == self.sequence + 1
        return answer


@pytest.fixture
def station() -> Station:
    return Station(MemoryFiles({"logs/a.log": LOG, "missions/m": b"old mission"}))


def refused(words: Words) -> int:
    assert words.opcode == oracle.OP_Nack
    return words.data[0]


@given(
    st.integers(0, 0xFFFF),
    st.integers(0, 255),
    st.integers(0, 129),
    st.integers(0, 0xFFFFFFFF),
    st.binary(max_size=MOST_DATA),
)
def test_words_lie_as_pymavlink_lays_them(sequence: int, session: int, opcode: int, offset: int, data: bytes) -> None:
    expected = bytes(oracle.FTP_OP(sequence, session, opcode, len(data), 15, 1, offset, bytearray(data)).pack())
    words = Words(sequence, session, opcode, len(data), 15, True, offset, data)
    assert packed(words) == expected
    assert unpacked(expected) == words


def test_numbers_of_opcodes_are_pymavlinks() -> None:
    names = {
        Opcode.TERMINATE_SESSION: "TerminateSession", Opcode.RESET_SESSIONS: "ResetSessions",
        Opcode.LIST_DIRECTORY: "ListDirectory", Opcode.OPEN_FILE_RO: "OpenFileRO", Opcode.READ_FILE: "ReadFile",
        Opcode.CREATE_FILE: "CreateFile", Opcode.WRITE_FILE: "WriteFile", Opcode.REMOVE_FILE: "RemoveFile",
        Opcode.CREATE_DIRECTORY: "CreateDirectory", Opcode.REMOVE_DIRECTORY: "RemoveDirectory",
        Opcode.OPEN_FILE_WO: "OpenFileWO", Opcode.TRUNCATE_FILE: "TruncateFile", Opcode.RENAME: "Rename",
        Opcode.CALC_FILE_CRC32: "CalcFileCRC32", Opcode.BURST_READ_FILE: "BurstReadFile", Opcode.ACK: "Ack",
        Opcode.NAK: "Nack", Opcode.NONE: "None",
    }  # fmt: skip
    assert {opcode: getattr(oracle, f"OP_{name}") for opcode, name in names.items()} == {o: int(o) for o in Opcode}


def test_read_and_burst_share_no_position(station: Station) -> None:
    """mavlink/MAVSDK#3106: gap reads and the burst shared a position, and the file came out wrong."""
    opened = station.one(Opcode.OPEN_FILE_RO, b"/logs/a.log\0")
    assert int.from_bytes(opened.data, "little") == len(LOG)
    whole = bytearray(len(LOG))
    station.outbox = Outbox(most=300)  # room for one piece at a time
    station.sequence += 1
    session = opened.session
    station.say(packed(Words(station.sequence, session, Opcode.BURST_READ_FILE, 100)))
    heard: list[Words] = []
    for k in range(30):
        station.server.poll(0.0, station.outbox)
        station.say(packed(Words(1000 + k, session, Opcode.READ_FILE, 50, offset=900 - 17 * k)))
        heard += station.hear()
    for words in heard:
        if words.opcode == Opcode.ACK:
            assert words.data == LOG[words.offset : words.offset + len(words.data)]
        if words.asked == Opcode.BURST_READ_FILE:
            whole[words.offset : words.offset + len(words.data)] = words.data
    assert whole == LOG
    burst = [words for words in heard if words.asked == Opcode.BURST_READ_FILE]
    assert [words.offset for words in burst] == list(range(0, 1000, 100))
    assert [words.burst_complete for words in burst] == [False] * 9 + [True]


def test_the_end_of_a_file_is_said(station: Station) -> None:
    session = station.one(Opcode.OPEN_FILE_RO, b"logs/a.log").session
    assert station.one(Opcode.READ_FILE, session=session, offset=990, size=100).data == LOG[990:]
    assert refused(station.one(Opcode.READ_FILE, session=session, offset=1000, size=100)) == FtpError.END_OF_FILE
    assert refused(station.one(Opcode.BURST_READ_FILE, session=session, offset=1000)) == FtpError.END_OF_FILE


def test_a_file_is_written_whole_or_not_at_all(station: Station) -> None:
    session = station.one(Opcode.CREATE_FILE, b"missions/m").session
    station.one(Opcode.WRITE_FILE, b"world", session=session, offset=6)
    station.one(Opcode.WRITE_FILE, b"hello ", session=session, offset=0)
    assert station.files["missions/m"] == b"old mission"
    station.one(Opcode.TERMINATE_SESSION, session=session)
    assert station.files["missions/m"] == b"hello world"
    session = station.one(Opcode.CREATE_FILE, b"missions/m").session
    station.one(Opcode.WRITE_FILE, b"half", session=session)
    station.t += IDLE + 1.0
    station.hear()
    assert refused(station.one(Opcode.WRITE_FILE, b"more", session=session)) == FtpError.INVALID_SESSION
    assert station.files["missions/m"] == b"hello world"
    assert station.files.discarded == 1


def test_write_only_keeps_what_stands_there(station: Station) -> None:
    session = station.one(Opcode.OPEN_FILE_WO, b"missions/m").session
    station.one(Opcode.WRITE_FILE, b"new", session=session)
    station.one(Opcode.TERMINATE_SESSION, session=session)
    assert station.files["missions/m"] == b"new mission"
    station.one(Opcode.TRUNCATE_FILE, b"missions/m", offset=3)
    assert station.files["missions/m"] == b"new"


def test_what_was_done_is_not_done_again(station: Station) -> None:
    """The answer was lost: the same question gets the same answer."""
    first = station.one(Opcode.CREATE_FILE, b"missions/n")
    station.sequence -= 1
    assert station.one(Opcode.CREATE_FILE, b"missions/n") == first
    station.one(Opcode.WRITE_FILE, b"x", session=first.session)
    done = station.one(Opcode.TERMINATE_SESSION, session=first.session)
    station.sequence -= 1
    assert station.one(Opcode.TERMINATE_SESSION, session=first.session) == done
    assert done.opcode == Opcode.ACK
    removed = station.one(Opcode.REMOVE_FILE, b"missions/n")
    station.sequence -= 1
    assert station.one(Opcode.REMOVE_FILE, b"missions/n") == removed
    assert refused(station.one(Opcode.REMOVE_FILE, b"missions/n")) == FtpError.FILE_NOT_FOUND


def test_another_question_under_an_old_number_is_another_question(station: Station) -> None:
    """A ground station that was restarted counts from the beginning."""
    station.one(Opcode.CREATE_DIRECTORY, b"one")
    station.sequence -= 1
    station.one(Opcode.CREATE_DIRECTORY, b"two")
    assert {("one",), ("two",)} < station.files.folders


def test_data_of_the_vehicle_are_protected(station: Station) -> None:
    for opcode in (Opcode.REMOVE_FILE, Opcode.CREATE_FILE, Opcode.OPEN_FILE_WO, Opcode.TRUNCATE_FILE):
        assert refused(station.one(opcode, b"logs/a.log")) == FtpError.FILE_PROTECTED
    assert refused(station.one(Opcode.RENAME, b"logs/a.log\0missions/a")) == FtpError.FILE_PROTECTED
    assert refused(station.one(Opcode.RENAME, b"missions/m\0logs/a.log")) == FtpError.FILE_PROTECTED
    assert station.files["logs/a.log"] == LOG


def test_errors_are_those_of_the_specification(station: Station) -> None:
    assert refused(station.one(Opcode.OPEN_FILE_RO, b"logs/none")) == FtpError.FILE_NOT_FOUND
    assert refused(station.one(Opcode.READ_FILE, session=7)) == FtpError.INVALID_SESSION
    assert refused(station.one(99)) == FtpError.UNKNOWN_COMMAND
    assert refused(station.one(Opcode.RENAME, b"missions/m")) == FtpError.INVALID_DATA_SIZE
    assert refused(station.one(Opcode.CREATE_DIRECTORY, b"logs")) == FtpError.FILE_EXISTS
    assert station.one(Opcode.NONE).opcode == Opcode.ACK


def test_crc_is_that_of_ground_stations(station: Station) -> None:
    """CRC-32 from 0 without the last inversion, as MAVSDK and MAVProxy compute it."""
    expected = zlib.crc32(LOG, 0xFFFFFFFF) ^ 0xFFFFFFFF
    assert station.one(Opcode.CALC_FILE_CRC32, b"logs/a.log").data == expected.to_bytes(4, "little")


def test_a_long_folder_is_listed_in_pages(station: Station) -> None:
    for k in range(60):
        station.files.files["logs", f"dive-{k:04}.log"] = b""
    names: list[bytes] = []
    while True:
        answer = station.one(Opcode.LIST_DIRECTORY, b"/logs", offset=len(names))
        if answer.opcode == Opcode.NAK:
            break
        assert len(answer.data) <= MOST_DATA
        names += answer.data.rstrip(b"\0").split(b"\0")
    assert answer.data[0] == FtpError.END_OF_FILE
    assert names == sorted([b"Fa.log\t1000", *(f"Fdive-{k:04}.log\t0".encode() for k in range(60))])
    assert station.one(Opcode.LIST_DIRECTORY, b"").data == b"Dlogs\0Dmissions\0"


def test_sessions_are_few_and_end(station: Station) -> None:
    numbers = [station.one(Opcode.OPEN_FILE_RO, b"logs/a.log").session for _ in range(MOST_SESSIONS)]
    assert sorted(numbers) == list(range(MOST_SESSIONS))
    assert refused(station.one(Opcode.OPEN_FILE_RO, b"logs/a.log")) == FtpError.NO_SESSIONS_AVAILABLE
    station.one(Opcode.RESET_SESSIONS)
    assert station.one(Opcode.OPEN_FILE_RO, b"logs/a.log", session=200).session == 200
    station.t += IDLE + 1.0
    station.hear()
    assert refused(station.one(Opcode.READ_FILE, session=200)) == FtpError.INVALID_SESSION


def test_sessions_of_two_stations_are_apart(station: Station) -> None:
    session = station.one(Opcode.OPEN_FILE_RO, b"logs/a.log").session
    other = Station(station.files, system=254)
    other.server = station.server
    assert refused(other.one(Opcode.READ_FILE, session=session, size=10)) == FtpError.INVALID_SESSION
    other.one(Opcode.RESET_SESSIONS)
    assert station.one(Opcode.READ_FILE, session=session, size=10).data == LOG[:10]


def test_a_log_that_grows_ends_where_it_ended_when_it_was_opened(station: Station) -> None:
    session = station.one(Opcode.OPEN_FILE_RO, b"logs/a.log").session
    station.files.files["logs", "a.log"] += b"more"
    assert station.one(Opcode.READ_FILE, session=session, offset=990, size=100).data == LOG[990:]


@pytest.mark.parametrize(
    "path", ["../secret", "logs/../../secret", "/..", "logs/\x01", "a\\b", "c:x", "logs/\ufffd", "x" * 201, "a/" * 20]
)
def test_no_path_leads_out(station: Station, path: str) -> None:
    with pytest.raises(FileRefusalError):
        plain_path(path)
    for opcode in (Opcode.OPEN_FILE_RO, Opcode.CREATE_FILE, Opcode.LIST_DIRECTORY, Opcode.REMOVE_FILE):
        assert refused(station.one(opcode, path.encode()[:MOST_DATA])) == FtpError.FAIL


@given(st.text(max_size=60))
def test_a_path_has_plain_names_or_is_refused(text: str) -> None:
    try:
        names = plain_path(text)
    except FileRefusalError:
        return
    assert all(name not in ("", ".", "..") and "/" not in name and "\0" not in name for name in names)


def test_garbage_ends_nothing_and_fills_nothing(station: Station) -> None:
    draw = random.Random(4)
    for _ in range(3000):
        payload = draw.randbytes(draw.randint(0, 251))
        if draw.random() < 0.7 and len(payload) > 3:
            payload = payload[:3] + bytes((draw.randrange(18), draw.randrange(240))) + payload[5:]
        station.say(payload)
        if draw.random() < 0.1:
            station.t += 1.0
            station.hear()
    assert len(station.server._sessions) <= MOST_SESSIONS
    assert len(station.server._answered) <= 16
    station.t += IDLE + 1.0
    station.hear()
    assert station.one(Opcode.OPEN_FILE_RO, b"logs/a.log").opcode == Opcode.ACK
    assert station.files["logs/a.log"] == LOG
