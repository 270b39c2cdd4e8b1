"""Numba's cache of one function, in the folder and with the key that stommel gives it."""

import uuid
from pathlib import Path
from typing import Any

import llvmlite
import numpy as np
from numba.core import types
from numba.core.caching import CompileResultCacheImpl, FunctionCache, IndexDataCacheFile, _CacheLocator

from stommel.compilation.cache import folder_of


class _Locator(_CacheLocator):
    """The folder's name is the hash of what the function is made of: neither times nor line numbers matter."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def get_cache_path(self) -> str:
        return str(self._folder)

    def get_source_stamp(self) -> tuple[str, str]:
        return llvmlite.__version__, np.__version__

    def get_disambiguator(self) -> str:
        return "stommel"

    @classmethod
    def from_function(cls, py_func: Any, py_file: str) -> "_Locator | None":  # noqa: ARG003 - Numba's signature
        folder = folder_of(py_func.__module__)
        return None if folder is None else cls(folder)


class _Implementation(CompileResultCacheImpl):
    _locator_classes: list[type[object]] = [_Locator]  # noqa: RUF012 - Numba declares it so


class _Index(IndexDataCacheFile):
    def _data_name(self, number: int) -> str:
        """Name a file of machine code as no other process does: by number alone, two at once take the same name."""
        name: str = super()._data_name(number)  # type: ignore[no-untyped-call]  # Numba is untyped
        return name.replace(".nbc", f"-{uuid.uuid4().hex[:12]}.nbc")


class MachineCode(FunctionCache):
    """What a dispatcher asks for machine code before it compiles."""

    _impl_class = _Implementation

    def __init__(self, py_func: Any) -> None:
        super().__init__(py_func)  # type: ignore[no-untyped-call]  # as above
        about = self._cache_path, self._impl.filename_base, self._impl.locator.get_source_stamp()
        self._cache_file = _Index(*about)  # type: ignore[no-untyped-call]  # as above

    def _index_key(self, sig: Any, codegen: Any) -> tuple[Any, ...]:
        key: tuple[Any, ...] = super()._index_key(sig, codegen)  # type: ignore[no-untyped-call]  # as above
        return (*key, tuple(_layout(kind) for kind in sig))


def _layout(kind: Any) -> Any:
    """Names of the fields of a named tuple, whose class the sources of the function need not name."""
    if not isinstance(kind, types.BaseTuple):
        return None
    parts: Any = kind
    return getattr(kind, "fields", None), tuple(_layout(part) for part in parts)


def keep(dispatcher: Any) -> None:
    """Keep the machine code of a function of stommel on disk; other functions are compiled in every process."""
    if folder_of(dispatcher.py_func.__module__) is not None:
        dispatcher._cache = MachineCode(dispatcher.py_func)
