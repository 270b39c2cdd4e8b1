"""Oracle: what the vehicle file promises. Every error names the file, the key, the value and what is allowed."""

from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from stommel.dynamics.packing import pack
from stommel.errors import FileError
from stommel.vehicle import (
    FULL,
    PAPER,
    UnknownVehicleError,
    builtin_names,
    builtin_text,
    load_vehicle,
    stated_numbers,
    vehicle_from_text,
)

ZJU = builtin_text("zju")


def refusal(text: str) -> str:
    with pytest.raises(FileError) as caught:
        vehicle_from_text(text, "my.toml")
    message = str(caught.value)
    assert all(line.startswith("my.toml: ") for line in message.splitlines())
    return message


def changed(old: str, new: str, text: str = ZJU) -> str:
    assert old in text
    return text.replace(old, new, 1)


@pytest.mark.parametrize("name", builtin_names())
def test_builtin_vehicles_are_sound(name: str) -> None:
    vehicle = load_vehicle(name)
    assert vehicle.origin == f"{name}.toml"
    for physics in (PAPER, FULL):
        record = pack(vehicle, physics)
        for field in record.dtype.names:
            assert np.isfinite(record[field]).all(), field


def test_builtin_set_is_the_promised_one() -> None:
    assert builtin_names() == ("rogue", "seawing", "slocum", "zju")


@pytest.mark.parametrize("name", builtin_names())
def test_every_builtin_number_has_an_origin(name: str) -> None:
    """No number of a built-in vehicle stands without a source or the word assumption."""
    unstated = [key for key, _, origin in stated_numbers(load_vehicle(name)) if origin.kind == "not stated"]
    assert unstated == []


def test_zju_is_table_3() -> None:
    d = load_vehicle("zju").description
    assert d.mass_kg == 60.0
    assert d.specification is not None
    assert d.specification.endurance_days == 20.0
    assert [bay.name for bay in d.bays if not bay.flooded] == [
        "pitch control bay (front)",
        "electrical hardware bay (middle)",
        "buoyancy and turning control bay (rear)",
    ]


class TestRefusals:
    @pytest.mark.parametrize(
        ("old", "new", "expected"),
        [
            ("neutral_position_m", "neutral_postion_m", "did you mean neutral_position_m (in m)?"),
            (
                "mass_kg = 45",
                "mass = 45",
                "rigid_body.mass: unknown key in [rigid_body]; did you mean mass_kg (in kg)?",
            ),
            ("mass_kg = 45", "", "rigid_body.mass_kg is missing; add mass_kg = <number in kg>"),
            ("mass_kg = 45", "mass_kg = -45", "rigid_body.mass_kg = -45: must be between 0.1 and 2000 kg"),
            ("mass_kg = 45", "mass_kg = nan", "rigid_body.mass_kg = nan: must be a finite number"),
            ("mass_kg = 45", "mass_kg = inf", "rigid_body.mass_kg = inf: must be a finite number"),
            ("mass_kg = 45", 'mass_kg = "heavy"', "rigid_body.mass_kg = 'heavy': must be a number"),
            ("mass_kg = 45", "mass_kg = true", "rigid_body.mass_kg = true: must be a number"),
            ("[4, 12, 11]", "[4, -12, 11]", "must be positive definite; its least eigenvalue is -12 kg m2"),
            ("[4, 12, 11]", "[0.05, 12, 11]", "about the centre of mass its least eigenvalue is -0.0625 kg m2"),
            ("[4, 12, 11]", "[[4, 1, 0], [0, 12, 0], [0, 0, 11]]", "must be symmetric"),
            ("[4, 12, 11]", "[4, 12]", "rigid_body.inertia_kg_m2"),
            (
                "position_m = [-0.5, 0, 0]",
                "position_m = [-5, 0, 0]",
                "ballast.position_m: -5 m is outside the hull, which reaches from -1.24 to 0.86 m",
            ),
            ("position_m = [-0.5, 0, 0]", "position_m = [-0.5, 0, 0.3]", "0.3 m off the axis is outside the hull"),
            ("[-50, 550]", "[-50, 950]", "actuators.moving_mass.travel_mm: 0.95 m is outside the hull"),
            ("[-50, 550]", "[550, -50]", "the first number must be less than the second"),
            ("[-50, 550]", "[300, 550]", "moving_mass.neutral_position_m = 0.25: must lie within"),
            (
                "density_kg_m3 = { value = 1000,",
                "density_kg_m3 = { value = 1,",
                "must be between 900 and 1200 kg/m3",
            ),
            (
                "pitch_deg = 50",
                "pitch_deg = 90",
                "specification.pitch_deg = 90: must be at least 0.1 and less than 90 degrees",
            ),
            (
                "length_m = { value = 1.5",
                "length_m = { value = -1.5",
                "hull.length_m = -1.5: must be between 0.2 and 10 m",
            ),
            ("value = 210,", "value = 230,", "inner_diameter_mm = 230: must be less than outer_diameter_mm = 220"),
            ("to_m = 0.0\n", "to_m = 0.8\n", "must be aft of"),
            ("format = 1", "format = 2", "format"),
            ("format = 1", "format = 1\ncolour = 3", "colour: unknown key at the top of the file"),
            ("surge_kg = 5", "surge_kg = { value = 5, source = 3 }", "source = 3: must be text"),
            (
                "surge_kg = 5",
                'surge_kg = { value = 5, source = "a", assumption = "b" }',
                "added_inertia.surge_kg has both source and assumption; keep one",
            ),
            (
                "surge_kg = 5",
                'surge_kg = { value = 5, assumption = "a", range = [8, 3] }',
                "added_inertia.surge_kg: range = [8, 3]: must be two numbers, the lower first",
            ),
            (
                "surge_kg = 5",
                'surge_kg = { value = 5, assumption = "a", range = [6, 8] }',
                "added_inertia.surge_kg = 5: must lie in its own range, 6 to 8; change that with it",
            ),
            (
                "surge_kg = 5",
                'surge_kg = { value = 5, source = "a", range = [3, 8] }',
                "added_inertia.surge_kg: range needs derived or assumption beside it",
            ),
            ("[rigid_body]", "[rigid_body", "is not valid TOML"),
        ],
    )
    def test_one_wrong_number(self, old: str, new: str, expected: str) -> None:
        assert expected in refusal(changed(old, new))

    def test_all_problems_at_once(self) -> None:
        text = changed("mass_kg = 45", "mass_kg = -1", changed("heave_kg = 70", "heave_kg = -2"))
        assert len(refusal(text).splitlines()) == 2

    def test_unknown_vehicle(self, tmp_path: Path) -> None:
        with pytest.raises(UnknownVehicleError, match="built-in: rogue, seawing, slocum, zju"):
            load_vehicle("zjoo")
        with pytest.raises(FileError, match=r"cannot be read: it is a folder$"):
            load_vehicle(tmp_path)

    def test_unreadable_file(self, tmp_path: Path) -> None:
        path = tmp_path / "latin.toml"
        path.write_bytes("name = 'Gleiter für'".encode("latin-1"))
        with pytest.raises(FileError, match=r"cannot be read: it is not UTF-8 text: line 1 has the byte 0xfc$"):
            load_vehicle(path)


def test_provenance_by_number_table_and_file() -> None:
    text = changed(
        'source = "Fan et al. (2013), section 3.1"\nmass_kg = 45', 'mass_kg = { value = 45, assumption = "guess" }'
    )
    vehicle = vehicle_from_text(text, "my.toml")
    assert vehicle.provenance_of("rigid_body.mass_kg").kind == "assumption"
    assert vehicle.provenance_of("rigid_body.mass_kg").text == "guess"
    # the table has no word of its own any more: the file's applies
    assert vehicle.provenance_of("rigid_body.centre_of_mass_m").text == "Fan et al. (2013), J. Zhejiang Univ. Sci. C"
    assert vehicle.provenance_of("moving_mass.mass_kg").text == "Fan et al. (2013), section 3.1"


@settings(deadline=None)
@given(value=st.floats(0.1, 1e3))
def test_with_value_changes_one_number(value: float) -> None:
    zju = load_vehicle("zju")
    other = zju.with_value("rigid_body.mass_kg", value)
    assert other.value("rigid_body.mass_kg") == value
    assert zju.value("rigid_body.mass_kg") == 45
    same = {key: number for key, number, _ in stated_numbers(other) if key != "rigid_body.mass_kg"}
    assert same == {key: number for key, number, _ in stated_numbers(zju) if key != "rigid_body.mass_kg"}


def test_with_value_inside_a_list() -> None:
    assert load_vehicle("zju").with_value(
        "rigid_body.centre_of_mass_m.2", 0.04
    ).description.rigid_body.centre_of_mass_m == (
        0.0,
        0.0,
        0.04,
    )


@given(text=st.text(max_size=200))
def test_no_text_crashes_the_loader(text: str) -> None:
    """Any text is either a vehicle or a clear refusal."""
    with pytest.raises(FileError):
        vehicle_from_text(text, "my.toml")


VALUES = st.one_of(
    st.integers(-10, 10), st.floats(), st.booleans(), st.text(max_size=5), st.lists(st.integers(), max_size=4)
)


@settings(deadline=None, max_examples=200)
@given(data=st.data())
def test_no_value_crashes_the_loader(data: st.DataObject) -> None:
    """Any value in place of any number is either accepted or refused by name."""
    zju = load_vehicle("zju")
    key = data.draw(st.sampled_from([key for key, _, _ in stated_numbers(zju)]))
    value = data.draw(VALUES)
    with suppress(FileError):
        zju.with_value(key, value)  # type: ignore[arg-type]  # wrong on purpose


@pytest.mark.parametrize(
    "key", ["", ".", "mass", "rigid_body", "rigid_body.centre_of_mass_m", "rigid_body.centre_of_mass_m.3",
            "rigid_body.centre_of_mass_m.-1", "rigid_body.centre_of_mass_m.²", "rigid_body.centre_of_mass_m.x",
            "rigid_body.mass_kg.0", "name", f"rigid_body.centre_of_mass_m.{'9' * 5000}"],
)  # fmt: skip
def test_keys_of_no_number(key: str) -> None:
    zju = load_vehicle("zju")
    for ask in (zju.value, lambda key: zju.with_value(key, 1.0)):
        with pytest.raises(FileError, match="no number of ZJU glider has this key") as caught:
            ask(key)
        assert len(str(caught.value)) < 600


def test_unknown_lateral_plane_is_listed() -> None:
    assert next(load_vehicle("rogue").description.unknown_lateral()) == "added_inertia.sway_kg"
    for name in ("zju", "slocum", "seawing"):
        assert list(load_vehicle(name).description.unknown_lateral()) == []


def test_with_value_of_a_field_left_at_its_default() -> None:
    """Any numeric field can be varied, stated in the file or not; a tensor stays symmetric."""
    zju = load_vehicle("zju")
    assert zju.value("moving_mass.offset_m") == 0.0
    assert zju.with_value("moving_mass.offset_m", 0.02).description.moving_mass.offset_m == 0.02
    assert zju.value("added_inertia.coupling_kg_m.1.2") == 0.0
    full = vehicle_from_text(changed("[4, 12, 11]", "[[4, 0, 0], [0, 12, 0], [0, 0, 11]]"), "my.toml")
    tensor = full.with_value("rigid_body.inertia_kg_m2.0.2", 0.5).description.rigid_body.inertia_kg_m2
    assert tensor[0][2] == tensor[2][0] == 0.5
    with pytest.raises(FileError, match=r"no number of .* has this key"):
        zju.with_value("moving_mass.colour", 1.0)
