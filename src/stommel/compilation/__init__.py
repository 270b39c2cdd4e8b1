"""What compiles: the decorators of compiled functions, when the compiler is wanted, where machine code is kept."""

from stommel.compilation.compiler import before_compiling, one_question, without_compiler
from stommel.compilation.decorators import compiled, inlined, plain

__all__ = ["before_compiling", "compiled", "inlined", "one_question", "plain", "without_compiler"]
