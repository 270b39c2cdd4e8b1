"""NovAtel's logs BESTPOS, BESTVEL and TIME, in ASCII and binary, read and written."""
