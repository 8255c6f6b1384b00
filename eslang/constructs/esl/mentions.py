"""What a program says of relations, as far as its text shows: a fact or query that it writes, a rule.

The analyser has noted the calls of the constructs; what stands in their
arguments under a quote or a backquote, or in (list 'relation ...), is read here.
"""

from __future__ import annotations

from eslang.base.hints import Any, Callable, Iterable, Iterator, NamedTuple
from eslang.base.lists import Cons, from_items, items
from eslang.base.spans import Span
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.base.text import String
from eslang.compile.analyser import Use
from eslang.compile.core import Call, Const, If, Inline, Node
from eslang.compile.registry import CL, ESL, SCS
from eslang.constructs.queries import LOGICAL_BINDING
from eslang.facts.goals import CONNECTIVES
from eslang.facts.unify import is_variable

DECLARED, DERIVED, ASSERTED = "declared", "derived", "asserted"
ASKED, CONDITION, GOAL = "asked", "condition", "goal"
UNKNOWN = Keyword("UNKNOWN")  # stands for what the text does not show
FUNCALL = Symbol.intern("FUNCALL", CL)


class Mention(NamedTuple):
    """A relation is spoken of: how, with how many arguments if that shows, and where."""

    how: str
    name: Symbol
    arity: int | None
    span: Span | None
    use: Use


class Question(NamedTuple):
    """A query as it is written, whose variables have no values from outside; or the body of a rule."""

    query: Value
    use: Use
    head: Value = None


class Mentions:
    """All that a program says of relations."""

    def __init__(self, uses: Iterable[Use], is_whole: bool) -> None:
        self.all: list[Mention] = []
        self.questions: list[Question] = []
        self.rules: list[Question] = []
        self.arguments: dict[tuple[Symbol, int], Value] = {}  # their names, where they are declared
        self.unquoted: list[tuple[Symbol, Span]] = []  # lists that are called where data is meant
        self.variables: list[tuple[Mention, Mention]] = []  # in unquoted queries: the query, the variable
        self.is_strict = False  # DEFRELATION stands in it: relations are to be declared
        self.is_whole = is_whole  # nothing is asserted that does not show
        for use in uses:
            if use.kind == "function" and use.symbol in ASSERTING:
                self.is_whole = False
            elif use.kind == "call" and use.arguments is not None:
                read = READERS.get(use.symbol)
                if read is not None:
                    self.note_unquoted(use)
                    read(self, use, [literal(node) for node in use.arguments])

    # --- what the constructs say ---------------------------------------------------

    def assert_fact(self, use: Use, given: list[Value]) -> None:
        """ASSERT: the fact."""
        self.note_asserted(use, given[0] if given else UNKNOWN)

    def ask(self, use: Use, given: list[Value]) -> None:
        """DB-QUERY and what is like it: the query, and whether bindings are inherited."""
        if given:
            self.note_query(ASKED, use, given[0])
            if len(given) < 2 or given[1] is None:
                self.questions.append(Question(given[0], use))

    def retract(self, use: Use, given: list[Value]) -> None:
        """RETRACT: the pattern."""
        if given:
            self.note_query(ASKED, use, given[0])

    def update(self, use: Use, given: list[Value]) -> None:
        """UPDATE: the pattern, and the fact."""
        self.retract(use, given)
        self.assert_fact(use, given[1:])

    def hold(self, use: Use, given: list[Value]) -> None:
        """A condition."""
        self.note_query(CONDITION, use, given[0])
        if use.scope.analyser.spans.of(use.form.cdr.car) is None:  # the program has no quote there
            self.note_variables(use, given[0])
        self.questions.append(Question(given[0], use))

    def maintain(self, use: Use, given: list[Value]) -> None:
        """WITH-MAINTAINED-PROPERTIES: the properties."""
        if given[0].__class__ is not Cons:
            return
        for wanted, form in zip(items(given[0]), items(use.form.cdr.car.cdr), strict=False):
            self.note_query(CONDITION, use, wanted)
            if use.scope.analyser.spans.of(form) is None:  # the program has no quote there
                self.note_variables(use, wanted)

    def define_goal(self, use: Use, given: list[Value]) -> None:
        """TO-ACHIEVE: the pattern."""
        self.note_query(GOAL, use, given[0])

    def give_goal(self, use: Use, given: list[Value]) -> None:
        """ADD-GOAL and DROP-GOAL: what is written, if its condition is a query; else its test is read."""
        goal, tests = given[0], given[2:3]
        if goal.__class__ is Cons and goal.cdr.__class__ is Cons and tests in ([], [None]):
            self.note_query(CONDITION, use, goal.cdr.car)
            self.questions.append(Question(goal.cdr.car, use))

    def define_relation(self, use: Use, given: list[Value]) -> None:
        """DEFRELATION and DEFPROPERTY: the name, and the arguments."""
        name, arguments = [*given, None, None][:2]
        if use.symbol is DEFINE_RELATION:
            self.is_strict = True
        if isinstance(name, Symbol):
            arity = arguments if arguments.__class__ is int else length_of(arguments)
            if arguments is None or arguments.__class__ is String:
                arity = None
            elif arity is not None and arguments.__class__ is Cons:
                self.arguments[name, arity] = arguments
            self.all.append(Mention(DECLARED, name, arity, use.span, use))

    def define_rule(self, use: Use, given: list[Value]) -> None:
        """DEFRULE: head and body."""
        head, body = [*given, None][:2]
        if head.__class__ is Cons and isinstance(head.car, Symbol):
            self.all.append(Mention(DERIVED, head.car, length_of(head.cdr), place_of(head, use), use))
        if body.__class__ is Cons:
            for goal in items(body):
                self.note_query(ASKED, use, goal)
        self.rules.append(Question(body, use, head))

    def open(self, use: Use, given: list[Value]) -> None:
        """What brings facts that the text does not show."""
        self.is_whole = False

    # --- notes ---------------------------------------------------------------------

    def note_unquoted(self, use: Use) -> None:
        """The arguments of USE that are no data, but look like it."""
        rest = use.form.cdr if use.symbol in TAKING_FACTS else None
        while rest.__class__ is Cons:
            part, rest = rest.car, rest.cdr
            place = use.scope.analyser.spans.of(part)
            if place is not None and isinstance(part.car, Symbol):
                self.unquoted.append((part.car, place))

    def note_asserted(self, use: Use, fact: Value) -> None:
        """FACT is asserted."""
        if fact.__class__ is Cons and isinstance(fact.car, Symbol) and fact.car is not UNKNOWN:
            self.all.append(Mention(ASSERTED, fact.car, length_of(fact.cdr), place_of(fact, use), use))
        else:
            self.is_whole = False

    def note_query(self, how: str, use: Use, query: Value) -> None:
        """QUERY is asked."""
        for goal in goals_of(query):
            self.all.append(Mention(how, goal.car, length_of(goal.cdr), place_of(goal, use), use))

    def note_variables(self, use: Use, query: Value) -> None:
        """In QUERY, names stand for themselves that are names of variables there."""
        for goal in goals_of(query):
            asked = Mention(CONDITION, goal.car, length_of(goal.cdr), place_of(goal, use), use)
            for part in parts_of(goal.cdr):
                name = part.car
                if name.__class__ is Symbol and any(name in frame.variables for frame in use.scope.frames()):
                    self.variables.append((asked, Mention(CONDITION, name, None, place_of(part, use), use)))


def goals_of(query: Value) -> Iterator[Cons]:
    """The patterns and tests in QUERY."""
    pending = [query]
    while pending:
        goal = pending.pop()
        if goal.__class__ is not Cons or not isinstance(goal.car, Symbol):
            continue
        if goal.car in CONNECTIVES:
            rest = goal.cdr
            while rest.__class__ is Cons:
                pending.append(rest.car)
                rest = rest.cdr
        elif goal.car not in (FUNCALL, LOGICAL_BINDING, UNKNOWN) and not is_variable(goal.car):
            yield goal


def length_of(arguments: Value) -> int | None:
    """How many ARGUMENTS there are, if all show."""
    count = 0
    while arguments.__class__ is Cons:
        count += 1
        arguments = arguments.cdr
    return count if arguments is None else None


def place_of(pattern: Cons, use: Use) -> Span | None:
    """Where the name stands with which PATTERN begins, or the call that it is in."""
    spans = use.scope.analyser.spans
    place = spans.element(pattern)
    if place is None:  # it is made of parts of the call
        places = [spans.element(part) for part in parts_of(use.form) if part.car is pattern.car]
        place = next((each for each in places if each is not None), use.span)
    return place


def parts_of(form: Value) -> Iterator[Cons]:
    """The conses of FORM, outer ones first."""
    pending = [form]
    for part in pending:
        if part.__class__ is Cons:
            yield part
            pending += [part.car, part.cdr]


def literal(node: Node) -> Value:
    """The value of NODE, as far as the text shows it."""
    if isinstance(node, Const):
        return node.value
    if isinstance(node, If) and isinstance(node.test, Call) and node.test.symbol is CALLS:
        return literal(node.otherwise)  # a condition that is a query
    if isinstance(node, Inline | Call):
        operator = node.operator if isinstance(node, Inline) else node.symbol.name
        if operator == "LIST":
            return from_items([literal(each) for each in node.arguments])
        if operator == "CONS" and len(node.arguments) == 2:
            return Cons(*map(literal, node.arguments))
    return UNKNOWN


CALLS, HOLDS, COMPUTED, UNSERVED = (
    Symbol.intern(name, ESL) for name in ("%CALLS-P", "%HOLDS-P", "%COMPUTED-CONDITION", "%UNSERVED-P")
)
DEFINE_RELATION, DEFINE_PROPERTY, DEFINE_RULE, DEFINE_GOAL, BINDINGS, MAINTAIN = (
    Symbol.intern(name, ESL)
    for name in (
        "%DEFINE-RELATION",
        "%DEFINE-PROPERTY",
        "%DEFINE-RULE",
        "%DEFINE-GOAL",
        "%CALL-WITH-QUERY-BINDINGS",
        "%MAINTAIN",
    )
)
ASSERT, RETRACT, UPDATE, DB_QUERY, EXPLAIN_QUERY, LOAD_FACTS = (
    Symbol.intern(name, ESL)
    for name in ("ASSERT", "RETRACT", "UPDATE", "DB-QUERY", "EXPLAIN-QUERY", "LOAD-FACTS")
)
ASSERTING = (ASSERT, UPDATE)
TAKING_FACTS = (ASSERT, RETRACT, UPDATE, DB_QUERY, EXPLAIN_QUERY, BINDINGS)
READERS: dict[Symbol, Callable[[Mentions, Use, list[Any]], None]] = {
    ASSERT: Mentions.assert_fact,
    RETRACT: Mentions.retract,
    UPDATE: Mentions.update,
    DB_QUERY: Mentions.ask,
    EXPLAIN_QUERY: Mentions.ask,
    BINDINGS: Mentions.ask,
    HOLDS: Mentions.hold,
    COMPUTED: Mentions.hold,
    UNSERVED: Mentions.hold,
    MAINTAIN: Mentions.maintain,
    DEFINE_GOAL: Mentions.define_goal,
    Symbol.intern("%ADD-GOAL", SCS): Mentions.give_goal,
    Symbol.intern("%DROP-GOAL", SCS): Mentions.give_goal,
    DEFINE_RELATION: Mentions.define_relation,
    DEFINE_PROPERTY: Mentions.define_relation,
    DEFINE_RULE: Mentions.define_rule,
    LOAD_FACTS: Mentions.open,
    Symbol.intern("LOAD", CL): Mentions.open,
    Symbol.intern("EVAL", CL): Mentions.open,
}
