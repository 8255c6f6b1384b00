"""The emitter: statements, loops and jumps.

A jump within its procedure is Python's return, break or continue; where other
Python loops lie between, a flag carries it outward. A jump from a closure is
an Unwind that names the block's token. Whatever leaves something on the stack
to be jumped to or undone turns Python's errors into failures at its inner
edge (`%signal-error`), so recovery procedures run before it is undone.
"""

from __future__ import annotations

import ast

from eslang.base.hints import Callable
from eslang.compile import core
from eslang.compile.core import Const, Node
from eslang.compile.emit import EFFECT, Destination, ExpressionEmitter, PythonLoop
from eslang.compile.inline import constant_test
from eslang.compile.pyast import is_simple

RETURN, BREAK, CONTINUE = "return", "break", "continue"


class StatementEmitter(ExpressionEmitter):
    """Emits the statements of one procedure."""

    def run(self, node: Node, destination: Destination) -> None:
        around = self.at
        self.move(node.span)
        emit = getattr(self, "run_" + node.__class__.__name__.lower(), None)
        self.unit.check_nesting(self.nesting, node)
        if emit is not None:
            emit(node, destination)
        else:
            self.send(self.value(node, destination.many), destination)
        self.at = around

    def send(self, expression: ast.expr, destination: Destination) -> None:
        """Send a computed result to its destination."""
        if destination.kind == RETURN:
            self.put(self.give(expression))
        elif destination.kind == "assign":
            self.put(self.assign(destination.name, expression))
        elif not is_simple(expression):
            self.put(self.effect(expression))

    def body_of(self, emit: Callable[[], None]) -> list[ast.stmt]:
        """The statements that EMIT puts, apart: they are to stand inside another."""
        around, self.block = self.block, []
        self.nesting += 1
        emit()
        self.nesting -= 1
        added, self.block = self.block, around
        return added

    # --- order and choice ------------------------------------------------------

    def run_seq(self, node: core.Seq, destination: Destination) -> None:
        for part in node.nodes[:-1]:
            self.run(part, EFFECT)
        self.run(node.nodes[-1], destination)

    def run_if(self, node: core.If, destination: Destination) -> None:
        test = self.test(node.test)
        known = constant_test(test)
        if known is not None:
            self.run(node.then if known else node.otherwise, destination)
            return
        then = self.body_of(lambda: self.run(node.then, destination))
        otherwise = self.body_of(lambda: self.run(node.otherwise, destination))
        self.put(self.if_(test, then, otherwise))

    def run_or(self, node: core.Or, destination: Destination) -> None:
        if destination.kind != "effect":
            self.send(self.value_or(node, destination.many), destination)
            return
        last = node.nodes[-1]
        first = node.nodes[0] if len(node.nodes) == 2 else core.Or(node.span, node.nodes[:-1])
        test = self.negation(first)
        self.put(self.if_(test, self.body_of(lambda: self.run(last, EFFECT)), []))

    def run_setlocal(self, node: core.SetLocal, destination: Destination) -> None:
        self.store(node.variable, self.value(node.value))
        if destination.kind != "effect":
            self.send(self.read(node.variable), destination)

    def run_setglobal(self, node: core.SetGlobal, destination: Destination) -> None:
        if destination.kind != "effect":
            self.send(self.value_setglobal(node, False), destination)
            return
        value = self.value(node.value)
        self.put(self.assign_attribute(self.name(self.unit.cell(node.symbol)), "value", value))

    # --- bindings --------------------------------------------------------------

    def run_let(self, node: core.Let, destination: Destination) -> None:
        self.bind_all(node)
        self.run(node.body, destination)

    def run_receive(self, node: core.Receive, destination: Destination) -> None:
        if isinstance(node.values, core.Several):
            self.receive_several(node, node.values)
        else:
            value = self.value(node.values, many=True)
            names = [v.name if v.mentioned else self.temporary() for v in node.variables]
            if names:
                count = self.constant(len(names))
                self.put(self.assign_all(names, self.call_support("%receive", value, count)))
                for variable in node.variables:
                    if variable.mentioned and variable.boxed:
                        self.bind(variable, self.name(variable.name))
            else:
                self.put(self.effect(value))
        self.run(node.body, destination)

    def receive_several(self, node: core.Receive, values: core.Several) -> None:
        """Bind variables to the values of a VALUES form, without making a Values of them."""
        expressions = [self.keep(expression) for expression in self.values(values.nodes)]
        for index, variable in enumerate(node.variables):
            value = expressions[index] if index < len(expressions) else self.constant(None)
            self.bind(variable, value)

    def run_bind(self, node: core.Bind, destination: Destination) -> None:
        values = self.values([value for _, value in node.bindings])
        for (symbol, _), value in zip(node.bindings, values, strict=True):
            cell = self.name(self.unit.cell(symbol))
            self.put(self.effect(self.call_support("%bind", cell, value)))
        undo = self.effect(self.call_support("%unbind", self.constant(len(values))))
        self.guarded(lambda: self.run(node.body, destination), [undo])

    def run_progv(self, node: core.Progv, destination: Destination) -> None:
        symbols, values = self.values([node.symbols, node.values])
        count = self.keep(self.call_support("%bind-all", symbols, values))
        undo = self.effect(self.call_support("%unbind", count))
        self.guarded(lambda: self.run(node.body, destination), [undo])

    # --- protection ------------------------------------------------------------

    def guarded(self, emit: Callable[[], None], final: list[ast.stmt]) -> None:
        """What EMIT puts, with Python's errors made failures, and FINAL run however it is left."""
        body = self.body_of(emit)
        self.put(self.try_(self.edge(body), [], final))

    def edge(self, body: list[ast.stmt]) -> list[ast.stmt]:
        """BODY, with Python's errors made failures at its edge."""
        name = self.temporary()
        signal = self.effect(self.call_support("%signal-error", self.name(name)))
        return [self.try_(body or [self.pass_()], [self.except_("Exception", name, [signal])])]

    def run_protect(self, node: core.Protect, destination: Destination) -> None:
        cleanup = self.closure(node.cleanup)
        run = self.effect(self.call_support("%clean", cleanup))
        self.guarded(lambda: self.run(node.body, destination), [run])

    # --- blocks ----------------------------------------------------------------

    def run_block(self, node: core.Block, destination: Destination) -> None:
        self.exits[node.exit] = destination
        token = node.exit.token
        if not node.exit.escapes:
            self.block_body(node, destination)
            return
        self.bind(token, self.call_support("%Exit"))
        body = self.body_of(lambda: self.block_body(node, destination))
        name = self.temporary()

        def caught() -> None:
            wrong = self.compare(self.attribute(self.name(name), "target"), ast.IsNot(), self.read(token))
            self.put(self.if_(wrong, [self.raise_()], []))
            result = self.attribute(self.name(name), "value")
            self.send(result if destination.many else self.call_support("%primary", result), destination)

        handler = self.except_("%ReturnFrom", name, self.body_of(caught))
        inner = self.try_(self.edge(body), [handler])
        dead = self.assign_attribute(self.read(token), "live", self.constant(False))
        self.put(self.try_([inner], [], [dead]))

    def block_body(self, node: core.Block, destination: Destination) -> None:
        """The body of a block; in a Python loop to break out of, where something jumps."""
        if not node.exit.jumps or destination.kind == RETURN:
            self.run(node.body, destination)
            return
        loop = PythonLoop(node.exit, BREAK, self.temporary())

        def body() -> None:
            self.run(node.body, destination)
            self.put(self.break_())

        self.python_loop(loop, body, self.forever)

    def python_loop(
        self, loop: PythonLoop, emit: Callable[[], None], make: Callable[[list[ast.stmt]], ast.stmt]
    ) -> None:
        """Put a Python loop around what EMIT puts, and pass on the jumps that go through it."""
        self.loops.append(loop)
        body = self.body_of(emit)
        self.loops.pop()
        if loop.flagged:
            self.put(self.assign(loop.flag, self.constant(False)))
        self.put(make(body))
        for target in loop.through:
            onward = self.break_()
            if self.loops[-1] is target and target.action == CONTINUE:
                self.put(
                    self.if_(
                        self.name(target.flag),
                        [self.assign(target.flag, self.constant(False)), self.continue_()],
                        [],
                    )
                )
            else:
                if self.loops[-1] is not target and target not in self.loops[-1].through:
                    self.loops[-1].through.append(target)
                self.put(self.if_(self.name(target.flag), [onward], []))

    def jump(self, target: core.Exit) -> None:
        """Jump to TARGET, whose Python loop is around here."""
        index = next(i for i, loop in enumerate(self.loops) if loop.target is target)
        loop = self.loops[index]
        if index == len(self.loops) - 1:
            self.put(self.continue_() if loop.action == CONTINUE else self.break_())
            return
        loop.flagged = True
        innermost = self.loops[-1]
        if loop not in innermost.through:
            innermost.through.append(loop)
        self.put(self.assign(loop.flag, self.constant(True)))
        self.put(self.break_())

    def run_returnfrom(self, node: core.ReturnFrom, destination: Destination) -> None:
        if not node.local:
            value = self.value(node.value, many=True)
            token = self.read(node.exit.token)
            self.put(self.effect(self.call_support("%return-from", token, value)))
            return
        target = self.exits[node.exit]
        self.run(node.value, target)
        if target.kind != RETURN:
            self.jump(node.exit)

    # --- tags and loops --------------------------------------------------------

    def run_tagbody(self, node: core.Tagbody, destination: Destination) -> None:
        target = node.exit
        if not target.jumps and not target.escapes:
            for segment in node.segments:
                self.run(segment, EFFECT)
        else:
            self.dispatch(node)
        self.send(self.constant(None), destination)

    def dispatch(self, node: core.Tagbody) -> None:
        """The segments of a tagbody, in a loop that starts at the one jumped to."""
        target = node.exit
        position = self.unit.position(target)
        if target.escapes:
            self.bind(target.token, self.call_support("%Exit"))
        self.put(self.assign(position, self.constant(0)))

        def segments() -> None:
            for number, segment in enumerate(node.segments):
                reached = self.compare(self.name(position), ast.LtE(), self.constant(number))
                body = self.body_of(lambda segment=segment: self.run(segment, EFFECT))  # type: ignore[misc]
                if body:
                    self.put(
                        self.if_(reached, body, []) if number + 1 < len(node.segments) else body_of_last(body)
                    )
            self.put(self.break_())

        def body_of_last(body: list[ast.stmt]) -> ast.stmt:
            return self.if_(self.constant(True), body, [])

        def catching() -> None:
            name = self.temporary()
            wrong = self.compare(
                self.attribute(self.name(name), "target"), ast.IsNot(), self.read(target.token)
            )
            caught = [
                self.if_(wrong, [self.raise_()], []),
                self.assign(position, self.attribute(self.name(name), "value")),
            ]
            self.put(self.try_(self.edge(self.body_of(segments)), [self.except_("%Go", name, caught)]))

        loop = PythonLoop(target, CONTINUE, self.temporary())
        if target.escapes:
            body = self.body_of(lambda: self.python_loop(loop, catching, self.ticking))
            dead = self.assign_attribute(self.read(target.token), "live", self.constant(False))
            self.put(self.try_(body, [], [dead]))
        else:
            self.python_loop(loop, segments, self.ticking)

    def run_go(self, node: core.Go, destination: Destination) -> None:
        segment = self.constant(node.segment)
        if not node.local:
            self.put(self.effect(self.call_support("%go", self.read(node.exit.token), segment)))
            return
        self.put(self.assign(self.unit.position(node.exit), segment))
        self.jump(node.exit)

    def run_while(self, node: core.While, destination: Destination) -> None:
        def body() -> None:
            if node.test is not None:
                test = self.test(node.test)
                known = constant_test(test)
                if known is None:
                    self.put(self.if_(self.unary(ast.Not(), test), [self.break_()], []))
                elif not known:
                    self.put(self.break_())
            self.run(node.body, EFFECT)

        self.python_loop(PythonLoop(None, BREAK), body, self.ticking)
        if not isinstance(node.test, Const) or node.test.value is None:
            self.send(self.constant(None), destination)
