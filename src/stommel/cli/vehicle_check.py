"""What a verb says of the cross-checks of the vehicle that it works with: how many findings, and where to read them."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from stommel.cli.output import show_notes
from stommel.files.units import counted

if TYPE_CHECKING:
    from stommel.vehicle import Vehicle


def vehicle_check(vehicle: "Vehicle") -> dict[str, Any]:
    """Run every cross-check; how many errors and warnings there are, and the command that lists them."""
    from stommel.design.checking import cross_check

    return cross_check(vehicle).as_row()


def show_vehicle_check(found: Mapping[str, Any] | None) -> None:
    """Print one line where there is anything to read."""
    if found is None or not found["errors"] + found["warnings"]:
        return
    # short, so that the command stays on one line
    show_notes(
        [f"{counted(found['errors'], 'error')}, {counted(found['warnings'], 'warning')}: {found['command']}"], "vehicle"
    )
