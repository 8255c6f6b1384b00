"""Calls, evaluation and jumps: APPLY, EVAL, MACROEXPAND, CATCH and THROW."""

from __future__ import annotations

from eslang.base.calls import reenter, spread
from eslang.base.control import Exit, Throw
from eslang.base.failure import control_error, simple_error, type_error
from eslang.base.lists import Cons, from_items, items
from eslang.base.many import Values, many_of, pack, primary
from eslang.base.running import running, to_function
from eslang.base.stack import STACK
from eslang.base.symbols import Symbol, Value, truth
from eslang.base.text import Vector
from eslang.compile.lambda_list_words import MARKERS
from eslang.compile.registry import function, variable
from eslang.compile.support import LISP_SUPPORT
from eslang.runtime.failures import signal_error


def _arguments(arguments: tuple[Value, ...]) -> list[Value]:
    """The arguments of APPLY, the last of which is a list of the rest."""
    if not arguments:
        raise simple_error("APPLY takes a list of arguments as its last argument")
    return [*arguments[:-1], *items(arguments[-1])]


def _apply_many(designator: Value, *arguments: Value) -> Value:
    return spread(many_of(to_function(designator)), _arguments(arguments))


@function("(apply function &rest arguments)", many=_apply_many)
def apply(designator: Value, *arguments: Value) -> Value:
    """Call FUNCTION with ARGUMENTS, the last of which is a list of the rest."""
    return spread(to_function(designator), _arguments(arguments))


def _funcall_many(designator: Value, *arguments: Value) -> Value:
    return spread(many_of(to_function(designator)), list(arguments))


@function("(funcall function &rest arguments)", many=_funcall_many)
def funcall(designator: Value, *arguments: Value) -> Value:
    """Call FUNCTION with ARGUMENTS."""
    return spread(to_function(designator), list(arguments))


def _values_many(*values: Value) -> Value:
    return pack(list(values))


@function("(values &rest values)", many=_values_many)
def values(*values: Value) -> Value:
    """Give VALUES as multiple values."""
    return values[0] if values else None


def _values_list_many(lst: Value) -> Value:
    return pack(items(lst))


@function("(values-list list)", many=_values_list_many)
def values_list(lst: Value) -> Value:
    """Give the elements of LIST as multiple values."""
    return lst.car if lst.__class__ is Cons else None


def _eval_many(form: Value) -> Value:
    return running.session.evaluate_form(form, many=True)


@function("(eval form)", many=_eval_many)
def eval_(form: Value) -> Value:
    """Evaluate FORM in the global scope."""
    return running.session.evaluate_form(form)


def _expand(form: Value, environment: Value, *, once: bool) -> Value:
    from eslang.compile.expand import macroexpand as expand_all
    from eslang.compile.expand import macroexpand_1 as expand_once

    expansion, expanded = (expand_once if once else expand_all)(form, running.session.image, environment)
    return Values((expansion, truth(expanded)))


def _macroexpand_1_many(form: Value, environment: Value = None) -> Value:
    return _expand(form, environment, once=True)


@function("(macroexpand-1 form &optional environment)", many=_macroexpand_1_many)
def macroexpand_1(form: Value, environment: Value = None) -> Value:
    """Expand the macro form FORM by one step.

    Returns: the expansion, and whether FORM was a macro form.
    """
    return primary(_expand(form, environment, once=True))


def _macroexpand_many(form: Value, environment: Value = None) -> Value:
    return _expand(form, environment, once=False)


@function("(macroexpand form &optional environment)", many=_macroexpand_many)
def macroexpand(form: Value, environment: Value = None) -> Value:
    """Expand the macro form FORM until it is none.

    Returns: the expansion, and whether FORM was a macro form.
    """
    return primary(_expand(form, environment, once=False))


@function("(macro-function name &optional environment)")
def macro_function(name: Value, environment: Value = None) -> Value:
    """Give the expander of the macro NAME; NIL if it names none."""
    if not isinstance(name, Symbol):
        raise type_error(name, "SYMBOL")
    return running.session.image.cell(name).macro


@function("(special-operator-p name)")
def special_operator_p(name: Value) -> Value:
    """Tell whether NAME is a special form."""
    if name is not None and not isinstance(name, Symbol):
        raise type_error(name, "SYMBOL")
    return truth(name is not None and running.session.is_special_form(name))


@function("(identity object)")
def identity(value: Value) -> Value:
    """Return OBJECT."""
    return value


@function("(constantly value)")
def constantly(value: Value) -> Value:
    """Give a function that takes any arguments and returns VALUE."""

    def always(*arguments: Value) -> Value:
        return value

    return always


@function("(complement function)")
def complement(designator: Value) -> Value:
    """Give a function that is true where FUNCTION is false."""
    wanted = to_function(designator)

    def opposite(*arguments: Value) -> Value:
        return truth(reenter(wanted, list(arguments)) is None)

    return opposite


# --- catch and throw -----------------------------------------------------------------


def _catch(tag: Value, body: Value, *, many: bool) -> Value:
    dynamic = running.session.dynamic
    token = Exit()
    catches = dynamic.catches
    depth = len(catches)
    catches.append((tag, token))
    try:
        try:
            return (many_of(body) if many else body)()
        except Exception as error:
            return signal_error(error)
    except Throw as jump:
        if jump.target is not token:
            raise
        return jump.value if many else primary(jump.value)
    finally:
        del catches[depth:]
        if STACK.raised:
            STACK.give_back()


def _catch_many(tag: Value, body: Value) -> Value:
    return _catch(tag, body, many=True)


@function("(%call-with-catch tag body)", many=_catch_many)
def call_with_catch(tag: Value, body: Value) -> Value:
    """Call BODY; a THROW to TAG inside it returns from here."""
    return _catch(tag, body, many=False)


@function("(%throw tag values)")
def throw(tag: Value, body: Value) -> Value:
    """Jump to the innermost CATCH of TAG with all the values that BODY gives."""
    values = many_of(body)()
    for known, token in reversed(running.session.dynamic.catches):
        if known is tag or (tag.__class__ is int and known.__class__ is int and known == tag):
            raise Throw(token, values)
    raise control_error("no CATCH is active for the tag thrown to")


@function("(%list-to-vector list)")
def list_to_vector(lst: Value) -> Value:
    """Give a vector of the elements of LIST."""
    return Vector(items(lst))


for _name, _implementation in LISP_SUPPORT.items():
    function(f"({_name.lower()} &rest arguments)")(_implementation)


variable(
    "lambda-list-keywords", from_items(MARKERS), "The markers that a lambda list may contain.", constant=True
)
variable("call-arguments-limit", 2**31, "No call has as many arguments.", constant=True)
variable("lambda-parameters-limit", 2**31, "No function has as many parameters.", constant=True)
variable("multiple-values-limit", 2**31, "No form gives as many values.", constant=True)
