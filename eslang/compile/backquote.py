"""Backquote: a template becomes code that builds it, at any depth."""

from __future__ import annotations

from eslang.base.lists import Cons, lisp_list
from eslang.base.symbols import Symbol, Value
from eslang.base.text import Vector
from eslang.compile.analyser import Analyser
from eslang.compile.core import Node
from eslang.compile.registry import special_form
from eslang.compile.scope import Scope


def _cl(name: str) -> Symbol:
    return Symbol.intern(name, "COMMON-LISP")


QUASIQUOTE, UNQUOTE, SPLICING, QUOTE, CONS, APPEND, LIST = map(
    _cl, ("QUASIQUOTE", "UNQUOTE", "UNQUOTE-SPLICING", "QUOTE", "CONS", "APPEND", "LIST")
)
TO_VECTOR = _cl("%LIST-TO-VECTOR")


@special_form("(quasiquote template)")
def quasiquote(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Build TEMPLATE, with the values of what is unquoted in it."""
    return analyser.node(_template(analyser, form.cdr.car, 1), scope)


def _is(form: Value, operator: Symbol) -> bool:
    return form.__class__ is Cons and form.car is operator and form.cdr.__class__ is Cons


def _template(analyser: Analyser, form: Value, depth: int) -> Value:
    """A form that builds the template FORM, which stands under DEPTH backquotes."""
    if _is(form, UNQUOTE):
        if depth == 1:
            return form.cdr.car
        return lisp_list(LIST, lisp_list(QUOTE, UNQUOTE), _template(analyser, form.cdr.car, depth - 1))
    if _is(form, QUASIQUOTE):
        return lisp_list(LIST, lisp_list(QUOTE, QUASIQUOTE), _template(analyser, form.cdr.car, depth + 1))
    if _is(form, SPLICING) and depth == 1:
        analyser.fail("misplaced-splice", "`,@` has no list around it to splice into")
    if form.__class__ is Vector:
        elements: Value = None
        for element in reversed(form.items):
            elements = Cons(element, elements)
        return lisp_list(TO_VECTOR, _elements(analyser, elements, depth))
    if form.__class__ is Cons:
        return _elements(analyser, form, depth)
    return lisp_list(QUOTE, form)


def _elements(analyser: Analyser, form: Value, depth: int) -> Value:
    """A form that builds the list FORM, element by element; spliced where it says so."""
    holders: list[Cons] = []
    rest = form
    while rest.__class__ is Cons and not (holders and (_is(rest, UNQUOTE) or _is(rest, QUASIQUOTE))):
        holders.append(rest)
        rest = rest.cdr
    if not _mentions(form):
        return lisp_list(QUOTE, form)
    result = _template(analyser, rest, depth) if rest is not None else None
    for holder in reversed(holders):
        element = holder.car
        if _is(element, SPLICING) and depth == 1:
            result = element.cdr.car if result is None else lisp_list(APPEND, element.cdr.car, result)
        elif _is(element, SPLICING):
            inner = _template(analyser, element.cdr.car, depth - 1)
            result = lisp_list(CONS, lisp_list(LIST, lisp_list(QUOTE, SPLICING), inner), result)
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
