"""The key of a vehicle's radio, as its configuration names it."""

import os
from pathlib import Path

from stommel.errors import FileError, Problem
from stommel.files.storage import Storage
from stommel.link.signing.guard import Guard
from stommel.link.signing.key_file import KeyFile
from stommel.link.signing.keys import Keys
from stommel.onboard.coordination.config import Configuration


class VehicleKey(KeyFile):
    """A key file that must be this vehicle's."""

    def __init__(self, path: Path, vehicle: int) -> None:
        super().__init__(path)
        self._vehicle = vehicle

    def read_of_any_mode(self) -> Keys:
        """Return the keys.

        Raises
        ------
        FileError
            There is no file, it is damaged, or it is another vehicle's.
        """
        keys = super().read_of_any_mode()
        if keys.vehicle != self._vehicle:
            why = f"vehicle = {keys.vehicle}: is the key of another vehicle; vehicle_id is {self._vehicle}"
            raise FileError([Problem(str(self.path), "vehicle", why)])
        return keys


def guard_of(configuration: Configuration, storage: Storage, utc: float) -> Guard:
    """Return who says who may command: a missing or damaged key is no error, but nobody then may.

    Parameters
    ----------
    configuration
        Names the key, or says that none is wanted.
    storage
        Keeps the stamps.
    utc
        By the vehicle's clock [s since 1970]; it may be wrong.
    """
    file = configuration.file
    if file.radio.unsigned:
        return Guard.unsigned(file.vehicle_id)
    key = VehicleKey(configuration.path(file.radio.key), file.vehicle_id)
    return Guard(file.vehicle_id, key, storage, utc, os.urandom)
