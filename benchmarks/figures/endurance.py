"""Energy and endurance of a vehicle: the whole question, best flights and sensitivities included."""

from figures.registry import Measurement, figure
from figures.timing import seconds, summary
from stommel.vehicle import load_vehicle

REPEATS = 15
MILLISECOND = 1e-3


@figure(unit="ms", bar=50.0)
def endurance_ms() -> Measurement:
    """Measure what `stommel endurance zju` computes, after start-up [ms]."""
    from stommel.design.endurance import endurance, energy_study  # noqa: PLC0415  # the other figures run without it

    vehicle = load_vehicle("zju")
    found = energy_study(vehicle)  # compiles
    times = seconds(lambda: energy_study(vehicle), REPEATS)
    balance = seconds(lambda: endurance(vehicle), REPEATS)
    detail = summary(times, MILLISECOND)
    return Measurement(
        detail["min"],
        detail
        | {
            "balance_alone": min(balance) / MILLISECOND,
            "sensitivities": len(found.sensitivities),
            "endurance_days": found.result.days,
        },
    )
