"""The shore's end of one vehicle, opened: its folder, its key, its transport."""

import os
import random
import time
from contextlib import ExitStack
from pathlib import Path
from typing import NamedTuple

from stommel.errors import StommelError
from stommel.files.folder_lock import FolderInUseError, locked
from stommel.files.folder_storage import FolderStorage
from stommel.link.service import SHORE_SYSTEM
from stommel.link.shore.shore_end import ShoreEnd, ShoreSettings
from stommel.link.signing.guard import Guard
from stommel.link.signing.key_file import KeyFile
from stommel.link.transports.address import read_address
from stommel.station.clock import VehicleClock
from stommel.station.settings import VehicleSettings

FAST = 1e6
"""Rate of a line that is not known to be slow [bit/s]."""


class VehicleError(StommelError):
    """A vehicle that cannot be attached; the message says what to do."""


class LateError(StommelError):
    """Something is being done, and takes longer than anybody waits."""


class MissingError(StommelError):
    """Something that is asked for is not there."""


class Opened(NamedTuple):
    """What a line needs."""

    end: ShoreEnd
    storage: FolderStorage
    clock: VehicleClock


def vehicle_folder(folder: Path, vehicle: int) -> Path:
    """Where the station keeps what it must know of a vehicle tomorrow, and its files."""
    return folder / f"vehicle-{vehicle}"


def open_end(settings: VehicleSettings, folder: Path, held: ExitStack) -> Opened:
    """Open the shore's end; `held` gives its folder back at the end.

    Raises
    ------
    StommelError
        The folder, the key or the address cannot be used.
    """
    number = settings.vehicle
    address = read_address(settings.link, f"vehicles.{number}.link")
    where = vehicle_folder(folder, number) / "link"
    try:
        storage = FolderStorage(where)
        held.enter_context(locked(where))
    except FolderInUseError:
        raise VehicleError(
            f"vehicle {number}: another station speaks to it from {where}; end that one, or give another --folder"
        ) from None
    except OSError as error:
        raise VehicleError(f"folder = {where}: cannot be used: {error.strerror or error}") from None
    clock = VehicleClock(settings.speed, simulated=settings.simulated)
    clock.restore(storage)
    rate = float(address.bit_rate or FAST) * settings.speed
    shore = ShoreSettings(number, rate, half_duplex=address.bit_rate is not None)
    guard = _guard(settings, storage, clock)
    end = ShoreEnd(shore, guard, random.SystemRandom(), os.urandom, storage, clock.link_now())
    return Opened(end, storage, clock)


def _guard(settings: VehicleSettings, storage: FolderStorage, clock: VehicleClock) -> Guard:
    if settings.key is None:
        return Guard.unsigned(SHORE_SYSTEM)
    keys = KeyFile(settings.key)
    number = keys.read().vehicle
    if number != settings.vehicle:
        raise VehicleError(f"vehicles.key = {settings.key}: is the key of vehicle {number}, not of {settings.vehicle}")
    wall = clock.link_now() if clock.simulated else time.time()
    return Guard(SHORE_SYSTEM, keys, storage, wall, os.urandom)
