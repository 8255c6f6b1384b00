"""eslang: ESL, the Execution Support Language, with SCS.

The front door. `Interpreter` is one ESL system; a plan that does not succeed
raises `Failure`, a wrong program `EslError`.
"""

from __future__ import annotations

from eslang.base.border import Text
from eslang.base.diagnostics import EslError
from eslang.base.failure import Failure
from eslang.base.symbols import Keyword, Symbol
from eslang.interpreter import Interpreter

__version__ = "0.1.0"
__all__ = ["EslError", "Failure", "Interpreter", "Keyword", "Symbol", "Text", "__version__"]
