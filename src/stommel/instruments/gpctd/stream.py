"""Lines and prompts of the CTD."""

LONGEST_LINE = 160
PROMPT = b"S>"


def look(buffer: bytes, at: int) -> tuple[bytes | None, int] | None:
    """Look for a line or a prompt, as `framing.Framer` asks; a line comes without its end.

    Lines have no checksum. Hence nothing is ever cut off the beginning of one to see whether the rest is a line.
    """
    if buffer.startswith(PROMPT, at):
        return PROMPT, at + len(PROMPT)
    end = buffer.find(b"\n", at)
    last = len(buffer) if end < 0 else end
    if last - at >= LONGEST_LINE:
        return None, last - LONGEST_LINE + 1  # what is left is still too long to be taken for a line
    if end < 0:
        return None
    return buffer[at:end].rstrip(b"\r"), end + 1
