"""Takes files that the other end offers: fetches what is missing of them, and says when they are whole."""

from typing import NamedTuple

from stommel.errors import StommelError
from stommel.link.files.fetching import Fetch
from stommel.link.files.paths import file_path
from stommel.link.files.port import FilePort, FileRefusalError, FileResult, Part
from stommel.link.outbox import Outbox
from stommel.link.service import Received
from stommel.link.traffic import Traffic
from stommel.link.values import octets, text, whole

MOST_INCOMING = 4
FORGOTTEN = 900.0
"""An offer of which nothing was heard for so long is closed; what has come of it stays on the disk [s]."""
_REMEMBERED = 16
_TOLD_AGAIN = 20.0
"""How long a refusal is told again to an offer that is repeated [s]; later it is a new offer, and may be taken."""
_UNKNOWN_EVERY = 0.5
Key = tuple[tuple[int, int], int]
"""System and component of whoever offers, and the number of the transfer."""


class Outcome(NamedTuple):
    """What became of an offer."""

    result: FileResult
    reason: str = ""


class _Offer(NamedTuple):
    path: str
    size: int
    sha256: bytes


class _Ended(NamedTuple):
    offer: _Offer
    outcome: Outcome
    t: float


class _Incoming:
    def __init__(self, offer: _Offer, part: Part, fetch: Fetch, t: float) -> None:
        self.offer, self.part, self.fetch = offer, part, fetch
        self.heard = t


class Receiving:
    """Offers of other ends, and what has come of them."""

    def __init__(self, port: FilePort, traffic: Traffic | None = None) -> None:
        self._port, self._traffic = port, traffic
        self._incoming: dict[Key, _Incoming] = {}
        self._ended: dict[Key, _Ended] = {}
        self._said_unknown = float("-inf")
        self.outcomes: list[tuple[Key, Outcome]] = []
        """To be said; whoever says them takes them out."""

    def offer(self, received: Received, t: float) -> None:
        """Take FILE_OFFER: begin, or go on; what has ended says so again."""
        key = ((received.system, received.component), whole(received.values, "transfer"))
        offer = _Offer(text(received.values, "path"), whole(received.values, "size"), octets(received.values, "sha256"))
        incoming, ended = self._incoming.get(key), self._ended.get(key)
        if ended is not None and ended.offer == offer and self._holds(ended, t):
            self.outcomes.append((key, ended.outcome))
        elif incoming is not None and incoming.offer == offer:
            incoming.heard = t
            incoming.fetch.wake(t)
        else:
            self._begin(key, offer, t)

    def _holds(self, ended: _Ended, t: float) -> bool:
        """Whether an outcome is one still: a file that came may have been removed since, and room may have come."""
        if ended.outcome.result is not FileResult.OK:
            return t - ended.t < _TOLD_AGAIN
        try:
            return self._port.size(file_path(ended.offer.path)) == ended.offer.size
        except StommelError:
            return False

    def _begin(self, key: Key, offer: _Offer, t: float) -> None:
        """Begin to receive; the same file under another number goes on under this one."""
        for other, incoming in tuple(self._incoming.items()):
            if other == key or incoming.offer.path == offer.path:
                self._close(other)
        if len(self._incoming) >= MOST_INCOMING:
            self.outcomes.append((key, Outcome(FileResult.NO_ROOM, f"{MOST_INCOMING} files are received already")))
            return
        try:
            part = self._port.receive(file_path(offer.path), offer.size, offer.sha256)
        except StommelError as error:
            self._end(key, offer, _refusal(error), t)
            return
        self._incoming[key] = _Incoming(offer, part, Fetch(*key, part.missing, part, traffic=self._traffic), t)

    def data(self, received: Received, t: float) -> None:
        """Take FILE_DATA."""
        key = ((received.system, received.component), whole(received.values, "transfer"))
        incoming = self._incoming.get(key)
        if incoming is None:
            self._unknown(key, t)
            return
        incoming.heard = t
        try:
            incoming.fetch.take(received, t)
        except StommelError as error:
            self._close(key)
            self._end(key, incoming.offer, _refusal(error), t)

    def _unknown(self, key: Key, t: float) -> None:
        """Somebody goes on with what this end has forgotten by a restart; say so now and then."""
        if key not in self._ended and t - self._said_unknown >= _UNKNOWN_EVERY:
            self._said_unknown = t
            self.outcomes.append((key, Outcome(FileResult.UNKNOWN, "offer it again")))

    def poll(self, t: float, outbox: Outbox) -> None:
        """Ask for what is missing, and end what is whole."""
        for key, incoming in tuple(self._incoming.items()):
            try:
                incoming.part.rest(t)
                if incoming.fetch.is_whole:
                    del self._incoming[key]
                    incoming.part.finish()
                    self._end(key, incoming.offer, Outcome(FileResult.OK), t)
                elif t - incoming.heard > FORGOTTEN:
                    self._close(key)
                else:
                    incoming.fetch.poll(t, outbox)
            except StommelError as error:
                self._incoming.pop(key, None)
                self._end(key, incoming.offer, _refusal(error), t)

    def _close(self, key: Key) -> None:
        self._incoming.pop(key).part.close()

    def _end(self, key: Key, offer: _Offer, outcome: Outcome, t: float) -> None:
        self._ended.pop(key, None)
        self._ended[key] = _Ended(offer, outcome, t)
        while len(self._ended) > _REMEMBERED:
            del self._ended[next(iter(self._ended))]
        self.outcomes.append((key, outcome))


def _refusal(error: StommelError) -> Outcome:
    return Outcome(error.result if isinstance(error, FileRefusalError) else FileResult.FAILED, str(error))
