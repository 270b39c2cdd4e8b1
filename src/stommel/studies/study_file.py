"""What a study file may say: which mission, which numbers to change and how, how many runs."""

from math import isfinite
from typing import Annotated, Any, Literal, Self

from pydantic import ConfigDict, Field, field_validator, model_validator

from stommel.files.fields import Name, Table
from stommel.files.ranges import GREATEST_SEED, between

SWEEP, LATIN_HYPERCUBE, MONTE_CARLO, SOBOL = "sweep", "latin_hypercube", "monte_carlo", "sobol"

Quantity = Annotated[float, between(-1e12, 1e12)]
"""A number that a parameter may take; its own field says what it may be."""

Value = float | str | bool
"""What a parameter may be set to."""

MOST_RUNS = 1_000_000

_SPACES = ("vehicle", "mission", "ocean", "sensors")
"""What a key begins with."""

_OF_DISTRIBUTION = {
    "uniform": ("from", "to"),
    "normal": ("mean", "standard_deviation"),
    "lognormal": ("median", "log_standard_deviation"),
}
"""Keys that describe each distribution."""


class Parameter(Table):
    """One key that the study changes. A sweep gives values, or beside others a distribution; every other kind that."""

    model_config = ConfigDict(extra="forbid", frozen=True, populate_by_name=False)

    key: str
    """vehicle.KEY of the vehicle file, mission.KEY of the mission file, ocean.PARAMETER or sensors.KEY."""
    name: Annotated[str, Field(pattern=r"^[A-Za-z]\w*$")] | None = None
    """Name in the result; the last part of the key if left out."""
    values: tuple[Any, ...] | None = None
    """Numbers, texts or true and false, of a sweep."""
    from_: Quantity | None = Field(None, alias="from")
    """First of equally spaced values, or lower end of a uniform distribution."""
    to: Quantity | None = None
    """Last of equally spaced values, or upper end of a uniform distribution."""
    steps: Annotated[int, Field(strict=True, ge=2, le=MOST_RUNS)] | None = None
    """Count of equally spaced values, both ends among them."""
    distribution: Literal["uniform", "normal", "lognormal"] | None = None
    mean: Quantity | None = None
    """Of a normal distribution."""
    standard_deviation: Annotated[float, between(1e-12, 1e12)] | None = None
    """Of a normal distribution."""
    median: Annotated[float, between(1e-12, 1e12)] | None = None
    """Of a lognormal distribution."""
    log_standard_deviation: Annotated[float, between(1e-6, 5)] | None = None
    """Of the natural logarithm, of a lognormal distribution."""
    at_least: Quantity | None = None
    """Cuts a distribution off below."""
    at_most: Quantity | None = None
    """Cuts a distribution off above."""

    @field_validator("key")
    @classmethod
    def _in_a_space(cls, key: str) -> str:
        space, *rest = key.split(".")
        if space not in _SPACES or not rest or not all(rest):
            raise ValueError(f"{key!r}: must be one of {', '.join(f'{name}.KEY' for name in _SPACES)}")
        return key

    def given(self) -> set[str]:
        """Keys of the file that describe values or distribution."""
        names = {info.alias or name: name for name, info in type(self).model_fields.items()}
        return {key for key, name in names.items() if key not in ("key", "name") and getattr(self, name) is not None}

    @property
    def drawn(self) -> bool:
        """Whether its values are drawn from a distribution."""
        return self.distribution is not None

    def check_sweep(self) -> None:
        """Refuse what is no list or range of values."""
        given = self.given()
        if given == {"values"}:
            self._check_values()
        elif given != {"from", "to", "steps"}:
            raise ValueError(
                f"{self.key}: a parameter of a sweep needs either values, or from, to and steps, and nothing else"
                f"; given: {_listed(given)}"
            )
        elif self.from_ == self.to:
            raise ValueError(f"{self.key}: from = to = {self.to:g}: the range is empty")

    def _check_values(self) -> None:
        assert self.values is not None
        if not self.values:
            raise ValueError(f"{self.key}: values = []: must hold at least one value")
        for value in self.values:
            if not isinstance(value, str | bool | int | float) or (isinstance(value, float) and not isfinite(value)):
                raise ValueError(f"{self.key}: values: {value!r}: must be a finite number, a text, true or false")
        kinds = {
            float if isinstance(value, int) and not isinstance(value, bool) else type(value) for value in self.values
        }
        if len(kinds) > 1:
            raise ValueError(f"{self.key}: values: must be all numbers, or all texts, or all true and false")
        if len(set(self.values)) < len(self.values):
            raise ValueError(f"{self.key}: values: a value is given twice")

    def check_distribution(self, kind: str) -> None:
        """Refuse what is no distribution."""
        given = self.given()
        if self.distribution is None:
            raise ValueError(
                f"{self.key}: a parameter of a {kind} study needs distribution = one of {', '.join(_OF_DISTRIBUTION)}"
            )
        needed = _OF_DISTRIBUTION[self.distribution]
        allowed = {"distribution", "at_least", "at_most", *needed}
        if not {*needed} <= given <= allowed:
            raise ValueError(
                f"{self.key}: distribution = {self.distribution!r} needs {' and '.join(needed)}, and allows at_least "
                f"and at_most; given: {_listed(given - {'distribution'})}"
            )
        for low, high, names in (
            (self.from_, self.to, "from must be less than to"),
            (self.at_least, self.at_most, "at_least must be less than at_most"),
        ):
            if low is not None and high is not None and not low < high:
                raise ValueError(f"{self.key}: {names}")


class StudyFile(Table):
    """A study, as its file describes it."""

    format: Literal[1] = 1
    name: Name
    mission: Annotated[str, Field(min_length=1)]
    """Mission file beside the study file, or a shipped mission."""
    kind: Literal["sweep", "latin_hypercube", "monte_carlo", "sobol"]
    runs: Annotated[int, Field(strict=True, ge=1, le=MOST_RUNS)] | None = None
    """Runs; of a sweep, at each combination of values (1 if left out); of a Sobol study, base points."""
    seed: Annotated[int, Field(strict=True, ge=0, le=GREATEST_SEED)] = 0
    """Of the samples and of every run."""
    same_noise: bool = False
    """Every run draws the same sensor noise, so that differences are the parameters' alone."""
    parameters: tuple[Parameter, ...]
    outputs: tuple[str, ...] = ()
    """Names of the summary's numbers to keep; all of them if left out."""

    @model_validator(mode="after")
    def _is_consistent(self) -> Self:
        if not self.parameters:
            raise ValueError("parameters is empty; add a table [[parameters]] with the key to change")
        for parameter in self.parameters:
            if self.kind == SWEEP and not parameter.drawn:
                parameter.check_sweep()
            else:
                parameter.check_distribution(self.kind)
        if self.kind == SWEEP:
            self._check_draws()
        keys = [parameter.key for parameter in self.parameters]
        for key in keys:
            if keys.count(key) > 1:
                raise ValueError(f"parameters: {key} is given twice")
        if self.runs is None and self.kind != SWEEP:
            raise ValueError(f"runs is missing; add runs = <count of runs of the {self.kind} study>")
        if self.kind == SOBOL and self.runs is not None and self.runs & (self.runs - 1):
            raise ValueError(
                f"runs = {self.runs}: must be a power of 2 in a Sobol study, such as {1 << self.runs.bit_length()}"
            )
        if self.count > MOST_RUNS:
            raise ValueError(f"the study has {self.count} runs; at most {MOST_RUNS} are allowed")
        return self

    def _check_draws(self) -> None:
        """Refuse a sweep whose parameters are all drawn, or whose count of draws is missing."""
        drawn = [parameter.key for parameter in self.parameters if parameter.drawn]
        if len(drawn) == len(self.parameters):
            raise ValueError(f"{drawn[0]}: a sweep needs a parameter with values; use kind = 'monte_carlo' without any")
        if drawn and self.runs is None:
            raise ValueError(f"runs is missing; add runs = <count of draws of {drawn[0]} at each combination>")

    @property
    def count(self) -> int:
        """Runs in all."""
        runs = self.runs or 1
        if self.kind == SOBOL:
            return runs * (len(self.parameters) + 2)
        if self.kind == SWEEP:
            for parameter in self.parameters:
                if not parameter.drawn:
                    runs *= len(parameter.values) if parameter.values is not None else parameter.steps or 1
        return runs


def _listed(keys: set[str]) -> str:
    return ", ".join(sorted(keys)) or "nothing"
