"""Words that must fit into a field of a message."""

from stommel.errors import one_line


def fitted(text: str, most: int) -> str:
    """A text on one line that takes at most so many bytes; a longer one is cut in its middle, then at its end."""
    plain = " ".join(text.split())
    if len(plain.encode("utf-8", "replace")) > most:
        plain = one_line(plain, max(most, 7))
    return plain.encode("utf-8", "replace")[:most].decode("utf-8", "ignore")
