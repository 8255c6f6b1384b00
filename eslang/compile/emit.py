"""The emitter: nodes to Python, one procedure at a time. Expressions.

`value` gives a Python expression for a node, having put before it whatever
statements the node needs; `test` the same as Python's truth; `run`
(emit_statements.py) puts statements whose result goes to a destination. Order
of evaluation is Lisp's: when a later argument needs statements, what earlier
arguments computed is kept in temporaries first.
"""

from __future__ import annotations

import ast

from eslang.base.hints import TYPE_CHECKING, NamedTuple
from eslang.base.symbols import Symbol
from eslang.compile import core
from eslang.compile.core import Const, Inline, Local, Node, Procedure, Variable
from eslang.compile.inline import INLINE, TRUTH, constant_test
from eslang.compile.pyast import Builder, depth, is_simple

if TYPE_CHECKING:
    from eslang.compile.unit import Unit

TOO_DEEP = 30  # an expression nested deeper than this is computed in steps


class Destination(NamedTuple):
    """Where a result goes: nowhere, out of the procedure, or into a Python variable."""

    kind: str  # "effect", "return" or "assign"
    many: bool = False  # all values are wanted
    name: str = ""


EFFECT = Destination("effect")
PLAIN = (int, float)


class PythonLoop:
    """A Python loop being emitted, and the jumps that go through it."""

    def __init__(self, target: core.Exit | None, action: str, flag: str = "") -> None:
        self.target = target
        self.action = action  # what a jump to the target does at its level: "break" or "continue"
        self.flag = flag  # the Python variable that says: a jump to the target is under way
        self.flagged = False
        self.through: list[PythonLoop] = []


class ExpressionEmitter(Builder):
    """Emits the expressions of one procedure."""

    def __init__(self, unit: Unit, procedure: Procedure | None, *, many: bool) -> None:
        super().__init__()
        self.unit = unit
        self.procedure = procedure
        self.many = many  # whether this procedure returns all its values
        self.block: list[ast.stmt] = []
        self.loops: list[PythonLoop] = []
        self.exits: dict[core.Exit, Destination] = {}
        self.nonlocals: dict[str, None] = {}
        self.effects = 0  # how many statements with effects were emitted: see `values`
        self.nesting = 0

    # --- names -----------------------------------------------------------------

    def temporary(self) -> str:
        """A Python variable of this procedure that nothing else uses."""
        return self.unit.temporary()

    def put(self, statement: ast.stmt) -> None:
        """Append a statement that may have an effect."""
        self.block.append(statement)
        self.effects += 1

    def keep(self, expression: ast.expr) -> ast.expr:
        """EXPRESSION computed now, into a temporary, unless it is a constant."""
        if isinstance(expression, ast.Constant):
            return expression
        name = self.temporary()
        self.put(self.assign(name, expression))
        return self.name(name)

    def call_function(self, name: str, arguments: list[ast.expr]) -> ast.expr:
        """A call of the standard function NAME, by its cell."""
        return self.call_for(self.function_of(Symbol.intern(name, "COMMON-LISP")), arguments, False)

    def function_of(self, symbol: Symbol) -> ast.expr:
        """The global function of SYMBOL, to be called.

        It is named on the way, since Python would make a method call of
        `cell.function(...)`: slower on 3.11, and its error does not tell the cell.
        """
        return self.name_it("%f", self.attribute(self.name(self.unit.cell(symbol)), "function"))

    # --- what the other half of the emitter does --------------------------------

    def run(self, node: Node, destination: Destination) -> None:
        """Put the statements that run NODE and send its result to DESTINATION."""
        raise NotImplementedError

    def closure(self, node: core.Lambda) -> ast.expr:
        """Put the definition of a function, and give its name."""
        raise NotImplementedError

    # --- values ----------------------------------------------------------------

    def value(self, node: Node, many: bool = False) -> ast.expr:
        """The Python expression for NODE, after the statements it needs."""
        around = self.at
        self.move(node.span)
        emit = getattr(self, "value_" + node.__class__.__name__.lower(), None)
        if emit is not None:
            result: ast.expr = emit(node, many)
        else:
            name = self.temporary()
            self.run(node, Destination("assign", many, name))
            result = self.name(name)
        self.at = around
        return result

    def values(self, nodes: list[Node], *, simple: bool = False) -> list[ast.expr]:
        """The expressions of NODES in order, kept in temporaries where order demands it."""
        results: list[ast.expr] = []
        for node in nodes:
            around, self.block = self.block, []
            effects = self.effects
            result = self.value(node)
            added, self.block = self.block, around
            if self.effects != effects:
                results = [earlier if self.is_stable(earlier) else self.keep(earlier) for earlier in results]
            self.block.extend(added)
            if depth(result) > TOO_DEEP:
                result = self.keep(result)
            results.append(result)
        if simple and not all(map(is_simple, results)):
            results = [result if self.is_stable(result) else self.keep(result) for result in results]
        return results

    def is_stable(self, expression: ast.expr) -> bool:
        """True if EXPRESSION gives the same value later on, whatever runs in between."""
        if isinstance(expression, ast.Constant):
            return True
        return isinstance(expression, ast.Name) and expression.id in self.unit.stable

    def value_const(self, node: Const, many: bool) -> ast.expr:
        value = node.value
        if value is None or value.__class__ is int or (value.__class__ is float and value - value == 0):
            return self.constant(value)
        return self.name(self.unit.constant_name(value))

    def value_local(self, node: Local, many: bool) -> ast.expr:
        return self.read(node.variable)

    def read(self, variable: Variable) -> ast.expr:
        """The value of VARIABLE."""
        name = self.name(variable.name)
        if variable.boxed:
            return self.attribute(name, "value")
        if not variable.assigned:
            self.unit.stable.add(variable.name)
        return name

    def value_global(self, node: core.Global, many: bool) -> ast.expr:
        return self.attribute(self.name(self.unit.cell(node.symbol)), "value")

    def value_functionof(self, node: core.FunctionOf, many: bool) -> ast.expr:
        name = "setf_function" if node.setf else "function"
        return self.attribute(self.name(self.unit.cell(node.symbol)), name)

    def value_setlocal(self, node: core.SetLocal, many: bool) -> ast.expr:
        value = self.value(node.value)
        self.store(node.variable, value)
        return self.keep(self.read(node.variable))

    def value_setglobal(self, node: core.SetGlobal, many: bool) -> ast.expr:
        value = self.keep(self.value(node.value))
        self.put(self.assign_attribute(self.name(self.unit.cell(node.symbol)), "value", value))
        return value

    def store(self, variable: Variable, value: ast.expr) -> None:
        """Give VARIABLE, which is bound, another value."""
        if variable.boxed:
            self.put(self.assign_attribute(self.name(variable.name), "value", value))
            return
        if variable.owner is not self.procedure:
            self.nonlocals[variable.name] = None
        self.put(self.assign(variable.name, value))

    def bind(self, variable: Variable, value: ast.expr) -> None:
        """Give VARIABLE its first value."""
        if variable.boxed:
            value = self.call_support("%Box", value)
        self.put(self.assign(variable.name, value))

    def value_seq(self, node: core.Seq, many: bool) -> ast.expr:
        for part in node.nodes[:-1]:
            self.run(part, EFFECT)
        return self.value(node.nodes[-1], many)

    def value_let(self, node: core.Let, many: bool) -> ast.expr:
        self.bind_all(node)
        return self.value(node.body, many)

    def bind_all(self, node: core.Let) -> None:
        """Bind the variables of a LET, in order."""
        for variable, value in node.bindings:
            expression = self.value(value)
            if variable.mentioned:
                self.bind(variable, expression)
            elif not is_simple(expression):
                self.put(self.effect(expression))

    # --- calls -----------------------------------------------------------------

    def value_call(self, node: core.Call, many: bool) -> ast.expr:
        arguments = self.values(node.arguments)
        return self.call_for(self.function_of(node.symbol), arguments, many)

    def call_for(self, function: ast.expr, arguments: list[ast.expr], many: bool) -> ast.expr:
        """A call for one value or for all."""
        if many:
            function = self.call_support("%many-of", function)
        return self.call(function, arguments)

    def value_funcall(self, node: core.Funcall, many: bool) -> ast.expr:
        function, *arguments = self.values([node.function, *node.arguments])
        if not node.known:
            if not is_simple(function):
                function = self.keep_before(function, arguments)
            kind = self.is_(self.attribute(function, "__class__"), self.name("%Function"))
            function = self.choose(kind, function, self.call_support("%to-function", function))
        return self.call_for(function, arguments, many)

    def keep_before(self, function: ast.expr, arguments: list[ast.expr]) -> ast.expr:
        """FUNCTION in a temporary, computed before ARGUMENTS are."""
        function = self.keep(function)
        arguments[:] = [a if self.is_stable(a) else self.keep(a) for a in arguments]
        return function

    def value_inline(self, node: Inline, many: bool) -> ast.expr:
        inline = INLINE[node.operator]
        result = inline.emit(self, self.values(node.arguments, simple=inline.simple), node.arguments)
        if inline.kind == TRUTH:
            return self.choose(result, self.name("%T"), self.constant(None))
        return result

    def value_lambda(self, node: core.Lambda, many: bool) -> ast.expr:
        return self.closure(node)

    def value_several(self, node: core.Several, many: bool) -> ast.expr:
        expressions = self.values(node.nodes)
        if many and len(expressions) != 1:
            return self.call_support("%Values", self.tuple(expressions))
        if not expressions:
            return self.constant(None)
        if len(expressions) > 1:
            first = expressions[0] if self.is_stable(expressions[0]) else self.keep(expressions[0])
            for part, expression in zip(node.nodes[1:], expressions[1:], strict=True):
                if not (isinstance(expression, ast.Constant) or self.is_own(part)):
                    self.put(self.effect(expression))  # names too: the other variant must find them captured
            return first
        return expressions[0]

    def is_own(self, node: Node) -> bool:
        """True if NODE is a variable of this procedure."""
        return isinstance(node, Local) and node.variable.owner is self.procedure

    def value_gather(self, node: core.Gather, many: bool) -> ast.expr:
        function = self.keep(self.value(node.function))
        collected = [self.keep(self.value(part, many=True)) for part in node.nodes]
        name = "%call-with-values-many" if many else "%call-with-values"
        return self.call_support(name, function, *collected)

    def value_first(self, node: core.First, many: bool) -> ast.expr:
        first = self.keep(self.value(node.first, many))
        for part in node.rest:
            self.run(part, EFFECT)
        return first

    # --- choice ----------------------------------------------------------------

    def apart(self, node: Node, many: bool) -> tuple[ast.expr, list[ast.stmt], bool]:
        """The expression of NODE, its statements apart, and whether they have effects."""
        around, self.block = self.block, []
        effects = self.effects
        result = self.value(node, many)
        added, self.block = self.block, around
        return result, added, self.effects != effects

    def value_if(self, node: core.If, many: bool) -> ast.expr:
        test = self.test(node.test)
        known = constant_test(test)
        if known is not None:
            return self.value(node.then if known else node.otherwise, many)
        self.nesting += 1
        self.unit.check_nesting(self.nesting, node)
        then, before_then, _ = self.apart(node.then, many)
        otherwise, before_otherwise, _ = self.apart(node.otherwise, many)
        self.nesting -= 1
        shallow = max(depth(then), depth(otherwise), depth(test)) <= TOO_DEEP
        if not before_then and not before_otherwise and shallow:
            return self.choose(test, then, otherwise)
        name = self.temporary()
        before_then.append(self.assign(name, then))
        before_otherwise.append(self.assign(name, otherwise))
        self.put(self.if_(test, before_then, before_otherwise))
        return self.name(name)

    def value_or(self, node: core.Or, many: bool) -> ast.expr:
        name = self.temporary()
        result = self.value(node.nodes[0])
        rest = node.nodes[1] if len(node.nodes) == 2 else core.Or(node.span, node.nodes[1:])
        expression, before, _ = self.apart(rest, many)
        if not before and depth(expression) <= TOO_DEEP:
            return self.choose(self.is_true(self.name_it(name, result)), self.name(name), expression)
        self.put(self.assign(name, result))
        before.append(self.assign(name, expression))
        self.put(self.if_(self.is_nil(self.name(name)), before, []))
        return self.name(name)

    def test(self, node: Node) -> ast.expr:
        """NODE as Python's truth; a constant True or False where it is known."""
        around = self.at
        self.move(node.span)
        result = self.test_of(node)
        self.at = around
        return result

    def test_of(self, node: Node) -> ast.expr:
        if isinstance(node, Const):
            return self.constant(node.value is not None)
        if isinstance(node, Inline) and INLINE[node.operator].kind == TRUTH:
            if node.operator in ("NOT", "NULL"):
                return self.negation(node.arguments[0])
            inline = INLINE[node.operator]
            arguments = self.values(node.arguments, simple=inline.simple)
            return inline.emit(self, arguments, node.arguments)
        if isinstance(node, core.If) and isinstance(node.otherwise, Const) and node.otherwise.value is None:
            return self.connect(ast.And(), [node.test, node.then])
        if isinstance(node, core.Or):
            return self.connect(ast.Or(), node.nodes)
        return self.is_true(self.value(node))

    def negation(self, node: Node) -> ast.expr:
        """The opposite of NODE's truth."""
        test = self.test(node)
        known = constant_test(test)
        if known is not None:
            return self.constant(not known)
        if isinstance(test, ast.Compare) and isinstance(test.ops[0], ast.Is | ast.IsNot):
            operator = ast.IsNot() if isinstance(test.ops[0], ast.Is) else ast.Is()
            return self.compare(test.left, operator, test.comparators[0])
        return self.unary(ast.Not(), test)

    def connect(self, operator: ast.boolop, nodes: list[Node]) -> ast.expr:
        """The tests of NODES joined by Python's and/or; in steps, where a later one needs statements."""
        first = self.test(nodes[0])
        if len(nodes) == 1:
            return first
        around, self.block = self.block, []
        self.nesting += 1
        self.unit.check_nesting(self.nesting, nodes[0])
        rest = self.connect(operator, nodes[1:])
        self.nesting -= 1
        added, self.block = self.block, around
        if not added and depth(rest) <= TOO_DEEP:
            return self.both(operator, [first, rest])
        name = self.temporary()
        self.put(self.assign(name, first))
        reached = self.name(name)
        if isinstance(operator, ast.Or):
            reached = self.unary(ast.Not(), reached)
        self.put(self.if_(reached, [*added, self.assign(name, rest)], []))
        return self.name(name)
