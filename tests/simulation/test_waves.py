"""Waves over the antenna: the JONSWAP spectrum, fixes that come late or never, and what the software makes of it."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from stommel.simulation.flight import Flown
from stommel.simulation.plant.waves import heave_period, jonswap, not_followed, waves_of
from tests.simulation.conftest import QUIET, Document, flown, made, mission_document, stays, surfaced

HEIGHT, PERIOD = 3.0, 8.0


@pytest.fixture(scope="module")
def components() -> tuple[np.ndarray, np.ndarray]:
    """Amplitudes of the sea itself [m], and angular frequencies; what the hull does not follow is taken out."""
    sea: Document = {"significant_height_m": HEIGHT, "peak_period_s": PERIOD}
    mission = made(mission_document(waves=sea))
    waves = waves_of(mission)
    return waves.amplitude / not_followed(waves.omega, heave_period(mission)), waves.omega


def test_significant_height_is_four_standard_deviations(components: tuple[np.ndarray, np.ndarray]) -> None:
    """Of the sum of cosines over a long time."""
    amplitude, omega = components
    t = np.arange(0.0, 200_000.0, 1.0)
    elevation = sum(a * np.cos(w * t + 1.7 * k) for k, (a, w) in enumerate(zip(amplitude, omega, strict=True)))
    assert 4.0 * np.std(elevation) == pytest.approx(HEIGHT, rel=0.01)


def test_energy_peaks_at_the_peak_period(components: tuple[np.ndarray, np.ndarray]) -> None:
    amplitude, omega = components
    assert 2.0 * np.pi / omega[np.argmax(amplitude)] == pytest.approx(PERIOD, rel=0.1)
    # half of the energy lies between the peak and 1.5 times its frequency, hardly any below 0.8 of it
    energy = amplitude**2 / np.sum(amplitude**2)
    assert energy[omega < 0.8 * 2.0 * np.pi / PERIOD].sum() < 0.05


def test_spectrum_is_jonswap() -> None:
    """Hasselmann et al. (1973): 3.3 times Pierson and Moskowitz's at the peak, the same far from it."""
    peak, omega = 0.8, np.linspace(0.4, 4.0, 20_001)
    found = jonswap(omega, peak)
    plain = omega**-5.0 * np.exp(-1.25 * (peak / omega) ** 4)
    assert omega[np.argmax(found)] == pytest.approx(peak, rel=1e-3)
    assert jonswap(np.array([peak]), peak)[0] / (peak**-5.0 * np.exp(-1.25)) == pytest.approx(3.3)
    assert found[-1] / plain[-1] == pytest.approx(1.0, abs=1e-6)


def test_hull_follows_long_waves_and_not_short_ones() -> None:
    period = 3.0
    long, resonant, short = not_followed(2.0 * np.pi / np.array([60.0, 3.0, 0.3]), period)
    assert long < 0.03
    assert resonant > 2.0
    assert short == pytest.approx(1.0, abs=0.05)


def test_calm_sea_is_as_without_waves(quarter_day: Flown) -> None:
    calm = flown(waves={"significant_height_m": 0.0, "peak_period_s": 12.0})
    np.testing.assert_array_equal(calm.record, quarter_day.record)


SHALLOW = {"depth_m": 30.0, "pitch_deg": 35.0, "speed_m_s": 0.35}
PATIENT = {"session_s": 140.0, "longest_s": 900.0}


def lengths(found: Flown) -> list[float]:
    return [end - begin for begin, end in stays(found, "surface")]


def test_first_position_comes_later_in_a_high_sea() -> None:
    """In calm water it leaves after its session; in a high sea it takes longer until the antenna was dry for 100 s."""
    calm, rough = (
        flown(dives=SHALLOW, surface=PATIENT, sensors={"first_fix_s": 100.0}, waves={"significant_height_m": height})
        for height in (0.0, 15.0)
    )
    assert set(lengths(calm)) == {140.0}
    assert min(lengths(rough)) > 150.0
    assert max(lengths(rough)) < 900.0
    assert len(rough.surfacings) == len(lengths(rough)) - 1  # every stay but the first tells of a dive


def test_drowned_antenna_waits_its_longest_and_dives_without() -> None:
    """Nose up the antenna at the tail is under water: no position ever, and no current."""
    surface = {"session_s": 60.0, "longest_s": 600.0, "pitch_deg": 45.0}
    found = flown(dives=SHALLOW, surface=surface, sensors={"first_fix_s": 55.0})
    assert set(lengths(found)) == {600.0}
    assert len(lengths(found)) > 5
    assert len(found.surfacings) == 0


EAST, NORTH = 0.15, -0.08


@pytest.fixture(scope="module")
def sometimes() -> Flown:
    """A sea in which every other stay or so ends without a position, in a current."""
    return flown(
        ocean={"name": "uniform", "parameters": {"current_east_m_s": EAST, "current_north_m_s": NORTH}},
        dives={"depth_m": 150.0, "pitch_deg": 35.0, "speed_m_s": 0.35},
        surface={"session_s": 100.0, "longest_s": 110.0},
        sensors=QUIET | {"first_fix_s": 66.0},
        waves={"significant_height_m": 0.5},
        duration_days=1.0,
    )


def test_current_after_dives_without_position_spans_them_all(sometimes: Flown) -> None:
    """Two dives and the drift between them: the current comes out as from one dive."""
    dives = len(stays(sometimes, "surface")) - 1
    told = surfaced(sometimes, "submerged")
    assert 3 < len(told) < dives - 2  # some stays gave a position, some did not
    one = np.median(np.diff([begin for begin, _ in stays(sometimes, "descent")])) - 110.0
    assert (told > 1.8 * one).sum() >= 3
    miss = np.hypot(surfaced(sometimes, "current_north") - NORTH, surfaced(sometimes, "current_east") - EAST)
    # the first time nothing is known of the drift at the surface, 110 s of it beside the time under water
    assert miss[0] < 110.0 / one * np.hypot(EAST, NORTH)
    assert miss[1:].max() < 0.01 * np.hypot(EAST, NORTH)


def test_reckoning_goes_on_without_a_position(sometimes: Flown) -> None:
    """Once the current is known, the error stays small also over several dives: drift at the surface is reckoned."""
    assert surfaced(sometimes, "reckoning_error")[2:].max() < 20.0


@pytest.mark.parametrize("peak", [0.5, 1.3])
def test_peak_is_steeper_below_than_above(peak: float) -> None:
    """Hasselmann et al. (1973): widths of 0.07 and 0.09 of the peak; one width away, 3.3 to the power exp(-1/2)."""
    for side, width in ((-1.0, 0.07), (1.0, 0.09)):
        for widths in (0.5, 1.0, 2.0):
            omega = np.array([peak * (1.0 + side * widths * width)])
            plain = omega**-5.0 * np.exp(-1.25 * (peak / omega) ** 4)
            expected = 3.3 ** np.exp(-0.5 * widths**2)
            assert jonswap(omega, peak) / plain == pytest.approx(expected, rel=1e-9)


def test_hull_answers_waves_as_a_damped_oscillator() -> None:
    """y'' + 2 zeta w y' + w2 (y - elevation) = 0, solved in time until the start is forgotten."""
    period, damping = 3.0, 0.2
    own = 2.0 * np.pi / period
    for wave in (12.0, 4.0, 3.0, 1.5):
        omega = 2.0 * np.pi / wave

        def rates(t: float, y: np.ndarray, omega: float = omega) -> list[float]:
            return [y[1], own**2 * (np.cos(omega * t) - y[0]) - 2.0 * damping * own * y[1]]

        t = np.linspace(40.0 * period, 40.0 * period + 4.0 * wave, 2000)
        heave = solve_ivp(rates, (0.0, t[-1]), [0.0, 0.0], t_eval=t, rtol=1e-8, atol=1e-10).y[0]
        along = np.abs(np.cos(omega * t) - heave).max()
        assert not_followed(np.array([omega]), period)[0] == pytest.approx(along, rel=2e-3)
