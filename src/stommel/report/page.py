"""Puts a design study into the page's templates."""

from dataclasses import dataclass
from importlib import resources
from math import degrees
from shlex import quote
from typing import Any

from stommel.analysis import LinearModel, Mode
from stommel.design.endurance.study import MODEL_ASSUMPTIONS
from stommel.design.study import DesignStudy
from stommel.report import wording
from stommel.report.figures import figures
from stommel.report.plots import planes_of
from stommel.report.readings import locus_heading, locus_reading
from stommel.report.verdict import nearest_limit, summary, verdict
from stommel.vehicle import PHYSICS, Physics
from stommel.version import __version__

_STATES = {
    "u": ("u", "m/s", "m/s²"), "v": ("v", "m/s", "m/s²"), "w": ("w", "m/s", "m/s²"),
    "p": ("p", "rad/s", "rad/s²"), "q": ("q", "rad/s", "rad/s²"), "r": ("r", "rad/s", "rad/s²"),
    "phi": ("φ", "rad", "rad/s"), "theta": ("θ", "rad", "rad/s"),
}  # fmt: skip
_INPUTS = {"r_px": ("r_px", "m"), "V_b": ("V_b", "m³"), "delta_r": ("δ_r", "rad"), "mu": ("μ", "rad")}

_EFFECTS = {
    "bladder": "moment of the bladder's volume and of the oil's mass",
    "hull_elasticity": "compression and thermal expansion of the hull",
    "large_angles": "separated flow beyond stall",
}

_BEST_ROWS = (
    ("Speed along the path", "m/s", "speed_m_s", 3),
    ("Pitch", "deg", "pitch_deg", 2),
    ("Glide path", "deg", "glide_path_deg", 2),
    ("Angle of attack", "deg", "angle_of_attack_deg", 2),
    ("Glide ratio: distance per depth", "m/m", "glide_ratio", 2),
    ("Horizontal speed", "m/s", "horizontal_speed_m_s", 3),
    ("Sinking speed", "m/s", "sinking_speed_m_s", 3),
    ("Moving mass position", "mm", "moving_mass_position_mm", 1),
)
"""Label, unit, key and decimals of each row of the table of best conditions."""


@dataclass(frozen=True)
class MatrixView:
    """A and B of one plane with the units of rows and columns."""

    plane: str
    rows: tuple[tuple[str, str, tuple[str, ...], tuple[str, ...]], ...]
    """Symbol, unit of its rate, entries of A, entries of B."""
    states: tuple[tuple[str, str], ...]
    inputs: tuple[tuple[str, str], ...]


def report_html(study: DesignStudy) -> str:
    """Render the report of a study: the same study gives the same bytes."""
    from jinja2 import Environment, PackageLoader, StrictUndefined  # noqa: PLC0415 - start-up counts
    from markupsafe import Markup  # noqa: PLC0415 - comes with jinja2

    environment = Environment(
        loader=PackageLoader("stommel.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {
        "fixed": wording.fixed,
        "short": wording.short,
        "signed": wording.signed,
        "listed": wording.listed,
        "deg": degrees,
    }
    css = (resources.files(__package__) / "templates" / "report.css").read_text(encoding="utf-8")
    return environment.get_template("report.html.j2").render(css=Markup(css), **_context(study))


def _context(study: DesignStudy) -> dict[str, Any]:
    words, tone = summary(study)
    return {
        "study": study,
        "description": study.vehicle.description,
        "version": __version__,
        "command": _command(study),
        "physics": _physics_words(study.physics),
        "summary": words,
        "summary_tone": tone,
        "answers": verdict(study),
        "figures": figures(study),
        "why": {
            part: wording.why_unanswered(study, part)
            for part in (
                "trim tables",
                "flight envelope",
                "best conditions",
                "turns",
                "pressure hull",
                "buoyancy engine",
                "endurance",
                "motor speed",
                "drives",
                "budget",
            )
        },
        "energy_assumptions": MODEL_ASSUMPTIONS,
        "best": _best(study),
        "best_rows": _BEST_ROWS,
        "planes": [
            ("Longitudinal", _shown(study.modes.longitudinal)),
            ("Lateral-directional", _shown(study.modes.lateral) if study.modes.lateral else None),
        ],
        "matrices": [
            _matrix(plane, model)
            for plane, model in (("Longitudinal", study.linear.longitudinal), ("Lateral", study.linear.lateral))
            if model is not None
        ],
        "loci": [
            (k, locus, locus_heading(locus), " ".join(locus_reading(locus, study.modes)), planes_of(locus))
            for k, locus in enumerate(study.loci)
        ],
        "loci_missing": [(part, why) for part, why in study.unanswered if part.startswith("root locus")],
        "turn_limit": nearest_limit(study, study.turns[-1]) if study.turns else "",
        "origins": _origins(study),
        "notes": study.notes,
        "unanswered": study.unanswered,
    }


def _command(study: DesignStudy) -> str:
    """The command that makes this report again."""
    vehicle = study.vehicle.builtin or study.vehicle.origin
    option = "" if study.physics == PHYSICS["paper"] else " --physics full"
    return f"stommel design {quote(vehicle)}{option}"


def _physics_words(physics: Physics) -> str:
    name = next((name for name, known in PHYSICS.items() if known == physics), "of its own")
    acting = [words for effect, words in _EFFECTS.items() if getattr(physics, effect)]
    resting = [words for effect, words in _EFFECTS.items() if not getattr(physics, effect)]
    parts = ["the equations of motion (4) to (7) of Fan et al. (2013)"]
    if acting:
        parts.append(f"with {wording.joined(acting)}")
    if resting:
        parts.append(f"without {wording.joined(resting)}")
    return f"“{name}”: {', '.join(parts)}"


def _best(study: DesignStudy) -> list[tuple[str, dict[str, float | None], str]]:
    """Name, quantities in words with units, and remark of each best flight."""
    if study.best is None:
        return []
    rows = []
    for name, flight, limits in (
        ("Best glide", study.best.best_glide, study.best.glide_remarks),
        ("Greatest horizontal speed", study.best.fastest, study.best.fastest_remarks),
    ):
        remarks = list(limits)
        if flight.theta > 0.0 > flight.gamma:
            remarks.append("sinks with the nose above the horizon")
        quantities = {**flight.as_turn(), "glide_ratio": flight.glide_ratio, "ballast_ml": flight.V_b * 1e6}
        rows.append((name, quantities, "; ".join(remarks) or "within all limits of the file"))
    return rows


def _shown(modes: tuple[Mode, ...]) -> list[Mode]:
    """One of each conjugate pair."""
    return [mode for mode in modes if not mode.oscillatory or mode.eigenvalue.imag > 0.0]


def _matrix(plane: str, model: LinearModel) -> MatrixView:
    def entries(row: Any) -> tuple[str, ...]:
        return tuple(f"{value + 0.0:.6g}" for value in row)

    return MatrixView(
        plane,
        tuple(
            (_STATES[state][0], _STATES[state][2], entries(a), entries(b))
            for state, a, b in zip(model.states, model.A, model.B, strict=True)
        ),
        tuple(_STATES[state][:2] for state in model.states),
        tuple(_INPUTS[name] for name in model.inputs),
    )


def _origins(study: DesignStudy) -> list[tuple[str, str, list[tuple[str, str, str, str]]]]:
    """Numbers of the vehicle file by kind of origin, assumptions first: (kind, heading, rows)."""
    kinds = (
        ("assumption", "Assumed"),
        ("not stated", "Without any origin"),
        ("derived", "Derived"),
        ("source", "From a source"),
    )
    return [
        (
            kind,
            heading,
            [
                (key, wording.listed(value), wording.unit(key), wording.origin(origin))
                for key, value, origin in study.numbers
                if origin.kind == kind and key != "format"  # no number of the vehicle
            ],
        )
        for kind, heading in kinds
    ]
