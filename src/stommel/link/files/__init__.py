"""Files over the radio: MAVLink FTP for every ground station, and beside it our own way that asks no byte twice."""
