"""From samples to what oceanographers use: profiles, derived quantities, sections; pure functions on xarray."""
