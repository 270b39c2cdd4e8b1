"""The report is one well-formed file that stands alone, and its numbers are those of the study and of the paper."""

import dataclasses
import re
from html.parser import HTMLParser

import numpy as np
import pytest

from stommel.design.study import design_study
from stommel.errors import OutputError
from stommel.report import report_html, write_report
from stommel.report.readings import locus_reading, trend
from stommel.report.wording import fixed, signed, unit
from stommel.vehicle import FULL, builtin_names, builtin_text, vehicle_from_text
from tests.support.python import run_python
from tests.support.reports import report_without_pictures

NAMES = pytest.mark.parametrize("name", builtin_names())
VOID = {"meta", "br", "wbr", "link", "img", "hr", "input"}
SECTIONS = (
    "verdict", "specification", "layout", "trim", "envelope", "best", "stability", "loci", "turns", "numbers", "notes",
)  # fmt: skip

# Fan et al. (2013), Tables 1 and 2: speed, pitch, moving mass [mm], angle of attack [deg], ballast [ml]
TABLE_1 = [
    (0.4, -5, 272.0, 5.52, -215.9), (0.4, -10, 291.3, 3.80, -150.3), (0.4, -15, 311.5, 2.78, -112.5),
    (0.4, -20, 332.9, 2.15, -89.2), (0.4, -25, 355.7, 1.72, -74.0), (0.4, -30, 380.6, 1.41, -63.4),
    (0.4, -35, 408.2, 1.17, -55.8), (0.4, -40, 439.3, 0.99, -50.1), (0.4, -45, 475.5, 0.83, -45.7),
    (0.4, -50, 518.6, 0.70, -42.3), (0.4, -55, 571.8, 0.58, -39.6), (0.4, -60, 640.1, 0.48, -37.5),
]  # fmt: skip
TABLE_2 = [
    (0.1, -35, 407.6, 1.17, -3.5), (0.2, -35, 407.7, 1.17, -13.9), (0.3, -35, 407.9, 1.17, -31.4),
    (0.4, -35, 408.2, 1.17, -55.8), (0.5, -35, 408.5, 1.17, -87.2), (0.6, -35, 408.9, 1.17, -125.5),
    (0.7, -35, 409.4, 1.17, -170.8), (0.8, -35, 410.0, 1.17, -223.1),
]  # fmt: skip


class Page(HTMLParser):
    """Checks nesting and identifiers; keeps attributes, text by element, and the cells of tables with an id."""

    def __init__(self, html):
        super().__init__()
        self.open, self.ids, self.attributes, self.tags = [], [], [], []
        self.tables, self.text, self._rows = {}, "", None
        self.feed(html)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.attributes += [(tag, *pair) for pair in attrs]
        named = dict(attrs)
        if "id" in named:
            self.ids.append(named["id"])
        if tag not in VOID:
            self.open.append(tag)
        if tag == "table":
            self._rows = self.tables.setdefault(named.get("id", f"table {len(self.tables)}"), [])
        elif tag == "tr":
            self._rows.append([])
        elif tag in ("td", "th") and self._rows is not None:
            self._rows[-1].append("")

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.handle_endtag(tag)

    def handle_endtag(self, tag):
        assert self.open, f"</{tag}> closes nothing"
        assert self.open.pop() == tag
        if tag == "table":
            self._rows = None

    def handle_data(self, data):
        if self.open and self.open[-1] not in ("style", "script"):
            self.text += data
        if self._rows and self._rows[-1] and {"td", "th"} & set(self.open):
            self._rows[-1][-1] += data


def number(cell):
    return float(cell.replace("−", "-"))


@pytest.fixture(scope="module")
def page(report_of):
    return Page(report_of("zju"))


@NAMES
def test_reports_are_well_formed_with_every_section_and_unique_identifiers(report_of, name):
    html = report_of(name)
    assert html.startswith("<!DOCTYPE html>")
    page = Page(html)
    assert len(page.ids) == len(set(page.ids))
    assert [i for i in page.ids if i in SECTIONS] == list(SECTIONS)
    inside = {value.removeprefix("#") for _, key, value in page.attributes if key in ("href", "xlink:href")}
    assert inside <= set(page.ids)
    clips = set(re.findall(r"url\(#([^)]+)\)", html))
    assert clips
    assert clips <= set(page.ids)


@NAMES
def test_reports_need_no_network_and_no_script(report_of, name):
    page = Page(report_of(name))
    assert not {"script", "link", "iframe", "object", "embed"} & set(page.tags)
    for tag, key, value in page.attributes:
        if key in ("src", "href", "xlink:href", "action", "data"):
            assert value.startswith("#"), (tag, key, value)
        assert not key.startswith("on")
    assert "@import" not in report_of(name)
    assert not re.search(r"url\((?!#)", report_of(name))


@NAMES
def test_reports_leave_no_number_undefined(report_of, name):
    text = Page(report_of(name)).text
    assert not re.search(r"\b(nan|None|inf|Undefined)\b", text)
    assert "{{" not in text


@pytest.mark.parametrize(("table", "printed"), [("trim-table-1", TABLE_1), ("trim-table-2", TABLE_2)])
def test_trim_tables_stand_beside_the_published_ones(page, table, printed):
    rows = page.tables[table][2:]
    assert len(rows) == len(printed)
    for row, (speed, pitch, mass, alpha, ballast) in zip(rows, printed, strict=True):
        cells = [number(cell) for cell in row[:11]]
        assert cells[:2] == [speed, pitch]
        # half a unit of the last printed digit, as the paper rounds, and half of ours
        for (found, published, difference), expected, slack in (
            (cells[2:5], mass, 0.055), (cells[5:8], alpha, 0.0075), (cells[8:11], ballast, 0.065),
        ):  # fmt: skip
            assert published == expected
            assert found == pytest.approx(expected, abs=slack)
            assert difference == pytest.approx(found - published, abs=0.0101)


def test_rows_beyond_a_limit_are_flagged_with_the_limit(page):
    flagged = [row for row in page.tables["trim-table-1"][2:] if "beyond" in row[-1]]
    assert [number(row[1]) for row in flagged] == [-55.0, -60.0]
    assert all("550 mm" in row[-1] for row in flagged)
    assert all("within" in row[-1] for row in page.tables["trim-table-2"][2:])


def test_the_verdict_reaches_the_papers_choices(page):
    assert "±300 mm" in page.text
    assert "Needed: ±268.6 mm about neutral at 250 mm" in page.text
    assert "±250 ml" in page.text
    assert "10 of 11 requirements met; not met: Endurance." in page.text
    assert "stable" in page.text


def test_the_verdict_says_what_fails():
    text = (
        builtin_text("zju")
        .replace("value = [-50, 550]", "value = [0, 500]")
        .replace("value = 0.8, source", "value = 0.9, source")
    )
    page = Page(report_without_pictures(design_study(vehicle_from_text(text, "mine.toml"))))
    assert "0 to 500 mm: not enough" in page.text
    assert re.search(r"not met: [^.]*Speed", page.text)
    assert [row[4] for row in page.tables["specification-table"] if row[0] == "Speed"] == ["not met"]


def test_the_mode_table_holds_the_modes_of_the_study(page, zju):
    rows = {row[0]: row for row in page.tables["modes-table"] if len(row) == 7}
    for mode in (*zju.modes.longitudinal, *zju.modes.lateral):
        row = rows[mode.name]
        assert number(row[1].split(" ±")[0]) == pytest.approx(mode.eigenvalue.real, abs=5.1e-5)
        assert number(row[2]) == pytest.approx(mode.natural_frequency, abs=5.1e-5)
        assert number(row[3]) == pytest.approx(mode.damping_ratio, abs=5.1e-4)
        assert number(row[5]) == pytest.approx(mode.time_to_half, abs=5.1e-3)
        assert (" ± " in row[1]) is mode.oscillatory


def test_the_matrices_are_those_of_the_study(report_of, zju):
    page = Page(report_of("zju"))
    matrix = next(rows for rows in page.tables.values() if rows[0][-1] == "B" and rows[1][1].startswith("u"))
    found = np.array([[float(cell) for cell in row[1:]] for row in matrix[2:]])
    model = zju.linear.longitudinal
    assert found == pytest.approx(np.hstack([model.A, model.B]), rel=1e-5, abs=1e-12)


def test_every_number_of_the_vehicle_file_is_listed_with_its_unit_assumptions_first(report_of, zju):
    html = report_of("zju")
    page = Page(html)
    listed = [row for rows in page.tables.values() if rows[0][0].startswith("Key") for row in rows[1:]]
    assert [row[0] for row in listed] != []
    assert {row[0] for row in listed} == {key for key, _, _ in zju.numbers if key != "format"}
    assert all(row[2] and row[3] for row in listed)
    assumed = [key for key, _, origin in zju.numbers if origin.kind == "assumption"]
    assert [row[0] for row in listed[: len(assumed)]] == assumed


def test_units_of_keys():
    assert unit("hydrodynamics.lift_per_rad_kg_m") == "kg/m per rad"
    assert unit("hydrodynamics.drag_per_rad2_kg_m") == "kg/m per rad²"
    assert unit("rigid_body.inertia_kg_m2") == "kg m²"
    assert unit("water.temperature_c") == "°C"


def test_a_name_from_a_users_file_is_escaped():
    text = builtin_text("zju").replace('name = "ZJU glider"', "name = '<script>alert(\"x\")</script>'")
    text = text.replace('"wet nose"', "'<b>$\\x & $nose'").replace("500 ml at", "<img src=x> 500 ml at")
    html = report_html(design_study(vehicle_from_text(text, "<i>.toml")))
    assert "<script" not in html
    assert "<img" not in html
    assert "<i>" not in html
    assert "&lt;script&gt;alert(&#34;x&#34;)&lt;/script&gt;" in html
    Page(html)


@pytest.mark.parametrize(
    ("name", "sentences"),
    [
        ("rogue", ["There is no envelope, because", "There are no turns, because", "Not known for this vehicle.",
                   "There is no root locus over wing position, because", "has no table [specification]",
                   "the lateral plane is left out, because"]),
        ("slocum", ["There are no turns, because", "can steer neither by rudder nor", "at the stall angle"]),
        ("seawing", ["There is no root locus over rudder position, because", "with rolled mass at"]),
    ],
)  # fmt: skip
def test_parts_without_an_answer_are_said_to_be_missing(report_of, name, sentences):
    text = " ".join(Page(report_of(name)).text.split())
    for sentence in sentences:
        assert sentence in text


def test_the_reading_of_a_locus_follows_from_its_numbers(zju):
    wing, rudder = zju.loci
    words = " ".join(locus_reading(rudder, zju.modes))
    assert "the decay rate of the roll oscillation grows throughout from 0.42 to 0.443 1/s" in words
    assert "stability is paid for with control authority" in words
    backwards = dataclasses.replace(
        rudder, values=rudder.values[::-1], lateral=rudder.lateral[::-1], authorities=rudder.authorities[::-1]
    )
    words = " ".join(locus_reading(backwards, zju.modes))
    assert "roll oscillation falls throughout from 0.443 to 0.42 1/s" in words
    assert "authority is paid for with stability" in words
    # section 3.2 of the paper: a wing farther aft damps, and limits pitch control
    words = " ".join(locus_reading(wing, zju.modes))
    assert "the decay rate of the short period grows throughout" in words
    assert "stability is paid for with control authority" in words
    unstable = dataclasses.replace(rudder, lateral=rudder.lateral + 0.1)
    assert "The vehicle is unstable at 0.5 to" in " ".join(locus_reading(unstable, zju.modes))


def test_trend():
    assert [trend(np.array(v)) for v in ([1.0, 2.0], [2.0, 1.0], [1.0, 1.001], [1.0, 2.0, 1.0])] == [1, -1, 0, 2]


def test_numbers_have_a_proper_minus_and_no_negative_zero():
    assert [fixed(-0.001), fixed(-1.25, 1), signed(0.001), signed(0.5), signed(-0.5)] == [
        "0.00", "−1.2", "0.00", "+0.50", "−0.50",
    ]  # fmt: skip


def test_the_same_study_gives_the_same_bytes(study_of, report_of):
    """In this process; tests/cli compares with another."""
    assert report_html(study_of("rogue")) == report_of("rogue")


def test_the_report_says_how_to_make_it_again(report_of):
    assert "<code>stommel design zju</code>" in report_of("zju")
    mine = vehicle_from_text(builtin_text("rogue"), "my gliders/mine.toml")
    html = report_without_pictures(design_study(mine, physics=FULL))
    assert "<code>stommel design &#39;my gliders/mine.toml&#39; --physics full</code>" in html
    assert "“full”" in html


def test_written_whole_or_not_at_all(study_of, report_of, tmp_path):
    path = tmp_path / "new" / "report.html"
    write_report(study_of("rogue"), path)
    assert path.read_text(encoding="utf-8") == report_of("rogue")
    with pytest.raises(OutputError, match="cannot be written"):
        write_report(study_of("rogue"), path / "below.html")
    assert [entry.name for entry in path.parent.iterdir()] == ["report.html"]


def test_importing_the_report_does_not_load_matplotlib_or_jinja():
    code = "import sys, stommel.report; print([m for m in ('matplotlib', 'jinja2') if m in sys.modules])"
    assert run_python("-c", code).strip() == "[]"
