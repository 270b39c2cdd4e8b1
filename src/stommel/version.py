"""The version, apart from the front door, which imports every layer."""

__version__ = "0.1.0"
