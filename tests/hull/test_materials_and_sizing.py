"""Materials as data, and properties that every sized hull must have."""

from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from stommel.design.hull import hull_study
from stommel.design.hull.ranking import ranked
from stommel.design.hull.requirement import requirement
from stommel.design.hull.sizing import size, size_by_paper
from stommel.errors import FileError
from stommel.machinery.hull import MaterialError, find_material, load_materials
from stommel.machinery.hull.buckling import RingSection, von_mises, windenburg_trilling
from stommel.vehicle import load_vehicle, vehicle_from_text
from stommel.vehicle.loading import builtin_text

MATERIALS = load_materials()
NEED = requirement(load_vehicle("zju"))


def test_every_number_has_an_origin() -> None:
    for material in MATERIALS:
        stated = {key for key, value in material.properties if isinstance(value, int | float) and value is not None}
        assert stated <= set(material.provenance), f"{material.name}: {stated - set(material.provenance)}"


def test_carbon_fibre_follows_from_its_lamina() -> None:
    """Oracle: classical laminate theory, AS4/3501-6 of Soden, Hinton and Kaddour (1998), plies at 0, ±45, 90 deg."""
    E_1, E_2, G, nu = 126e9, 11e9, 6.6e9, 0.28
    d = 1 - nu**2 * E_2 / E_1
    Q = E_1 / d, E_2 / d, nu * E_2 / d, G
    U_1 = (3 * Q[0] + 3 * Q[1] + 2 * Q[2] + 4 * Q[3]) / 8
    U_4 = (Q[0] + Q[1] + 6 * Q[2] - 4 * Q[3]) / 8
    carbon = find_material("carbon-fibre", MATERIALS)
    modulus = (U_1**2 - U_4**2) / U_1
    assert pytest.approx(modulus, rel=2e-3) == carbon.E
    assert carbon.nu == pytest.approx(U_4 / U_1, abs=1e-3)
    assert carbon.sigma_fail == pytest.approx(1480e6 / E_1 * modulus, rel=2e-3)


@pytest.mark.parametrize(
    ("name", "found"),
    [("tc4", "TC4"), ("12Gr1MoV", "12Cr1MoV"), ("Ti-6Al-4V", "TC4"), ("6061 t6", "6061-T6"), ("ceramic", "alumina")],
)
def test_names_as_people_write_them(name: str, found: str) -> None:
    assert find_material(name, MATERIALS).name == found


def test_unknown_material() -> None:
    with pytest.raises(MaterialError, match=r"'6061-T7': unknown; did you mean 6061-T6\? known materials: 12Cr1MoV"):
        find_material("6061-T7", MATERIALS)


@settings(max_examples=60, deadline=None)
@given(
    material=st.sampled_from(MATERIALS),
    pressure=st.floats(0.2e6, 12e6),
    length=st.floats(0.1, 1.4),
    D_o=st.floats(0.1, 0.4),
)
def test_the_required_wall_meets_every_criterion_of_the_paper(material, pressure, length, D_o) -> None:  # type: ignore[no-untyped-def]
    need = replace(NEED, P=pressure, L=length, D_o=D_o, D_i=None)
    hull = size(material, need)
    assert hull.required_wall >= hull.exact_wall - 1e-12
    assert hull.required_wall - hull.exact_wall < 1.0001e-4
    for criterion in hull.criteria[1:3]:
        assert criterion.permissible >= pressure * (1 - 1e-9)
    assert not [warning for warning in hull.warnings if warning.name == "wall too thin"]
    assert not hull.failed
    assert not [warning for warning in hull.warnings if warning.name == "classical criterion not met"]
    # a wall thinner by more than the rounding is found out
    thin = size(material, need, hull.exact_wall - 2e-5)
    assert [warning for warning in thin.warnings if warning.name == "wall too thin"]


@settings(max_examples=40, deadline=None)
@given(
    material=st.sampled_from(MATERIALS),
    pressure=st.floats(0.2e6, 12e6),
    length=st.floats(0.1, 1.4),
    knock_down=st.floats(0.5, 1.0),
)
def test_a_raised_wall_is_the_least_that_does(material, pressure, length, knock_down) -> None:  # type: ignore[no-untyped-def]
    """0.1 mm less fails what the wall was raised for, by the formulas themselves; no wall was raised without need."""
    need = replace(NEED, P=pressure, L=length, D_i=None, knock_down=knock_down)
    hull = size(material, need)
    paper = size_by_paper(material, need)
    assert hull.raised_for == paper.failed
    if hull.raised_for:
        less = size(material, need, hull.tube.delta - 1e-4)
        assert less.failed
        assert set(less.failed) <= set(hull.raised_for)
        lobes = von_mises(less.tube.delta, less.tube.R, length, material.E, material.nu).pressure
        fit = windenburg_trilling(less.tube.delta, less.tube.R, length, material.E, material.nu)
        assert knock_down * min(lobes, fit) < need.m_c * pressure or "Lame" in less.failed[0]
    else:
        assert hull.tube.delta == paper.tube.delta


def test_ceramic_over_a_long_bay_is_raised_and_says_so() -> None:
    """At 1.2 m Eq. (9) asks 3.5 mm of alumina, which von Mises's lobes collapse at 361 m where 400 m are wanted."""
    alumina, need = find_material("alumina", MATERIALS), replace(NEED, L=1.2)
    paper = size_by_paper(alumina, need)
    assert paper.depth(paper.collapse.pressure) == pytest.approx(361, abs=1)
    assert paper.failed == ("von Mises, n lobes",)
    hull = size(alumina, need)
    assert hull.tube.delta == pytest.approx(3.7e-3)
    assert hull.depth(hull.collapse.pressure) > 400
    (row,) = ranked([hull])
    assert "raised to 3.7 mm: the 3.5 mm of Eqs. (8) to (10) fail von Mises, n lobes at 1.2 m" in row.reasons


def test_a_wall_that_fails_comes_last_and_says_so() -> None:
    """5 mm of every material over 1.2 m: those that fail a criterion stand below those that do not, and name it."""
    rows = ranked([size(material, replace(NEED, L=1.2, D_i=None), 5e-3) for material in MATERIALS])
    fails = [bool(row.hull.failed) for row in rows]
    assert fails == sorted(fails)
    assert any(fails)
    assert not all(fails)
    for row in rows:
        assert any(reason.startswith("fails ") for reason in row.reasons) is bool(row.hull.failed)


def test_knock_down_is_a_share_of_the_buckling_round_the_circumference() -> None:
    """Twice the safety factor and half the pressure are the same wall; yield and buckling along the axis stay."""
    titanium = find_material("TC4", MATERIALS)
    plain, knocked = size(titanium, NEED, 4.2e-3), size(titanium, replace(NEED, knock_down=0.5), 4.2e-3)
    shares = {b.name: b.pressure / a.pressure for a, b in zip(plain.criteria, knocked.criteria, strict=True)}
    round_it = {"circumferential buckling, Eq. (9)", "von Mises, n lobes", "Windenburg and Trilling"}
    assert shares == {name: pytest.approx(0.5 if name in round_it else 1.0) for name in shares}
    half, twice = replace(NEED, knock_down=0.5), replace(NEED, m_c=2 * NEED.m_c)
    assert size(titanium, half).tube.delta == size(titanium, twice).tube.delta


@pytest.mark.parametrize("material", MATERIALS, ids=lambda material: material.name)
def test_formulas_and_their_inverses(material) -> None:  # type: ignore[no-untyped-def]
    """Each exact wall is permitted exactly the working pressure by the criterion that asked for it."""
    hull = size(material, NEED)
    for index, wall in enumerate((hull.yield_wall, hull.circumferential_wall, hull.axial_wall)):
        assert size(material, NEED, wall).criteria[index].permissible == pytest.approx(NEED.P, rel=1e-12)


def test_yield_without_an_inner_diameter() -> None:
    """Eq. (8) with D_i = D_o - 2 delta holds for the wall that is found."""
    need = replace(NEED, D_i=None, C=0.3e-3, phi_s=0.8)
    hull = size(find_material("LY12", MATERIALS), need)
    delta = hull.yield_wall
    inner = need.D_o - 2 * delta
    assert need.P * inner / (2 * hull.sigma * need.phi_s - need.P) + need.C == pytest.approx(delta, rel=1e-12)


def test_rings_save_wall_and_add_a_criterion() -> None:
    titanium = find_material("TC4", MATERIALS)
    ringed = size(titanium, replace(NEED, rings=RingSection(0.15, 0.012, 0.004)))
    assert ringed.required_wall < size(titanium, NEED).required_wall
    assert "rings and tube, Bryant" in [criterion.name for criterion in ringed.criteria]


def test_ranking_follows_its_marks() -> None:
    rows = ranked([size(material, NEED) for material in MATERIALS])
    fitting = [row for row in rows if row.hull.fits]
    assert [row.score for row in fitting] == sorted((row.score for row in fitting), reverse=True)
    assert [row.hull.fits for row in rows] == sorted((row.hull.fits for row in rows), reverse=True)
    lightest = ranked([row.hull for row in fitting], {"mass": 1.0})
    assert lightest[0].hull.tube.mass == min(row.hull.tube.mass for row in fitting)
    assert lightest[0].score == 1.0


def test_own_hull_thinner_than_its_criterion_is_named() -> None:
    text = builtin_text("zju").replace("wall_mm = { value = 4.2", "wall_mm = { value = 3")
    study = hull_study(vehicle_from_text(text, "zju.toml"))
    named = {warning.name: warning.message for warning in study.warnings}
    assert "3 mm is less than the 4.18 mm" in named["wall too thin"]
    assert "classical criterion not met" in named


def test_own_unknown_material_is_named() -> None:
    text = builtin_text("zju").replace('"titanium alloy TC4"', '"unobtainium"')
    study = hull_study(vehicle_from_text(text, "mine.toml"))
    assert study.own is None
    assert [warning.name for warning in study.warnings] == ["unknown material"]


def test_the_papers_diameters_and_wall_disagree() -> None:
    names = [warning.name for warning in hull_study(load_vehicle("zju")).warnings]
    assert "diameters and wall disagree" in names


def test_longest_dry_bay_if_no_length_is_given() -> None:
    text = builtin_text("zju")
    (line,) = [line for line in text.splitlines() if line.startswith("checked_length_m")]
    need = requirement(vehicle_from_text(text.replace(line, ""), "mine.toml"))
    assert need.L == 0.75
    assert any("longest dry bay" in note for note in need.notes)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("[", "not valid TOML"),
        ("[x]\ntitle = 'x'\n", "[x] elastic_modulus_mpa is missing"),
        (
            "[x]\ntitle='x'\nelastic_modulus_mpa=-1\npoisson_ratio=0.3\ndensity_kg_m3=1000\nthermal_expansion_per_k=0\n"
            "corrosion_grade=3\ncorrosion=''\nmachinability_grade=3\nmachinability=''\n",
            "[x] elastic_modulus_mpa = -1: must be between 10 and 1500000 MPa",
        ),
        (
            "[x]\ntitle='x'\nelastic_modulus_mpa=1e5\npoisson_ratio=0.3\ndensity_kg_m3=1000\n"
            "thermal_expansion_per_k=0\ncorrosion_grade=3\ncorrosion=''\nmachinability_grade=3\nmachinability=''\n"
            "yield_stress_mpa=100\n",
            "[x] needs yield_stress_mpa and tensile_stress_mpa",
        ),
    ],
)
def test_bad_tables_of_materials(tmp_path: Path, content: str, words: str) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(content)
    with pytest.raises(FileError) as caught:
        load_materials(path)
    assert words in str(caught.value)
    assert "mine.toml" in str(caught.value)
