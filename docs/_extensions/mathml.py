"""Equations as MathML: browsers render it themselves, so the pages need no script and no network.

An equation labelled `eq-4` shows the number (4), and `eq-h3` shows (H3): the number is part of the label, so the
numbers of the paper stay the paper's, and a new equation renumbers nothing.
"""

import re
import unicodedata
from typing import Any
from xml.etree import ElementTree as ET

from docutils import nodes
from latex2mathml.converter import convert
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.writers.html5 import HTML5Translator

logger = logging.getLogger(__name__)

PREFIX = "eq-"
MATHML = "http://www.w3.org/1998/Math/MathML"
ET.register_namespace("", MATHML)

_REWRITTEN = (  # what the converter lacks, in terms of what it knows
    (re.compile(r"\{aligned\}"), "{align*}"),
    (re.compile(r"\\mathrm\b"), r"\\text"),
    (re.compile(r"\|([^|]+)\|"), r"\\left|\1\\right|"),
)
_STYLES = {"bold": "BOLD", "bold-italic": "BOLD ITALIC", "double-struck": "DOUBLE-STRUCK"}
_ACCENTS = set("˙¨^~¯")
_SIGNS = set("+-−±∓")
_CLOSING = set(")]}⊤")
_THIN = {"width": "0.167em"}


def _styled(character: str, style: str) -> str:
    """Return the letter of the Unicode mathematical alphabets: browsers no longer read `mathvariant`."""
    try:
        words = unicodedata.name(character).replace("LATIN ", "").replace("GREEK ", "").replace("LETTER ", "")
        return unicodedata.lookup(f"MATHEMATICAL {style.replace(' ITALIC', '') if 'DIGIT' in words else style} {words}")
    except (KeyError, ValueError):
        return character


def _is(element: ET.Element | None, *names: str) -> bool:
    return element is not None and element.tag.removeprefix(f"{{{MATHML}}}") in names


def _is_function(element: ET.Element) -> bool:
    """Whether it is a name such as sin, with or without an exponent."""
    if _is(element, "msup", "msub"):
        element = element[0]
    return _is(element, "mi") and len(element.text or "") > 1


def _space(row: ET.Element) -> None:
    """Set thin spaces about names of functions, and tell a sign from an operation."""
    children = list(row)
    row[:] = []
    for before, child, after in zip([None, *children], children, [*children[1:], None], strict=False):
        begins = before is None or (_is(before, "mo", "mspace") and before.text not in _CLOSING)
        if _is(child, "mo") and child.text in _SIGNS and begins:
            child.set("form", "prefix")
        function = _is_function(child)
        if function and before is not None and not _is(before, "mo", "mspace") and not _is_function(before):
            row.append(ET.Element(f"{{{MATHML}}}mspace", _THIN))
        row.append(child)
        if function and after is not None and not _is(after, "mo", "mspace"):
            row.append(ET.Element(f"{{{MATHML}}}mspace", _THIN))


def mathml(latex: str, display: str, location: Any = None) -> str:
    """Convert an equation, with a warning for anything that the converter passed through without understanding it."""
    for pattern, replacement in _REWRITTEN:
        latex = pattern.sub(replacement, latex)
    root = ET.fromstring(convert(latex, display=display))  # own text
    for row in [row for row in root.iter() if _is(row, "math", "mrow", "mtd")]:
        _space(row)
    for element in root.iter():
        text = element.text or ""
        if text.startswith("\\") or text == "&":
            logger.warning("equation not understood at %r: %s", text, latex, location=location)
        style = _STYLES.get(element.get("mathvariant", ""))
        if style:
            del element.attrib["mathvariant"]
            element.text = "".join(_styled(character, style) for character in text)
        if _is(element, "mover") and element[-1].text in _ACCENTS:
            element.set("accent", "true")
            element[-1].attrib.pop("stretchy", None)
    return ET.tostring(root, encoding="unicode")


def _visit_inline(self: HTML5Translator, node: nodes.math) -> None:
    self.body.append(mathml(node.astext(), "inline", node))
    raise nodes.SkipNode


def _visit_block(self: HTML5Translator, node: nodes.math_block) -> None:
    self.body.append(self.starttag(node, "div", CLASS="math"))
    self.body.append(mathml(node.astext(), "block", node))
    if node.get("label"):
        self.body.append(f'<span class="eqno">({node["number"]})')
        self.add_permalink_ref(node, "Link to this equation")
        self.body.append("</span>")
    self.body.append("</div>\n")
    raise nodes.SkipNode


def _number_by_label(app: Sphinx, doctree: nodes.document) -> None:
    equations = app.env.domains.math_domain.equations
    for node in doctree.findall(nodes.math_block):
        label = node.get("label")
        if label:
            node["number"] = label.removeprefix(PREFIX).upper()
            equations[label] = (app.env.current_document.docname, node["number"])


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the renderer `mathml`."""
    app.add_html_math_renderer("mathml", (_visit_inline, None), (_visit_block, None))
    app.connect("doctree-read", _number_by_label)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
