"""Lines and prompts of the CTD."""

from stommel.onboard.instruments.framing import Look

LONGEST_LINE = 160
PROMPT = b"S>"


def look(buffer: bytes, at: int) -> tuple[bytes | None, int] | None:
    """Look for a line or a prompt, as `framing.Framer` asks; a line comes without its end."""
    if buffer.startswith(PROMPT, at):
        return PROMPT, at + len(PROMPT)
    end = buffer.find(b"\n", at, at + LONGEST_LINE)
    if end < 0:
        if len(buffer) - at < LONGEST_LINE:
            return None
        return None, at + LONGEST_LINE
    line = buffer[at : end + 1].rstrip(b"\r\n")
    return line, end + 1


_: Look[bytes] = look
