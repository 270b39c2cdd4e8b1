"""MAVLink FTP aboard, for every ground station that speaks it.

Source: mavlink.io/en/services/ftp.html. An answer that was lost is said again when the question comes again under its
sequence number; nothing is done twice.
"""

import zlib
from collections.abc import Callable
from typing import NamedTuple

from stommel.link.files import ftp_words
from stommel.link.files.ftp_sessions import IDLE, Burst, FtpSessions, OpenFile, Peer
from stommel.link.files.ftp_words import MOST_DATA, Opcode, Words, acknowledgement, refusal
from stommel.link.files.paths import file_path, plain_path, shown
from stommel.link.files.port import FilePort, FileRefusalError, FtpError, Path
from stommel.link.outbox import Outbox, Priority
from stommel.link.service import Received, is_for

_MOST_WAITING = 32
"""Answers that wait for room; more questions than that are not heard."""
_REMEMBERED = 16
"""Answers that are kept for questions that come again."""
_BURST = 64
"""Pieces of a burst; then the ground station asks for the next one."""
_MOST_CRC = 64 << 20
_CHUNK = 1 << 18
_FRAME = 255
_ALL_ONES = 0xFFFFFFFF


class _Answered(NamedTuple):
    question: Words
    answer: Words
    t: float


class FtpServer:
    """Answers FILE_TRANSFER_PROTOCOL.

    Parameters
    ----------
    system, component
        Who answers.
    port
        The files.
    """

    def __init__(self, system: int, component: int, port: FilePort) -> None:
        self._system, self._component, self._port = system, component, port
        self._sessions = FtpSessions()
        self._waiting: list[tuple[Peer, Words]] = []
        self._answered: dict[tuple[Peer, int], _Answered] = {}
        self._obey: dict[int, Callable[[Peer, Words, float], Words | None]] = {
            Opcode.NONE: lambda _peer, question, _t: acknowledgement(question),
            Opcode.TERMINATE_SESSION: self._terminate,
            Opcode.RESET_SESSIONS: self._reset,
            Opcode.LIST_DIRECTORY: self._list,
            Opcode.OPEN_FILE_RO: self._open_to_read,
            Opcode.READ_FILE: self._read,
            Opcode.CREATE_FILE: self._create,
            Opcode.WRITE_FILE: self._write,
            Opcode.REMOVE_FILE: self._on_path(port.remove),
            Opcode.CREATE_DIRECTORY: self._on_path(port.make_folder),
            Opcode.REMOVE_DIRECTORY: self._on_path(port.remove_folder),
            Opcode.OPEN_FILE_WO: self._open_to_write,
            Opcode.TRUNCATE_FILE: self._truncate,
            Opcode.RENAME: self._rename,
            Opcode.CALC_FILE_CRC32: self._crc,
            Opcode.BURST_READ_FILE: self._burst,
        }

    def take(self, received: Received, t: float) -> None:
        """Take a question at a time [s]."""
        if received.name != ftp_words.MESSAGE or not is_for(received, self._system, self._component):
            return
        payload = received.values["payload"]
        question = ftp_words.unpacked(payload) if isinstance(payload, bytes) else None
        if question is None or question.opcode >= Opcode.ACK or len(self._waiting) >= _MOST_WAITING:
            return
        peer = (received.system, received.component)
        answer = self._said_before(peer, question, t) or self._answer(peer, question, t)
        if answer is not None:
            self._waiting.append((peer, answer))

    def poll(self, t: float, outbox: Outbox) -> None:
        """Say answers, then pieces of bursts as there is room."""
        self._sessions.forget(None, t - IDLE)
        while self._waiting and outbox.room(Priority.COMMAND) >= _FRAME:
            self._say(outbox, Priority.COMMAND, *self._waiting.pop(0))
        for (peer, number), file in self._sessions:
            if file.burst is not None and outbox.room(Priority.DATA) >= _FRAME:
                file.used = t
                self._say(outbox, Priority.DATA, peer, self._piece(number, file, file.burst))

    def _say(self, outbox: Outbox, priority: Priority, peer: Peer, words: Words) -> None:
        system, component = peer
        outbox.put(
            priority,
            ftp_words.MESSAGE,
            {"target_system": system, "target_component": component, "payload": ftp_words.packed(words)},
            self._component,
        )

    # questions

    def _said_before(self, peer: Peer, question: Words, t: float) -> Words | None:
        known = self._answered.get((peer, question.session))
        return known.answer if known is not None and known.question == question and t - known.t < IDLE else None

    def _answer(self, peer: Peer, question: Words, t: float) -> Words | None:
        obey = self._obey.get(question.opcode)
        try:
            if obey is None:
                raise FileRefusalError(FtpError.UNKNOWN_COMMAND, f"opcode {question.opcode} is not known")  # noqa: TRY301
            answer = obey(peer, question, t)
        except FileRefusalError as error:
            answer = refusal(question, error.code)
        if answer is not None:
            self._answered.pop((peer, question.session), None)
            self._answered[peer, question.session] = _Answered(question, answer, t)
            while len(self._answered) > _REMEMBERED:
                del self._answered[next(iter(self._answered))]
        return answer

    def _terminate(self, peer: Peer, question: Words, _t: float) -> Words:
        self._sessions.end(peer, question.session)
        return acknowledgement(question)

    def _reset(self, peer: Peer, question: Words, t: float) -> Words:
        self._sessions.forget(peer, t)
        return acknowledgement(question)

    def _list(self, _peer: Peer, question: Words, _t: float) -> Words:
        entries = self._port.entries(plain_path(question.text))[question.offset :]
        data = b""
        for entry in entries:
            said = f"D{entry.name}" if entry.is_folder else f"F{entry.name}\t{entry.size}"
            # A name that fits nowhere is skipped as the words have it: "S".
            line = said.encode() + b"\0" if len(said.encode()) < MOST_DATA else b"S\0"
            if len(data) + len(line) > MOST_DATA:
                break
            data += line
        if not data:
            raise FileRefusalError(FtpError.END_OF_FILE, "there are no more entries")
        return acknowledgement(question, data)

    def _open_to_read(self, peer: Peer, question: Words, t: float) -> Words:
        path = file_path(question.text)
        return self._opened(peer, question, OpenFile(path, self._port.size(path), None), t)

    def _create(self, peer: Peer, question: Words, t: float) -> Words:
        path = file_path(question.text)
        return self._opened(peer, question, OpenFile(path, 0, self._port.stage(path, from_old=False)), t)

    def _open_to_write(self, peer: Peer, question: Words, t: float) -> Words:
        path = file_path(question.text)
        staged = self._port.stage(path, from_old=True)
        return self._opened(peer, question, OpenFile(path, staged.size, staged), t)

    def _opened(self, peer: Peer, question: Words, file: OpenFile, t: float) -> Words:
        try:
            number = self._sessions.begin(peer, question.session, file, t)
        except FileRefusalError:
            if file.staged is not None:
                file.staged.discard()
            raise
        return acknowledgement(question, min(file.size, _ALL_ONES).to_bytes(4, "little"), session=number)

    def _read(self, peer: Peer, question: Words, t: float) -> Words:
        file = self._sessions.of(peer, question, t)
        data = self._bytes(file, question.offset, min(question.size, MOST_DATA) or MOST_DATA)
        if not data:
            raise FileRefusalError(FtpError.END_OF_FILE, f"{shown(file.path)}: ends before {question.offset}")
        return acknowledgement(question, data)

    def _bytes(self, file: OpenFile, offset: int, length: int) -> bytes:
        """Bytes of an open file; what grew behind its end since it was opened is not shown."""
        if file.staged is not None:
            raise FileRefusalError(FtpError.FAIL, f"{shown(file.path)}: is open to be written")
        return self._port.read(file.path, offset, max(0, min(length, file.size - offset)))

    def _burst(self, peer: Peer, question: Words, t: float) -> Words | None:
        file = self._sessions.of(peer, question, t)
        if file.staged is not None or question.offset >= file.size:
            raise FileRefusalError(FtpError.END_OF_FILE, f"{shown(file.path)}: ends before {question.offset}")
        size = min(question.size, MOST_DATA) or MOST_DATA
        file.burst = Burst(question.sequence, question.offset, size, _BURST)
        return None

    def _piece(self, number: int, file: OpenFile, burst: Burst) -> Words:
        """The next piece of a burst."""
        question = Words(burst.sequence, number, Opcode.BURST_READ_FILE, offset=burst.offset)
        try:
            data = self._bytes(file, burst.offset, burst.size)
            if not data:
                raise FileRefusalError(FtpError.END_OF_FILE, f"{shown(file.path)}: ends before {burst.offset}")  # noqa: TRY301
        except FileRefusalError as error:
            file.burst = None
            return refusal(question, error.code)
        end = burst.offset + len(data)
        last = burst.left == 1 or end >= file.size
        file.burst = None if last else Burst((burst.sequence + 1) & 0xFFFF, end, burst.size, burst.left - 1)
        return acknowledgement(question, data)._replace(burst_complete=last)

    def _write(self, peer: Peer, question: Words, t: float) -> Words:
        file = self._sessions.of(peer, question, t)
        if file.staged is None:
            raise FileRefusalError(FtpError.FAIL, f"{shown(file.path)}: is open to be read")
        file.staged.write(question.offset, question.data)
        return acknowledgement(question, len(question.data).to_bytes(4, "little"))

    def _truncate(self, _peer: Peer, question: Words, _t: float) -> Words:
        path = file_path(question.text)
        staged = self._port.stage(path, from_old=True)
        try:
            staged.truncate(question.offset)
        except FileRefusalError:
            staged.discard()
            raise
        staged.commit()
        return acknowledgement(question)

    def _rename(self, _peer: Peer, question: Words, _t: float) -> Words:
        names = question.data.split(b"\0")
        if len(names) < 2:
            raise FileRefusalError(FtpError.INVALID_DATA_SIZE, "rename: needs two paths")
        old, new = (file_path(name.decode("utf-8", "replace")) for name in names[:2])
        self._port.rename(old, new)
        return acknowledgement(question)

    def _crc(self, _peer: Peer, question: Words, _t: float) -> Words:
        """CRC-32 as ground stations compute it: from 0, and not inverted at its end."""
        path = file_path(question.text)
        size = self._port.size(path)
        if size > _MOST_CRC:
            raise FileRefusalError(
                FtpError.FAIL, f"{shown(path)}: {size} bytes: at most {_MOST_CRC} are summed at once"
            )
        crc = _ALL_ONES
        for offset in range(0, size, _CHUNK):
            crc = zlib.crc32(self._port.read(path, offset, min(_CHUNK, size - offset)), crc)
        return acknowledgement(question, (crc ^ _ALL_ONES).to_bytes(4, "little"))

    def _on_path(self, act: Callable[[Path], None]) -> Callable[[Peer, Words, float], Words]:
        def obey(_peer: Peer, question: Words, _t: float) -> Words:
            act(file_path(question.text))
            return acknowledgement(question)

        return obey
