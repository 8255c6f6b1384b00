"""A form as a message quotes it: in lower case, as people write it, and not too long."""

from __future__ import annotations

from eslang.base.printer import WriteSettings, prin1
from eslang.base.symbols import Value

_SHORT = WriteSettings(case="DOWNCASE", length=6, level=3)


def shown(value: Value) -> str:
    """VALUE for a message, between backticks."""
    return prin1(value, _SHORT)
