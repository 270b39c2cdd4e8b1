"""Pictures of a mission, read back: each artist holds the variable that its title and label name.

Every variable is filled with numbers of its own first, so that no two can be mistaken. The expectation is the Dataset.
"""

from typing import Any

import numpy as np
import pytest
import xarray as xr

from stommel.control.dive_cycle import DESCENT, PHASES
from stommel.simulation.pictures import actuators_figure, ctd_figure, energy_figure, sawtooth_figure, trial_figure
from stommel.simulation.results.dataset import dataset_of
from tests.simulation.conftest import flown

FILLED = (
    "roll", "pitch", "measured_pitch", "ballast_volume", "moving_mass_position", "rudder_angle", "roll_mass_angle",
    "surge", "sway", "heave", "measured_depth", "temperature", "salinity",
)  # fmt: skip


@pytest.fixture(scope="module")
def six_dives() -> xr.Dataset:
    """Six dives or more, every variable with its own random numbers; headings about north."""
    dives = {"depth_m": 25.0, "pitch_deg": 35.0, "speed_m_s": 0.35}
    dataset = dataset_of(
        flown(dives=dives, duration_days=0.12, surface={"session_s": 60.0}, sensors={"first_fix_s": 20.0})
    )
    draw, count = np.random.default_rng(3), dataset.sizes["time"]
    dataset = dataset.assign(
        {name: ("time", draw.uniform(10.0 * k + 1.0, 10.0 * k + 9.0, count), dataset[name].attrs)
         for k, name in enumerate(FILLED)}
    )  # fmt: skip
    heading = np.mod(draw.uniform(-30.0, 20.0, count), 360.0)
    return dataset.assign(
        heading=("time", heading, dataset["heading"].attrs),
        measured_heading=("time", np.mod(heading + draw.uniform(-3.0, 3.0, count), 360.0), {}),
        bottom_depth=("time", draw.uniform(26.0, 40.0, count), {}),
        rudder_angle=dataset["rudder_angle"],
        roll_mass_angle=("time", np.zeros(count), {}),
    )


@pytest.fixture(scope="module")
def shown(six_dives: xr.Dataset) -> xr.Dataset:
    """The first four dives, to the begin of the fifth."""
    plain = six_dives["event_reason"].values == 0
    begins = six_dives["event_time"].values[plain & (six_dives["event_phase"].values == DESCENT)]
    assert len(begins) >= 6
    part = six_dives.isel(time=six_dives["time"].values <= begins[4])
    assert 10 < part.sizes["time"] < six_dives.sizes["time"]
    return part


def minutes(dataset: xr.Dataset) -> Any:
    return (dataset["time"].values - dataset["time"].values[0]) / np.timedelta64(1, "s") / 60.0


def titled(figure: Any, begin: str) -> Any:
    (axes,) = (axes for axes in figure.axes if axes.get_title(loc="left").startswith(begin))
    return axes


def labelled(axes: Any, label: str) -> tuple[Any, Any]:
    (line,) = (line for line in axes.get_lines() if line.get_label() == label)
    return np.asarray(line.get_xdata(), float), np.asarray(line.get_ydata(), float)


def about_north(angles: Any) -> Any:
    return (np.asarray(angles, float) + 180.0) % 360.0 - 180.0


def test_trial_draws_bladder_attitude_and_path_of_the_first_dives(six_dives: xr.Dataset, shown: xr.Dataset) -> None:
    figure = trial_figure(six_dives)
    volume, attitude, path = figure.axes
    assert volume.get_title(loc="left") == "Varied volume of the bladder [ml]"
    (line,) = volume.get_lines()
    assert volume.get_xlabel() == "Time [min]"
    np.testing.assert_allclose(line.get_xdata(), minutes(shown))
    np.testing.assert_array_equal(line.get_ydata(), shown["ballast_volume"].values)
    angles = {
        "pitch, measured": shown["measured_pitch"].values,
        "roll, true": shown["roll"].values,
        "heading, measured": about_north(shown["measured_heading"].values),
        "heading, true": about_north(shown["heading"].values),
    }
    assert len(attitude.get_lines()) == len(angles)
    for label, expected in angles.items():
        x, y = labelled(attitude, label)
        np.testing.assert_allclose(x, minutes(shown))
        np.testing.assert_allclose(y, expected, err_msg=label)
    assert path.get_title(loc="left") == "Path: depth [m] over the way"
    depth = path.get_lines()[0]
    np.testing.assert_array_equal(depth.get_ydata(), shown["depth"].values)
    np.testing.assert_array_equal(labelled(path, "bottom")[1], shown["bottom_depth"].values)
    low, high = path.get_ylim()
    assert low > high  # down is down
    # the way, on a sphere's degrees at 18 N (WGS 84)
    north, east = np.diff(shown["latitude"].values) * 110_680.4, np.diff(shown["longitude"].values) * 105_904.9
    way = np.concatenate([[0.0], np.cumsum(np.hypot(north, east))])
    scale = {"m": 1.0, "km": 1e3}[path.get_xlabel().split("[")[1].rstrip("]")]
    np.testing.assert_allclose(np.asarray(depth.get_xdata()) * scale, way, rtol=1e-4, atol=1e-3)


def test_trial_leaves_out_a_bottom_that_is_far(six_dives: xr.Dataset) -> None:
    far = six_dives.assign(bottom_depth=six_dives["bottom_depth"] + 1000.0)
    assert len(trial_figure(far).axes[2].get_lines()) == 1


@pytest.mark.parametrize("by_mass", [False, True])
def test_actuators_draws_each_in_its_panel(six_dives: xr.Dataset, shown: xr.Dataset, by_mass: bool) -> None:
    whole, part = six_dives, shown
    if by_mass:
        rolled = np.random.default_rng(4).uniform(-30.0, 30.0, six_dives.sizes["time"])
        whole = six_dives.assign(roll_mass_angle=("time", rolled, {}))
        part = whole.isel(time=slice(0, shown.sizes["time"]))
    figure = actuators_figure(whole)
    panels = {
        "Depth [m]": part["depth"].values,
        "Ballast volume [ml]": part["ballast_volume"].values,
        "Moving mass [mm]": 1e3 * part["moving_mass_position"].values,
        "Pitch [deg]": part["pitch"].values,
        "Roll angle of the mass [deg]" if by_mass else "Rudder [deg]": part[
            "roll_mass_angle" if by_mass else "rudder_angle"
        ].values,
        "Heading [deg]": about_north(part["heading"].values),
    }
    assert [axes.get_title(loc="left") for axes in figure.axes] == list(panels)
    for title, expected in panels.items():
        axes = titled(figure, title)
        (line,) = (one for one in axes.get_lines() if one.get_gid())
        np.testing.assert_allclose(line.get_xdata(), minutes(part))
        np.testing.assert_allclose(line.get_ydata(), expected, err_msg=title)
    assert figure.axes[0].yaxis_inverted()
    assert not any(axes.yaxis_inverted() for axes in figure.axes[1:])
    assert figure.axes[-1].get_xlabel().startswith("Time [min]; behind: ")
    assert figure.axes[0].get_xlim() == pytest.approx((0.0, minutes(part)[-1]))


WORDS = {
    "surface": "blue", "recovery": "blue", "descent": "white", "inflection": "orange", "ascent": "grey",
}  # fmt: skip
"""As the axis below the picture says."""


def colour_in_words(colour: tuple[float, float, float]) -> str:
    red, green, blue = colour
    if min(colour) == 1.0:
        return "white"
    if max(colour) - min(colour) < 0.02:
        return "grey"
    return {red: "orange", green: "green", blue: "blue"}[max(colour)]


def test_phases_are_shaded_where_they_are(six_dives: xr.Dataset, shown: xr.Dataset) -> None:
    """In the middle of every row the colour behind is that of its phase, as the words below the picture call it."""
    from matplotlib.colors import to_rgb

    figure = actuators_figure(six_dives)
    told = figure.axes[-1].get_xlabel().split("behind: ")[1]
    assert told == "at the surface blue, descent white, inflection orange, ascent grey"
    patches = figure.axes[1].patches
    spans = [(one.get_x(), one.get_x() + one.get_width(), to_rgb(one.get_facecolor())) for one in patches]
    time, phases = minutes(shown), shown["phase"].values
    for k in range(len(time) - 1):
        middle = 0.5 * (time[k] + time[k + 1])
        (behind,) = (colour for low, high, colour in spans if low <= middle <= high)
        assert colour_in_words(behind) == WORDS[PHASES[phases[k]]], k


def test_ctd_draws_both_quantities_over_time_and_pressure(six_dives: xr.Dataset) -> None:
    from matplotlib.dates import date2num

    figure = ctd_figure(six_dives)
    panels = [axes for axes in figure.axes if axes.get_ylabel() == "Sea pressure [dbar]"]
    bars = [axes.get_ylabel() for axes in figure.axes if axes not in panels]
    assert bars == ["Temperature [°C]", "Practical salinity"]
    when = date2num(six_dives["sample_time"].values)
    for axes, name in zip(panels, ("sample_temperature", "sample_practical_salinity"), strict=True):
        (dots,) = axes.collections
        np.testing.assert_array_equal(dots.get_array(), six_dives[name].values)
        np.testing.assert_allclose(dots.get_offsets()[:, 0], when, atol=1e-6)
        np.testing.assert_array_equal(dots.get_offsets()[:, 1], six_dives["sample_pressure"].values)
        low, high = axes.get_ylim()
        assert low > six_dives["sample_pressure"].values.max()
        assert high == 0.0
        least, most = dots.get_clim()
        inside = np.mean((six_dives[name].values >= least) & (six_dives[name].values <= most))
        assert inside > 0.98


def test_many_samples_are_drawn_as_their_means(six_dives: xr.Dataset) -> None:
    count = 20_000
    time = six_dives["time"].values[0] + (np.linspace(0.0, 9000.0, count) * 1e9).astype("timedelta64[ns]")
    pressure = 50.0 + 50.0 * np.sin(np.linspace(0.0, 60.0, count))
    many = xr.Dataset(
        {
            "sample_time": ("sample", time),
            "sample_pressure": ("sample", pressure),
            "sample_temperature": ("sample", 20.0 - 0.1 * pressure),
            "sample_practical_salinity": ("sample", 34.0 + 0.01 * pressure),
        },
        coords={"time": six_dives["time"]},
        attrs=six_dives.attrs,
    )
    for axes, (at_zero, slope) in zip(ctd_figure(many).axes[:2], ((20.0, -0.1), (34.0, 0.01)), strict=True):
        (mesh,) = axes.collections
        cells = mesh.get_array()
        assert cells.shape[0] == 50
        middle = (np.arange(50) + 0.5) * pressure.max() / 50
        means = np.nanmean(np.ma.filled(cells, np.nan), axis=1)
        np.testing.assert_allclose(means, at_zero + slope * middle, atol=1.1 * abs(slope) * pressure.max() / 50)


def test_sawtooth_draws_depth_at_its_time(six_dives: xr.Dataset) -> None:
    from matplotlib.dates import date2num

    few = six_dives.isel(time=slice(0, 600), event=six_dives["event_time"].values <= six_dives["time"].values[599])
    path, bottom = sawtooth_figure(few).axes[0].get_lines()
    for line, name in ((path, "depth"), (bottom, "bottom_depth")):
        np.testing.assert_allclose(line.get_xdata(), date2num(few["time"].values), atol=1e-6)
        np.testing.assert_array_equal(line.get_ydata(), few[name].values)
    whole, part = sawtooth_figure(six_dives).axes[:2]  # of many dives the path would hide the water
    assert len(whole.get_lines()) == 1
    drawn = np.asarray(part.get_lines()[0].get_ydata())
    assert 600 < len(drawn) < six_dives.sizes["time"]
    np.testing.assert_array_equal(drawn, six_dives["depth"].values[: len(drawn)])


def test_energy_draws_the_voltage_that_was_measured(six_dives: xr.Dataset) -> None:
    axes = energy_figure(six_dives).axes
    drawn = [line.get_ydata() for panel in axes for line in panel.get_lines()]
    assert any(np.array_equal(curve, six_dives["battery_voltage"].values) for curve in drawn)
