"""The CTD; oracles: the answers of first-order lags to a ramp in closed form, gsw, the profile that was given."""

from pathlib import Path

import gsw
import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid, solve_ivp

from stommel.control.dive_cycle import PHASES
from stommel.simulation.flight import Flown, fly_mission
from stommel.simulation.results.ctd import samples_of
from stommel.simulation.results.dataset import dataset_of
from stommel.simulation.scenario.loading import mission_from
from stommel.simulation.scenario.world_tables import Ctd
from tests.simulation.conftest import EXACT, Document, column, flown, mission_document, sampled, stays

IDEAL: Document = {
    "temperature_noise_c": 0.0,
    "conductivity_noise_s_m": 0.0,
    "pressure_noise_dbar": 0.0,
    "temperature_lag_s": 0.0,
    "cell_share": 0.0,
}
"""No noise, no lags."""

EVERY_SECOND = {"every_s": 1.0}
RAMP = "depth_m,temperature_c,salinity_psu\n0,25,33\n200,5,35\n"
STEP = "depth_m,temperature_c,salinity_psu\n0,25,34\n48,25,34\n52,12,34\n200,12,34\n"


def cast(folder: Path, profile: str, **changes: object) -> Flown:
    """Dives through a profile, everything recorded each second."""
    (folder / "profile.csv").write_text(profile)
    document = mission_document(
        ocean={"file": "profile.csv", "parameters": {"latitude_deg": 18.0, "longitude_deg": 116.0}},
        dives={"depth_m": 150.0, "pitch_deg": 35.0, "speed_m_s": 0.35},
        sensors=EXACT, sampling=EVERY_SECOND, output_every_s=1.0, duration_days=0.03,
    )  # fmt: skip
    return fly_mission(mission_from(document | changes, "test.toml", folder))


def within(found: Flown, phase: str, after: float) -> np.ndarray:
    """Samples from so long after the first such phase began until it ends."""
    begin, end = stays(found, phase)[0]
    t = sampled(found, "time")
    return np.asarray((t > begin + after) & (t < end - 2.0))


@pytest.fixture(scope="module")
def ideal(tmp_path_factory: pytest.TempPathFactory) -> Flown:
    return cast(tmp_path_factory.mktemp("ideal"), RAMP, ctd=IDEAL)


def water_at_samples(found: Flown) -> np.ndarray:
    """True temperature at each sample, from the record of the same moments."""
    return np.interp(sampled(found, "time"), column(found, "time"), column(found, "temperature"))


def rate_ago(found: Flown, seconds: float) -> np.ndarray:
    """dT/dt of the water around the vehicle so long ago [K/s]."""
    t = sampled(found, "time")
    return np.interp(t - seconds, t, np.gradient(water_at_samples(found), t))


@pytest.mark.parametrize("lag", [0.3, 2.0, 10.0])
@pytest.mark.parametrize("phase", ["descent", "ascent"])
def test_thermistor_lags_by_its_time_constant(lag: float, phase: str, tmp_path: Path) -> None:
    """Ramp: T - T_thermistor settles at tau dT/dt, also where tau is shorter than a control step.

    The vehicle does not sink quite evenly; to first order the rate is the one of tau ago.
    """
    found = cast(tmp_path, RAMP, ctd=IDEAL | {"temperature_lag_s": lag})
    steady = within(found, phase, 300.0)
    rate = rate_ago(found, lag)
    behind = water_at_samples(found) - sampled(found, "thermistor")
    assert np.abs(rate[steady]).min() > 0.01
    np.testing.assert_allclose(behind[steady], lag * rate[steady], rtol=0.01)


@pytest.mark.parametrize("phase", ["descent", "ascent"])
def test_cell_s_walls_answer_as_lueck_and_picklo(phase: str, tmp_path: Path) -> None:
    """Ramp: the error settles at alpha tau dT/dt, after 1 - exp(-t / tau)."""
    share, lag = 0.03, 40.0
    found = cast(tmp_path, RAMP, ctd=IDEAL | {"cell_share": share, "cell_lag_s": lag})
    steady = within(found, phase, 300.0)
    rate = rate_ago(found, lag)
    error = water_at_samples(found) - sampled(found, "cell")
    np.testing.assert_allclose(error[steady], share * lag * rate[steady], rtol=0.02)
    assert (np.sign(error[steady]) == (-1.0 if phase == "descent" else 1.0)).all()  # walls warm going down


def test_cell_s_walls_follow_their_equation_through_a_thermocline(tmp_path: Path) -> None:
    """e' = alpha dT/dt - e / tau, solved anew by a general method."""
    share, lag = 0.03, 12.0
    found = cast(tmp_path, STEP, ctd=IDEAL | {"cell_share": share, "cell_lag_s": lag})
    begin, end = stays(found, "descent")[0]
    t = sampled(found, "time")
    dive = (t >= begin) & (t < end)
    t, water = t[dive], water_at_samples(found)[dive]
    rates = np.diff(water) / np.diff(t)

    def walls(now: float, error: np.ndarray) -> np.ndarray:
        return share * rates[min(int(np.searchsorted(t, now, "right")) - 1, len(rates) - 1)] - error / lag

    expected = solve_ivp(walls, (t[0], t[-1]), [0.0], t_eval=t, max_step=0.5, rtol=1e-6, atol=1e-9).y[0]
    error = water - sampled(found, "cell")[dive]
    assert np.abs(expected).max() > 0.05
    assert np.abs(error - expected).max() < 0.01 * np.abs(expected).max()


def test_without_errors_the_ocean_s_salinity_comes_out(ideal: Flown) -> None:
    """Through pressure, temperature and conductivity and back; the profile's own practical salinity at the depth."""
    made, t = samples_of(ideal), sampled(ideal, "time")
    depth, S_A = (np.interp(t, column(ideal, "time"), column(ideal, name)) for name in ("depth", "salinity"))
    assert np.abs(made.practical_salinity - np.interp(depth, [0.0, 200.0], [33.0, 35.0])).max() < 1e-3
    assert np.abs(made.practical_salinity - gsw.SP_from_SA(S_A, made.pressure, 116.0, 18.0)).max() < 1e-4
    np.testing.assert_allclose(made.temperature, water_at_samples(ideal), atol=1e-9)


def test_pressure_is_the_weight_of_the_water(ideal: Flown) -> None:
    begin, end = stays(ideal, "descent")[0]
    t = column(ideal, "time")
    dive = (t >= begin) & (t < end)
    weight = cumulative_trapezoid(column(ideal, "density")[dive] * gsw.grav(18.0, 0.0), column(ideal, "depth")[dive])
    made = samples_of(ideal).pressure[(sampled(ideal, "time") >= begin) & (sampled(ideal, "time") < end)]
    assert made.max() > 140.0
    np.testing.assert_allclose(made[1:], 1e-4 * weight, rtol=1e-3, atol=1e-3)


@pytest.mark.parametrize(
    ("lags", "on_the_way_down"),
    [({"temperature_lag_s": 1.5}, -1.0), ({"cell_share": 0.05, "cell_lag_s": 10.0}, 1.0)],
    ids=["thermistor", "cell"],
)
def test_salinity_spikes_at_a_thermocline(lags: Document, on_the_way_down: float, tmp_path: Path) -> None:
    """A slow thermistor tells fresher water going down into the cold, slow walls saltier; coming up the other way."""
    found = cast(tmp_path, STEP, ctd=IDEAL | lags)
    error = samples_of(found).practical_salinity - 34.0
    for phase, sign in (("descent", on_the_way_down), ("ascent", -on_the_way_down)):
        leg = within(found, phase, 0.0)
        spike = error[leg][np.argmax(np.abs(error[leg]))]
        assert np.sign(spike) == sign
        assert abs(spike) > 0.05
    # away from the thermocline nothing is left
    depth = np.interp(sampled(found, "time"), column(found, "time"), column(found, "depth"))
    assert np.abs(error[within(found, "descent", 0.0) & (depth > 110.0)]).max() < 5e-3


def test_noise_has_its_standard_deviation() -> None:
    noise = {"temperature_noise_c": 0.02, "conductivity_noise_s_m": 0.003, "pressure_noise_dbar": 0.5}
    noisy, clean = (flown(ctd=IDEAL | errors, sampling=EVERY_SECOND) for errors in (noise, {}))
    for name, key in (("temperature", "temperature_noise_c"), ("conductivity", "conductivity_noise_s_m"),
                      ("pressure", "pressure_noise_dbar")):  # fmt: skip
        error = getattr(samples_of(noisy), name) - getattr(samples_of(clean), name)
        assert np.std(error) == pytest.approx(noise[key], rel=0.05)
        assert abs(np.mean(error)) < 4.0 * noise[key] / np.sqrt(len(error))


@pytest.mark.parametrize("phases", [("ascent",), ("descent",), ("descent", "inflection", "ascent")])
@pytest.mark.parametrize("every", [4.0, 30.0])
def test_samples_are_taken_when_they_should(phases: tuple[str, ...], every: float) -> None:
    found = flown(sampling={"every_s": every, "phases": phases}, duration_days=0.1)
    t = sampled(found, "time")
    expected = sum(
        int(np.ceil(end / every) - np.ceil(begin / every)) for phase in phases for begin, end in stays(found, phase)
    )
    assert {PHASES[int(phase)] for phase in np.unique(sampled(found, "phase"))} <= set(phases)
    assert (np.mod(t, every) == 0.0).all()
    last = events_end(found)
    assert np.sum(t < last) == expected


def events_end(found: Flown) -> float:
    """When the last completed phase ended."""
    return float(found.events["time"][-1])


def test_sampling_on_the_ascent_alone_saves_the_ctd_s_energy() -> None:
    """0.175 W behind a regulator of 0.85, for as long as it does not run."""
    both, up = (
        flown(sampling={"phases": phases}, sensors=EXACT)
        for phases in (("descent", "inflection", "ascent"), ("ascent",))
    )
    np.testing.assert_array_equal(both.events, up.events)
    t, phase = column(both, "time"), column(both, "phase")
    idle = float(np.isin(phase, [PHASES.index(name) for name in ("descent", "inflection")]).sum()) * (t[1] - t[0])
    saved = column(both, "energy_sensors")[-1] - column(up, "energy_sensors")[-1]
    assert saved == pytest.approx(0.175 / 0.85 * idle, rel=0.01)
    for name in ("pump", "controller", "navigation"):
        assert column(both, f"energy_{name}")[-1] == column(up, f"energy_{name}")[-1]


def test_cell_goes_by_its_flow_as_morison_found() -> None:
    """The two ends of their table: SBE 9 at 1.75 m/s has alpha 0.0286 and tau 9.26 s by their fit; slower is worse."""
    fast, slow = Ctd(cell_flow_m_s=1.75), Ctd(cell_flow_m_s=0.25)
    assert (fast.thermal_share, fast.thermal_lag_s) == pytest.approx((0.02859, 9.2558), rel=1e-3)
    assert (slow.thermal_share, slow.thermal_lag_s) == pytest.approx((0.1191, 12.7215), rel=1e-3)
    stated = Ctd(cell_flow_m_s=1.75, cell_share=0.04, cell_lag_s=8.0)
    assert (stated.thermal_share, stated.thermal_lag_s) == (0.04, 8.0)


def test_cell_left_to_its_flow_settles_where_morison_s_numbers_say(tmp_path: Path) -> None:
    """Ramp: the error settles at alpha tau dT/dt with both from the flow, 0.0663 and 11.04 s at 0.5 m/s."""
    found = cast(tmp_path, RAMP, ctd={key: value for key, value in IDEAL.items() if key != "cell_share"}
                 | {"cell_flow_m_s": 0.5})  # fmt: skip
    share, lag = 0.0264 / 0.5 + 0.0135, 2.7858 / np.sqrt(0.5) + 7.1499
    steady = within(found, "descent", 150.0)
    error = water_at_samples(found) - sampled(found, "cell")
    np.testing.assert_allclose(error[steady], share * lag * rate_ago(found, lag)[steady], rtol=0.02)


def test_samples_carry_the_number_of_their_profile() -> None:
    """By the depth alone: each odd profile only sinks, each even one only rises, in the order of time without gaps."""
    found = flown(sensors=EXACT, dives={"depth_m": 60.0, "pitch_deg": 35.0, "speed_m_s": 0.35, "per_surfacing": 2},
                  duration_days=0.1)  # fmt: skip
    data = dataset_of(found)
    number, pressure = data["sample_profile"].values, data["sample_pressure"].values
    profiles = [int(n) for n in dict.fromkeys(number[number > 0])]
    assert profiles == list(range(1, len(profiles) + 1))
    assert len(profiles) >= 4
    for n in profiles[:-1]:
        steps = np.diff(pressure[number == n])[5:]  # an ascent begins while the vehicle still sinks
        assert ((steps > -0.3) if n % 2 else (steps < 0.3)).all()
        assert abs(pressure[number == n][-1] - pressure[number == n][0]) > 30.0
