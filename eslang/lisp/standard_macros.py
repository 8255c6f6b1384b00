"""Standard macros that the compiler knows as special forms, for those who expand them.

The compiler takes WHEN, COND and their like apart itself, which gives better
code. MACROEXPAND and MACRO-FUNCTION treat them as the macros that they are in
Common Lisp.
"""

from __future__ import annotations

from eslang.base.hints import Any
from eslang.base.lists import Cons, lisp_list
from eslang.base.symbols import Symbol, T, Value
from eslang.compile.registry import CL, macro

IF, PROGN, LET, COND, AND, OR = (
    Symbol.intern(name, CL) for name in ("IF", "PROGN", "LET", "COND", "AND", "OR")
)


def _body(forms: Value) -> Value:
    """One form for FORMS run in order."""
    return forms.car if forms is not None and forms.cdr is None else Cons(PROGN, forms)


@macro("(when test &body forms)")
def when(form: Cons, environment: Any) -> Value:
    """Run FORMS if TEST is true."""
    return lisp_list(IF, form.cdr.car, _body(form.cdr.cdr))


@macro("(unless test &body forms)")
def unless(form: Cons, environment: Any) -> Value:
    """Run FORMS if TEST is false."""
    return lisp_list(IF, form.cdr.car, None, _body(form.cdr.cdr))


@macro("(and &rest forms)")
def and_(form: Cons, environment: Any) -> Value:
    """Run FORMS in order until one is false; give the values of the last."""
    forms = form.cdr
    if forms is None:
        return T
    return forms.car if forms.cdr is None else lisp_list(IF, forms.car, Cons(AND, forms.cdr))


@macro("(or &rest forms)")
def or_(form: Cons, environment: Any) -> Value:
    """Run FORMS in order until one is true; give its value."""
    forms = form.cdr
    if forms is None or forms.cdr is None:
        return forms.car if forms is not None else None
    value = Symbol.uninterned("VALUE")
    choice = lisp_list(IF, value, value, Cons(OR, forms.cdr))
    return lisp_list(LET, lisp_list(lisp_list(value, forms.car)), choice)


@macro("(cond &rest clauses)")
def cond(form: Cons, environment: Any) -> Value:
    """Run the forms of the first of CLAUSES whose test is true.

    A clause is (TEST . FORMS).
    Returns: the value of the clause's last form; of the test, if there is none.
    """
    if form.cdr is None:
        return None
    clause, rest = form.cdr.car, Cons(COND, form.cdr.cdr)
    if clause.cdr is None:
        return lisp_list(OR, clause.car, rest)
    return lisp_list(IF, clause.car, _body(clause.cdr), rest)
