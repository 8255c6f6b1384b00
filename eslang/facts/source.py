"""From steps to Python: the text of one function body after another.

A query becomes nested loops over look-ups, since nothing else is as fast. This
file knows how steps are said in Python; what the functions around them are
for, and what they do with an answer, is written in functions.py.
"""

from __future__ import annotations

from eslang.base.hints import Any, Callable, NamedTuple
from eslang.base.symbols import Symbol
from eslang.facts.goals import ANYTHING, Constant, Nested, Term
from eslang.facts.nested import Leaf, builder, leaves_of, matcher, written, written_with
from eslang.facts.procs import Proc
from eslang.facts.relations import Access
from eslang.facts.steps import Absent, Branch, Join, Look, Present, Steps, Test

Scope = dict[Symbol, str]  # the Python variable that holds the code of a logic variable
DEEPEST = 12  # blocks within one function; Python takes 20
STEP = "    "


class Sink(NamedTuple):
    """What becomes of an answer, and how a function goes on in another."""

    finish: Callable[[Scope], list[str]]
    names: tuple[str, ...]  # the Python variables that every part of the body needs
    onward: tuple[str, ...]  # lines, {} for the call
    ending: tuple[str, ...] = ()  # lines at the end of every part
    circle: frozenset[Proc] = frozenset()  # whose answers are still being found while this runs
    joints: tuple[Joint, ...] = ()  # where ways that are being said may end


class Joint(NamedTuple):
    """Where the ways of an OR come together, to go on with a rest."""

    number: int
    steps: Steps
    seen: str  # the Python variable that holds the values with which the rest was done
    scope: Scope  # before the OR
    sink: Sink  # of what comes behind it
    calls: dict[tuple[Symbol, ...], str]  # functions that do the rest, by what the ways bind


class Source:
    """The functions that make up one query, and what they refer to."""

    def __init__(self) -> None:
        self.functions: list[str] = []
        self.accesses: dict[Access, str] = {}
        self.objects: list[Any] = []
        self.plain: set[str] = set()  # Python variables whose code is known to be a value
        self.count = 0

    def access(self, relation: Any, positions: tuple[int, ...]) -> str:
        """The name of what reads like this."""
        return self.accesses.setdefault(Access(relation, positions), f"a{len(self.accesses)}")

    def object(self, value: Any) -> str:
        """A name for VALUE."""
        for number, known in enumerate(self.objects):
            if known is value:
                return f"o{number}"
        self.objects.append(value)
        return f"o{len(self.objects) - 1}"

    def fresh(self, letter: str) -> str:
        """A name that nothing has yet."""
        self.count += 1
        return f"{letter}{self.count}"

    def value(self, code: str) -> str:
        """The Python expression for the value of what is coded in CODE."""
        if code in self.plain:
            return code
        if not code.isidentifier():
            return f"value_of({code})"
        return f"({code} if {code}.__class__ in DIRECT else value_of({code}))"

    def add(self, head: str, lines: list[str]) -> None:
        """Take a whole function."""
        self.functions.append("\n".join([head, *(STEP + line for line in lines)]))


class Body:
    """The lines of one function."""

    def __init__(self, source: Source, sink: Sink, constants: tuple[str, ...]) -> None:
        self.source = source
        self.sink = sink
        self.constants = constants  # the query's constants, where the function gets them as arguments
        self.lines: list[str] = []

    def line(self, depth: int, text: str) -> None:
        """One more line."""
        self.lines.append(STEP * depth + text)

    def emit(self, steps: Steps, scope: Scope, depth: int) -> None:
        """Say STEPS, and what becomes of an answer."""
        if not steps:
            for text in self.sink.finish(scope):
                self.line(depth, text)
        elif depth >= DEEPEST:
            self._onward(steps, scope, depth)
        else:
            step, rest = steps[0], steps[1:]
            if isinstance(step, Look):
                self._look(step, rest, scope, depth)
            elif isinstance(step, Branch):
                self._branch(step, scope, depth)
            elif isinstance(step, Join):
                self._join(step, scope, depth)
            else:
                self.line(depth, f"if {self._claim(step, scope)}:")
                self.emit(rest, scope, depth + 1)

    def _branch(self, branch: Branch, scope: Scope, depth: int) -> None:
        """Go one way after the other."""
        outer = self.sink
        for rest in branch.rests:
            seen = self.source.fresh("j")
            self.line(depth, f"{seen} = set()")
            joint = Joint(rest.number, rest.steps, seen, scope, outer, {})
            self.sink = self.sink._replace(names=(*self.sink.names, seen), joints=(*self.sink.joints, joint))
        for way in branch.ways:
            self.emit(way, scope, depth)
        self.sink = outer

    def _join(self, join: Join, scope: Scope, depth: int) -> None:
        """Go on with the rest behind an OR, once for the same values: in a function that all ways call."""
        joint = next(each for each in self.sink.joints if each.number == join.number)
        fresh = sorted((each for each in scope if each not in joint.scope), key=str)
        carried = list(dict.fromkeys([*joint.sink.names, *joint.scope.values()]))
        values = [scope[each] for each in fresh]
        name = joint.calls.get(tuple(fresh)) or self._rest(joint, fresh, carried)
        self.line(depth, f"if {tuple_of(values)} not in {joint.seen}:")
        self.line(depth + 1, f"{joint.seen}.add({tuple_of(values)})")
        for text in joint.sink.onward:
            self.line(depth + 1, text.replace("{}", f"{name}({', '.join([*carried, *values])})"))

    def _rest(self, joint: Joint, fresh: list[Symbol], carried: list[str]) -> str:
        """A function that does the rest at JOINT, of what is CARRIED and of FRESH variables."""
        name = joint.calls[tuple(fresh)] = self.source.fresh("g")
        names = {each: self.source.fresh("v") for each in fresh}
        part = Body(self.source, joint.sink, self.constants)
        part.emit(joint.steps, {**joint.scope, **names}, 0)
        part.lines += joint.sink.ending
        self.source.add(f"def {name}({', '.join([*carried, *names.values()])}):", part.lines or ["pass"])
        return name

    def _claim(self, step: Test | Absent | Present, scope: Scope) -> str:
        """The Python expression that is true if STEP is."""
        if isinstance(step, Test):
            values = "".join(f"{self._argument(term, scope)}, " for term in step.atom.terms)
            return f"call({self.source.object(step.atom.name)}, [{values}])"
        if isinstance(step, Absent):
            return f"not {self._exists(step.steps, scope)}"
        return " or ".join(self._exists(way, scope) for way in step.ways) or "False"

    def _exists(self, steps: Steps, scope: Scope) -> str:
        """The Python expression that is true if STEPS lead somewhere."""
        only = steps[0] if len(steps) == 1 else None
        if isinstance(only, Look) and only.proc is None and len(only.positions) == only.relation.arity:
            keys = [self.expression(term, scope) for term in only.atom.terms]
            return f"{self.source.access(only.relation, only.positions)}({tuple_of(keys)})"
        sink = Sink(
            lambda _: ["return True"], self.constants, ("if {}:", "    return True"), ("return False",)
        )
        return self._part("e", sink, steps, scope)

    def _onward(self, steps: Steps, scope: Scope, depth: int) -> None:
        """Go on in another function: Python does not nest deeper."""
        call = self._part("f", self.sink, steps, scope)
        for text in self.sink.onward:
            self.line(depth, text.replace("{}", call))

    def _part(self, letter: str, sink: Sink, steps: Steps, scope: Scope) -> str:
        """A function of its own that says STEPS; the call of it."""
        name = self.source.fresh(letter)
        names = ", ".join(dict.fromkeys([*sink.names, *scope.values()]))
        part = Body(self.source, sink, self.constants)
        part.emit(steps, scope, 0)
        part.lines += sink.ending
        self.source.add(f"def {name}({names}):", part.lines or ["pass"])
        return f"{name}({names})"

    def _look(self, look: Look, rest: Steps, scope: Scope, depth: int) -> None:
        """Go through what LOOK finds."""
        keys = [self.expression(look.atom.terms[place], scope) for place in look.positions]
        ground = len(keys) == look.relation.arity
        row = self.source.fresh("r")
        if look.proc is not None:
            if look.proc in self.sink.circle:
                self._wait(look, rest, scope, depth, keys)
                return
            self.line(depth, f"for {row} in {_answers(look.proc, keys)}:")
        else:
            access = self.source.access(look.relation, look.positions)
            if ground:
                self.line(depth, f"if {access}({tuple_of(keys)}):")
            elif not keys:
                self.line(depth, f"for {row} in paced({access}()):")
            else:
                bucket = self.source.fresh("b")
                key = keys[0] if len(keys) == 1 else tuple_of(keys)
                self.line(depth, f"{bucket} = {access}({key}, EMPTY)")
                self.line(depth, f"for {row} in {_few_or_paced(bucket)}:")
        mark = len(self.lines)
        self._take(look, row, rest, scope, depth + 1)
        if len(self.lines) == mark:
            self.line(depth + 1, "pass")
        if ground and look.proc is not None:
            self.line(depth + 1, "break")

    def _take(self, look: Look, row: str, rest: Steps, scope: Scope, depth: int) -> None:
        """Bind what a row tells that was not known, and go on with REST."""
        places = [
            (term, f"{row}[{place}]")
            for place, term in enumerate(look.atom.terms)
            if place not in look.positions
        ]
        before = scope
        scope, depth = self.unify(places, scope, depth)
        if look.proc is None and look.relation.is_plain:
            self.source.plain.update(name for term, name in scope.items() if term not in before)
        self.emit(rest, scope, depth)

    def unify(self, places: list[tuple[Term, str]], scope: Scope, depth: int) -> tuple[Scope, int]:
        """Let terms be what Python expressions say; new bindings, and how deep that leads."""
        scope = dict(scope)
        claims = []
        for term, expression in places:
            if isinstance(term, Constant) or term in scope:
                claims.append(f"{self.expression(term, scope)} == {expression}")
            elif isinstance(term, Symbol) and term.name != ANYTHING:
                name = expression
                if "[" in expression:
                    name = self.source.fresh("v")
                    self.line(depth, f"{name} = {expression}")
                scope[term] = name
        if claims:
            self.line(depth, f"if {' and '.join(claims)}:")
            depth += 1
        nested = [place for place in places if isinstance(place[0], Nested)]
        if nested:
            scope = self._take_apart(nested, scope, depth)
            depth += 1
        return scope, depth

    def _take_apart(self, places: list[tuple[Term, str]], scope: Scope, depth: int) -> Scope:
        """Bind what stands in nested terms; an `if` is left open."""
        terms = tuple(term for term, _ in places)
        leaves = leaves_of(Nested(terms, None))
        known: list[Leaf] = [leaf for leaf in leaves if isinstance(leaf, Constant) or leaf in scope]
        wanted = [leaf for leaf in leaves if isinstance(leaf, Symbol) and leaf not in scope]
        row = tuple_of([expression for _, expression in places])
        given = ", ".join([row, *(self.expression(leaf, scope) for leaf in known)])
        match = self.source.object(matcher(terms, known, wanted))
        found = self.source.fresh("m")
        self.line(depth, f"{found} = {match}({given})")
        self.line(depth, f"if {found} is not None:")
        names = {leaf: self.source.fresh("v") for leaf in wanted}
        self.line(depth + 1, f"{tuple_of(list(names.values()))} = {found}")
        return {**scope, **names}

    def _wait(self, look: Look, rest: Steps, scope: Scope, depth: int, keys: list[str]) -> None:
        """Go on for each answer of the same circle, when there is one: in a segment of its own."""
        assert look.proc is not None
        name = self.source.fresh("s")
        carried = [each for each in self.sink.names if each not in TABLE_NAMES]
        environment = tuple_of(list(dict.fromkeys([*carried, *scope.values()])))
        part = Body(self.source, self.sink, self.constants)
        part.lines = [*TABLE_OPENING, f"{environment} = environment", "for r in paced(rows):"]
        mark = len(part.lines)
        part._take(look, "r", rest, scope, 1)
        if len(part.lines) == mark:
            part.line(1, "pass")
        self.source.add(f"def {name}(t, environment, rows):", part.lines)
        self.line(depth, f"demand({look.proc.number}, {tuple_of(keys)}, {name}, t, {environment})")

    def expression(self, term: Term, scope: Scope) -> str:
        """The Python expression for the code of TERM, all of which is known."""
        if isinstance(term, Constant):
            return f"c{term.number}"
        if isinstance(term, Symbol):
            return scope[term]
        leaves = ", ".join(self.expression(leaf, scope) for leaf in leaves_of(term))
        return f"{self.source.object(builder(term))}({leaves})"

    def _argument(self, term: Term, scope: Scope) -> str:
        """The Python expression for TERM as the argument of a test."""
        if isinstance(term, Constant):
            return f"{self.source.object(written)}({self.expression(term, scope)})"
        if isinstance(term, Symbol):
            return self.source.value(scope[term])
        leaves = ", ".join(self.expression(leaf, scope) for leaf in leaves_of(term))
        return f"{self.source.object(written_with(term))}({leaves})"


TABLE_NAMES = ("t", "have", "fresh")
TABLE_OPENING = ("have = t.rows", "fresh = t.fresh")


def tuple_of(parts: list[str]) -> str:
    """The Python expression for the tuple of PARTS."""
    return f"({', '.join(parts)}{',' if len(parts) == 1 else ''})"


def _few_or_paced(bucket: str) -> str:
    """The Python expression for the rows of a bucket, with pauses if they are many."""
    return f"{bucket} if {bucket}.__class__ is tuple else paced({bucket})"


def _answers(proc: Proc, keys: list[str]) -> str:
    """The Python expression that gives the answers of rules."""
    if not proc.circle:
        return f"p{proc.number}({', '.join(keys)})"
    if proc.is_linear():
        return f"paced(p{proc.number}({', '.join(keys)}))"
    return f"paced(complete({proc.number}, {tuple_of(keys)}))"
