"""What a reader sees: the mark of generated data, a curve a pressure, limits, and the section of the design report."""

from collections.abc import Callable
from math import pi
from pathlib import Path

import pytest

from stommel.bench import MARKER, bench_engine, fit_engine, generate_log, judge, performance, read_pressure_test
from stommel.bench.fit_plot import fit_figure
from stommel.bench.holding_plot import holding_figure
from stommel.bench.performance_plot import performance_figure, response_figure
from stommel.bench.speed_study import SpeedStudy, speed_study
from stommel.figures.saving import svg_text
from stommel.machinery.engine.steady_state import EngineParameters
from stommel.vehicle import load_vehicle


@pytest.fixture(scope="module")
def study() -> SpeedStudy:
    return speed_study(load_vehicle("zju"))


def test_generated_data_are_marked_in_every_plot(engine: EngineParameters) -> None:
    log = generate_log(engine, 1)
    runs = performance(log, engine.piston_area_m2)
    points = [run.point for run in runs]
    fit = fit_engine(runs, engine)
    for generated in (True, False):
        figures = [performance_figure(points, generated=generated), fit_figure(fit, runs, generated=generated)]
        for figure in figures:
            assert (figure.get_suptitle() == f"Data {MARKER}") is generated
    assert MARKER in response_figure(log, 733.0).get_suptitle()


def test_figure_14_has_one_curve_a_pressure(study: SpeedStudy) -> None:
    figure = performance_figure(study.points, generated=True, engine=study.engine, choice=study.choice)
    current, consumption = figure.axes
    labels = current.get_legend_handles_labels()[1]
    assert labels == ["0.00 MPa", "0.50 MPa", "1.00 MPa", "1.50 MPa", "2.00 MPa", "2.50 MPa"]
    assert "J/mm" in consumption.get_ylabel()
    assert any("chosen 7000 r/min" in text.get_text() for text in consumption.texts)


def test_figure_15_has_the_times_of_its_log(engine: EngineParameters) -> None:
    log = generate_log(engine, 1)
    axes = response_figure(log, 7000 * 2 * pi / 60).axes[0]
    assert axes.get_title(loc="left") == "Response at 7000 r/min"
    times = [float(text.get_text().removesuffix(" s")) for text in axes.texts]
    assert len(times) == 6
    assert times == sorted(times)


def test_a_failed_hold_is_named_in_the_plot(tmp_path: Path) -> None:
    path = tmp_path / "holds.csv"
    path.write_text("hold,from,to,from_pressure_mpa,to_pressure_mpa\n1,23:30,00:30,2.4,2.1\n")
    figure = holding_figure(judge(read_pressure_test(path)))
    assert figure.axes[0].get_title(loc="left").endswith("FAILED")
    assert "passed" in holding_figure(judge(read_pressure_test("fan2013-table5"))).axes[0].get_title(loc="left")


def test_the_same_figure_has_the_same_bytes(study: SpeedStudy) -> None:
    first, second = (svg_text(performance_figure(study.points, generated=True, engine=study.engine)) for _ in "ab")
    assert first == second


def test_the_study_takes_speeds_and_pressures_of_section_512(study: SpeedStudy) -> None:
    speeds = sorted({round(point.motor_speed * 60 / (2 * pi)) for point in study.points})
    assert speeds == [3500, 5250, 7000, 8750]
    assert sorted({point.pressure / 1e6 for point in study.points}) == [0.0, 0.5, 1.0, 1.5, 2.0, 2.5]
    assert study.choice.chosen is not None
    assert study.choice.chosen.motor_speed == pytest.approx(study.file_speed)
    assert study.engine == bench_engine(load_vehicle("zju"))


def test_the_design_report_has_the_section(report_of: Callable[[str], str]) -> None:
    section = report_of("zju").partition('<section id="motor-speed">')[2].partition("</section>")[0]
    assert "7000 r/min takes least" in section
    assert "by the model, not measured" in section
    assert section.count("<tr>") == 5
    assert "No motor speed is compared, because" in report_of("rogue")
