"""Macro expansion: a macro is a function from a form and its scope to a form."""

from __future__ import annotations

from eslang.base.control import Failed
from eslang.base.diagnostics import EslError
from eslang.base.errors import to_failure
from eslang.base.failure import Failure
from eslang.base.failure_text import message_of
from eslang.base.hints import TYPE_CHECKING, Any, NoReturn
from eslang.base.image import Image
from eslang.base.lists import Cons
from eslang.base.printer import prin1
from eslang.base.running import running
from eslang.base.shown import shown
from eslang.base.symbols import Symbol, Value
from eslang.compile.core import Variable
from eslang.compile.registry import CL, ESL, SCS
from eslang.compile.scope import LocalMacro, Scope, SymbolMacro
from eslang.compile.signatures import usage

if TYPE_CHECKING:
    from eslang.compile.analyser import Analyser

LANGUAGES = (CL, ESL, SCS)
MOST = 1000  # expansions inside one another


def expand_macro(form: Cons, expander: Any, scope: Scope, analyser: Analyser) -> Value:
    """The expansion of FORM; what goes wrong in the expander is an error of the program."""
    analyser.expanders.append(expander)
    try:
        return _run_quietly(expander, form, scope)
    except EslError:
        raise
    except RecursionError:
        refuse_endless(form, analyser)
    except (Exception, Failed) as wrong:
        failure = wrong.value if isinstance(wrong, Failed) else to_failure(wrong)
        refuse_shape(form, expander, failure, analyser)
        analyser.fail("macro-failed", f"expanding `{shown(form.car)}` failed: {failure_text(failure)}")


def _run_quietly(expander: Any, form: Cons, scope: Scope) -> Value:
    """Run an expander: nobody is told of its failures, and no recovery procedure of a plan answers them."""
    dynamic = running.session.dynamic
    forms, quiet = dynamic.forms, dynamic.quiet
    dynamic.forms, dynamic.quiet = None, True
    try:
        return expander(form, scope)
    finally:
        dynamic.forms, dynamic.quiet = forms, quiet


def refuse_shape(form: Cons, expander: Any, failure: Failure, analyser: Analyser) -> None:
    """Say that the form is not written as a macro of the language wants it; nothing for other macros."""
    cell = analyser.image.cell(form.car)
    if cell.macro is expander and cell.definition is not None and form.car.package in LANGUAGES:
        message = message_of(failure).rstrip(".")
        if message[1:2].islower() or message[1:2] == " ":  # a sentence, not the name of an operator
            message = message[0].lower() + message[1:]
        analyser.fail(
            "malformed-form",
            f"`{shown(form.car)}` cannot be read: {message}",
            hint=f"write `{usage(cell.definition)}`" + namesake(form.car, analyser),
        )


def namesake(operator: Symbol, analyser: Analyser) -> str:
    """What to write for the operator of SCS that is called as OPERATOR of Common Lisp is."""
    other = Symbol.intern(operator.name, SCS)
    if operator.package != CL or analyser.image.cell(other).macro is None:
        return ""
    return f"; that of SCS is `scs:{shown(operator)}`"


def refuse_endless(form: Cons, analyser: Analyser) -> NoReturn:
    """Say that the macro of FORM expands into itself for ever, or that too many stand inside one another."""
    analyser.fail("nested-too-deep", f"expanding `{shown(form.car)}` comes to no end within {MOST} steps")


def failure_text(failure: Failure) -> str:
    """`:CAUSE argument...`, with a message as it reads."""
    shown = [a if isinstance(a, str) else prin1(a) for a in failure.arguments]
    return " ".join([prin1(failure.cause), *shown])


def macroexpand_1(form: Value, image: Image, scope: Scope | None = None) -> tuple[Value, bool]:
    """One step of expansion, and whether there was one."""
    if isinstance(form, Symbol):
        return _expand_symbol(form, image, scope)
    if form.__class__ is not Cons or not isinstance(form.car, Symbol):
        return form, False
    found = scope.find_function(form.car) if scope is not None else None
    if found.__class__ is LocalMacro:
        return found.expander(form, scope), True
    if found is None:
        expander = image.cell(form.car).macro
        if expander is not None:
            return expander(form, scope), True
    return form, False


def _expand_symbol(symbol: Symbol, image: Image, scope: Scope | None) -> tuple[Value, bool]:
    found = scope.find_variable(symbol) if scope is not None else None
    if found.__class__ is SymbolMacro:
        return found.expansion, True
    if found is None or found.__class__ is not Variable:
        expansion = image.cell(symbol).symbol_macro
        if expansion is not None and found is None:
            return expansion[0], True
    return symbol, False


def macroexpand(form: Value, image: Image, scope: Scope | None = None) -> tuple[Value, bool]:
    """Expand FORM until it is no macro form, and whether there was a step at all."""
    expanded = False
    while True:
        form, again = macroexpand_1(form, image, scope)
        if not again:
            return form, expanded
        expanded = True
