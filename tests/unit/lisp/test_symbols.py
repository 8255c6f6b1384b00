"""Symbols: what they mean in an image."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(symbol-name 'foo)", '"FOO"'),
        ("(symbol-name nil)", '"NIL"'),
        ("(symbol-name :foo)", '"FOO"'),
        ('(symbol-name "a")', "failure :TYPE-ERROR"),
    ],
)
def test_names(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (
            "(progn (set 'zork 5) (list (boundp 'zork) (symbol-value 'zork) (boundp (makunbound 'zork))))",
            "(T 5 NIL)",
        ),
        ("(boundp 'nil)", "T"),
        ("(boundp 'unheard-of)", "NIL"),
        ("(symbol-value 'unheard-of)", "failure :UNBOUND-VARIABLE"),
        ("(symbol-value :a)", ":A"),
        ("(set 'pi 3)", "failure :ERROR"),
        ("(set 'nil 3)", "failure :ERROR"),
    ],
)
def test_values(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(fboundp 'car)", "T"),
        ("(fboundp 'unheard-of)", "NIL"),
        ("(symbol-function 'unheard-of)", "failure :UNDEFINED-FUNCTION"),
        ("(fdefinition 5)", "failure :TYPE-ERROR"),
        ("(symbol-function 'car)", "#<FUNCTION CAR>"),
    ],
)
def test_functions(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(list (get 'gadget 'colour) (get 'gadget 'colour :none))", "(NIL :NONE)"),
        (
            (
                "(progn (setf (get 'gadget 'colour) :red) (list (get 'gadget 'colour) (symbol-plist "
                "'gadget) (remprop 'gadget 'colour) (remprop 'gadget 'colour) (symbol-plist "
                "'gadget)))"
            ),
            "(:RED (COLOUR :RED) T NIL NIL)",
        ),
    ],
)
def test_properties(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(symbol-name (make-symbol "Abc"))', '"Abc"'),
        ('(symbol-package (make-symbol "A"))', "NIL"),
        ("(make-symbol 'a)", "failure :TYPE-ERROR"),
        ("(symbol-name (copy-symbol 'foo))", '"FOO"'),
        ("(symbol-name (gensym 5))", '"G5"'),
    ],
)
def test_new_symbols(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(constantp 5)", "T"),
        ("(constantp 'pi)", "T"),
        ("(constantp ''a)", "T"),
        ("(constantp 'unheard-of)", "NIL"),
        ("(constantp :a)", "T"),
    ],
)
def test_constants(form: str, value: str) -> None:
    assert value_of(form) == value
