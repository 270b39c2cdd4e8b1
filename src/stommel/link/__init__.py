"""The radio link: MAVLink 2 on both ends, without I/O."""
