"""What a scenario file may say: a plan, and the world that it is flown in."""

from datetime import UTC, datetime
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from stommel.files.fields import Finite
from stommel.files.ranges import GREATEST_SEED, between
from stommel.mission.plan import Plan, Position
from stommel.simulation.scenario.world_tables import (
    Ballasting,
    Ctd,
    HullAir,
    Integration,
    Leak,
    OceanChoice,
    Sensing,
    Waves,
)

MOST_CONTROL_STEPS = 1e8
"""Of a mission: three years of seconds."""
MOST_ROWS = 1e7
"""Of output, and of samples of the CTD: they are kept in memory."""
LONGEST_LATENCY = 16
"""Control steps by which a measurement may reach the software late, and one."""


class ScenarioFile(Plan):
    """A scenario, as its file describes it: what the vehicle is told, and beside it what the world is like."""

    vehicle: Annotated[str, Field(min_length=1)]
    """Built-in vehicle or vehicle file, beside the scenario file."""
    changes: dict[str, Finite] = Field(default_factory=dict)
    """Numbers of the vehicle file that this mission changes, by their dotted keys."""
    physics: Literal["paper", "full"] = "full"
    start_time: datetime
    """With its time zone."""
    duration_days: Annotated[float, between(0.0005, 730)]
    """The mission ends here at the latest."""
    seed: Annotated[int, Field(strict=True, ge=0, le=GREATEST_SEED)] = 0
    """Of every random draw."""
    output_every_s: Annotated[float, between(0.05, 86400)] = 10.0
    start: Position
    heading_deg: Annotated[float, between(-360, 360)] = 0.0
    """At the start."""
    ballasting: Ballasting = Ballasting()
    sensors: Sensing = Sensing()
    ctd: Ctd = Ctd()
    waves: Waves = Waves()
    hull_air: HullAir = HullAir()
    leak: Leak = Leak()
    ocean: OceanChoice
    integration: Integration = Integration()

    @property
    def start_seconds(self) -> float:
        """Start [s since 1970-01-01 UTC]."""
        return self.start_time.timestamp()

    @property
    def end_seconds(self) -> float:
        """Latest end [s since 1970-01-01 UTC]."""
        return self.start_seconds + self.duration_days * 86400.0

    @model_validator(mode="after")
    def _is_consistent(self) -> Self:
        if self.start_time.tzinfo is None:
            raise ValueError(
                f"start_time = {self.start_time.isoformat()}: needs a time zone, such as "
                f"{self.start_time.replace(tzinfo=UTC).isoformat()}"
            )
        if self.sensors.first_fix_s >= self.surface.session_s:
            raise ValueError(
                f"sensors.first_fix_s = {self.sensors.first_fix_s:g}: must be less than surface.session_s = "
                f"{self.surface.session_s:g}, or no position is ever found"
            )
        self._check_steps()
        return self

    def _check_steps(self) -> None:
        """Refuse times that the control steps cannot keep."""
        step = self.integration.control_step_s
        for key, value in (("output_every_s", self.output_every_s), ("sampling.every_s", self.sampling.every_s)):
            steps = value / step
            if abs(steps - round(steps)) > 1e-9 or steps < 1:
                raise ValueError(f"{key} = {value:g}: must be a multiple of integration.control_step_s = {step:g}")
        for key, every, most in (
            ("integration.control_step_s", step, MOST_CONTROL_STEPS),
            ("output_every_s", self.output_every_s, MOST_ROWS),
            ("sampling.every_s", self.sampling.every_s, MOST_ROWS),
        ):
            count = self.duration_days * 86400.0 / every
            if count > most:
                raise ValueError(
                    f"{key} = {every:g}: makes {count:.3g} steps of duration_days = {self.duration_days:g}; at most "
                    f"{most:g} are flown"
                )
        longest = (LONGEST_LATENCY - 1) * step
        for key in ("attitude_latency_s", "pressure_latency_s"):
            late = getattr(self.sensors, key)
            if late > longest:
                raise ValueError(
                    f"sensors.{key} = {late:g}: must be {longest:g} or less, {LONGEST_LATENCY - 1} control steps"
                )
