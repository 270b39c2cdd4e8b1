"""The instruments at the coordinator's own serial ports: compass, GPS and radio."""

from collections.abc import Mapping

from stommel.control.commands import Commands
from stommel.instruments.gnss.driver import GnssDriver, GnssState
from stommel.instruments.gnss.fix import Fix
from stommel.instruments.radio import Radio
from stommel.instruments.tcm.driver import CompassDriver
from stommel.onboard.coordination.compass.calibration import running_bits
from stommel.onboard.coordination.compass.compensation import CompassCompensation
from stommel.onboard.coordination.perception import SILENT_AFTER, Perception
from stommel.onboard.coordination.power import PowerSchedule
from stommel.onboard.coordination.settings import CoordinatorSettings

COMPASS, GNSS, RADIO = "compass", "gnss", "radio"
PORTS = (COMPASS, GNSS, RADIO)
"""Serial ports of the coordinator."""

GPS_PATIENCE = 10.0
"""Time after switching on in which a receiver need not say anything [s]."""
ANSWERS_WITHIN = 1.0
"""So long before a decision a compass that rests is asked [s]: its reading has come by then."""

_SPEAKS = (GnssState.SEARCHING, GnssState.FIXED, GnssState.REFUSED)


class OwnInstruments:
    """Drivers, and what perception learns from them.

    Parameters
    ----------
    settings
        Of the coordinator.
    seen
        Where readings go.
    """

    def __init__(self, settings: CoordinatorSettings, seen: Perception) -> None:
        self.compass, self.gnss, self.radio = CompassDriver(settings.compass), GnssDriver(settings.gnss), Radio()
        self._compensation = CompassCompensation(settings.calibration, settings.masking, settings.declination)
        self._schedule: PowerSchedule = settings.schedule
        self._seen = seen
        self.fix: Fix | None = None
        """The last position by GPS that was believed."""
        self._fix_sigma: float | None = None

    def hear(self, t: float, bytes_in: Mapping[str, bytes], phase: int) -> None:
        """Make readings of what has come to the ports in a phase of the dive."""
        self._hear_compass(t, bytes_in.get(COMPASS, b""), phase)
        seen = self._seen
        if bytes_in.get(GNSS):
            depth = seen.value("Depth", "depth", float("nan"))
            for outcome in self.gnss.take(bytes_in[GNSS], t, depth):
                if isinstance(outcome, Fix):
                    self.fix, self._fix_sigma = outcome, outcome.sigma
                    seen.take_fix(outcome.t - outcome.age, outcome.latitude, outcome.longitude)
        self.radio.take(bytes_in.get(RADIO, b""), t)

    def _hear_compass(self, t: float, data: bytes, phase: int) -> None:
        seen = self._seen
        drives = seen.latest.get("MotionDrives", {})
        for got in self.compass.take(data, t):
            running = running_bits(
                bool(drives.get("pump_running")), bool(drives.get("valve_open")), bool(drives.get("mass_moving")),
                bool(drives.get("steering_moving")),
            )  # fmt: skip
            estimate = self._compensation.update(got.t, got.acceleration, got.magnetic_field, running)
            attitude = seen.attitude
            attitude.at, attitude.theta, attitude.psi = t, estimate.pitch, estimate.heading
            attitude.down_b2, attitude.down_b3 = estimate.down_b2, estimate.down_b3
            attitude.gravity, attitude.field = _length(got.acceleration), _length(got.magnetic_field)
            # until the next reading, which may be asked for in another phase
            seen.compass_patience = SILENT_AFTER + self.compass_every(phase) - 1.0

    def take_fix_sigma(self) -> float | None:
        """Return how far the last new position may be wrong [m], once; None if there is none or it does not say."""
        sigma, self._fix_sigma = self._fix_sigma, None
        return sigma

    def compass_every(self, phase: int) -> float:
        """Time between two readings of the compass in a phase of the dive [s], a second at least."""
        rests, schedule = self._schedule.compass_rests[phase], self._schedule
        return max(1.0, self.compass.interval, schedule.decide[phase] if rests else 0.0)

    def gps_silent(self, since: float, t: float) -> bool:
        """Whether a receiver that was switched on at a time says nothing [s]; looking for a position is no silence."""
        return t - since > GPS_PATIENCE and self.gnss.health(t).state not in _SPEAKS

    def ask(self, t: float, commands: Commands, phase: int, next_decision: float) -> dict[str, bytes]:
        """Return bytes to the instruments; those without power are not asked, nor a compass that rests."""
        asked = not self._schedule.compass_rests[phase] or next_decision - t <= ANSWERS_WITHIN + 1e-6
        out = {COMPASS: self.compass.poll(t, asked=asked)}
        if commands.radio:
            if self._schedule.gps[phase]:
                out[GNSS] = self.gnss.poll(t)
            out[RADIO] = self.radio.poll(t)
        return out


def _length(vector: tuple[float, float, float]) -> float:
    x, y, z = vector
    return float((x * x + y * y + z * z) ** 0.5)
