"""Whether a vehicle is heard as it should be: a surfacing that was missed, a link that is silent."""

from datetime import UTC, datetime
from typing import NamedTuple

from stommel.station.alarms.change import Change

_LAST_TIME = 253_402_300_799.0
"""Of the year 9999 [s]."""
SURFACING_MISSED, LINK_SILENT = "surfacing_missed", "link_silent"


class Contact(NamedTuple):
    """What is known of the contact to a vehicle; times are those of the vehicle's clock [s]."""

    heard: float | None = None
    """When it was heard last; None: never."""
    expected: float | None = None
    """When it shall be heard next; None: nobody knows, or it is heard now."""
    is_diving: bool = False
    """Whether it dives, as far as is known; when it shall be back is not always known."""
    trouble: str = ""
    """What is wrong with the transport."""


class ContactWatch:
    """Contacts in, alarms that begin or end out.

    A surfacing is missed when the vehicle was not heard until the time that was expected when it was last heard, and a
    margin: whoever reckons the next one anew meanwhile does not move it. A silence that no dive explains is told as a
    silent link. Both end when the vehicle is heard.

    Parameters
    ----------
    margin
        For how long after the expected time a surfacing is not yet missed [s].
    longest_silence, longest_dive
        For how long a link may be silent without a dive, and in a dive whose end nobody knows [s].
    open_keys
        Alarms that were raised before, as from before a restart.
    """

    def __init__(
        self, margin: float, longest_silence: float, longest_dive: float, open_keys: frozenset[str] = frozenset()
    ) -> None:
        self._margin, self._longest, self._longest_dive = margin, longest_silence, longest_dive
        self._raised = open_keys & {SURFACING_MISSED, LINK_SILENT}
        self._heard: float | None = None
        self._expected: float | None = None
        self._begun: float | None = None

    def look(self, now: float, contact: Contact) -> list[Change]:
        """See at a time [s] whether the vehicle should have been heard."""
        if self._begun is None or now < self._begun:
            self._begun = now
        ended = self._heard_again(contact.heard) if contact.heard is not None else []
        if self._expected is None and contact.expected is not None:
            self._expected = contact.expected
        return ended + self._missed(now) + self._silent(now, contact)

    def _heard_again(self, heard: float) -> list[Change]:
        first, before = self._heard is None, self._heard
        if before == heard:
            return []
        self._heard, self._expected = heard, None
        if first:  # what the archive knew when the station started; the vehicle is not heard by that
            return []
        ended = [Change(key, False, heard, None, "", "notice") for key in sorted(self._raised)]
        self._raised = frozenset()
        return ended

    def _missed(self, now: float) -> list[Change]:
        if self._expected is None or now <= self._expected + self._margin or SURFACING_MISSED in self._raised:
            return []
        self._raised |= {SURFACING_MISSED}
        words = f"Surfacing missed, expected at {_utc(self._expected)}"
        return [Change(SURFACING_MISSED, True, now, None, words, "critical")]

    def _silent(self, now: float, contact: Contact) -> list[Change]:
        since = self._begun if self._heard is None else self._heard
        longest = self._longest_dive if contact.is_diving else self._longest
        if self._expected is not None or self._raised or since is None or now - since <= longest:
            return []
        self._raised |= {LINK_SILENT}
        why = "its dive should have ended" if contact.is_diving else "no dive is known"
        words = f"Nothing heard for {(now - since) / 60.0:.0f} min and {why}"
        words += contact.trouble and f": {contact.trouble}"
        return [Change(LINK_SILENT, True, now, None, words, "warning")]


def _utc(t: float) -> str:
    return datetime.fromtimestamp(min(max(t, 0.0), _LAST_TIME), UTC).strftime("%Y-%m-%d %H:%M UTC")
