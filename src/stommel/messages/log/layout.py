"""Bytes of a log: the first of a file, of a record, and what its formats are called."""

import struct

MAGIC = b"stommel log 1\n"
"""First bytes of a file."""
SYNC = b"\xd5\xaa"
"""First bytes of a record."""
HEADER_KIND = 0
"""Kind of the one record that is the file's header, in JSON."""
HEAD = struct.Struct("<2sBHI")
"""Sync word, kind, length of the payload [bytes], sequence number."""
TAIL = struct.Struct("<I")
"""CRC-32 of all between the sync word and itself."""
LONGEST_PAYLOAD = 0xFFFF
"""[bytes]"""
SEQUENCES = 1 << 32

SERIES = ("essential", "detail", "raw")
"""How much a record matters, as names of files: where room is needed, the least important ones go first."""
TEXT, BYTES = "text", "bytes"
"""Formats of a last field without a fixed length: UTF-8 text, or plain bytes, to the end of the record."""
