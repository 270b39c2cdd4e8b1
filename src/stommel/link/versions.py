"""Messages of another version: their extra byte of the checksum is another one than ours."""

from functools import cache

from fastcrc import crc16

_ENOUGH = 3
"""Frames of a message with the same other extra byte; of noise, one in 256 has some, and hardly ever the same again."""
_SHOWN = 3


class OtherVersions:
    """Looks at frames of a known number whose checksum is wrong."""

    def __init__(self) -> None:
        self._seen: dict[str, tuple[int, int]] = {}
        self.names: list[str] = []
        """Messages that the other end defines otherwise, as they were found."""

    def look(self, name: str, body: bytes, told: int) -> None:
        """Take note of a frame: all between its mark and its checksum, and the checksum that it tells."""
        found: int = crc16.mcrf4xx(body)
        extra = _extras().get(told ^ found >> 8)
        if extra is None or name in self.names:
            return
        extra ^= found & 0xFF
        before, count = self._seen.get(name, (extra, 0))
        self._seen[name] = extra, count + 1 if before == extra else 1
        if self._seen[name][1] >= _ENOUGH:
            self.names.append(name)

    @property
    def sentence(self) -> str:
        """What there is to say; empty if nothing was found."""
        if not self.names:
            return ""
        more = f" and {len(self.names) - _SHOWN} more" if len(self.names) > _SHOWN else ""
        return (
            f"the other end has another version of {', '.join(self.names[:_SHOWN])}{more}: "
            "bring the software of both ends to the same release"
        )


@cache
def _extras() -> dict[int, int]:
    """Last byte of what is summed, by what it makes of a sum of zero; each makes something else."""
    return {crc16.mcrf4xx(bytes((extra,)), 0): extra for extra in range(256)}
