"""Defining forms: DEFUN, DEFMACRO and the DEFVAR family.

Each becomes a call of an internal function with the name and the value, so
that a definition takes effect when it is run, at top level or not.
"""

from __future__ import annotations

from eslang.base.lists import Cons, lisp_list
from eslang.base.printer import prin1
from eslang.base.shown import shown
from eslang.base.symbols import Keyword, Symbol, T, Value
from eslang.base.text import String
from eslang.compile.analyser import Analyser
from eslang.compile.core import Call, Const, Node
from eslang.compile.core_forms import split_body
from eslang.compile.destructuring import macro_lambda
from eslang.compile.functions import checked_lambda_list, function_node, parameter_names, setf_name
from eslang.compile.registry import special_form
from eslang.compile.scope import Scope


def _cl(name: str) -> Symbol:
    return Symbol.intern(name, "COMMON-LISP")


DEFINE_FUNCTION, DEFINE_SETF, DEFINE_MACRO, DEFINE_VARIABLE = map(
    _cl, ("%DEFINE-FUNCTION", "%DEFINE-SETF-FUNCTION", "%DEFINE-MACRO", "%DEFINE-VARIABLE")
)


def _name(analyser: Analyser, form: Cons, what: str) -> Symbol:
    """The name that FORM defines; it must be free to be defined."""
    name = form.cdr.car
    if not isinstance(name, Symbol) or isinstance(name, Keyword) or name is T:
        analyser.fail(
            "malformed-form", f"`{shown(name)}` cannot name a {what}", analyser.spans.element(form.cdr)
        )
    if what != "variable" and name in analyser.image.special_forms:
        analyser.fail(
            "redefined-special-form",
            f"`{shown(name)}` is a special form and cannot be redefined",
            analyser.spans.element(form.cdr),
        )
    if what != "variable":
        _check_free(analyser, form, name)
    return name


def _check_free(analyser: Analyser, form: Cons, name: Symbol) -> None:
    """Fail if NAME, which FORM defines, is an operator of Common Lisp."""
    if analyser.image.is_fixed(name):
        analyser.fail(
            "redefined-standard-name",
            f"`{shown(name)}` is an operator of Common Lisp and cannot be redefined",
            analyser.spans.element(form.cdr),
            hint="choose another name, or shadow this one in a package of your own",
        )


def _record(analyser: Analyser, signature: str, documentation: str | None) -> list[Node]:
    """Constants that tell people of a definition: signature, documentation, place."""
    span = analyser.span
    where = lisp_list(String(span.source.name), span.line, span.column) if span is not None else None
    doc = String(documentation) if documentation is not None else None
    return [Const(span, String(signature)), Const(span, doc), Const(span, where)]


@special_form("(defun name lambda-list &body forms)")
def defun(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Define NAME as a function of LAMBDA-LIST with the body FORMS.

    NAME may be (setf place-name). A string at the head of FORMS is its documentation.
    Returns: NAME.
    """
    setf = setf_name(form.cdr.car)
    name = setf or _name(analyser, form, "function")
    if setf is not None:
        _check_free(analyser, form, setf)
    title = prin1(form.cdr.car).lower()
    around, analyser.definition = analyser.definition, f"`{title}`"
    lst, forms = form.cdr.cdr.car, form.cdr.cdr.cdr
    node = function_node(analyser, name.name, lst, forms, scope, name, named=True)
    analyser.definition = around
    record = _record(analyser, f"({title} {parameter_names(lst)}".rstrip() + ")", node.documentation)
    define = DEFINE_SETF if setf is not None else DEFINE_FUNCTION
    return Call(analyser.span, define, [Const(analyser.span, name), node, *record])


@special_form("(defmacro name lambda-list &body forms)")
def defmacro(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Define NAME as a macro of LAMBDA-LIST, which FORMS expand.

    Returns: NAME.
    """
    name = _name(analyser, form, "macro")
    lst, forms = form.cdr.cdr.car, form.cdr.cdr.cdr
    checked_lambda_list(analyser, lst, destructuring=True)
    _, documentation, _ = split_body(forms, documented=True)
    around, analyser.definition = analyser.definition, f"`{shown(name)}`"
    expander = macro_lambda(analyser, name, lst, forms)
    node = function_node(analyser, f"macro {name.name}", expander.cdr.car, expander.cdr.cdr, scope)
    analyser.definition = around
    record = _record(
        analyser, f"({prin1(name).lower()} {_macro_parameters(lst)}".rstrip() + ")", documentation
    )
    return Call(analyser.span, DEFINE_MACRO, [Const(analyser.span, name), node, *record])


def _macro_parameters(lst: Value) -> str:
    """The lambda list as it stands, but for &environment and &whole."""
    words: list[str] = []
    while lst.__class__ is Cons:
        element = lst.car
        if isinstance(element, Symbol) and element.name in ("&ENVIRONMENT", "&WHOLE"):
            lst = lst.cdr.cdr
            continue
        if element.__class__ is Cons and words and any(m in words for m in ("&optional", "&key")):
            element = element.car if isinstance(element.car, Symbol) else element
        words.append(prin1(element).lower())
        lst = lst.cdr
    return " ".join(words) if lst is None else " ".join([*words, "&rest", prin1(lst).lower()])


def _variable(analyser: Analyser, form: Cons, scope: Scope, kind: str) -> Node:
    name = _name(analyser, form, "variable")
    rest = form.cdr.cdr
    documentation = rest.cdr.car.text if rest and rest.cdr and rest.cdr.car.__class__ is String else None
    values: list[Node] = []
    if rest is not None:
        procedure = analyser.procedure("value", scope)
        from eslang.compile.core import Lambda

        body = analyser.nodes(Cons(rest.car, None), scope.inner(procedure))[0]
        values = [Lambda(analyser.span, procedure, [], [], None, None, False, body)]
    kind_node = Const(analyser.span, Keyword(kind))
    record = _record(analyser, prin1(name).lower(), documentation)[1:]
    value = values[0] if values else Const(analyser.span, None)
    return Call(analyser.span, DEFINE_VARIABLE, [Const(analyser.span, name), kind_node, value, *record])


@special_form("(defvar name &optional value documentation)")
def defvar(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Make NAME a special variable; give it VALUE if it has none yet.

    Returns: NAME.
    """
    return _variable(analyser, form, scope, "VAR")


@special_form("(defparameter name value &optional documentation)")
def defparameter(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Make NAME a special variable with VALUE.

    Returns: NAME.
    """
    return _variable(analyser, form, scope, "PARAMETER")


@special_form("(defconstant name value &optional documentation)")
def defconstant(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Make NAME a constant with VALUE.

    Returns: NAME.
    """
    return _variable(analyser, form, scope, "CONSTANT")


@special_form("(in-package name)")
def in_package(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Make the package called NAME, which is not evaluated, the current one."""
    return Call(analyser.span, _cl("%IN-PACKAGE"), [Const(analyser.span, form.cdr.car)])
