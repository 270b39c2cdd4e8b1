"""The navigation beside a page is made from titles alone.

For each page Sphinx copies what is on all other pages and then keeps their titles: with every function of the reference
in it, that is two thirds of the time of a build.
"""

from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx


def setup(app: Sphinx) -> dict[str, Any]:
    """Let the theme ask for the navigation while the environment knows titles alone."""
    titles: dict[str, nodes.bullet_list] = {}

    def shorten(app: Sphinx, _builder: object) -> None:
        titles.update({name: _titles(toc) for name, toc in app.env.tocs.items()})

    def wrap(app: Sphinx, _name: str, _template: str, context: dict[str, Any], _doctree: object) -> None:
        whole, made = app.env.tocs, context.get("toctree")
        if made is None:
            return

        def toctree(**asked: object) -> str:
            app.env.tocs = titles
            try:
                return str(made(**asked))
            finally:
                app.env.tocs = whole

        context["toctree"] = toctree

    app.connect("write-started", shorten)
    app.connect("html-page-context", wrap, priority=400)  # before the theme asks
    return {"parallel_read_safe": True, "parallel_write_safe": False}


def _titles(toc: nodes.bullet_list) -> nodes.bullet_list:
    """A copy without the lists in which no other page is named."""
    short = toc.deepcopy()
    for inner in list(short.findall(nodes.bullet_list)):
        if inner.parent is not None and next(iter(inner.findall(addnodes.toctree)), None) is None:
            inner.parent.remove(inner)
    return short
