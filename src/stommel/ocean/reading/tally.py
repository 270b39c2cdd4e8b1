"""What was left out or set right while the numbers of a file were read: counted, to be told at the end."""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Tally:
    """Counts of numbers by variable and by what was done with them."""

    counts: dict[tuple[str, str], list[int]] = field(default_factory=dict)
    """Numbers concerned, and numbers read, by variable and what was done."""

    def add(self, variable: str, done: str, concerned: int, read: int) -> None:
        """Count numbers of a part of a variable."""
        found = self.counts.setdefault((variable, done), [0, 0])
        found[0] += concerned
        found[1] += read

    def told(self) -> dict[str, str]:
        """A sentence for each variable of whose numbers some were concerned."""
        sentences: dict[str, str] = {}
        for (variable, done), (concerned, read) in self.counts.items():
            if concerned:
                sentence = f"{concerned} of {read} numbers ({share(concerned, read)}) {done}"
                before = sentences.get(variable)
                sentences[variable] = f"{before}; {sentence}" if before else sentence
        return sentences


def share(part: int, whole: int) -> str:
    """A share in per cent, never nothing where there is some."""
    return f"{100.0 * part / max(whole, 1):.2g} %"
