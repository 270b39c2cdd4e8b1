"""What a table of holds says about a hull: loss and rate of each hold, the leak that would explain it, pass or fail."""

from dataclasses import dataclass
from math import exp, log

import numpy as np

from stommel.bench.holding_cycles import Hold, PressureTest


@dataclass(frozen=True)
class HoldResult:
    """One hold judged."""

    hold: Hold
    rate: float
    """Pressure lost per time [Pa/s]."""
    leak: float | None
    """Water that would have to enter the hull per time to lose the pressure [m3/s]; None without a chamber."""
    cooling: float | None
    """Cooling of the water that would lose as much pressure [K]; None without a chamber."""
    too_much: bool
    """The loss reaches the limit."""
    too_low: bool
    """The pressure does not stay above the limit."""

    @property
    def passed(self) -> bool:
        """Within both limits."""
        return not self.too_much and not self.too_low

    def as_row(self) -> dict[str, object]:
        """Words and units for JSON and tables."""
        h = self.hold
        return {
            "hold": h.name,
            "from": _clock(h.begin),
            "to": _clock(h.end),
            "across_midnight": h.begin // 86400 != h.end // 86400,
            "duration_hours": h.duration / 3600,
            "begin_pressure_mpa": h.begin_pressure / 1e6,
            "end_pressure_mpa": h.end_pressure / 1e6,
            "loss_mpa": h.loss / 1e6,
            "rate_mpa_per_h": self.rate * 3600 / 1e6,
            "leak_ml_per_h": None if self.leak is None else self.leak * 3600 * 1e6,
            "equivalent_cooling_k": self.cooling,
            "passed": self.passed,
        }


@dataclass(frozen=True)
class Settling:
    """How the rate of loss changes from hold to hold: a leak stays, settling dies out."""

    ratio_per_hour: float
    """Factor by which the rate changes in an hour under pressure."""
    low: float
    """Lower end of its 95 % interval."""
    high: float
    """Upper end."""

    @property
    def verdict(self) -> str:
        """Say what the interval allows."""
        span = (
            f"a factor of {self.ratio_per_hour:.2f} per hour under pressure (95 %: {self.low:.2f} to {self.high:.2f})"
        )
        if self.high < 1.0:
            return f"the rate of loss falls by {span}: chamber and hull settle, as the paper says; a leak would stay"
        if self.low > 1.0:
            return f"the rate of loss grows by {span}: a leak that opens"
        return f"the rate of loss changes by {span}: too few holds to tell a leak from settling"


@dataclass(frozen=True)
class PressureReport:
    """A pressure test judged."""

    test: PressureTest
    results: tuple[HoldResult, ...]
    settling: Settling | None
    """None with fewer than four holds, or one without loss."""

    @property
    def passed(self) -> bool:
        """Every hold is within its limits."""
        return all(result.passed for result in self.results)

    def failures(self) -> list[str]:
        """Say which hold fails which limit."""
        limits, found = self.test.description.limits, []
        for result in self.results:
            h = result.hold
            if result.too_much:
                found.append(
                    f"hold {h.name} loses {h.loss / 1e6:.3f} MPa; less than {limits.largest_loss_mpa:g} is allowed"
                )
            if result.too_low:
                found.append(
                    f"hold {h.name} falls to {h.end_pressure / 1e6:.3f} MPa; it must stay above "
                    f"{limits.lowest_pressure_mpa:g}"
                )
        return found

    def notes(self) -> list[str]:
        """What to know when reading the numbers."""
        found = []
        chamber = self.test.description.chamber
        if chamber is None:
            found.append("no leak rate: the description declares no [chamber]")
        else:
            assumed = [key for key, origin in self.test.provenance.items() if origin.kind == "assumption"]
            found.append(
                "the leak rate takes the whole loss for water that enters the hull: an upper bound, "
                "because settling and cooling lose pressure too"
            )
            if assumed:
                found.append(f"assumed, not measured: {', '.join(assumed)}")
        if self.settling is not None:
            found.append(self.settling.verdict)
        return found

    def as_json(self) -> dict[str, object]:
        """Everything, in words and units."""
        description = self.test.description
        chamber = description.chamber
        return {
            "title": description.title,
            "file": self.test.file,
            "source": list(self.test.comments),
            "passed": self.passed,
            "failures": self.failures(),
            "limits": {
                "largest_loss_mpa": description.limits.largest_loss_mpa,
                "lowest_pressure_mpa": description.limits.lowest_pressure_mpa,
            },
            "compliance_ml_per_mpa": None if chamber is None else chamber.compliance_m3_pa * 1e12,
            "holds": [result.as_row() for result in self.results],
            "rate_ratio_per_hour": None if self.settling is None else self.settling.ratio_per_hour,
            "rate_ratio_95": None if self.settling is None else [self.settling.low, self.settling.high],
            "notes": self.notes(),
        }


def judge(test: PressureTest) -> PressureReport:
    """Judge every hold of a pressure test against its limits."""
    limits, chamber = test.description.limits, test.description.chamber
    results = []
    for hold in test.holds:
        rate = hold.loss / hold.duration
        leak = cooling = None
        if chamber is not None:
            C = chamber.compliance_m3_pa
            leak = C * rate
            cooling = C * hold.loss / (chamber.water_thermal_expansion_per_k * chamber.water_volume_m3)
        results.append(
            HoldResult(
                hold=hold,
                rate=rate,
                leak=leak,
                cooling=cooling,
                too_much=hold.loss >= limits.largest_loss_mpa * 1e6,
                too_low=hold.end_pressure <= limits.lowest_pressure_mpa * 1e6,
            )
        )
    return PressureReport(test, tuple(results), _settling(results))


def _settling(results: list[HoldResult]) -> Settling | None:
    """Fit a straight line to the logarithm of the rate against the time under pressure at the middle of each hold."""
    if len(results) < 4 or any(result.rate <= 0.0 for result in results):
        return None
    from scipy.stats import linregress, t  # noqa: PLC0415 - start-up counts

    durations = np.array([result.hold.duration for result in results]) / 3600
    middles = np.cumsum(durations) - 0.5 * durations
    line = linregress(middles, [log(result.rate) for result in results])
    half = float(t.ppf(0.975, len(results) - 2)) * float(line.stderr)
    slope = float(line.slope)
    return Settling(exp(slope), exp(slope - half), exp(slope + half))


def _clock(seconds: float) -> str:
    minutes = round(seconds / 60)
    return f"{minutes // 60 % 24:02d}:{minutes % 60:02d}"
