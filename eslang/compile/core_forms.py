"""Special forms: quoting, order, choice, assignment and declaration.

Each function takes the analyser, a form of the shape its signature says, and
the scope; it returns a node. Loops and jumps are exits.py, bindings are
bindings.py, functions are functions.py.
"""

from __future__ import annotations

from eslang.base.lists import Cons, items
from eslang.base.shown import shown
from eslang.base.symbols import Keyword, Symbol, T, Value
from eslang.base.words import VARIABLES_NOT_OFFERED
from eslang.compile.analyser import Analyser
from eslang.compile.core import (
    Block,
    Const,
    If,
    Let,
    Local,
    Node,
    Or,
    ReturnFrom,
    Seq,
    SetGlobal,
    SetLocal,
    Variable,
)
from eslang.compile.registry import special_form
from eslang.compile.scope import SPECIAL, Scope, SymbolMacro
from eslang.compile.signatures import count_arguments

DECLARE = Symbol.intern("DECLARE", "COMMON-LISP")
SPECIAL_NAME = Symbol.intern("SPECIAL", "COMMON-LISP")
IGNORABLE = {Symbol.intern(name, "COMMON-LISP") for name in ("IGNORE", "IGNORABLE")}
SETF = Symbol.intern("SETF", "COMMON-LISP")
TEST = Symbol.uninterned("TEST")
LONG = 30  # clauses, or forms of AND and OR; of more, Python's own compiler is not to make a nest
OTHERWISE = (T, Symbol.intern("OTHERWISE", "COMMON-LISP"))


@special_form("(quote object)")
def quote(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Give OBJECT itself, unevaluated."""
    return Const(analyser.span, form.cdr.car)


@special_form("(progn &body forms)")
def progn(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS in order; give the values of the last."""
    return analyser.body(form.cdr, scope)


@special_form("(%where-function operator form)")
def where_function(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORM, which is only come to where OPERATOR names a function: a check is to know that."""
    around, analyser.supposed = analyser.supposed, (*analyser.supposed, form.cdr.car)
    try:
        return analyser.node(form.cdr.cdr.car, scope)
    finally:
        analyser.supposed = around


@special_form("(if test then &optional else)")
def if_(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run THEN if TEST is true, else ELSE."""
    nodes = analyser.nodes(form.cdr, scope)
    return If(analyser.span, nodes[0], nodes[1], nodes[2] if len(nodes) > 2 else Const(analyser.span, None))


@special_form("(when test &body forms)")
def when(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS if TEST is true."""
    test = analyser.nodes(Cons(form.cdr.car, None), scope)[0]
    return If(analyser.span, test, analyser.body(form.cdr.cdr, scope), Const(analyser.span, None))


@special_form("(unless test &body forms)")
def unless(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS if TEST is false."""
    test = analyser.nodes(Cons(form.cdr.car, None), scope)[0]
    return If(analyser.span, test, Const(analyser.span, None), analyser.body(form.cdr.cdr, scope))


@special_form("(cond &rest clauses)")
def cond(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run the forms of the first of CLAUSES whose test is true.

    A clause is (TEST . FORMS).

    Returns: the value of the clause's last form; of the test, if there is none.
    """
    is_long = (count_arguments(form) or 0) > LONG
    scope.procedure.nesting += 3 * is_long
    parts = _clauses(analyser, form, scope)
    scope.procedure.nesting -= 3 * is_long
    if is_long:
        return _one_by_one(analyser, parts, scope)
    result: Node = Const(analyser.span, None)
    for test, body in reversed(parts):
        if body is None:
            result = Or(test.span, [test, result])
        elif isinstance(test, Const) and test.value is not None:
            result = body
        else:
            result = If(test.span, test, body, result)
    return result


def _clauses(analyser: Analyser, form: Cons, scope: Scope) -> list[tuple[Node, Node | None]]:
    """The test and the body of each clause of COND; None for a body that is not there."""
    parts: list[tuple[Node, Node | None]] = []
    around = analyser.span
    rest = form.cdr
    while rest is not None:
        clause = rest.car
        analyser.span = analyser.spans.of(clause) or analyser.spans.element(rest) or around
        if clause.__class__ is not Cons:
            analyser.fail(
                "malformed-form", f"`{shown(clause)}` is no clause of `cond`", hint="write `(test form...)`"
            )
        test = analyser.nodes(Cons(clause.car, None), scope)[0]
        parts.append((test, analyser.body(clause.cdr, scope) if clause.cdr is not None else None))
        analyser.span = around
        rest = rest.cdr
    return parts


def _one_by_one(analyser: Analyser, parts: list[tuple[Node, Node | None]], scope: Scope) -> Node:
    """A long COND: one clause after the other, each of which leaves the whole."""
    target = analyser.exit(None, scope)
    target.jumps = len(parts)
    nothing = Const(analyser.span, None)
    nodes: list[Node] = []
    for test, body in parts:
        if body is None:
            value = analyser.unnamed_variable(TEST, scope)
            value.mentioned = True
            found = Local(test.span, value)
            leave = ReturnFrom(test.span, target, found, local=True)
            nodes.append(Let(test.span, [(value, test)], If(test.span, found, leave, nothing)))
        else:
            leave = ReturnFrom(test.span, target, body, local=True)
            nodes.append(If(test.span, test, leave, nothing))
    return Block(analyser.span, target, Seq(analyser.span, [*nodes, nothing]))


@special_form("(and &rest forms)")
def and_(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS in order until one is false; give the values of the last."""
    return _conjunction(analyser, analyser.nodes(form.cdr, scope) or [Const(analyser.span, T)])


def _conjunction(analyser: Analyser, nodes: list[Node]) -> Node:
    """The nodes of AND in a nest, or, if there are many, in a nest of nests."""
    if len(nodes) > LONG:
        nodes = [_conjunction(analyser, nodes[i : i + LONG]) for i in range(0, len(nodes), LONG)]
        return _conjunction(analyser, nodes)
    result = nodes[-1]
    for node in reversed(nodes[:-1]):
        result = If(analyser.span, node, result, Const(analyser.span, None))
    return result


@special_form("(or &rest forms)")
def or_(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS in order until one is true; give its value."""
    return _disjunction(analyser, analyser.nodes(form.cdr, scope) or [Const(analyser.span, None)])


def _disjunction(analyser: Analyser, nodes: list[Node]) -> Node:
    """The nodes of OR, or, if there are many, of ORs in an OR."""
    if len(nodes) > LONG:
        nodes = [_disjunction(analyser, nodes[i : i + LONG]) for i in range(0, len(nodes), LONG)]
        return _disjunction(analyser, nodes)
    return nodes[0] if len(nodes) == 1 else Or(analyser.span, nodes)


@special_form("(setq &rest pairs)")
def setq(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Give each variable of PAIRS the value of the form behind it, in order."""
    nodes: list[Node] = []
    rest = form.cdr
    while rest is not None:
        if rest.cdr is None:
            analyser.fail("malformed-form", f"`setq` has no value for `{shown(rest.car)}`")
        symbol = rest.car
        if not isinstance(symbol, Symbol) or isinstance(symbol, Keyword) or symbol is T:
            analyser.fail(
                "constant-assignment",
                f"`{shown(symbol)}` is no variable",
                analyser.spans.element(rest),
                hint=f"write `(setf {shown(symbol)} ...)`" if symbol.__class__ is Cons else None,
            )
        nodes.append(assignment(analyser, symbol, rest.cdr, scope))
        rest = rest.cdr.cdr
    if len(nodes) == 1:
        return nodes[0]
    return Seq(analyser.span, nodes) if nodes else Const(analyser.span, None)


def assignment(analyser: Analyser, symbol: Symbol, holder: Cons, scope: Scope) -> Node:
    """The node that gives SYMBOL the value of the form that HOLDER's car is."""
    found = scope.find_variable(symbol)
    expansion = None
    if found.__class__ is SymbolMacro:
        expansion = [found.expansion]
    elif found is None:
        expansion = analyser.image.cell(symbol).symbol_macro
    if expansion is not None:
        return analyser.node(Cons(SETF, Cons(expansion[0], Cons(holder.car, None))), scope)
    value = analyser.nodes(Cons(holder.car, None), scope)[0]
    if isinstance(found, Variable):
        found.assigned = True
        if found.given is not None:
            found.given.append(value)
        return SetLocal(analyser.span, found, value)
    if analyser.image.cell(symbol).constant:
        analyser.fail("constant-assignment", f"`{shown(symbol)}` is a constant and cannot be set")
    if found is None:
        refuse_not_offered(analyser, symbol)
        analyser.use("assignment", symbol, None, symbol, scope)
    return SetGlobal(analyser.span, symbol, value)


def refuse_not_offered(analyser: Analyser, symbol: Symbol) -> None:
    """Fail for a variable of the standard that is not offered, unless the program has made one."""
    if symbol.name in VARIABLES_NOT_OFFERED and not analyser.image.cell(symbol).special:
        analyser.fail("unknown-variable", f"`{shown(symbol)}` of Common Lisp is not offered here")


# --- declarations ------------------------------------------------------------------


def split_body(forms: Value, *, documented: bool = False) -> tuple[list[Cons], str | None, Value]:
    """The declarations at the head of a body, its docstring, and the forms that remain."""
    from eslang.base.text import String

    declarations: list[Cons] = []
    documentation = None
    while forms.__class__ is Cons:
        head = forms.car
        if head.__class__ is Cons and head.car is DECLARE:
            declarations += [d for d in items(head.cdr) if d.__class__ is Cons]
        elif documented and documentation is None and head.__class__ is String and forms.cdr is not None:
            documentation = head.text
        else:
            break
        forms = forms.cdr
    return declarations, documentation, forms


def declared(declarations: list[Cons], names: set[Symbol] | Symbol) -> set[Symbol]:
    """The variables that DECLARATIONS say one of NAMES of."""
    wanted = {names} if isinstance(names, Symbol) else names
    return {
        symbol
        for declaration in declarations
        if declaration.car in wanted
        for symbol in items(declaration.cdr)
    }


def declare_specials(analyser: Analyser, declarations: list[Cons], scope: Scope) -> None:
    """Make what is declared special, and not bound here, special in SCOPE."""
    for symbol in declared(declarations, SPECIAL_NAME):
        scope.variables[symbol] = SPECIAL


@special_form("(locally &body forms)")
def locally(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS under the declarations at their head."""
    declarations, _, forms = split_body(form.cdr)
    inner = scope.inner()
    declare_specials(analyser, declarations, inner)
    return analyser.body(forms, inner)


@special_form("(the type form)")
def the(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Give the values of FORM; TYPE is taken on trust."""
    return analyser.nodes(form.cdr.cdr, scope)[0]


@special_form("(declare &rest declarations)")
def declare(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Say something of the variables of the body that this is the head of."""
    analyser.fail("misplaced-declare", "`declare` stands at the head of a body, and nowhere else")


@special_form("(eval-when situations &body forms)")
def eval_when(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS.

    Plans are compiled as they are loaded, so all SITUATIONS are one.
    """
    return analyser.body(form.cdr.cdr, scope)
