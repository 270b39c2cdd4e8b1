"""A file as large as files may be is answered within ten seconds, however it is written, and in a bounded text."""

import time

import pytest

from stommel.errors import FileError
from stommel.files.opening import TOML_MIB
from stommel.files.toml_reader import parse_toml
from stommel.machinery.hull.materials import materials_from_text
from stommel.vehicle import vehicle_from_text

SIZE = TOML_MIB << 20


def many(line: str) -> str:
    """Lines, numbered, up to the largest file."""
    rows, length = [], 0
    while length < SIZE - 100:
        rows.append(line.format(len(rows)))
        length += len(rows[-1]) + 1
    return "\n".join(rows)


TEXTS = {
    "unknown keys": many("k{}=1"),
    "tables": many("[k{}]"),
    "wrong tables": many("[k{}]\ntitle=1"),
    "lists of tables": "[[a]]\n" * (SIZE // 6),
    "keys of 32 parts": many("a." * 31 + "b{}=1"),
    "lists": "a=[" + "[]," * (SIZE // 3 - 4) + "]",
    "inline tables": "a=[" + "{b=1}," * (SIZE // 6 - 4) + "]",
    "numbers": "a=[" + "1," * (SIZE // 2 - 4) + "]",
    "digits": "a=" + "7_" * (SIZE // 2 - 4) + "7",
    "long numbers": "a=[" + ",".join(["7" * 5000] * 200) + "]",
    "one word": "a" * SIZE,
    "words": "a " * (SIZE // 2),
    "parts of keys": "a." * (SIZE // 2),
    "quoted parts": '"!"."?".' * (SIZE // 8),
    "quotes": '"' * SIZE,
    "open quotes": "'a" * (SIZE // 2),
    "blanks": "a" + " " * (SIZE - 4) + "=",
    "one text": "name='" + "x" * (SIZE - 10) + "'",
    "one key": "x" * (SIZE - 10) + "=1",
}


CASES = [(vehicle_from_text, name) for name in TEXTS] + [
    (materials_from_text, name) for name in ("unknown keys", "tables", "wrong tables", "one key")
]


@pytest.mark.parametrize(("read", "name"), CASES)
def test_the_largest_files(read: object, name: str) -> None:
    assert len(TEXTS[name]) <= SIZE
    start = time.process_time()
    with pytest.raises(FileError) as caught:
        read(TEXTS[name], "x.toml")  # type: ignore[operator]
    assert time.process_time() - start < 10.0
    lines = str(caught.value).splitlines()
    assert len(lines) <= 110
    assert max(map(len, lines)) < 500


def test_many_wrong_keys_are_counted() -> None:
    with pytest.raises(FileError) as caught:
        vehicle_from_text("\n".join(f"k{k} = 1" for k in range(1000)), "x.toml")
    assert str(caught.value.problems[-1]).startswith("x.toml: and 907 more problems")  # 7 tables are missing
    assert len(caught.value.problems) == 101


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("a = [" + "[" * 31 + "]" * 32, [[]]),
        ("a = 9223372036854775807", 2**63 - 1),
        ("a = -9223372036854775808", -(2**63)),
        ("a = 0x7fffffffffffffff", 2**63 - 1),
        (f"a = '{'7' * 5000}'", "7" * 5000),
        (f"a = 1.{'7' * 5000}", float("1." + "7" * 20)),
        (".".join(["b"] * 32) + " = 1\na = 'a.b.c'", "a.b.c"),
    ],
    ids=["32 lists", "largest", "least", "hexadecimal", "a text of digits", "a fraction", "a key of 32 parts"],
)
def test_what_lies_within_the_bounds_is_read(text: str, value: object) -> None:
    found = parse_toml(text, "x.toml")["a"]
    if value == [[]]:
        assert str(found) == "[" * 32 + "]" * 32
    else:
        assert found == value


def test_digits_in_a_text_stay_beside_a_number_that_is_too_long() -> None:
    """The second reading, which finds the key of the number, must not take a text for one."""
    text = f"a = '{'7' * 5000}'\nb = {'7' * 5000}"
    with pytest.raises(FileError, match=r"^x\.toml: b: must be a whole number"):
        parse_toml(text, "x.toml")
