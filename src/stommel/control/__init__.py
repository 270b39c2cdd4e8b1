"""The vehicle's decisions as pure functions: readings in, commands out; dive cycle, laws, guidance, dead reckoning."""
