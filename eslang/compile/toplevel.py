"""Top-level forms: compiled and run one at a time, so each sees what those before it defined.

A PROGN at top level is its forms, one after the other. Every piece of code
that was run is remembered in order, so that a text that was compiled once can
be run again from its code alone (cache.py).
"""

from __future__ import annotations

from types import CodeType

from eslang.base.diagnostics import Diagnostic, error_at
from eslang.base.hints import Any, Callable, Iterator
from eslang.base.image import Image
from eslang.base.lists import Cons
from eslang.base.spans import Span, Spans
from eslang.base.stack import is_nearly_full
from eslang.base.symbols import Symbol, Value
from eslang.compile import backquote, bindings, core_forms, definitions, destructuring, exits, functions
from eslang.compile.analyser import Analyser, Use
from eslang.compile.expand import MOST, expand_macro, refuse_endless
from eslang.compile.purity import is_pure
from eslang.compile.scope import LocalMacro, Scope
from eslang.compile.unit import Unit

ROOMS = (core_forms, bindings, exits, functions, destructuring, definitions, backquote)
MOST_BLOCKS = 3  # Python blocks that one block or tagbody can become
PROGN, EVAL_WHEN = (Symbol.intern(name, "COMMON-LISP") for name in ("PROGN", "EVAL-WHEN"))


class Compiler:
    """Compiles the top-level forms of one text."""

    def __init__(self, image: Image, support: dict[str, Any], name: str) -> None:
        self.image = image
        self.unit = Unit(image, support, name)
        self.codes: list[CodeType] = []
        self.uses: list[Use] | None = None
        self.notices: list[Diagnostic] | None = None
        self.expanders: list[Any] = []  # of the macros that were expanded

    def is_pure(self) -> bool:
        """True if compiling the text again could not matter."""
        return all(is_pure(expander) for expander in self.expanders)

    def run(
        self,
        form: Value,
        spans: Spans,
        span: Span | None,
        *,
        run: Callable[[CodeType], Value],
        many: bool = False,
    ) -> Value:
        """Compile FORM and let RUN run its code; the value, or with `many` all the values."""
        if is_nearly_full():
            raise RecursionError("no room to compile a form")
        counters = dict(self.image.counters)
        try:
            form = self._expanded(form, spans, span)
            parts = self._parts(form)
            code = self._code(form, spans, span, many) if parts is None else None
        except RecursionError:
            raise error_at("nested-too-deep", "this form is nested too deep to compile", span) from None
        self.image.counters = counters  # expanding counts for nothing: a kept text does not expand
        if code is not None:
            self.codes.append(code)
            return run(code)
        result: Value = None
        for index, part in enumerate(parts or (), start=1):
            last = parts is not None and index == len(parts)
            result = self.run(part, spans, spans.of(part) or span, run=run, many=many and last)
        return result

    def pieces(self, form: Value, spans: Spans, span: Span | None) -> Iterator[CodeType]:
        """The code of FORM, piece by piece, to be run or not before the next is compiled."""
        form = self._expanded(form, spans, span)
        parts = self._parts(form)
        if parts is None:
            yield self._code(form, spans, span, many=False)
        for part in parts or ():
            yield from self.pieces(part, spans, spans.of(part) or span)

    def _parts(self, form: Value) -> list[Value] | None:
        """The forms that a top-level PROGN or EVAL-WHEN stands for; None for any other form."""
        if form.__class__ is not Cons or form.car not in (PROGN, EVAL_WHEN):
            return None
        rest = form.cdr if form.car is PROGN else form.cdr.cdr if form.cdr.__class__ is Cons else None
        parts = []
        while rest.__class__ is Cons:
            parts.append(rest.car)
            rest = rest.cdr
        return parts if rest is None else None

    def _expanded(self, form: Value, spans: Spans, span: Span | None) -> Value:
        """FORM with its macros expanded at the head, so that a PROGN shows."""
        for _ in range(MOST):
            operator = form.car if form.__class__ is Cons else None
            if not isinstance(operator, Symbol) or operator in self.image.special_forms:
                return form
            cell = self.image.cell(operator)
            if cell.macro is None:
                return form
            analyser, scope = self._scope(spans, spans.of(form) or span)
            if cell.definition is not None:
                analyser.check_shape(cell.definition, form)
            expansion = expand_macro(form, cell.macro, scope, analyser)
            if expansion.__class__ is Cons:
                spans.copy_from(expansion, form)
            form = expansion
        refuse_endless(form, analyser)

    def _scope(self, spans: Spans, span: Span | None) -> tuple[Analyser, Scope]:
        analyser = Analyser(self.image, spans, span, self._expander, self.uses, self.expanders, self.notices)
        return analyser, Scope(None, analyser.procedure("top level", None), analyser)

    def _code(self, form: Value, spans: Spans, span: Span | None, many: bool) -> CodeType:
        """The code of a form; a second attempt takes every block for as deep as it can be."""
        mark = self.unit.mark()
        try:
            analyser, scope = self._scope(spans, span)
            return self.unit.top(analyser.node(form, scope), scope.procedure, many=many)
        except SyntaxError:  # Python: too many statically nested blocks
            self.unit.forget(mark)
        analyser, scope = self._scope(spans, span)
        analyser.block_cost = MOST_BLOCKS
        return self.unit.top(analyser.node(form, scope), scope.procedure, many=many)

    def _expander(self, form: Value, scope: Scope) -> Any:
        """The function of a MACROLET expander; it sees the macros around it, but no variables."""
        analyser = scope.analyser
        inner = Scope(None, analyser.procedure("expander", None), analyser)
        frame: Scope | None = scope
        while frame is not None:
            for name, found in frame.functions.items():
                if isinstance(found, LocalMacro):
                    inner.functions.setdefault(name, found)
            frame = frame.outer
        node = analyser.node(form, inner)
        return self.unit.load(self.unit.top(node, inner.procedure, many=False))()
