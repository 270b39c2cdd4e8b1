"""What is wrong with a line, told from the bytes that come."""

_ENOUGH = 300
"""Bytes that must hold a frame: the longest has 280."""
_LONG = 10.0
"""Silence of frames after which bytes without any are suspect [s]."""


class LineWatch:
    """Counts bytes and frames."""

    def __init__(self) -> None:
        self.bytes = 0
        """All that came."""
        self._in_vain = 0
        self._frame_at: float | None = None
        self._byte_at: float | None = None

    def heard(self, count: int, frames: int, t: float) -> None:
        """Take note of bytes that came at a time [s], and of how many frames were in them."""
        self.bytes += count
        self._byte_at = t
        self._in_vain = 0 if frames else self._in_vain + count
        if frames:
            self._frame_at = t

    def complaint(self, t: float) -> str:
        """What seems wrong at a time [s]; empty if nothing does. That nothing comes is no fault of the line."""
        if self._byte_at is None or t - self._byte_at > _LONG or self._in_vain < _ENOUGH:
            return ""
        if self._frame_at is not None and t - self._frame_at < _LONG:
            return ""
        return (
            f"{self._in_vain} bytes came, but no frame in them: another speed of the port at the other end, "
            "or a program that does not speak MAVLink 2"
        )
