"""Backquote: a template becomes code that builds it, at any depth."""

from __future__ import annotations

from eslang.base.lists import Cons, items, lisp_list
from eslang.base.symbols import Symbol, Value
from eslang.base.text import Vector
from eslang.compile.analyser import Analyser
from eslang.compile.core import Node
from eslang.compile.registry import special_form
from eslang.compile.scope import Scope


def _cl(name: str) -> Symbol:
    return Symbol.intern(name, "COMMON-LISP")


OPERATORS = QUASIQUOTE, UNQUOTE, SPLICING = tuple(map(_cl, ("QUASIQUOTE", "UNQUOTE", "UNQUOTE-SPLICING")))
QUOTE, CONS, APPEND = map(_cl, ("QUOTE", "CONS", "APPEND"))
TO_VECTOR = _cl("%LIST-TO-VECTOR")


@special_form("(quasiquote template)")
def quasiquote(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Build TEMPLATE, with the values of what is unquoted in it."""
    return analyser.node(_template(analyser, form.cdr.car, 1), scope)


def _is(form: Value, operator: Symbol) -> bool:
    if form.__class__ is not Cons or form.car is not operator:
        return False
    return form.cdr is None or form.cdr.__class__ is Cons


def _template(analyser: Analyser, form: Value, depth: int) -> Value:
    """A form that builds the template FORM, which stands under DEPTH backquotes."""
    if _is(form, UNQUOTE) and depth == 1 and form.cdr is not None:
        return form.cdr.car
    if depth > 1 and (_is(form, UNQUOTE) or _is(form, SPLICING)):
        return _inner(analyser, form, depth - 1)
    if _is(form, QUASIQUOTE):
        return _inner(analyser, form, depth + 1)
    if _is(form, SPLICING):
        analyser.fail("misplaced-splice", "`,@` has no list around it to splice into")
    if form.__class__ is Vector:
        elements: Value = None
        for element in reversed(form.items):
            elements = Cons(element, elements)
        return lisp_list(TO_VECTOR, _elements(analyser, elements, depth))
    if form.__class__ is Cons:
        return _elements(analyser, form, depth)
    return lisp_list(QUOTE, form)


def _inner(analyser: Analyser, form: Cons, depth: int) -> Value:
    """A form that builds FORM, a backquote or comma inside a template, with DEPTH for what is in it.

    A `,@` right behind an inner comma gives that comma several forms, or none.
    """
    return lisp_list(CONS, lisp_list(QUOTE, form.car), _elements(analyser, form.cdr, depth))


def _elements(analyser: Analyser, form: Value, depth: int) -> Value:
    """A form that builds the list FORM, element by element; spliced where it says so."""
    holders: list[Cons] = []
    rest = form
    while rest.__class__ is Cons and not (holders and any(_is(rest, operator) for operator in OPERATORS)):
        holders.append(rest)
        rest = rest.cdr
    if not _mentions(form):
        return lisp_list(QUOTE, form)
    result = _template(analyser, rest, depth) if rest is not None else None
    for holder in reversed(holders):
        element = holder.car
        if depth == 1 and (_is(element, SPLICING) or _is(element, UNQUOTE)):
            for value in reversed(list(items(element.cdr))):
                if _is(element, UNQUOTE):
                    result = lisp_list(CONS, value, result)
                else:
                    result = value if result is None else lisp_list(APPEND, value, result)
        else:
            result = lisp_list(CONS, _template(analyser, element, depth), result)
    return result


def _mentions(form: Value) -> bool:
    """True if some part of the template FORM is to be computed."""
    pending = [form]
    while pending:
        part = pending.pop()
        if part.__class__ is Vector:
            pending.extend(part.items)
        elif part.__class__ is Cons:
            if part.car is UNQUOTE or part.car is SPLICING or part.car is QUASIQUOTE:
                return True
            pending.append(part.car)
            pending.append(part.cdr)
    return False
