"""`stommel modes`: linear models and natural modes of a flight."""

from typing import TYPE_CHECKING

from stommel.cli.design_flight import design_pitch, design_speed
from stommel.cli.finish import finish
from stommel.cli.options import (
    JsonOption,
    PhysicsChoice,
    PhysicsOption,
    PitchOption,
    SpeedOption,
    VehicleArgument,
    load,
    physics_of,
)
from stommel.cli.output import number, show_table, show_values
from stommel.compilation import one_question

if TYPE_CHECKING:
    from stommel.analysis import Authority, Mode, Modes


@one_question()
def modes(
    vehicle: VehicleArgument,
    speed: SpeedOption = None,
    pitch: PitchOption = None,
    physics: PhysicsOption = PhysicsChoice.paper,
    as_json: JsonOption = False,
) -> None:
    """Linearise about a wings-level flight; name its modes, and show the control authority beside them.

    Example: stommel modes zju --speed 0.4 --pitch -35
    """
    from stommel.analysis import authority, linearise, trim
    from stommel.analysis import modes as find_modes

    glider = load(vehicle)
    switches = physics_of(physics)
    V, theta = design_speed(glider, speed), design_pitch(glider, pitch)
    flight = trim(glider, speed_m_s=V, pitch_deg=theta, physics=switches)
    linear = linearise(glider, flight, physics=switches)
    found, able = find_modes(linear), authority(linear)
    answer = found.as_row() | linear.as_row() | {"authority": able.as_row(), "flight": flight.as_row()}
    finish(answer, None, as_json, lambda _: _show(glider.name, found, able))


def _show(name: str, found: "Modes", able: "Authority") -> None:
    _show_plane(f"{name}: longitudinal modes (u, w, q, theta)", found.longitudinal)
    if found.lateral is None:
        show_values(
            "Lateral-directional modes", {"not known": "the sources of this vehicle give no lateral coefficients"}
        )
    else:
        _show_plane("Lateral-directional modes (v, p, r, phi)", found.lateral)
    _show_authority(able)


def _show_plane(title: str, found: "tuple[Mode, ...]") -> None:
    rows = []
    for mode in found:
        if mode.eigenvalue.imag < 0.0:
            continue  # the other half of the pair
        swing = f" ± {mode.eigenvalue.imag:.4f}i" if mode.oscillatory else ""
        rows.append(
            [
                mode.name,
                f"{mode.eigenvalue.real:.4f}{swing}",
                number(mode.damping_ratio, 3),
                number(mode.period, 2) if mode.oscillatory else "-",
                number(mode.time_constant, 2),
                number(mode.time_to_half, 2),
            ]
        )
    columns = ["mode", "eigenvalue\n1/s", "damping\nratio", "period\ns", "time\nconstant s", "time to\nhalf s"]
    show_table(title, columns, rows)


def _show_authority(able: "Authority") -> None:
    values = {
        "pitch per moving mass": number(able.pitch_deg_per_mm, 4, "deg/mm"),
        "speed per ballast": number(able.speed_m_s_per_ml * 1e3, 3, "mm/s per ml"),
        "peak pitch rate": number(able.peak_pitch_rate_deg_s_per_mm, 4, "deg/s per mm, after a step"),
        "initial pitch acceleration": number(able.initial_pitch_acceleration_deg_s2_per_mm, 4, "deg/s2 per mm"),
    }
    if able.turn_rate_deg_s_per_rudder_deg is not None:
        values["turn rate per rudder"] = number(able.turn_rate_deg_s_per_rudder_deg, 4, "deg/s per deg")
    if able.turn_rate_deg_s_per_roll_deg is not None:
        values["turn rate per roll of mass"] = number(able.turn_rate_deg_s_per_roll_deg, 5, "deg/s per deg")
    show_values("Control authority (final change per unit)", values)
