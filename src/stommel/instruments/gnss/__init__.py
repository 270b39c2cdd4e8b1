"""The satellite receiver: NMEA 0183, and NovAtel's logs in ASCII and binary."""
