"""What compiles: the decorators of every compiled function, and where its machine code is kept."""

from stommel.compilation.decorators import compiled, inlined

__all__ = ["compiled", "inlined"]
