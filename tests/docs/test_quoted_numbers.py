"""Numbers that the pages quote are those of the code: each sentence is made from them and looked for on its page."""

import re
import tomllib
from functools import cache
from math import pi, radians
from pathlib import Path

import numpy as np
import pytest

import stommel
from stommel.analysis import limits, specified_flights, steady_equations
from stommel.bench import identifiability, speed_choice
from stommel.bench.column_map import Checks
from stommel.bench.generation import SensorNoise
from stommel.control import laws
from stommel.design.budget import trimming
from stommel.design.drives import study as drive_study
from stommel.design.endurance import energy_study
from stommel.design.endurance.sensitivity import SPAN_OF_SOURCED, SPAN_WITHOUT_RANGE
from stommel.machinery.drives.rudder import centre_of_pressure
from stommel.machinery.engine import cycle, results
from stommel.machinery.hull import buckling, end_caps, paper_formulas
from stommel.machinery.power import engine_work
from stommel.ocean import ocean
from stommel.ocean.analytic.catalogue import ANALYTIC
from stommel.simulation import timing
from stommel.simulation.plant import motion, waves
from stommel.simulation.scenario import scenario_file
from stommel.simulation.scenario.shipped import mission_path
from stommel.simulation.scenario.world_tables import Ctd, Integration

ROOT = Path(__file__).parents[2]
WORDS = {0.5: "half", 3: "three", 6: "six", 20: "20"}


@cache
def text_of(page: str) -> str:
    """The page on one line; `theory` is all pages of theory."""
    files = sorted((ROOT / "docs" / page).glob("*.md")) if page == "theory" else [ROOT / page]
    return " ".join(" ".join(path.read_text("utf-8") for path in files).split())


STEP, CTD, NOISE, CHECKS = Integration(), Ctd(), SensorNoise(), Checks()

CONSTANTS = [
    ("theory", f"kept to {WORDS[laws.ENDABLE]} of what the steering could just hold"),
    ("theory", f"A mission advances in control steps $h$ ({STEP.control_step_s:g} s)"),
    ("theory", f"looked up anew every {STEP.ocean_s:g} s"),
    (
        "theory",
        rf"(c, c_d) = ({timing.FASTEST_STEADY:g}, {motion.LARGEST_STEADY:g}) \text{{ at rest, }} "
        rf"({timing.FASTEST_MOVING:g}, {motion.LARGEST_MOVING:g}) \text{{ in motion}}",
    ),
    ("theory", f"The elevation is a sum of {waves.COMPONENTS} cosines"),
    ("theory", rf"JONSWAP with $\gamma = {waves.PEAKEDNESS:g}$"),
    ("theory", rf"the damping ratio $\xi = {waves.HEAVE_DAMPING:g}$"),
    ("theory", f"The thermistor is a first-order lag behind the water ({CTD.temperature_lag_s:g} s)"),
    ("theory", rf"{CTD.cell_flow_m_s:g} m/s, an estimate: $a = {CTD.thermal_share:.3f}$ and"),
    ("theory", rf"$\tau_\mathrm{{c}} = {CTD.thermal_lag_s:.1f}$ s."),
    ("theory", rf"\left( \frac{{m_\mathrm{{c}} P_\mathrm{{max}} L}}{{{paper_formulas.SHORT_TUBE:g} E D_\mathrm{{o}}}}"),
    ("theory", rf"[\sigma]_\mathrm{{cr}} = \frac{{{paper_formulas.AXIAL_FACTOR:g} E \delta}}"),
    ("theory", rf"p_\mathrm{{cr}} = {end_caps.MACHINED_SPHERE:g} E"),
    ("theory", rf"shorter than ${buckling.critical_length(1.0, 1.0):g} D_\mathrm{{o}}"),
    (
        "theory",
        rf"x_\mathrm{{cp}} = {centre_of_pressure(0.0):g} + "
        rf"{centre_of_pressure(pi / 2) - centre_of_pressure(0.0):g} \sin|\delta_\mathrm{{r}}|",
    ),
    ("theory", f"its simulation at {WORDS[len(engine_work.SIMULATED_SHARES)]} pressures"),
    ("theory", f"moves less than a thousandth of its oil in {cycle.PATIENCE_S:g} s is given up"),
    ("theory", f"A complex step of $10^{{{np.log10(steady_equations.COMPLEX_STEP):.0f}}}$ in an unknown"),
    ("theory", f"stops at $10^{{{np.log10(steady_equations.TOLERANCE):.0f}}}$ N and N m"),
    ("theory", f"{1 / limits.SPEED_WEIGHT:g} m/s equal to {1 / limits.ANGLE_WEIGHT / radians(1):g} degrees of pitch"),
    ("theory", f"with columns of unit length is below $10^{{{np.log10(identifiability.SINGULAR):.0f}}}$"),
    ("theory", f"({NOISE.flow_repeat:.1%} and {NOISE.current_repeat:.0%})".replace("%", " %")),
    (
        "theory",
        f"{NOISE.pressure_pa / 1e3:g} kPa, {NOISE.motor_speed_rad_s * 30 / pi:g} r/min, {NOISE.voltage_v * 1e3:g} mV, "
        f"{NOISE.current_a * 1e3:g} mA, {NOISE.piston_travel_m * 1e3:g} mm",
    ),
    ("theory", rf"+ {trimming.REMOVAL_COST:g} \sum_j q_j"),
    ("theory", f"Foam may fill {WORDS[trimming.FILL]} of a flooded bay's"),
    ("docs/guide/bench.md", f"a gap of more than {WORDS[CHECKS.longest_gap]} usual steps"),
    ("docs/guide/bench.md", f"fewer than {CHECKS.fewest_rows} rows while the motor turns"),
    ("docs/guide/bench.md", f"stuck_rows = {CHECKS.stuck_rows} saturated_rows = {CHECKS.saturated_rows}"),
    (
        "docs/guide/bench.md",
        f"A correlation above {identifiability.CORRELATED:g} and a standard error above "
        f"{WORDS[identifiability.UNDETERMINED]} of the value",
    ),
    ("docs/guide/bench.md", f"what the margin of {100 * speed_choice.MARGIN:g} % is for"),
    ("docs/guide/budget.md", f"of foam to add, {trimming.FOAM_DENSITY:g} kg/m³ if left out"),
    ("docs/guide/drives.md", f"differ by more than {100 * drive_study.AGREEMENT:g} %"),
    ("docs/guide/engine.md", f"{results.SAMPLES} samples over time"),
    (
        "docs/guide/endurance.md",
        f"by {100 * SPAN_WITHOUT_RANGE:g} % where the file states none; numbers with a source are varied by "
        f"{100 * SPAN_OF_SOURCED:g} %",
    ),
    ("docs/guide/missions.md", f"Up to {scenario_file.LONGEST_LATENCY - 1} control steps"),
    ("docs/guide/ocean.md", f"a Kuroshio-like jet of {ANALYTIC['east_china_sea']().transport_sv:g} Sv"),
    ("docs/guide/ocean.md", f"fresh water {ANALYTIC['pool']().bottom_m:g} m deep"),
    ("docs/guide/ocean.md", f"blend_km={ocean.BLEND_KM:g}, blend_hours={ocean.BLEND_H:g}"),
]  # fmt: skip


@pytest.mark.parametrize(("page", "sentence"), CONSTANTS, ids=lambda text: text[:50])
def test_constant_is_quoted_as_it_is(page: str, sentence: str) -> None:
    assert sentence in text_of(page)


@pytest.fixture(scope="module")
def zju() -> stommel.Vehicle:
    return stommel.load_vehicle("zju")


@pytest.mark.parametrize("page", ["README.md", "docs/checked.md"])
def test_ranges_that_the_wanted_flights_need(page: str, zju: stommel.Vehicle) -> None:
    needs = stommel.ranges_needed(zju, specified_flights(zju))
    assert f"need ±{needs.moving_mass_mm:.1f} mm" in text_of(page)
    assert f"±{needs.ballast_ml:.1f} ml" in text_of(page)
    assert f"±{needs.moving_mass_choice_mm:g} mm and ±{needs.ballast_choice_ml:g} ml" in text_of(page)


def test_endurance_with_its_interval(zju: stommel.Vehicle) -> None:
    interval, page = energy_study(zju).interval, text_of("docs/guide/endurance.md")
    assert f"is **{interval.likely_least:.1f} to {interval.likely_most:.1f} days**" in page
    assert f"at one end it is {interval.least:.1f} or {interval.most:.1f} days" in page
    likely = f"{interval.likely_least:.1f} to {interval.likely_most:.1f} days"
    assert f"every uncertain number in its range {likely}" in text_of("docs/checked.md")


def test_mission_on_the_battery_as_built(tmp_path: Path) -> None:
    """The benchmark's mission without its larger battery."""
    text = mission_path("still_20_days").read_text("utf-8")
    changes = tomllib.loads(text)["changes"]["battery.capacity_ah"]
    mine = tmp_path / "mine.toml"
    mine.write_text("\n".join(line for line in text.splitlines() if not line.startswith("changes")))
    mission = stommel.load_mission(mine)
    assert mission.vehicle.description.battery is not None
    built = mission.vehicle.description.battery.capacity_ah
    record = stommel.fly_mission(mission).record
    days = record["time"][-1] / 86400
    assert f"on {changes:g} A h ({built:g} A h last {days:.1f})" in text_of("README.md")
    assert f"with {built:g} A h is over after {days:.1f} days" in text_of("docs/guide/endurance.md")


def crossing(vehicle: stommel.Vehicle, quantity: str, low: float, high: float) -> float:
    """Pitch [deg] at which the spiral's growth or the rudder's effect changes its sign, at 0.4 m/s; by bisection."""

    def value(pitch: float) -> float:
        flight = stommel.trim(vehicle, speed_m_s=0.4, pitch_deg=pitch, within_limits=False)
        linear = stommel.linearise(vehicle, flight)
        if quantity == "rudder":
            return stommel.authority(linear).turn_rate_deg_s_per_rudder_deg or 0.0
        assert linear.lateral is not None
        return float(linear.lateral.eigenvalues().real.max())

    for _ in range(12):
        middle = (low + high) / 2
        low, high = (middle, high) if value(middle) * value(low) > 0.0 else (low, middle)
    return (low + high) / 2


def test_pitches_at_which_the_lateral_plane_changes(zju: stommel.Vehicle) -> None:
    spiral, rudder = crossing(zju, "spiral", -45, -35), crossing(zju, "rudder", -20, -10)
    assert f"steeper than about {spiral:.1f} deg at 0.4 m/s" in text_of("docs/theory/stability.md")
    assert f"steeper than about {spiral:.0f} deg" in text_of("docs/decisions/0007-steering-by-the-slow-mode.md")
    assert f"about {rudder:.0f} deg of pitch" in text_of("docs/guide/commands.md")
    assert f"between about {rudder:.0f} deg and level" in text_of("docs/decisions/0007-steering-by-the-slow-mode.md")


def test_lever_of_the_side_force(zju: stommel.Vehicle) -> None:
    file = zju.description
    assert file.hydrodynamics.yaw_moment_per_rad_kg is not None
    assert file.hydrodynamics.side_force_per_rad_kg_m is not None
    assert file.specification is not None
    lever = file.hydrodynamics.yaw_moment_per_rad_kg / file.hydrodynamics.side_force_per_rad_kg_m
    assert (
        f"acts {lever:g} m from the centre of a vehicle of {file.specification.overall_length_m:g} m"
        in text_of("docs/checked.md")
    )  # fmt: skip


def test_moment_of_the_bladder(zju: stommel.Vehicle) -> None:
    buoyancy, water = zju.description.actuators.buoyancy, zju.description.water
    assert buoyancy is not None
    assert buoyancy.bladder_position_m is not None
    aft = -buoyancy.bladder_position_m[0]
    moment = water.density_kg_m3 * water.gravity_m_s2 * buoyancy.volume_m3[1] * aft
    sentence = f"{moment:.1f} N m at {buoyancy.volume_ml[1]:g} ml and the {aft:g} m that `zju` assumes"
    assert sentence in text_of("docs/theory/steady-flight.md")


QUOTED_LENGTHS = (0.375, 0.5, 0.75, 0.9, 1.0, 1.2, 1.4, 1.6, 1.8)


def row_of(page: str, name: str) -> list[float]:
    """Numbers of the row of a table in a page whose lines are joined."""
    found = re.search(rf"\| {re.escape(name)} \|((?: \d\.\d\d \|)+)", page)
    assert found is not None, name
    return [float(number) for number in found.group(1).split("|")[:-1]]


def test_where_eq_9_is_safe() -> None:
    """Against von Mises, for the paper's wall of titanium and lengths up to the greatest of the formulas."""
    wall, D, E, nu = 4.2e-3, 0.22, 1.06e11, 0.34
    lengths = np.arange(0.3, buckling.critical_length(wall, D), 0.01)
    exact = np.array([buckling.von_mises(wall, (D - wall) / 2, L, E, nu).pressure for L in lengths])
    eq_9 = np.array([paper_formulas.circumferential_pressure(wall, D, L, E) for L in lengths]) / exact
    fit = np.array([buckling.windenburg_trilling(wall, (D - wall) / 2, L, E, nu) for L in lengths]) / exact
    assert (eq_9[lengths < 0.905] < 1.0).all()
    assert (eq_9[(lengths > 0.995) & (lengths < 1.405)] > 1.0).all()
    page = text_of("docs/theory/hull.md")
    assert f"within its own limit it lies from 16 % below to {100 * (fit.max() - 1):.0f} % above" in page
    assert "above over about two thirds of the lengths. **Neither is on the safe side.**" in page
    quoted = {
        name: dict(zip(QUOTED_LENGTHS, row_of(page, name), strict=True))
        for name in ("Windenburg and Trilling", "Eq. (9)")
    }
    for L in QUOTED_LENGTHS:
        k = int(np.argmin(np.abs(lengths - L)))
        # von Mises is up to 0.7 % above the elements that the page compares with
        assert quoted["Windenburg and Trilling"][L] == pytest.approx(fit[k], abs=0.03)
        assert quoted["Eq. (9)"][L] == pytest.approx(eq_9[k], abs=0.03)
