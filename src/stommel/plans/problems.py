"""What is wrong with a plan, for people: the key, its value, the reason, and what is allowed."""

import re
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

from stommel.errors import FileError, StommelError
from stommel.files.sentences import validated
from stommel.plans.plan import StationPlan

ORIGIN = "plan"
"""How sentences name it where it is no file."""
_SENTENCE = re.compile(r"(?P<key>[A-Za-z_][\w.]*)(?: = (?P<value>.+?))?: (?P<rest>.+)", re.DOTALL)
_ALLOWED = (
    (re.compile(r"\bmust (?:be )?([^;]+)"), "{}"),
    (re.compile(r"(?:deeper than|more than|below) [^,]+, ([\d.]+ \w+)$"), "at most {}"),
    (re.compile(r"outside the ocean, which has (.+)"), "{}"),
    (re.compile(r"\bknown keys: (.+)"), "one of {}"),
    (re.compile(r" is missing; (?:add|it) (.+)"), "{}"),
)
"""How sentences say what is allowed."""
_LONGEST_KEY = 120
_OF_FILES = '; outside = "hold" or "climatology" allows it'
"""Advice that no plan can follow."""


@dataclass(frozen=True)
class PlanProblem:
    """One thing wrong with a plan."""

    key: str
    """Dotted, as `dives.depth_m` or `waypoints.2`; empty for the plan as a whole."""
    value: str
    """As it was given, in words; empty where there is none."""
    reason: str
    """A sentence."""
    allowed: str
    """What may stand there; empty where the reason says it all."""

    def as_row(self) -> dict[str, str]:
        """The problem as JSON has it."""
        return asdict(self)


class PlanError(StommelError):
    """A plan that cannot be; `problems` holds everything found wrong with it."""

    def __init__(self, problems: Iterable[PlanProblem]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(problem.reason for problem in self.problems))


def problem(key: str, sentence: str) -> PlanProblem:
    """Take a sentence apart that names key, value and what is allowed, as all of stommel's do."""
    sentence = sentence.removesuffix(_OF_FILES)
    if key and sentence.startswith(f"{key}: {key}"):  # said of a table as a whole, in words that name it already
        key, sentence = "", sentence.removeprefix(f"{key}: ")
    found = _SENTENCE.fullmatch(sentence)
    value = (found["value"] or "") if found is not None else ""
    if not key and found is not None and len(found["key"]) <= _LONGEST_KEY:
        key = found["key"]
    return PlanProblem(key, value, sentence, _allowed(sentence))


def _allowed(sentence: str) -> str:
    for pattern, words in _ALLOWED:
        found = pattern.search(sentence)
        if found is not None:
            return words.format(found[1].strip())
    return ""


def problems_of(error: StommelError, origin: str = ORIGIN) -> list[PlanProblem]:
    """Everything that an error says is wrong; `origin` is how its sentences name the plan, and is left out."""
    if isinstance(error, PlanError):
        return list(error.problems)
    if isinstance(error, FileError):
        return [problem(each.key, each.message) for each in error.problems]
    lines = str(error).replace("ballasting.neutral_depth_m", "neutral_density_kg_m3").splitlines()
    return [problem("", line.removeprefix(f"{origin}: ")) for line in lines]


def plan_from(document: Any) -> StationPlan:
    """Read a plan from the values of its JSON.

    Raises
    ------
    PlanError
        Every key that is unknown, missing or out of range.
    """
    try:
        return validated(document, StationPlan, ORIGIN)
    except FileError as error:
        raise PlanError(problems_of(error)) from None
