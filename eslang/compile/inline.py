"""Standard functions that are compiled in place.

Common Lisp forbids programs to redefine its functions, so (+ a b) may be
Python's a + b. That is right because no value of ours but a number does
arithmetic (base/symbols.Datum), and because ordering, unlike Python's ==,
refuses what is no number: hence `=` of unknown values is two comparisons.
"""

from __future__ import annotations

import ast

from eslang.base.hints import TYPE_CHECKING, Any, Callable, NamedTuple
from eslang.base.symbols import Symbol
from eslang.base.text import Character
from eslang.compile.core import Const, Inline, Local, Node
from eslang.compile.pyast import is_simple

if TYPE_CHECKING:
    from eslang.compile.emit import ExpressionEmitter as Emitter

Emit = Callable[["Emitter", list[ast.expr], list[Node]], ast.expr]
VALUE, NUMBER, TRUTH = "value", "number", "truth"


class InlineFunction(NamedTuple):
    """How one standard function is compiled; its kind says what the Python expression gives."""

    least: int
    most: int | None
    kind: str
    emit: Emit
    simple: bool  # the arguments must be names or constants, since they are used twice

    def takes(self, count: int) -> bool:
        return count >= self.least and (self.most is None or count <= self.most)


INLINE: dict[str, InlineFunction] = {}


def inline(
    name: str, least: int, most: int | None, kind: str, *, simple: bool = False
) -> Callable[[Emit], Emit]:
    """Register the emitter of the standard function NAME."""

    def register(emit: Emit) -> Emit:
        INLINE[name] = InlineFunction(least, most, kind, emit, simple)
        return emit

    return register


def is_number(node: Node) -> bool:
    """True if NODE surely gives a number; a variable does if it is never given anything else."""
    if isinstance(node, Local):
        given = node.variable.given
        return given is not None and all(not isinstance(value, Local) and is_number(value) for value in given)
    if isinstance(node, Const):
        return node.value.__class__ in (int, float)
    return isinstance(node, Inline) and INLINE[node.operator].kind == NUMBER


def is_integer(expression: ast.expr) -> bool:
    """True if EXPRESSION is an integer as it stands."""
    return isinstance(expression, ast.Constant) and expression.value.__class__ is int


# --- arithmetic --------------------------------------------------------------------


def _fold(name: str, operator: type[ast.operator]) -> None:
    @inline(name, 2, None, NUMBER)
    def emit(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
        result = arguments[0]
        for argument in arguments[1:]:
            result = e.operate(result, operator(), argument)
        return result


_fold("+", ast.Add)
_fold("-", ast.Sub)
_fold("*", ast.Mult)


@inline("1+", 1, 1, NUMBER)
def _increment(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
    return e.operate(arguments[0], ast.Add(), e.constant(1))


@inline("1-", 1, 1, NUMBER)
def _decrement(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
    return e.operate(arguments[0], ast.Sub(), e.constant(1))


@inline("MOD", 2, 2, NUMBER)
def _mod(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
    return e.operate(arguments[0], ast.Mod(), arguments[1])


@inline("ABS", 1, 1, NUMBER)
def _abs(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
    return e.call_support("abs", *arguments)


def _extreme(name: str, operator: type[ast.cmpop]) -> None:
    @inline(name, 2, 2, NUMBER)
    def emit(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
        (left, again), (right, once_more) = _twice(e, arguments[0]), _twice(e, arguments[1])
        return e.choose(e.compare(left, operator(), right), again, once_more)


_extreme("MAX", ast.GtE)
_extreme("MIN", ast.LtE)


def _parity(name: str, operator: type[ast.cmpop]) -> None:
    @inline(name, 1, 1, TRUTH, simple=True)
    def emit(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
        integer = e.is_(e.attribute(arguments[0], "__class__"), e.name("int"))
        rest = e.operate(arguments[0], ast.Mod(), e.constant(2))
        other = e.is_true(e.call_function(name, arguments))
        return e.choose(integer, e.compare(rest, operator(), e.constant(0)), other)


_parity("EVENP", ast.Eq)
_parity("ODDP", ast.NotEq)


def _order(name: str, operator: type[ast.cmpop]) -> None:
    @inline(name, 2, 2, TRUTH)
    def emit(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
        return e.compare(arguments[0], operator(), arguments[1])


for _name, _operator in (("<", ast.Lt), (">", ast.Gt), ("<=", ast.LtE), (">=", ast.GtE)):
    _order(_name, _operator)


def _twice(e: Emitter, expression: ast.expr) -> tuple[ast.expr, ast.expr]:
    """EXPRESSION for two uses, of which the first comes first and in any case."""
    if is_simple(expression):
        return expression, expression
    name = e.temporary()
    return e.name_it(name, expression), e.name(name)


def _equal_numbers(e: Emitter, left: ast.expr, right: ast.expr, nodes: list[Node]) -> ast.expr:
    if all(is_number(node) for node in nodes):
        return e.compare(left, ast.Eq(), right)
    (left, again), (right, once_more) = _twice(e, left), _twice(e, right)
    return e.both(ast.And(), [e.compare(left, ast.LtE(), right), e.compare(again, ast.GtE(), once_more)])


@inline("=", 2, 2, TRUTH)
def _number_equal(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
    return _equal_numbers(e, arguments[0], arguments[1], nodes)


@inline("/=", 2, 2, TRUTH)
def _number_unequal(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
    return e.unary(ast.Not(), _equal_numbers(e, arguments[0], arguments[1], nodes))


@inline("ZEROP", 1, 1, TRUTH)
def _zerop(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
    return _equal_numbers(e, arguments[0], e.constant(0), nodes)


@inline("PLUSP", 1, 1, TRUTH)
def _plusp(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
    return e.compare(arguments[0], ast.Gt(), e.constant(0))


@inline("MINUSP", 1, 1, TRUTH)
def _minusp(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
    return e.compare(arguments[0], ast.Lt(), e.constant(0))


# --- sameness ----------------------------------------------------------------------


def _by_identity(nodes: list[Node]) -> bool:
    """True if one of the nodes is a constant that nothing but itself is EQUAL to."""
    return any(
        isinstance(node, Const) and (node.value is None or isinstance(node.value, (Symbol, Character)))
        for node in nodes
    )


def _sameness(name: str, support: str) -> None:
    @inline(name, 2, 2, TRUTH)
    def emit(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
        literal = any(isinstance(a, ast.Constant) and a.value is not None for a in arguments)
        if _by_identity(nodes) and not literal:
            return e.is_(arguments[0], arguments[1])
        return e.call_support(support, *arguments)


_sameness("EQ", "%eq")
_sameness("EQL", "%eql")


@inline("NULL", 1, 1, TRUTH)
@inline("NOT", 1, 1, TRUTH)
def _null(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
    return e.is_nil(arguments[0])


def _class_test(name: str, support: str, *, negated: bool = False) -> None:
    @inline(name, 1, 1, TRUTH)
    def emit(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
        operator = ast.IsNot() if negated else ast.Is()
        return e.compare(e.attribute(arguments[0], "__class__"), operator, e.name(support))


_class_test("CONSP", "Cons")
_class_test("ATOM", "Cons", negated=True)
_class_test("INTEGERP", "int")
_class_test("FLOATP", "float")
_class_test("STRINGP", "String")
_class_test("CHARACTERP", "Character")


# --- conses and vectors ------------------------------------------------------------


def _part(e: Emitter, owner: ast.expr, name: str) -> ast.expr:
    """The car or cdr of OWNER, which may be NIL."""
    if is_simple(owner):
        return e.choose(e.is_true(owner), e.attribute(owner, name), e.constant(None))
    temporary = e.temporary()
    test = e.is_true(e.name_it(temporary, owner))
    return e.choose(test, e.attribute(e.name(temporary), name), e.constant(None))


def _path(name: str, letters: str) -> None:
    @inline(name, 1, 1, VALUE)
    def emit(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
        result = arguments[0]
        for letter in reversed(letters):
            result = _part(e, result, "car" if letter == "A" else "cdr")
        return result


for _letters in ("A", "D", "AA", "AD", "DA", "DD", "ADD", "DDD", "ADDD"):
    _path(f"C{_letters}R", _letters)
for _name, _letters in (
    ("FIRST", "A"),
    ("REST", "D"),
    ("SECOND", "AD"),
    ("THIRD", "ADD"),
    ("FOURTH", "ADDD"),
):
    _path(_name, _letters)


def _sure_part(name: str, attribute: str) -> None:
    """The car or cdr of what DOLIST or LOOP knows is no NIL; what is no cons is a type error."""

    @inline(name, 1, 1, VALUE)
    def emit(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
        return e.attribute(arguments[0], attribute)


_sure_part("%CAR", "car")
_sure_part("%CDR", "cdr")


@inline("CONS", 2, 2, VALUE)
def _cons(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
    return e.call_support("Cons", *arguments)


@inline("LIST", 0, 8, VALUE)
def _list(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
    result = e.constant(None)
    for argument in reversed(arguments):
        result = e.call_support("Cons", argument, result)
    return result


def _element(name: str) -> None:
    @inline(name, 2, 2, VALUE, simple=True)
    def emit(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
        vector, index = arguments
        items = e.attribute(vector, "items")
        below = e.compare(index, ast.Lt(), e.call_support("len", items))
        tests = [e.is_(e.attribute(vector, "__class__"), e.name("Vector"))]
        if not is_integer(index):
            tests.append(e.is_(e.attribute(index, "__class__"), e.name("int")))
        tests += [e.compare(e.constant(0), ast.LtE(), index), below]
        return e.choose(e.both(ast.And(), tests), e.subscript(items, index), e.call_function(name, arguments))


_element("AREF")
_element("SVREF")


@inline("%COLLECT", 2, 2, VALUE)
def _collect(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
    cell = e.keep(e.call_support("Cons", arguments[1], e.constant(None)))
    e.put(e.assign_attribute(arguments[0], "cdr", cell))
    return cell


# --- characters ----------------------------------------------------------------------


def _character(e: Emitter, argument: ast.expr) -> ast.expr:
    """The Python text of a character."""
    return e.attribute(argument, "char")


@inline("CHAR-CODE", 1, 1, VALUE)
def _char_code(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
    return e.call_support("ord", _character(e, arguments[0]))


@inline("CODE-CHAR", 1, 1, VALUE, simple=True)
def _code_char(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
    code = arguments[0]
    tests = [
        e.is_(e.attribute(code, "__class__"), e.name("int")),
        e.compare(e.constant(0), ast.LtE(), code),
        e.compare(code, ast.Lt(), e.constant(0x110000)),
    ]
    found = e.subscript(e.name("%Characters"), e.call_support("chr", code))
    return e.choose(e.both(ast.And(), tests), found, e.call_function("CODE-CHAR", arguments))


def _character_test(name: str, method: str) -> None:
    @inline(name, 1, 1, TRUTH)
    def emit(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
        return e.call(e.attribute(_character(e, arguments[0]), method), [])


_character_test("ALPHA-CHAR-P", "isalpha")
_character_test("ALPHANUMERICP", "isalnum")


def _character_order(name: str, operator: type[ast.cmpop]) -> None:
    @inline(name, 2, 2, TRUTH)
    def emit(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
        return e.compare(_character(e, arguments[0]), operator(), _character(e, arguments[1]))


_character_order("CHAR=", ast.Eq)
_character_order("CHAR/=", ast.NotEq)
_character_order("CHAR<", ast.Lt)
_character_order("CHAR>", ast.Gt)


def _character_at(name: str) -> None:
    @inline(name, 2, 2, VALUE, simple=True)
    def emit(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
        string, index = arguments
        text = e.attribute(string, "text")
        tests = [e.is_(e.attribute(string, "__class__"), e.name("String"))]
        if not is_integer(index):
            tests.append(e.is_(e.attribute(index, "__class__"), e.name("int")))
        tests.append(e.compare(e.constant(0), ast.LtE(), index))
        tests.append(e.compare(index, ast.Lt(), e.call_support("len", text)))
        found = e.subscript(e.name("%Characters"), e.subscript(text, index))
        return e.choose(e.both(ast.And(), tests), found, e.call_function(name, arguments))


_character_at("CHAR")
_character_at("SCHAR")


@inline("IDENTITY", 1, 1, VALUE)
def _identity(e: Emitter, arguments: list[ast.expr], nodes: list[Node]) -> ast.expr:
    return arguments[0]


def constant_test(expression: Any) -> bool | None:
    """The truth of a test that is known; None: it must be computed."""
    return bool(expression.value) if expression.__class__ is ast.Constant else None
