"""What a sweep gave at each value, what is drawn beside it, and its pictures; means are taken anew from the result."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from stommel.errors import FileError
from stommel.studies.headline import in_words
from stommel.studies.pictures import drawn_outputs, runs_figure, sensitivity_figure, sweep_figure
from stommel.studies.run import Finished, run_study
from stommel.studies.sampling import run_values
from stommel.studies.study import load_study
from stommel.studies.study_file import StudyFile
from tests.studies.conftest import UNIFORM, Write
from tests.support.command import run_here
from tests.support.terminal import tables

SWEPT = """
kind = "sweep"
runs = 3
seed = 4
outputs = ["dives", "distance_made_good_km", "mean_power_w"]
[[parameters]]
key = "mission.dives.pitch_deg"
values = [20, 40]
[[parameters]]
key = "ocean.current_east_m_s"
distribution = "normal"
mean = 0.1
standard_deviation = 0.05
[[parameters]]
key = "mission.dives.depth_m"
values = [30, 40]
"""


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory) -> tuple[Finished, Path]:
    from tests.studies.conftest import MISSION

    folder = tmp_path_factory.mktemp("swept")
    (folder / "hop.toml").write_text(MISSION)
    (folder / "study.toml").write_text('name = "steeper"\nmission = "hop.toml"\n' + SWEPT)
    return run_study(load_study(folder / "study.toml"), folder / "r.nc", workers=1), folder


def test_each_combination_flies_the_same_draws(swept: tuple[Finished, Path]) -> None:
    done, _ = swept
    runs = np.array(done.study.values, float)
    assert runs.shape == (12, 3)
    assert [tuple(row) for row in runs[::3][:, [0, 2]]] == [(20, 30), (20, 40), (40, 30), (40, 40)]
    draws = runs[:, 1].reshape(4, 3)
    assert (draws == draws[0]).all()
    assert len(set(draws[0])) == 3
    assert list(done.study.names) == ["pitch_deg", "current_east_m_s", "depth_m"]


def test_result_has_draws_along_repeat(swept: tuple[Finished, Path]) -> None:
    done, folder = swept
    result = xr.load_dataset(folder / "r.nc")
    assert result["dives"].dims == ("pitch_deg", "depth_m", "repeat")
    assert result["current_east_m_s"].dims == ("repeat",)
    assert result["current_east_m_s"].values == pytest.approx([run[1] for run in done.study.values[:3]])
    assert result["current_east_m_s"].attrs["units"] == "m/s"
    # run 7 is pitch 40, depth 30, second draw
    assert float(result["mean_power_w"][1, 0, 1]) == done.outputs["mean_power_w"][7]


def test_draws_have_the_moments_of_their_distribution() -> None:
    file = StudyFile.model_validate(
        {"name": "s", "mission": "m", "kind": "sweep", "runs": 20_000, "parameters": [
            {"key": "mission.x", "values": [1, 2]},
            {"key": "mission.y", "distribution": "uniform", "from": 2.0, "to": 6.0},
        ]}
    )  # fmt: skip
    values = np.array(run_values(file), float)
    assert file.count == len(values) == 40_000
    assert values[:, 1].mean() == pytest.approx(4.0, abs=0.03)
    assert values[:, 1].std() == pytest.approx(4.0 / np.sqrt(12.0), rel=0.02)


def test_draws_are_of_the_seed() -> None:
    drawn = {"key": "mission.y", "distribution": "uniform", "from": 2.0, "to": 6.0}
    studies = [
        StudyFile.model_validate(
            {"name": "s", "mission": "m", "kind": "sweep", "runs": 4, "seed": seed,
             "parameters": [{"key": "mission.x", "values": [1]}, drawn]}
        )
        for seed in (1, 1, 2)
    ]  # fmt: skip
    one, again, other = (run_values(file) for file in studies)
    assert one == again
    assert one != other


def test_runs_that_cannot_be_flown_are_counted_out(folder: Path, write: Write) -> None:
    study = write(
        'kind = "sweep"\nruns = 2\noutputs = ["dives"]\n[[parameters]]\nkey = "mission.dives.ballast_ml"\n'
        "values = [200, 5000]\n"
    )
    done = run_study(load_study(study), folder / "f.nc", workers=1)
    flown, failed = done.combinations()
    assert (flown.flown, flown.runs, set(flown.outputs)) == (2, 2, {"dives"})
    assert (failed.flown, failed.runs, failed.outputs) == (0, 2, {})


def test_table_of_a_sweep_has_means_of_its_runs(swept: tuple[Finished, Path]) -> None:
    done, folder = swept
    result = xr.load_dataset(folder / "r.nc")
    rows = done.as_json()["combinations"]
    assert len(rows) == 4
    for row in rows:
        assert (row["runs"], row["flown"]) == (3, 3)
        for name, numbers in row["outputs"].items():
            values = result[name].sel(row["values"]).values
            assert numbers["mean"] == pytest.approx(values.mean())
            assert numbers["standard_deviation"] == pytest.approx(values.std(ddof=1))
            assert (numbers["least"], numbers["greatest"]) == (values.min(), values.max())


def test_terminal_shows_a_row_for_each_combination(swept: tuple[Finished, Path]) -> None:
    done, folder = swept
    shown = run_here(folder, "study", "study.toml", "--output", "r.nc", "--plots", "pictures")
    assert shown.status == 0, shown.err
    lines = shown.out.splitlines()
    assert max(map(len, lines)) <= 80
    begin = lines.index(next(line for line in lines if line.startswith("By pitch_deg and depth_m")))
    cells = [line.split() for line in lines[begin:] if line.split()[:1] in (["20"], ["40"])]
    combination = done.combinations()[2]
    mean, spread = combination.outputs["mean_power_w"].mean, combination.outputs["mean_power_w"].standard_deviation
    row = next(cell for cell in cells if cell[:2] == ["40", "30"])
    assert row[-3:] == [f"{mean:.4g}", "±", f"{spread:.2g}"]
    assert "mean and standard deviation over the runs of each combination" in shown.out
    assert "outputs are shown" not in shown.out  # all that were asked for
    names = {"sweep.png", "sweep.svg", "sensitivity.png", "sensitivity.svg"}
    assert {path.name for path in (folder / "pictures").iterdir()} == names
    assert all(f"wrote pictures/{name}" in shown.out for name in names)


def test_every_number_of_the_terminal_is_taken_anew_from_the_result(swept: tuple[Finished, Path]) -> None:
    _, folder = swept
    shown = run_here(folder, "study", "study.toml", "--output", "r.nc")
    assert shown.status == 0, shown.err
    result = xr.load_dataset(folder / "r.nc")
    whole, *groups = tables(shown.out)[:-1]
    assert whole.columns == ("output", "mean", "sd", "least", "greatest")
    assert {row["output"] for row in whole.rows} >= {"dives", "distance_made_good_km", "mean_power_w"}
    for row in whole.rows:
        values = result[row["output"]].values.ravel()
        told = (values.mean(), values.std(ddof=1), values.min(), values.max())
        assert [row[key] for key in whole.columns[1:]] == [f"{value:.6g}" for value in told]
    words = {"dives": "dives", "distance made good km": "distance_made_good_km", "mean power W": "mean_power_w"}
    seen = set()
    for group in groups:
        pitch, depth, *outputs = group.columns
        assert (pitch.split()[0], depth.split()[0]) == ("pitch", "depth")
        for row in group.rows:
            runs = result.sel(pitch_deg=float(row[pitch]), depth_m=float(row[depth]))
            for heading in outputs:
                values = runs[words[heading]].values
                assert row[heading] == f"{values.mean():.4g} ± {values.std(ddof=1):.2g}"
                seen.add(heading)
    assert seen == set(words)


def test_selection_is_said(folder: Path, write: Write) -> None:
    study = write('kind = "sweep"\n[[parameters]]\nkey = "mission.dives.pitch_deg"\nvalues = [25, 35]\n')
    shown = run_here(folder, "study", study, "--workers", 1, "--output", "s.nc")
    known = len(run_here(folder, "study", study, "--output", "s.nc", "--json").json["statistics"])
    note = f"8 of {known} outputs are shown; outputs = [...] in the study chooses, --json has all"
    assert note in " ".join(shown.out.split())


def test_pictures_of_a_sweep_show_the_means(swept: tuple[Finished, Path]) -> None:
    done, _ = swept
    names = drawn_outputs(done)
    figure = sweep_figure(done)
    assert [axes.get_title(loc="left") for axes in figure.axes[: len(names)]] == [
        {"dives": "Dives", "distance_made_good_km": "Distance made good [km]", "mean_power_w": "Mean power [W]"}[name]
        for name in names
    ]
    axes = figure.axes[names.index("mean_power_w")]
    result = done.dataset["mean_power_w"].mean("repeat")
    for line, depth in zip([one for one in axes.get_lines() if "depth" in str(one.get_label())], (30, 40), strict=True):
        assert line.get_label() == f"depth {depth} m"
        assert list(line.get_xdata()) == [20.0, 40.0]
        assert np.asarray(line.get_ydata()) == pytest.approx(result.sel(depth_m=depth).values)
    assert {one.get_xlabel() for one in figure.axes[: len(names)]} == {"Pitch [degrees]"}
    spread = done.dataset["mean_power_w"].std("repeat", ddof=1)
    for bars, depth in zip(axes.containers, (30, 40), strict=True):
        (lines,) = bars.lines[2]  # type: ignore[attr-defined]
        halves = [0.5 * (end[1] - begin[1]) for begin, end in lines.get_segments()]
        assert halves == pytest.approx(spread.sel(depth_m=depth).values)


def test_pictures_of_runs_show_every_run(folder: Path, write: Write) -> None:
    study = write('kind = "monte_carlo"\nruns = 8\noutputs = ["mean_power_w", "deepest_m", "battery_wh"]\n' + UNIFORM)
    done = run_study(load_study(study), folder / "m.nc", workers=1)
    assert drawn_outputs(done) == ["mean_power_w", "deepest_m"]  # the battery is the same in all
    assert done.combinations() == []
    figure = runs_figure(done)
    histogram, by_pitch, by_current = figure.axes[:3]
    assert sum(bar.get_height() for bar in histogram.patches) == 8  # type: ignore[attr-defined]
    for axes, k in ((by_pitch, 0), (by_current, 1)):
        (dots,) = axes.get_lines()
        assert np.asarray(dots.get_xdata()) == pytest.approx([run[k] for run in done.study.values])
        assert np.asarray(dots.get_ydata()) == pytest.approx(done.outputs["mean_power_w"])
    assert histogram.get_xlabel() == by_pitch.get_ylabel() == "Mean power [W]"
    assert by_pitch.get_xlabel() == "Pitch [degrees]"
    assert by_current.get_xlabel() == "Current east [m/s]"
    found = done.sensitivity
    assert found is not None
    bars: Any = sensitivity_figure(done).axes[0].containers
    for j, group in enumerate(bars):
        widths = [bar.get_width() for bar in group]
        rows = [found.outputs.index(name) for name in ("mean_power_w", "deepest_m")]
        assert widths == pytest.approx(found.measures["coefficient"][rows, j])
        assert group.get_label() == ("Pitch [degrees]", "Current east [m/s]")[j]
    # the bars of an output stand about its name
    places: Any = [[bar.get_y() + 0.5 * bar.get_height() for bar in group] for group in bars]
    assert np.mean(places, axis=0) == pytest.approx(sensitivity_figure(done).axes[0].get_yticks())


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            'kind = "sweep"\n' + UNIFORM,
            ["mission.dives.pitch_deg", "needs a parameter with values", "monte_carlo"],
        ),
        (
            'kind = "sweep"\n[[parameters]]\nkey = "mission.dives.depth_m"\nvalues = [30, 40]\n' + UNIFORM,
            ["runs is missing", "draws of mission.dives.pitch_deg"],
        ),
        (
            'kind = "sweep"\nruns = 2\n[[parameters]]\nkey = "mission.dives.depth_m"\nvalues = [30]\n[[parameters]]\n'
            'key = "mission.dives.pitch_deg"\ndistribution = "normal"\nmean = 30',
            ["needs mean and standard_deviation"],
        ),
    ],
)
def test_sweeps_that_draw_wrongly_are_refused(folder: Path, write: Write, text: str, words: list[str]) -> None:
    with pytest.raises(FileError) as caught:
        load_study(write(text))
    for word in words:
        assert word in str(caught.value)


@pytest.mark.parametrize(
    ("name", "words", "unit"),
    [
        ("distance_made_good_km", "distance made good", "km"),
        ("energy_wh_pump", "energy pump", "W h"),
        ("current_east_m_s", "current east", "m/s"),
        ("reckoning_error_m_greatest", "reckoning error greatest", "m"),
        ("dives", "dives", ""),
        ("waypoints_reached", "waypoints reached", ""),
    ],
)
def test_names_are_said_in_words(name: str, words: str, unit: str) -> None:
    assert in_words(name) == (words, unit)
