"""What a vehicle's software is configured with: one file, its tables, and what becomes of them."""

from stommel.onboard.coordination.config.configuration import Configuration, read_configuration
from stommel.onboard.coordination.config.configuration_file import ConfigurationFile

__all__ = ["Configuration", "ConfigurationFile", "read_configuration"]
