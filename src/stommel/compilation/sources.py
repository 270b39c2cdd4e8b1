"""What machine code is made of: the definitions that a module's compiled functions reach, found in the sources as text.

Nothing is imported, and no list is kept by hand. From each compiled function the search follows the names that its text
uses: to other definitions of its module, and through imports to those of other modules of the package. What is found is
hashed without comments, docstrings, annotations and line numbers, for none of them changes the machine code.

The search errs on the safe side: it follows a name wherever the module defines it, also where a local name hides that;
whatever it cannot follow by name, it takes whole. One rule is left to the sources: a module that changes the objects of
another (as Numba's `overload` does) is imported by a decorated function of the module that it changes.
"""

import ast
import hashlib
import os
import sys
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

COMPILER, FLAGS = "compilation", "flags"
"""The package of the decorators, and its module of flags; the rest of it leaves no trace in machine code."""

_ROOTS = "compiled"
"""The decorator whose functions have machine code of their own."""

_ALWAYS = "*"
"""Stands for the imports that count without a use of their name: `from module import *`, and `import module`."""

_Target = tuple[str, str | None]
"""A module, and the name that is wanted of it; None for all of it."""


@dataclass(frozen=True)
class _Statement:
    text: str
    uses: frozenset[str]
    imports: tuple[_Target, ...]
    """Imports within a function: they count where the function does."""


@dataclass
class _Module:
    named: dict[str, list[_Statement]] = field(default_factory=dict)
    acting: list[_Statement] = field(default_factory=list)
    """Statements that may act on what is there: all but plain definitions, plain assignments and imports."""
    imports: dict[str, list[_Target]] = field(default_factory=dict)
    compiled: set[str] = field(default_factory=set)
    standard: set[str] = field(default_factory=set)
    """Names from the standard library, whose decorators act on nothing but what they decorate."""


class Sources:
    """The Python sources of one package, read when they are needed."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.package = root.name
        self._modules: dict[str, _Module] = {}

    @cached_property
    def files(self) -> dict[str, bytes]:
        """Text of every source, by its path within the package."""
        return {path: text for path, (text, _) in self._found.items()}

    @cached_property
    def newest(self) -> float:
        """When the last of the sources came to be as it is [s since 1970]; no tool can set this time back."""
        return max(changed for _, changed in self._found.values())

    @cached_property
    def _found(self) -> dict[str, tuple[bytes, float]]:
        found = {}
        start = len(str(self.root)) + 1
        for folder, _, names in os.walk(self.root):
            for name in names:
                if name.endswith(".py"):
                    with open(f"{folder}/{name}", "rb", buffering=0) as file:  # noqa: PTH123 - in every process
                        found[f"{folder}/{name}"[start:]] = file.read(), os.fstat(file.fileno()).st_ctime
        return dict(sorted(found.items()))

    @cached_property
    def digest(self) -> str:
        """Hash of all sources, byte by byte: any edit at all changes it."""
        digest = hashlib.sha256()
        for path, text in self.files.items():
            digest.update(f"{path}\0{len(text)}\0".encode() + text)
        return digest.hexdigest()

    def compiled_modules(self) -> list[str]:
        """Names of the modules with compiled functions, such as `stommel.analysis.batch`."""
        marked = [path for path, text in self.files.items() if f"@{_ROOTS}".encode() in text]
        names = [".".join((self.package, *Path(path).with_suffix("").parts)) for path in marked]
        return [name.removesuffix(".__init__") for name in names]

    def key_of(self, module: str) -> str:
        """Return the hash of all that the compiled functions of `module` are made of; 32 hexadecimal digits."""
        parts = {f"{name}\0{statement.text}" for name, statement in self._reach(module)}
        return hashlib.sha256("\0".join(sorted(parts)).encode()).hexdigest()[:32]

    def _reach(self, module: str) -> Iterator[tuple[str, _Statement]]:
        roots: Iterable[str | None] = sorted(self._module(module).compiled) or [None]
        todo: list[_Target] = [(module, name) for name in roots]
        todo.append((f"{self.package}.{COMPILER}.{FLAGS}", None))
        seen: set[_Target] = set(todo)
        entered: set[str] = set()
        while todo:
            where, name = todo.pop()
            found = list(self._statements(where, name))
            if where not in entered:
                entered.add(where)
                found += self._module(where).acting
            reached = self._targets(where, name)
            for statement in found:
                yield where, statement
                reached += self._followed(where, statement)
            new = set(reached) - seen
            seen |= new
            todo += new

    def _statements(self, where: str, name: str | None) -> Iterable[_Statement]:
        named = self._module(where).named
        return named.get(name, []) if name is not None else [one for several in named.values() for one in several]

    def _targets(self, where: str, name: str | None) -> list[_Target]:
        """Return where a name that a module imports comes from, or all that the module imports."""
        module = self._module(where)
        if name is None:
            return [target for targets in module.imports.values() for target in targets]
        if name in module.named or name in module.imports:
            return module.imports.get(name, [])
        inner = f"{where}.{name}"
        return [(inner if self._path_of(inner) else where, None)]  # a module, or made in a way that the text hides

    def _followed(self, where: str, statement: _Statement) -> list[_Target]:
        module = self._module(where)
        known = statement.uses & (module.named.keys() | module.imports.keys())
        return [*statement.imports, *module.imports.get(_ALWAYS, []), *((where, name) for name in known)]

    def _module(self, name: str) -> _Module:
        if name not in self._modules:
            self._modules[name] = self._read(name)
        return self._modules[name]

    def _read(self, name: str) -> _Module:
        path = self._path_of(name)
        module = _Module()
        tree = ast.parse(self.files[path])
        package = name if path.endswith("__init__.py") else name.rpartition(".")[0]
        for node in tree.body:
            if not _is_text(node):
                self._file_away(module, node, package)
        return module

    def _file_away(self, module: _Module, node: ast.stmt, package: str) -> None:
        if isinstance(node, ast.If) and _is_type_checking(node.test):
            # names for annotations, and in a package that imports late what it hands out
            for inner in (*node.body, *node.orelse):
                self._file_away(module, inner, package)
        elif isinstance(node, ast.Import | ast.ImportFrom):
            for name, target in self._imported(node, package):
                module.imports.setdefault(name, []).append(target)
            module.standard |= _standard_names(node)
        else:
            _strip(node)
            uses = frozenset(inner.id for inner in ast.walk(node) if isinstance(inner, ast.Name))
            imports = [target for inner in ast.walk(node) for _, target in self._imported(inner, package)]
            statement = _Statement(ast.dump(node), uses, tuple(imports))
            names = _bound_by(node)
            for name in names:
                module.named.setdefault(name, []).append(statement)
            if _acts(node, module.standard):
                module.acting.append(statement)
            if _ROOTS in uses:
                module.compiled |= names

    def _imported(self, node: ast.AST, package: str) -> Iterator[tuple[str, _Target]]:
        """Yield the names that an import of this package binds, and what stands behind each."""
        if isinstance(node, ast.Import):
            for alias in node.names:
                if self._path_of(alias.name):
                    yield _ALWAYS, (alias.name, None)
                    yield alias.asname or self.package, (alias.name, None)
        elif isinstance(node, ast.ImportFrom):
            above = package.split(".")[: len(package.split(".")) + 1 - node.level] if node.level else []
            base = ".".join([*above, *filter(None, [node.module])])
            if self._path_of(base) and base.split(".")[1:2] != [COMPILER]:
                for alias in node.names:
                    yield alias.asname or alias.name, (base, None if alias.name == "*" else alias.name)

    def _path_of(self, module: str) -> str:
        """Path of a module within the package, empty for modules of other packages."""
        first, *inner = module.split(".")
        if first != self.package:
            return ""
        stem = "/".join(inner)
        for path in (f"{stem}/__init__.py" if stem else "__init__.py", f"{stem}.py"):
            if path in self.files:
                return path
        return ""


def _is_text(node: ast.stmt) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)


def _is_type_checking(test: ast.expr) -> bool:
    return isinstance(test, ast.Name) and test.id == "TYPE_CHECKING"


def _standard_names(node: ast.Import | ast.ImportFrom) -> set[str]:
    """Names that an import takes from the standard library."""
    if isinstance(node, ast.ImportFrom):
        inside = not node.level and (node.module or "").partition(".")[0] in sys.stdlib_module_names
        return {alias.asname or alias.name for alias in node.names if inside}
    tops = {alias.asname or alias.name: alias.name.partition(".")[0] for alias in node.names}
    return {name.partition(".")[0] for name, top in tops.items() if top in sys.stdlib_module_names}


def _acts(node: ast.stmt, standard: set[str]) -> bool:
    """Tell whether a statement may act on what is there already, beside binding a name."""
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        return any(_first_name(decorator) not in standard | {_ROOTS, "inlined"} for decorator in node.decorator_list)
    if isinstance(node, ast.Assign | ast.AnnAssign):
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        return not all(isinstance(inner, ast.Name | ast.Tuple) for inner in targets)
    return True


def _first_name(decorator: ast.expr) -> str:
    """Return `a` of the decorators `@a`, `@a.b` and `@a.b(c)`."""
    while isinstance(decorator, ast.Call | ast.Attribute):
        decorator = decorator.func if isinstance(decorator, ast.Call) else decorator.value
    return decorator.id if isinstance(decorator, ast.Name) else ""


def _bound_by(node: ast.stmt) -> set[str]:
    """Names that a statement of a module binds, also within an `if`, a loop or a `try`."""
    if isinstance(node, ast.FunctionDef | ast.ClassDef | ast.AsyncFunctionDef):
        return {node.name}
    inner = list(ast.walk(node))
    names = {one.id for one in inner if isinstance(one, ast.Name) and isinstance(one.ctx, ast.Store)}
    return names | {one.name for one in inner if isinstance(one, ast.FunctionDef | ast.ClassDef)}


def _strip(node: ast.stmt) -> None:
    """Take out of a statement what leaves no trace in machine code: docstrings, and annotations of functions."""
    for inner in ast.walk(node):
        if isinstance(inner, ast.FunctionDef | ast.ClassDef):
            inner.body = [one for one in inner.body if not _is_text(one)] or [ast.Pass()]
        if isinstance(inner, ast.FunctionDef):
            inner.returns = None
            for argument in (*inner.args.posonlyargs, *inner.args.args, *inner.args.kwonlyargs):
                argument.annotation = None
