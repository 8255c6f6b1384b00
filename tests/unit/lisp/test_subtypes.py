"""SUBTYPEP."""

from __future__ import annotations

import pytest
from forms import value_of

DEFINED = """
  (defstruct sub-point x)
  (defstruct (sub-pixel (:include sub-point)) colour)
  (define-condition sub-trouble (error) ())
  (deftype sub-digit () '(integer 0 9))
"""


@pytest.mark.parametrize(
    ("first", "second", "answer"),
    [
        ("integer", "number", "yes"),
        ("number", "integer", "no"),
        ("null", "list", "yes"),
        ("list", "(or cons null)", "unknown"),
        ("bit", "fixnum", "yes"),
        ("(integer 1 5)", "(integer 0 *)", "yes"),
        ("(integer 1 5)", "(integer 2 *)", "no"),
        ("(integer (0) 5)", "(rational 1 5)", "yes"),
        ("(float 0.0 (1.0))", "(real 0 1)", "yes"),
        ("(real 0 1)", "(real 0 (1))", "no"),
        ("(unsigned-byte 8)", "(mod 256)", "yes"),
        ("(mod 256)", "(unsigned-byte 7)", "no"),
        ("string", "vector", "yes"),
        ("vector", "sequence", "yes"),
        ("sequence", "list", "no"),
        ("keyword", "symbol", "yes"),
        ("symbol", "atom", "yes"),
        ("cons", "atom", "no"),
        ("(member 1 2)", "integer", "yes"),
        ("(member 1 a)", "integer", "no"),
        ("boolean", "(member t nil)", "yes"),
        ("(or integer string)", "(or string number)", "yes"),
        ("(or integer cons)", "number", "no"),
        ("(and integer (satisfies oddp))", "number", "yes"),
        ("(satisfies oddp)", "integer", "unknown"),
        ("integer", "(and number rational)", "yes"),
        ("nil", "string", "yes"),
        ("string", "nil", "no"),
        ("(cons integer null)", "(cons number list)", "yes"),
        ("(cons integer)", "(cons string)", "no"),
        ("(cons nil t)", "string", "yes"),
        ("t", "integer", "no"),
        ("integer", "t", "yes"),
        ("(not integer)", "(not integer)", "yes"),
        ("string", "(not integer)", "unknown"),
        ("sub-pixel", "sub-point", "yes"),
        ("sub-point", "sub-pixel", "no"),
        ("sub-point", "structure-object", "yes"),
        ("sub-point", "integer", "no"),
        ("integer", "sub-point", "no"),
        ("sub-trouble", "error", "yes"),
        ("sub-trouble", "warning", "no"),
        ("type-error", "condition", "yes"),
        ("sub-digit", "unsigned-byte", "yes"),
        ("no-such-type", "integer", "unknown"),
    ],
)
def test_subtypep(first: str, second: str, answer: str) -> None:
    values = {"yes": "(T T)", "no": "(NIL T)", "unknown": "(NIL NIL)"}
    assert value_of(f"{DEFINED} (multiple-value-list (subtypep '{first} '{second}))") == values[answer]


def test_upgraded_array_element_type() -> None:
    assert value_of("(upgraded-array-element-type 'character)") == "CHARACTER"
    assert value_of("(upgraded-array-element-type 'fixnum)") == "T"
