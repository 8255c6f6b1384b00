"""Python syntax, built in few words and with the place of the Lisp form on every node.

Expressions remember how deep they are nested, because Python's own compiler
walks them recursively: the emitter computes deep ones in steps.
"""

from __future__ import annotations

import ast

from eslang.base.hints import Any, Iterable
from eslang.base.spans import Span

LOAD, STORE = ast.Load(), ast.Store()


def depth(expression: ast.expr) -> int:
    """How deep EXPRESSION is nested, as far as this module built it."""
    return getattr(expression, "eslang_depth", 0)


def _deep(expression: Any, *parts: ast.expr) -> Any:
    expression.eslang_depth = 1 + max(map(depth, parts), default=0)
    return expression


def is_simple(expression: ast.expr) -> bool:
    """True if EXPRESSION is a name or a constant: cheap, and without effect."""
    return expression.__class__ is ast.Name or expression.__class__ is ast.Constant


class Builder:
    """Makes Python AST nodes at one place of the Lisp text after another."""

    def __init__(self) -> None:
        self.at: dict[str, Any] = {"lineno": 1, "col_offset": 0, "end_lineno": 1, "end_col_offset": 0}

    def move(self, span: Span | None) -> None:
        """Let the nodes to come stand at SPAN."""
        if span is not None:
            self.at = {
                "lineno": span.line,
                "col_offset": span.column - 1,
                "end_lineno": span.end_line,
                "end_col_offset": span.end_column - 1,
            }

    def start(self) -> dict[str, Any]:
        """The place of an attribute. Python takes one of several lines to its last, so it gets but one."""
        at = self.at
        if at["lineno"] == at["end_lineno"]:
            return at
        return {**at, "end_lineno": at["lineno"], "end_col_offset": at["col_offset"] + 1}

    # --- expressions -----------------------------------------------------------

    def name(self, name: str) -> ast.expr:
        return ast.Name(name, LOAD, **self.at)

    def constant(self, value: Any) -> ast.expr:
        return ast.Constant(value, **self.at)

    def attribute(self, owner: ast.expr, name: str) -> ast.expr:
        return _deep(ast.Attribute(owner, name, LOAD, **self.start()), owner)  # type: ignore[no-any-return]

    def call(self, function: ast.expr, arguments: Iterable[ast.expr]) -> ast.expr:
        parts = list(arguments)
        return _deep(ast.Call(function, parts, [], **self.at), function, *parts)  # type: ignore[no-any-return]

    def call_support(self, name: str, *arguments: ast.expr) -> ast.expr:
        return self.call(self.name(name), arguments)

    def compare(self, left: ast.expr, operator: ast.cmpop, right: ast.expr) -> ast.expr:
        return _deep(ast.Compare(left, [operator], [right], **self.at), left, right)  # type: ignore[no-any-return]

    def is_(self, left: ast.expr, right: ast.expr) -> ast.expr:
        return self.compare(left, ast.Is(), right)

    def is_nil(self, value: ast.expr) -> ast.expr:
        if isinstance(value, ast.Constant):
            return self.constant(value.value is None)
        return self.compare(value, ast.Is(), self.constant(None))

    def is_true(self, value: ast.expr) -> ast.expr:
        if isinstance(value, ast.Constant):
            return self.constant(value.value is not None)
        return self.compare(value, ast.IsNot(), self.constant(None))

    def operate(self, left: ast.expr, operator: ast.operator, right: ast.expr) -> ast.expr:
        return _deep(ast.BinOp(left, operator, right, **self.at), left, right)  # type: ignore[no-any-return]

    def unary(self, operator: ast.unaryop, operand: ast.expr) -> ast.expr:
        return _deep(ast.UnaryOp(operator, operand, **self.at), operand)  # type: ignore[no-any-return]

    def choose(self, test: ast.expr, then: ast.expr, otherwise: ast.expr) -> ast.expr:
        return _deep(ast.IfExp(test, then, otherwise, **self.at), test, then, otherwise)  # type: ignore[no-any-return]

    def both(self, operator: ast.boolop, parts: list[ast.expr]) -> ast.expr:
        return _deep(ast.BoolOp(operator, parts, **self.at), *parts)  # type: ignore[no-any-return]

    def subscript(self, owner: ast.expr, index: ast.expr) -> ast.expr:
        return _deep(ast.Subscript(owner, index, LOAD, **self.at), owner, index)  # type: ignore[no-any-return]

    def tuple(self, parts: list[ast.expr]) -> ast.expr:
        return _deep(ast.Tuple(parts, LOAD, **self.at), *parts)  # type: ignore[no-any-return]

    def name_it(self, name: str, value: ast.expr) -> ast.expr:
        """`(name := value)`."""
        target = ast.Name(name, STORE, **self.at)
        return _deep(ast.NamedExpr(target, value, **self.at), value)  # type: ignore[no-any-return]

    # --- statements ------------------------------------------------------------

    def assign(self, name: str, value: ast.expr) -> ast.stmt:
        return ast.Assign([ast.Name(name, STORE, **self.at)], value, **self.at)

    def assign_all(self, names: list[str], value: ast.expr) -> ast.stmt:
        targets: list[ast.expr] = [ast.Name(name, STORE, **self.at) for name in names]
        return ast.Assign([ast.Tuple(targets, STORE, **self.at)], value, **self.at)

    def assign_attribute(self, owner: ast.expr, name: str, value: ast.expr) -> ast.stmt:
        return ast.Assign([ast.Attribute(owner, name, STORE, **self.start())], value, **self.at)

    def effect(self, value: ast.expr) -> ast.stmt:
        return ast.Expr(value, **self.at)

    def give(self, value: ast.expr) -> ast.stmt:
        return ast.Return(value, **self.at)

    def if_(self, test: ast.expr, then: list[ast.stmt], otherwise: list[ast.stmt]) -> ast.stmt:
        return ast.If(test, then or [self.pass_()], otherwise, **self.at)

    def pass_(self) -> ast.stmt:
        return ast.Pass(**self.at)

    def break_(self) -> ast.stmt:
        return ast.Break(**self.at)

    def continue_(self) -> ast.stmt:
        return ast.Continue(**self.at)

    def raise_(self, value: ast.expr | None = None) -> ast.stmt:
        return ast.Raise(value, None, **self.at)

    def forever(self, body: list[ast.stmt]) -> ast.stmt:
        """`while True:`, for what runs once and may break."""
        return ast.While(self.constant(True), body, [], **self.at)

    def ticking(self, body: list[ast.stmt]) -> ast.stmt:
        """An endless loop whose rounds count as steps: `for _ in %ticks.source:`."""
        target = ast.Name("%round", STORE, **self.at)
        return ast.For(
            target, self.attribute(self.name("%ticks"), "source"), body or [self.pass_()], [], **self.at
        )

    def try_(
        self, body: list[ast.stmt], handlers: list[ast.ExceptHandler], final: list[ast.stmt] | None = None
    ) -> ast.stmt:
        return ast.Try(body, handlers, [], final or [], **self.at)

    def except_(self, kind: str, name: str | None, body: list[ast.stmt]) -> ast.ExceptHandler:
        return ast.ExceptHandler(self.name(kind), name, body, **self.at)

    def nonlocal_(self, names: list[str]) -> ast.stmt:
        return ast.Nonlocal(names, **self.at)

    def define(
        self,
        name: str,
        parameters: list[str],
        defaults: list[ast.expr],
        rest: str | None,
        body: list[ast.stmt],
    ) -> ast.stmt:
        arguments = ast.arguments(
            posonlyargs=[],
            args=[ast.arg(p, None, **self.at) for p in parameters],
            vararg=ast.arg(rest, None, **self.at) if rest is not None else None,
            kwonlyargs=[],
            kw_defaults=[],
            kwarg=None,
            defaults=defaults,
        )
        fields: dict[str, Any] = {"type_params": []} if hasattr(ast, "TypeAlias") else {}
        return ast.FunctionDef(name, arguments, body, [], None, **fields, **self.at)
