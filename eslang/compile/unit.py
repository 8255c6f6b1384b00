"""Units: the Python code of one text, its constants, and how it is put together.

A unit has one table of global names for all its top-level forms: the support
functions, a cell for each global name, the constants. Functions are numbered,
so that the variant of a function that gives all its values can be made from
the function at hand when it is first wanted (many_of).
"""

from __future__ import annotations

import ast
import warnings
from types import CodeType

from eslang.base.diagnostics import error_at
from eslang.base.hints import Any
from eslang.base.image import Image
from eslang.base.symbols import Symbol, Value
from eslang.compile import core
from eslang.compile.code import SEPARATOR, Code
from eslang.compile.core import Exit, Lambda, Node, Procedure
from eslang.compile.emit import Destination
from eslang.compile.emit_functions import Emitter

DEEPEST = 1000  # nested control structures, in statements: Python's compiler walks them on the C stack


class Unit(Code):
    """The code of one text, as it grows form by form."""

    def __init__(self, image: Image, support: dict[str, Any], name: str) -> None:
        super().__init__(image, support)
        self.name = name
        self.cells: dict[Symbol, str] = {}
        self.constants: dict[int, tuple[str, Value]] = {}
        self.lambdas: list[Lambda] = []
        self.titles: dict[str, tuple[str, int]] = {}
        self.stable: set[str] = set()  # Python names that are assigned once
        self.counter = 0

    # --- names -----------------------------------------------------------------

    def temporary(self) -> str:
        """A Python name that nothing else in this unit has."""
        self.counter += 1
        name = f"%{self.counter}"
        self.stable.add(name)
        return name

    def position(self, target: Exit) -> str:
        """The Python variable that says where a tagbody goes on."""
        return f"%at {target.token.name}"

    def cell(self, symbol: Symbol) -> str:
        """The global name of SYMBOL's cell."""
        name = self.cells.get(symbol)
        if name is None:
            name = (
                f"@{symbol.package}:{symbol.name}" if symbol.package else f"@{len(self.cells)}:{symbol.name}"
            )
            self.cells[symbol] = name
            self.add_cell(name, symbol)
        return name

    def constant_name(self, value: Value) -> str:
        """The global name of a constant."""
        entry = self.constants.get(id(value))
        if entry is None:
            entry = (f"'{len(self.constants)}", value)
            self.constants[id(value)] = entry
            self.add_constant(entry[0], value)
        return entry[0]

    def number(self, node: Lambda) -> None:
        """Give a function its number."""
        if not node.number:
            self.lambdas.append(node)
            node.number = len(self.lambdas)

    def mark(self) -> int:
        """How many functions there are, for `forget`."""
        return len(self.lambdas)

    def forget(self, mark: int) -> None:
        """Forget the functions made since MARK: their code could not be compiled."""
        del self.lambdas[mark:]

    def function_name(self, node: Lambda) -> str:
        """A Python name for the definition of a function."""
        self.number(node)
        return f"%function {node.number}"

    def title(self, name: str, node: Lambda) -> None:
        """Let the code of the Python definition NAME carry the Lisp name and the number of NODE."""
        self.titles[name] = (node.procedure.name, node.number)

    def check_nesting(self, nesting: int, node: Node) -> None:
        """Refuse control structures nested so deep that Python could not compile them."""
        if nesting > DEEPEST:
            raise error_at(
                "nested-too-deep", f"control structures are nested more than {DEEPEST} deep", node.span
            )

    # --- putting together ------------------------------------------------------

    def top(self, node: Node, procedure: Procedure, *, many: bool) -> CodeType:
        """The code of a top-level form, as a function without parameters."""
        lambda_ = Lambda(node.span, procedure, [], [], None, None, False, node)
        self.number(lambda_)
        emitter = Emitter(self, procedure, many=many)
        emitter.move(node.span)
        body = emitter.body_of(lambda: emitter.run(node, Destination("return", many)))
        if not body or not isinstance(body[-1], ast.Return):
            body.append(emitter.give(emitter.constant(None)))
        self.title("%top", lambda_)
        definition = emitter.define("%top", [], [], None, body)
        return self.extract([definition], "%top")

    def extract(self, body: list[ast.stmt], name: str) -> CodeType:
        """Compile definitions, and take out the code of the one called NAME."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SyntaxWarning)  # Python's opinions on literals
            module = compile(ast.Module(body, []), self.name, "exec", dont_inherit=True)
        return self.finished(find_code(module, name))

    def finished(self, code: CodeType) -> CodeType:
        """CODE with Lisp names: the qualified name carries the number of the function."""
        constants = tuple(self.finished(c) if isinstance(c, CodeType) else c for c in code.co_consts)
        name, number = self.titles.get(code.co_name, (code.co_name, 0))
        return code.replace(co_consts=constants, co_name=name, co_qualname=f"{name}{SEPARATOR}{number}")

    # --- variants --------------------------------------------------------------

    def variant_code(self, number: int) -> CodeType | None:
        """The code of function NUMBER that gives all its values, made when first wanted."""
        code = self.variants.get(number)
        if code is None:
            node = self.lambdas[number - 1]
            if not may_be_many(node.body):
                return None
            emitter = Emitter(self, node.procedure.parent, many=True)
            emitter.move(node.span)
            name = self.function_name(node)
            definition = emitter.definition(name, node, many=True)
            names = [variable.name for variable in node.procedure.free]
            outer: list[ast.stmt] = [emitter.assign(free, emitter.constant(None)) for free in names]
            wrapper = emitter.define("%outer", [], [], None, [*outer, definition])
            code = self.variants[number] = self.extract([wrapper], name)
        return code


def may_be_many(node: Node) -> bool:
    """True unless NODE surely gives exactly one value."""
    match node:
        case core.Seq(nodes=nodes):
            return may_be_many(nodes[-1])
        case core.If(then=then, otherwise=otherwise):
            return may_be_many(then) or may_be_many(otherwise)
        case (
            core.Let(body=body)
            | core.Receive(body=body)
            | core.Bind(body=body)
            | core.LocalFunctions(body=body)
        ):
            return may_be_many(body)
        case core.Const() | core.Local() | core.Global() | core.Inline() | core.Lambda() | core.FunctionOf():
            return False
        case core.SetLocal() | core.SetGlobal() | core.While() | core.Tagbody():
            return False
    return True


def find_code(code: CodeType, name: str) -> CodeType:
    """The code of the definition called NAME, somewhere inside CODE."""
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            if constant.co_name == name:
                return constant
            try:
                return find_code(constant, name)
            except KeyError:
                pass
    raise KeyError(name)
