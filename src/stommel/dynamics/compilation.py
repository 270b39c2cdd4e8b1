"""The decorators of `stommel.compilation`, which packages below the dynamics use as well."""

from stommel.compilation import compiled, inlined

__all__ = ["compiled", "inlined"]
