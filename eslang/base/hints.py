"""The words of type annotations, as cheap as they can be.

Importing `typing` takes as long as starting Python, and serves programs that
look at annotations while they run. Everything below the tools takes these
words from here: type checkers see those of `typing`, a running program sees
stand-ins.
"""

from __future__ import annotations

from _collections_abc import Callable, Iterable, Iterator, Sequence  # collections.abc, without collections

TYPE_CHECKING = False  # type checkers take it for true, whatever it says

if TYPE_CHECKING:
    from typing import Any, Final, NamedTuple, NoReturn, TextIO, TypeVar, overload

    F = TypeVar("F", bound=Callable[..., Any])
else:
    from eslang.base.records import Record as NamedTuple

    Any = Final = NoReturn = TextIO = F = object

    def overload(function: Callable[..., object]) -> Callable[..., object]:
        """One way to call a function; only type checkers care."""
        return function


__all__ = [
    "TYPE_CHECKING",
    "Any",
    "Callable",
    "F",
    "Final",
    "Iterable",
    "Iterator",
    "NamedTuple",
    "NoReturn",
    "Sequence",
    "TextIO",
    "overload",
]
