"""Keyword arguments and indices of Lisp functions written in Python.

A function registered with &key gets what follows its required arguments as
*options; here they are told apart. Knows nothing of what the keywords mean.
"""

from __future__ import annotations

from eslang.base.failure import simple_error, type_error
from eslang.base.hints import Final
from eslang.base.symbols import Keyword, Symbol, Value


class _Unsupplied:
    __slots__ = ()

    def __repr__(self) -> str:
        return "UNSUPPLIED"


UNSUPPLIED: Final = _Unsupplied()  # the default of an &optional or &key argument that may itself be NIL


def take_keys(options: tuple[Value, ...], names: tuple[str, ...], default: Value = None) -> list[Value]:
    """The values of the keywords NAMES in OPTIONS, in that order; DEFAULT for those not given.

    The first of two equal keywords counts. An unknown one is an error, unless
    :allow-other-keys is given and true.
    """
    values = [default] * len(names)
    if not options:
        return values
    if len(options) % 2:
        raise simple_error("odd number of keyword arguments", *options)
    for place in range(len(options) - 2, -1, -2):
        key = options[place]
        name = key.name if key.__class__ is Keyword else None
        if name in names:
            values[names.index(name)] = options[place + 1]
        elif name != "ALLOW-OTHER-KEYS":
            _check_unknown(key, options)
    return values


def _check_unknown(key: Value, options: tuple[Value, ...]) -> None:
    """Fail for the unknown KEY, unless OPTIONS allow other keys."""
    allow = Keyword("ALLOW-OTHER-KEYS")
    for place in range(0, len(options), 2):
        if options[place] is allow:
            if options[place + 1] is not None:
                return
            break
    if not isinstance(key, Symbol):
        raise type_error(key, "SYMBOL")
    raise simple_error("unknown keyword argument", key)


def check_index(value: Value, operator: str) -> int:
    """VALUE, if it is a non-negative integer; else a type error."""
    if value.__class__ is int and value >= 0:
        index: int = value
        return index
    raise type_error(value, "UNSIGNED-BYTE", operator)
