"""What the source of a table says of its keys: the text below each attribute."""

import ast
import inspect

from pydantic import BaseModel

from stommel.files.fields import Table


def attribute_docstrings(model: type[BaseModel]) -> dict[str, str]:
    """Return the text that stands below each attribute in the source of a class or of the tables it inherits from."""
    found = {}
    for table in reversed([base for base in model.__mro__ if issubclass(base, Table) and base is not Table]):
        body = ast.parse(inspect.getsource(table)).body[0]
        assert isinstance(body, ast.ClassDef)
        for before, after in zip(body.body, body.body[1:], strict=False):
            if isinstance(before, ast.AnnAssign) and isinstance(before.target, ast.Name):
                match after:
                    case ast.Expr(ast.Constant(str(text))):
                        found[before.target.id] = " ".join(text.split())
    return found
