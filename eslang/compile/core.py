"""The core language: what every form is made of, some 25 node kinds.

The analyser (core_forms and its neighbours) turns forms into these nodes, the
emitter turns nodes into Python. A node knows where its form stands. Variables,
blocks and tagbodies are objects shared by the nodes that mention them, so what
the analysis learns of them (assigned? captured?) is known when code is emitted.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from eslang.base.spans import Span
from eslang.base.symbols import Symbol, Value


@dataclass(slots=True, eq=False)
class Procedure:
    """One Python function to be: a lambda, or a top-level form."""

    name: str
    parent: Procedure | None
    loops: int = 0  # how many loops of this procedure enclose what is being analysed
    nesting: int = 0  # how many Python blocks do, at most; Python allows 20
    free: dict[Variable, None] = field(default_factory=dict)  # variables of outer procedures


@dataclass(slots=True, eq=False)
class Variable:
    """A lexical variable, or the name of a local function."""

    symbol: Symbol
    name: str  # its Python name, unique in its unit
    owner: Procedure
    in_loop: bool = False  # bound anew each time round a loop of its owner
    assigned: bool = False
    captured: bool = False  # mentioned by an inner procedure
    mentioned: bool = False
    ignorable: bool = False
    given: list[Node] | None = None  # all that it is ever bound or set to; None: not known

    @property
    def fresh(self) -> bool:
        """True if each entry needs a variable of its own for the closures that capture it."""
        return self.captured and self.in_loop

    @property
    def boxed(self) -> bool:
        """True if it lives in a Box, since closures capture it by value and it changes."""
        return self.fresh and self.assigned


@dataclass(slots=True, eq=False)
class Exit:
    """A block or tagbody: a place that code inside it jumps to."""

    symbol: Symbol | None
    owner: Procedure
    token: Variable  # holds what inner procedures name as their target
    jumps: int = 0  # from within its own procedure
    escapes: bool = False  # also from inner procedures


@dataclass(slots=True, eq=False)
class Node:
    """A piece of core language, and where its form stands."""

    span: Span | None


@dataclass(slots=True, eq=False)
class Const(Node):
    value: Value


@dataclass(slots=True, eq=False)
class Local(Node):
    variable: Variable


@dataclass(slots=True, eq=False)
class SetLocal(Node):
    variable: Variable
    value: Node


@dataclass(slots=True, eq=False)
class Global(Node):
    """The value of a special variable."""

    symbol: Symbol


@dataclass(slots=True, eq=False)
class SetGlobal(Node):
    symbol: Symbol
    value: Node


@dataclass(slots=True, eq=False)
class FunctionOf(Node):
    """The global function of a name: a symbol, or (setf symbol)."""

    symbol: Symbol
    setf: bool = False


@dataclass(slots=True, eq=False)
class Optional:
    """An optional parameter: its variable, its default, its supplied-p variable."""

    variable: Variable
    default: Node
    supplied: Variable | None


@dataclass(slots=True, eq=False)
class KeyParameter:
    """A keyword parameter: as an optional one, and the keyword that names it."""

    keyword: Symbol
    variable: Variable
    default: Node
    supplied: Variable | None


@dataclass(slots=True, eq=False)
class Lambda(Node):
    """A function. Special parameters are bound by nodes inside the body."""

    procedure: Procedure
    required: list[Variable]
    optional: list[Optional]
    rest: Variable | None
    keys: list[KeyParameter] | None  # None: no &key at all
    allow_other_keys: bool
    body: Node
    documentation: str | None = None
    number: int = 0  # its number in the unit, from emission on


@dataclass(slots=True, eq=False)
class Call(Node):
    """A call of a global function by name."""

    symbol: Symbol
    arguments: list[Node]


@dataclass(slots=True, eq=False)
class Funcall(Node):
    """A call of whatever FUNCTION gives; `known`: it is surely a function object."""

    function: Node
    arguments: list[Node]
    known: bool = False


@dataclass(slots=True, eq=False)
class Inline(Node):
    """A call of a standard function that is compiled in place (inline.py)."""

    operator: str
    arguments: list[Node]


@dataclass(slots=True, eq=False)
class If(Node):
    test: Node
    then: Node
    otherwise: Node


@dataclass(slots=True, eq=False)
class Or(Node):
    nodes: list[Node]


@dataclass(slots=True, eq=False)
class Seq(Node):
    nodes: list[Node]


@dataclass(slots=True, eq=False)
class Let(Node):
    """Lexical bindings, in order (parallel or not is settled by scope), around a body."""

    bindings: list[tuple[Variable, Node]]
    body: Node


@dataclass(slots=True, eq=False)
class Bind(Node):
    """Dynamic bindings, all at once, around a body."""

    bindings: list[tuple[Symbol, Node]]
    body: Node


@dataclass(slots=True, eq=False)
class Progv(Node):
    symbols: Node
    values: Node
    body: Node


@dataclass(slots=True, eq=False)
class LocalFunctions(Node):
    """FLET or LABELS: functions known by variables, around a body."""

    functions: list[tuple[Variable, Lambda]]
    body: Node


@dataclass(slots=True, eq=False)
class Block(Node):
    exit: Exit
    body: Node


@dataclass(slots=True, eq=False)
class ReturnFrom(Node):
    exit: Exit
    value: Node
    local: bool  # from the block's own procedure


@dataclass(slots=True, eq=False)
class Tagbody(Node):
    """Segments of statements; jump N goes to the start of segment N."""

    exit: Exit
    segments: list[Node]


@dataclass(slots=True, eq=False)
class Go(Node):
    exit: Exit
    segment: int
    local: bool


@dataclass(slots=True, eq=False)
class While(Node):
    """Repeat BODY while TEST is true (None: for ever); its value is NIL."""

    test: Node | None
    body: Node


@dataclass(slots=True, eq=False)
class Protect(Node):
    """UNWIND-PROTECT; the cleanup is a procedure of its own."""

    body: Node
    cleanup: Lambda


@dataclass(slots=True, eq=False)
class Several(Node):
    """(values ...)."""

    nodes: list[Node]


@dataclass(slots=True, eq=False)
class Receive(Node):
    """MULTIPLE-VALUE-BIND: the values of a node, bound to variables, around a body."""

    variables: list[Variable]
    values: Node
    body: Node


@dataclass(slots=True, eq=False)
class Gather(Node):
    """MULTIPLE-VALUE-CALL: all the values of all the nodes, as arguments."""

    function: Node
    nodes: list[Node]


@dataclass(slots=True, eq=False)
class First(Node):
    """MULTIPLE-VALUE-PROG1: all values of the first node, then the rest for effect."""

    first: Node
    rest: list[Node] = field(default_factory=list)
