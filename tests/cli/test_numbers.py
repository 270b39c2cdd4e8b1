"""Ranges on the command line hold both ends and every step between, however the decimals are rounded."""

from decimal import Decimal

import pytest

from stommel.cli.numbers import numbers


@pytest.mark.parametrize("step", ["0.1", "0.01", "0.05", "0.3", "0.7", "1", "2.5"])
@pytest.mark.parametrize("first", ["0", "0.1", "0.2", "-0.3", "1.1"])
def test_a_range_ends_where_it_says(first: str, step: str) -> None:
    """Decimal numbers are the oracle: 0.1:0.7:0.1 is seven numbers, though 0.6 / 0.1 is less than 6 in binary."""
    for count in range(1, 40):
        expected = [Decimal(first) + k * Decimal(step) for k in range(count)]
        assert numbers(f"{first}:{expected[-1]}:{step}", "--x", (-1e3, 1e3)) == [float(x) for x in expected]
        down = expected[::-1]
        assert numbers(f"{down[0]}:{down[-1]}:-{step}", "--x", (-1e3, 1e3)) == [float(x) for x in down]
        beyond = expected[-1] + Decimal(step) * Decimal("0.9")
        assert len(numbers(f"{first}:{beyond}:{step}", "--x", (-1e3, 1e3))) == count
