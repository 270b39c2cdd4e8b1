"""Verdicts and tones of the report follow from the requirement and from the side that matters, one way at a time.

The oracle is arithmetic on what the file gives: zju needs +-268.6 mm about 250 mm and +-223.2 ml (section 3.1 of the
paper, checked in test_report), so a range is enough when its *smaller* side is, and a requirement that is met in dives
alone is not met.
"""

import dataclasses
import re
from collections.abc import Callable

import pytest

from stommel.design.specification import SpecificationRow, specification_check
from stommel.design.study import DesignStudy
from stommel.report.verdict import Answer, summary, verdict
from stommel.vehicle import PAPER, Vehicle, builtin_text, vehicle_from_text
from tests.report.test_report import Page
from tests.support.reports import report_without_pictures

TRAVEL = "travel_mm = { value = [-50, 550]"
VOLUME = "volume_ml = { value = [-250, 250]"


def changed(*changes: tuple[str, str]) -> Vehicle:
    text = builtin_text("zju")
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    return vehicle_from_text(text, "mine.toml")


def answer(study: DesignStudy, question: str) -> Answer:
    (found,) = (one for one in verdict(study) if one.question.startswith(question))
    return found


@pytest.mark.parametrize(
    ("low", "high", "enough"),
    [
        (-250, 250, True), (-224, 224, True), (-222, 222, False), (-250, 200, False), (-200, 250, False),
        (-222, 278, False), (-278, 222, False), (-224, 276, True),
    ],
)  # fmt: skip
def test_ballast_is_judged_by_its_smaller_side(zju: DesignStudy, low: int, high: int, enough: bool) -> None:
    mine = changed((VOLUME, f"volume_ml = {{ value = [{low}, {high}]"))
    found = answer(dataclasses.replace(zju, vehicle=mine), "Ballast volume")
    assert found.tone == ("good" if enough else "bad")
    words = f"The file gives {low} to {high} ml: {'enough' if enough else 'not enough'}.".replace("-", "−")
    assert found.detail.endswith(words)
    assert found.value == "±250 ml"


@pytest.mark.parametrize(
    ("low", "high", "enough"),
    [
        (-50, 550, True), (-19, 519, True), (-18, 550, False), (-50, 518, False), (-18, 700, False), (-300, 518, False),
        (-19, 700, True),
    ],
)  # fmt: skip
def test_travel_is_judged_about_neutral_by_its_smaller_side(
    zju: DesignStudy, low: int, high: int, enough: bool
) -> None:
    """Neutral is at 250 mm: from -18.6 to 518.6 mm is needed."""
    mine = changed((TRAVEL, f"travel_mm = {{ value = [{low}, {high}]"))
    found = answer(dataclasses.replace(zju, vehicle=mine), "Moving-mass range")
    assert found.tone == ("good" if enough else "bad")
    assert f"{low} to {high} mm: {'enough' if enough else 'not enough'}.".replace("-", "−") in found.detail


def row(name: str, met: bool | None, found: float | None = 1.0, required: float = 2.0) -> SpecificationRow:
    return SpecificationRow(name, "1", required, found, met, "")


@pytest.mark.parametrize(
    ("verdicts", "tone", "words"),
    [
        ((True, True), "good", "2 of 2 requirements met."),
        ((True, False), "bad", "1 of 2 requirements met; not met: b."),
        ((False, True), "bad", "1 of 2 requirements met; not met: a."),
        ((False, False), "bad", "0 of 2 requirements met; not met: a, b."),
        ((True, None), "good", "1 of 2 requirements met; cannot be told: b."),
        ((None, False), "bad", "0 of 2 requirements met; not met: b; cannot be told: a."),
    ],
)
def test_one_requirement_that_is_missed_makes_the_banner_bad(
    zju: DesignStudy, verdicts: tuple[bool | None, ...], tone: str, words: str
) -> None:
    rows = tuple(row(name, met) for name, met in zip("ab", verdicts, strict=True))
    assert summary(dataclasses.replace(zju, specification=rows)) == (words, tone)


def test_nothing_to_hold_it_against_is_neither_good_nor_bad(zju: DesignStudy) -> None:
    assert summary(dataclasses.replace(zju, specification=()))[1] == "unknown"


@pytest.mark.parametrize(
    ("dive", "climb", "tone", "value"),
    [
        ((True, 53.0), (True, 51.0), "good", "±51.0°"),
        ((True, 53.0), (False, 20.0), "bad", "±20.0°"),
        ((False, 21.0), (True, 53.0), "bad", "±21.0°"),
        ((True, 53.0), (False, None), "bad", "none"),
    ],
)
def test_pitch_is_told_by_its_worse_way(
    zju: DesignStudy, dive: tuple[bool, float], climb: tuple[bool, float | None], tone: str, value: str
) -> None:
    rows = tuple(
        row(f"Pitch, {way}", met, found, 50.0) for way, (met, found) in (("diving", dive), ("climbing", climb))
    )
    found = answer(dataclasses.replace(zju, specification=rows), "Steepest pitch")
    assert (found.tone, found.value) == (tone, value)
    told = "none" if climb[1] is None else f"{climb[1]:.1f}°"
    assert f"diving: {dive[1]:.1f}°; climbing: {told}; wanted ±50°" in found.detail


@pytest.mark.parametrize(("met", "tone"), [(True, "good"), (False, "bad"), (None, "plain")])
def test_speed_is_good_where_the_wanted_one_is_reached(zju: DesignStudy, met: bool | None, tone: str) -> None:
    found = answer(dataclasses.replace(zju, specification=(row("Speed", met, 0.7, 0.8),)), "Greatest speed")
    assert found.tone == tone
    assert ("At the design pitch: 0.7 m/s; wanted 0.8 m/s." in found.detail) is (met is not None)
    fastest = max(one.fastest.V for one in zju.envelope or () if one.fastest)
    assert found.value == f"{fastest:.2f} m/s"


def test_one_mode_that_grows_is_unstable(zju: DesignStudy) -> None:
    assert answer(zju, "Stability").tone == "good"
    slowest = max((*zju.modes.longitudinal, *(zju.modes.lateral or ())), key=lambda mode: mode.eigenvalue.real)
    told = answer(zju, "Stability").detail
    assert f"the slowest, {slowest.name}, halves in {0.6931472 / -slowest.eigenvalue.real:.1f} s" in told
    for plane in ("longitudinal", "lateral"):
        modes = getattr(zju.modes, plane)
        for k in range(len(modes)):
            grown = dataclasses.replace(modes[k], eigenvalue=complex(0.05, 0.0))
            other = dataclasses.replace(zju.modes, **{plane: (*modes[:k], grown, *modes[k + 1 :])})
            found = answer(dataclasses.replace(zju, modes=other), "Stability")
            assert (found.value, found.tone) == ("unstable", "bad")
            assert found.detail.endswith(f": {grown.name}; the fastest doubles in 13.9 s.")


def test_a_best_glide_beyond_a_limit_is_bad(zju: DesignStudy) -> None:
    assert answer(zju, "Best glide").tone == "plain"
    short = changed((TRAVEL, "travel_mm = { value = [240, 550]"))
    found = answer(dataclasses.replace(zju, vehicle=short), "Best glide")
    assert found.tone == "bad"


def met_of(vehicle: Vehicle) -> dict[str, bool | None]:
    return {one.name: one.met for one in specification_check(vehicle, PAPER)}


ONE_WAY = [
    (TRAVEL, "travel_mm = { value = [200, 550]", {"Pitch, diving": True, "Pitch, climbing": False}),
    (TRAVEL, "travel_mm = { value = [-50, 300]", {"Pitch, diving": False, "Pitch, climbing": True}),
    (VOLUME, "volume_ml = { value = [-250, 20]",
     {"Pitch, diving": True, "Pitch, climbing": False, "Speed": True, "Oil volume": False}),
    (VOLUME, "volume_ml = { value = [-20, 250]",
     {"Pitch, diving": False, "Pitch, climbing": True, "Speed": False, "Oil volume": False}),
    (VOLUME, "volume_ml = { value = [-200, 300]", {"Oil volume": True, "Speed": False}),
    ("depth_rating_m = { value = 200", "depth_rating_m = { value = 199", {"Depth": False}),
    ("depth_rating_m = { value = 200", "depth_rating_m = { value = 300", {"Depth": True}),
    ("travel_deg = { value = 60", "travel_deg = { value = 59", {"Rudder": False}),
    ("travel_deg = { value = 60", "travel_deg = { value = 70", {"Rudder": True}),
    ("length_m = 1.5", "length_m = 1.51", {"Body length": True, "Overall length": True}),
    ("body_length_m = 1.5", "body_length_m = 1.49", {"Body length": False, "Overall length": True}),
    ("overall_length_m = 2.1", "overall_length_m = 2.0", {"Body length": True, "Overall length": False}),
    ("diameter_mm = 220", "diameter_mm = 219", {"Diameter": False}),
    ("diameter_mm = 220", "diameter_mm = 230", {"Diameter": True}),
    ("mass_kg = 60", "mass_kg = 59", {"Mass": False}),
    ("mass_kg = 60", "mass_kg = 61", {"Mass": True}),
    ("oil_volume_ml = 500", "oil_volume_ml = 501", {"Oil volume": False}),
    ("oil_volume_ml = 500", "oil_volume_ml = 499", {"Oil volume": True}),
    ("endurance_days = 20", "endurance_days = 11", {"Endurance": True}),
    ("endurance_days = 20", "endurance_days = 12", {"Endurance": False}),
]  # fmt: skip


@pytest.mark.parametrize(
    ("old", "new", "expected"), ONE_WAY, ids=[f"{new} ({k})" for k, (_, new, _) in enumerate(ONE_WAY)]
)
def test_a_requirement_is_met_from_its_own_side(old: str, new: str, expected: dict[str, bool]) -> None:
    found = met_of(changed((old, new)))
    assert {name: found[name] for name in expected} == expected


def test_tones_reach_the_page(study_of: Callable[[str], DesignStudy], zju: DesignStudy) -> None:
    one_way = changed((VOLUME, "volume_ml = { value = [-250, 200]"))
    html = report_without_pictures(dataclasses.replace(zju, vehicle=one_way))
    tones = re.findall(r'<article class="answer (\w+)">\s*<h3>([^<]+)</h3>', html)
    assert {question: tone for tone, question in tones} == {
        "Moving-mass range": "good", "Ballast volume": "bad", "Stability, actuators fixed": "good",
        "Greatest speed": "good", "Steepest pitch": "good", "Best glide": "plain", "Tightest turn": "plain",
    }  # fmt: skip
    assert '<p class="banner bad">' in html
    section = html.split('<section id="specification">')[1].split("</section>")[0]
    chips = re.findall(r'<span class="chip (\w+)">(met|not met|cannot tell)</span>', section)
    assert [tone for tone, _ in chips] == ["good" if one.met else "bad" for one in zju.specification]
    assert [words for _, words in chips] == ["met" if one.met else "not met" for one in zju.specification]
    rogue = report_without_pictures(study_of("rogue"))
    assert '<p class="banner unknown">' in rogue
    assert 'class="answer unknown"' in rogue
    assert Page(html).tables["specification-table"][1:]
