"""How everything is compiled: one floating-point contract for all (part of the key of all machine code).

The compiler may fuse a multiplication with an addition (`contract`), as C compilers do, but may not reorder sums:
one machine and one seed give the same bytes. Division by zero follows IEEE 754, as in NumPy.
"""

from typing import Any

COMPILED: dict[str, Any] = {"error_model": "numpy", "fastmath": {"contract"}}

INLINED: dict[str, Any] = COMPILED | {"forceinline": True, "_nrt": False}
"""Building blocks: always inlined, without counting references."""
