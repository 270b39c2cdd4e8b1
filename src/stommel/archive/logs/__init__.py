"""Logs of vehicles, taken into the archive: what was measured while the radio was silent."""
