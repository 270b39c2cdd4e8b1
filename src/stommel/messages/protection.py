"""End-to-end protection of a frame: CRC-8 0x2F, as AUTOSAR's E2E profile 2 has it (CRC-8H2F).

It covers the identifier too, so that a frame that comes under another's identifier fails. Its Hamming distance is 4 up
to 119 bits (Koopman and Chakravarty 2004): with 16 bits of identifier and 64 of data every error of up to three bits is
caught.
"""

POLYNOMIAL, START, FINAL_XOR = 0x2F, 0xFF, 0xFF


def _remainder(byte: int) -> int:
    for _ in range(8):
        byte = (byte << 1) ^ POLYNOMIAL if byte & 0x80 else byte << 1
    return byte & 0xFF


_TABLE = bytes(_remainder(byte) for byte in range(256))


def crc8(data: bytes) -> int:
    """CRC-8 0x2F of some bytes, 0 to 255; of b"123456789" it is 0xDF."""
    crc = START
    for byte in data:
        crc = _TABLE[crc ^ byte]
    return crc ^ FINAL_XOR


def checksum(identifier: int, data: bytes) -> int:
    """Checksum of a frame: of its identifier, low byte first, and its data without the last byte."""
    return crc8(identifier.to_bytes(2, "little") + data[:-1])
