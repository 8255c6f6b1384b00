"""The analyser: one form in, one node of core language out.

Here is only the walk: what an atom means, what an operator means. Each special
form has its own function, registered in core_forms.py and its neighbours; each
macro is called and its expansion analysed in its place.
"""

from __future__ import annotations

from eslang.base.diagnostics import Diagnostic, EslError, Label
from eslang.base.hints import Any, Callable, NamedTuple, NoReturn
from eslang.base.image import Image
from eslang.base.lists import Cons
from eslang.base.shown import shown
from eslang.base.spans import Span, Spans
from eslang.base.symbols import Keyword, Symbol, T, Value
from eslang.base.text import String
from eslang.base.words import MACROS_NOT_OFFERED
from eslang.compile.core import (
    Call,
    Const,
    Exit,
    Funcall,
    Global,
    Inline,
    Lambda,
    Local,
    Node,
    Procedure,
    Seq,
    Variable,
)
from eslang.compile.expand import MOST, expand_macro, refuse_endless
from eslang.compile.inline import INLINE
from eslang.compile.registry import Definition
from eslang.compile.scope import LocalMacro, Scope, SymbolMacro
from eslang.compile.signatures import arity, count_arguments, usage

LAMBDA = Symbol.intern("LAMBDA", "COMMON-LISP")
DEEPEST = 10  # Python blocks in one procedure, of the 20 that Python allows
EXIT = Symbol.uninterned("EXIT")


class Use(NamedTuple):
    """A global name that the program mentions: what `esl check` looks at."""

    kind: str  # "call", "function" or "variable"
    symbol: Symbol
    arguments: list[Node] | None
    span: Span | None
    form: Value
    scope: Scope
    within: str | None  # the definition around it
    supposed: tuple[Symbol, ...] = ()  # it is only come to where these name functions


class Analyser:
    """Analyses the forms of one top-level form."""

    def __init__(
        self,
        image: Image,
        spans: Spans,
        span: Span | None,
        compile_expander: Callable[[Value, Scope], Any],
        uses: list[Use] | None = None,
        expanders: list[Any] | None = None,
        notices: list[Diagnostic] | None = None,
    ) -> None:
        self.image = image
        self.compile_expander = compile_expander  # a MACROLET function from its LAMBDA form
        self.spans = spans
        self.span = span  # of the innermost form that has one
        self.block_cost = 1  # how many Python blocks a block or tagbody is taken for: 1, or 3 at most
        self.names: dict[str, int] = {}
        self.expanding = 0  # how many macros are being expanded inside one another
        self.definition: str | None = None  # the definition around the form, for `= in`
        self.uses = uses
        self.supposed: tuple[Symbol, ...] = ()  # names that are functions where the form at hand is come to
        self.notices = notices
        self.expanders = expanders if expanders is not None else []  # of the macros met on the way

    # --- names -----------------------------------------------------------------

    def unique(self, base: str) -> str:
        """A Python name that nothing else in this top-level form has."""
        number = self.names.get(base, 0)
        self.names[base] = number + 1
        return f"{base}.{number}" if number else f"{base}."

    def variable(self, symbol: Symbol, scope: Scope) -> Variable:
        """A new lexical variable, bound in SCOPE."""
        if isinstance(symbol, Keyword) or symbol is T or self.image.cell(symbol).constant:
            self.fail("constant-assignment", f"`{shown(symbol)}` is a constant and cannot be bound")
        variable = self.unnamed_variable(symbol, scope)
        scope.variables[symbol] = variable
        return variable

    def unnamed_variable(self, symbol: Symbol, scope: Scope) -> Variable:
        """A new variable that no name in the program finds."""
        name = self.unique(symbol.name.lower())
        return Variable(symbol, name, scope.procedure, in_loop=scope.procedure.loops > 0)

    def exit(self, symbol: Symbol | None, scope: Scope) -> Exit:
        """A new block or tagbody."""
        token = Variable(EXIT, self.unique("exit"), scope.procedure, in_loop=scope.procedure.loops > 0)
        return Exit(symbol, scope.procedure, token)

    def procedure(self, name: str, scope: Scope | None) -> Procedure:
        """A new procedure inside the one of SCOPE."""
        return Procedure(name, scope.procedure if scope is not None else None)

    # --- the walk --------------------------------------------------------------

    def node(self, form: Value, scope: Scope) -> Node:
        """The node of any form."""
        if form.__class__ is Cons:
            return self.list_form(form, scope)
        if isinstance(form, Symbol):
            return self.symbol(form, scope)
        return Const(self.span, form)

    def nodes(self, forms: Value, scope: Scope) -> list[Node]:
        """The nodes of a list of forms; an atom at its place in the list."""
        result = []
        rest = forms
        around = self.span
        while rest.__class__ is Cons:
            if rest.car.__class__ is not Cons:
                self.span = self.spans.element(rest) or around
            result.append(self.node(rest.car, scope))
            self.span = around
            rest = rest.cdr
        if rest is not None:
            self.fail("malformed-form", "a form cannot end in a dot")
        return result

    def body(self, forms: Value, scope: Scope) -> Node:
        """The node of forms run in order."""
        return self.body_of(self.nodes(forms, scope))

    def body_of(self, nodes: list[Node]) -> Node:
        """One node for nodes run in order."""
        if len(nodes) == 1:
            return nodes[0]
        return Seq(self.span, nodes) if nodes else Const(self.span, None)

    def symbol(self, symbol: Symbol, scope: Scope) -> Node:
        """The node of a variable."""
        if isinstance(symbol, Keyword) or symbol is T:
            return Const(self.span, symbol)
        found = scope.find_variable(symbol)
        if found.__class__ is Variable:
            return Local(self.span, found)
        if found.__class__ is SymbolMacro:
            return self.node(found.expansion, scope)
        if found is None:
            cell = self.image.cell(symbol)
            if cell.symbol_macro is not None:
                return self.node(cell.symbol_macro[0], scope)
            self.use("variable", symbol, None, symbol, scope)
        return Global(self.span, symbol)

    def list_form(self, form: Cons, scope: Scope) -> Node:
        """The node of a compound form."""
        around = self.span
        self.span = self.spans.of(form) or around
        try:
            return self.compound(form, scope)
        finally:
            self.span = around

    def compound(self, form: Cons, scope: Scope) -> Node:
        operator = form.car
        if isinstance(operator, Symbol):
            found = scope.find_function(operator)
            if found.__class__ is Variable:
                return Funcall(self.span, Local(self.span, found), self.nodes(form.cdr, scope), known=True)
            if found.__class__ is LocalMacro:
                return self.expanded(form, found.expander, scope)
            special = self.image.special_forms.get(operator)
            if special is not None:
                self.check_shape(special, form)
                return self.special_form(special, form, scope)
            cell = self.image.cell(operator)
            if cell.macro is not None:
                if cell.definition is not None:
                    self.check_shape(cell.definition, form)
                return self.expanded(form, cell.macro, scope)
            return self.call(operator, form, scope)
        if operator.__class__ is Cons and operator.car is LAMBDA:
            return Funcall(self.span, self.node(operator, scope), self.nodes(form.cdr, scope), known=True)
        self.fail(
            "bad-operator",
            f"`{shown(operator)}` cannot be called",
            self.spans.element(form),
            "expected the name of a function, a macro or a special form",
            hint="quote the list if it is meant as a value" if not isinstance(operator, String) else None,
        )

    def special_form(self, special: Definition, form: Cons, scope: Scope) -> Node:
        """The node of a special form; in a procedure of its own where Python nests no deeper."""
        if scope.procedure.nesting <= DEEPEST:
            node: Node = special.implementation(self, form, scope)
            return node
        procedure = self.procedure("part", scope)
        body: Node = special.implementation(self, form, scope.inner(procedure))
        part = Lambda(self.span, procedure, [], [], None, None, False, body)
        return Funcall(self.span, part, [], known=True)

    def call(self, operator: Symbol, form: Cons, scope: Scope) -> Node:
        """The node of a call of a global function."""
        offered = operator.name not in MACROS_NOT_OFFERED or hasattr(self.image.cell(operator), "function")
        arguments = self.nodes(form.cdr, scope) if offered else []
        if operator.package == "COMMON-LISP":
            inline = INLINE.get(operator.name)
            if inline is not None and inline.takes(len(arguments)):
                return Inline(self.span, operator.name, arguments)
        self.use("call", operator, arguments, form, scope)
        return Call(self.span, operator, arguments)

    def expanded(self, form: Cons, expander: object, scope: Scope) -> Node:
        """The node of a macro's expansion, which stands where the macro stood."""
        expansion = expand_macro(form, expander, scope, self)
        if expansion.__class__ is Cons:
            self.spans.copy_from(expansion, form)
        self.expanding += 1
        if self.expanding > MOST:
            refuse_endless(form, self)
        node = self.node(expansion, scope)
        self.expanding -= 1
        return node

    def use(self, kind: str, symbol: Symbol, arguments: list[Node] | None, form: Value, scope: Scope) -> None:
        """Note that the program mentions a global name."""
        if self.uses is not None:
            span = self.spans.element(form) if form.__class__ is Cons and form.car is symbol else None
            place = span or self.span
            use = Use(kind, symbol, arguments, place, form, scope, self.definition, self.supposed)
            self.uses.append(use)

    # --- mistakes --------------------------------------------------------------

    def warn(self, name: str, message: str, span: Span | None, hint: str | None = None) -> None:
        """Note what is not wrong, but surely not meant; only a check tells of it."""
        place = span or self.span
        if self.notices is not None and place is not None:
            labels = (Label(place),)
            self.notices.append(Diagnostic(name, message, labels, self.definition, hint, severity="warning"))

    def check_shape(self, definition: Definition, form: Cons) -> None:
        """Fail unless FORM has as many arguments as DEFINITION takes."""
        count = count_arguments(form)
        if count is None:
            self.fail("malformed-form", "a form cannot end in a dot")
        expected = arity(definition.signature)
        if not expected.takes(count):
            self.fail(
                "malformed-form",
                f"`{definition.name.lower()}` takes {expected.phrase()}, found {count}",
                hint=f"write `{usage(definition)}`",
            )

    def fail(
        self,
        name: str,
        message: str,
        span: Span | None = None,
        label: str = "",
        hint: str | None = None,
        construct: str | None = None,
    ) -> NoReturn:
        """Raise the diagnostic of a mistake at SPAN, or at the form at hand; CONSTRUCT is around it."""
        place = span or self.span
        labels = (Label(place, label),) if place is not None else ()
        within = " of ".join([part for part in (construct, self.definition) if part]) or None
        raise EslError(Diagnostic(name, message, labels, within=within, hint=hint))
