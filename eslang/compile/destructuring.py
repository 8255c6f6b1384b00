"""Destructuring: patterns of macros and DESTRUCTURING-BIND, as nested bindings.

A pattern becomes LET* bindings that walk the list with a few small functions
(support.py), so defaults see what is bound before them, in order.
"""

from __future__ import annotations

from eslang.base.lists import Cons, from_items, lisp_list
from eslang.base.shown import shown
from eslang.base.symbols import Symbol, Value
from eslang.compile.analyser import LAMBDA, Analyser
from eslang.compile.core import Node
from eslang.compile.core_forms import split_body
from eslang.compile.lambda_lists import BadLambdaList, LambdaList, parse_lambda_list
from eslang.compile.registry import special_form
from eslang.compile.scope import Scope


def _cl(name: str) -> Symbol:
    return Symbol.intern(name, "COMMON-LISP")


LET_STAR, IF, CAR, CDR, QUOTE, BLOCK, DECLARE, IGNORABLE = map(
    _cl, ("LET*", "IF", "CAR", "CDR", "QUOTE", "BLOCK", "DECLARE", "IGNORABLE")
)
NEED, END, FIND_KEY, CHECK_KEYS = map(
    _cl, ("%DESTRUCTURE-NEED", "%DESTRUCTURE-END", "%DESTRUCTURE-KEY", "%DESTRUCTURE-CHECK-KEYS")
)


class _Pattern:
    """Collects the bindings of one pattern."""

    def __init__(self, analyser: Analyser, what: Value) -> None:
        self.analyser = analyser
        self.what = what  # named in the failure when a list does not fit
        self.bindings: list[Value] = []

    def add(self, name: Value, form: Value) -> None:
        self.bindings.append(lisp_list(name, form))

    def temporary(self, form: Value) -> Symbol:
        """A fresh variable bound to FORM."""
        symbol = Symbol.uninterned("TAIL")
        self.add(symbol, form)
        return symbol

    def target(self, pattern: Value, form: Value) -> None:
        """Bind PATTERN, a variable or a pattern, to the value of FORM."""
        if pattern.__class__ is Cons:
            self.pattern(pattern, form)
        elif pattern is None:
            self.temporary(lisp_list(END, form, lisp_list(QUOTE, self.what)))
        else:
            self.add(pattern, form)

    def pattern(self, lst: Value, form: Value) -> None:
        """Bind the lambda list LST to the list that FORM gives."""
        self.parts(self.parse(lst), form)

    def parse(self, lst: Value) -> LambdaList:
        try:
            return parse_lambda_list(lst, destructuring=True)
        except BadLambdaList as mistake:
            named = f": `{shown(mistake.element)}`" if mistake.element is not None else ""
            self.analyser.fail("malformed-lambda-list", mistake.message + named, self.analyser.spans.of(lst))

    def parts(self, parts: LambdaList, form: Value) -> None:
        what = lisp_list(QUOTE, self.what)
        tail = self.temporary(form)
        if parts.whole is not None:
            self.add(parts.whole, tail)
        for pattern in parts.required:
            self.target(pattern, lisp_list(CAR, lisp_list(NEED, tail, what)))
            tail = self.temporary(lisp_list(CDR, tail))
        for parameter in parts.optional:
            if parameter.supplied is not None:
                self.add(parameter.supplied, lisp_list(IF, tail, _cl("T"), None))
            self.target(parameter.name, lisp_list(IF, tail, lisp_list(CAR, tail), parameter.default))
            tail = self.temporary(lisp_list(CDR, tail))
        if parts.has_rest:
            self.target(parts.rest, tail)
        if parts.keys is not None:
            self.keys(parts, tail, what)
        elif not parts.has_rest:
            self.temporary(lisp_list(END, tail, what))
        for parameter in parts.aux:
            self.target(parameter.name, parameter.default)

    def keys(self, parts: LambdaList, tail: Symbol, what: Value) -> None:
        """Bind the keyword parameters from the property list in TAIL."""
        assert parts.keys is not None
        known = from_items([parameter.keyword for parameter in parts.keys])
        allow = _cl("T") if parts.allow_other_keys else None
        self.temporary(lisp_list(CHECK_KEYS, tail, lisp_list(QUOTE, known), allow, what))
        for parameter in parts.keys:
            found = self.temporary(lisp_list(FIND_KEY, tail, lisp_list(QUOTE, parameter.keyword)))
            if parameter.supplied is not None:
                self.add(parameter.supplied, lisp_list(IF, found, _cl("T"), None))
            self.target(parameter.name, lisp_list(IF, found, lisp_list(CAR, found), parameter.default))


@special_form("(destructuring-bind pattern list &body forms)")
def destructuring_bind(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS with the variables of PATTERN bound to the parts of LIST.

    Fails: :error if LIST does not fit.
    """
    pattern = _Pattern(analyser, form.cdr.car)
    pattern.pattern(form.cdr.car, form.cdr.cdr.car)
    return analyser.node(Cons(LET_STAR, Cons(from_items(pattern.bindings), form.cdr.cdr.cdr)), scope)


def macro_lambda(analyser: Analyser, name: Value, lst: Value, forms: Value) -> Value:
    """The LAMBDA form of a macro's expander: of the form and its environment."""
    declarations, _, body = split_body(forms, documented=True)
    form, environment = Symbol.uninterned("FORM"), Symbol.uninterned("ENVIRONMENT")
    pattern = _Pattern(analyser, name)
    parts = pattern.parse(lst)
    if parts.environment is not None:
        pattern.add(parts.environment, environment)
    if parts.whole is not None:
        pattern.add(parts.whole, form)
        parts.whole = None
    pattern.parts(parts, lisp_list(CDR, form))
    declare = from_items([Cons(DECLARE, from_items(declarations))] if declarations else [])
    block = Cons(Cons(BLOCK, Cons(name, body)), None)
    let = Cons(LET_STAR, Cons(from_items(pattern.bindings), from_items(list(declare or []), block)))
    ignorable = lisp_list(DECLARE, lisp_list(IGNORABLE, form, environment))
    return lisp_list(LAMBDA, lisp_list(form, environment), ignorable, let)
