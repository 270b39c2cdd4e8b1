"""The tables of the first version; what changes later has a file of its own in versions."""
