"""Reading what is drawn: a plan's definitions, out of the forms that the checker has read.

The plan is checked first, as `esl check` does it, and not run; only what it
defines for its own text is, its macros above all. So its macros are expanded
here, and a form that one of them makes is drawn in the place of its call.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePath
from typing import Any, NamedTuple

from eslang.base.diagnostics import Diagnostic
from eslang.base.lists import Cons
from eslang.base.spans import Spans
from eslang.base.symbols import Symbol, Value
from eslang.base.text import String
from eslang.compile.registry import CL, ESL, SCS
from eslang.tools import graph_esl, graph_lisp, graph_scs
from eslang.tools.graph_goals import goals_in, may_match
from eslang.tools.graph_lisp import hashable, led
from eslang.tools.graph_model import Box, Definition, Graph, Key
from eslang.tools.graph_scs import parts_of
from eslang.tools.graph_text import form_text, name_text, text_of
from eslang.tools.graph_walk import Scope, Walk, add, after, holders, numbered
from eslang.tools.opening import bytes_of

READERS = {**graph_lisp.READERS, **graph_esl.READERS, **graph_scs.READERS}
DECLARE = Symbol.intern("DECLARE", CL)
HOLDING = {  # what may stand around definitions: how many arguments before them
    Symbol.intern(name, CL): heads
    for name, heads in (("PROGN", 0), ("LOCALLY", 0), ("EVAL-WHEN", 1), ("LET", 1), ("LET*", 1))
}
DEFINING = {
    Symbol.intern("DEFUN", CL): "function",
    Symbol.intern("DEFACTION", SCS): "action",
    Symbol.intern("DEFSTEP", SCS): "step",
    Symbol.intern("TO-ACHIEVE", ESL): "to achieve",
    Symbol.intern("DEFTEST", ESL): "test",
}


class Found(NamedTuple):
    """A top-level form: what it defines, if anything, and where it stands."""

    kind: str  # of DEFINING, or "loaded"
    holder: Cons
    spans: Spans
    file: str

    @property
    def name(self) -> Value:
        """What it defines."""
        place = after(self.holder.car, 1)
        return None if place is None else place.car

    def is_named(self) -> bool:
        """Whether it has a name as definitions have."""
        is_list = self.name.__class__ is Cons
        return is_list if self.kind == "to achieve" else is_list or isinstance(self.name, Symbol)


def read_plan(interp: Any, paths: list[str]) -> tuple[Graph | None, list[Diagnostic]]:
    """The structure of the program in the files at PATHS, if it could all be analysed; its errors."""
    readings: list[Any] = []
    with interp.at_work():
        checker = interp.texts.analyse(paths, bytes_of, readings.append)
        errors = [each for each in checker.finish() if each.severity == "error"]
        if errors and not checker.is_whole:
            return None, errors
        title = "Structure of " + ", ".join("standard input" if path == "-" else path for path in paths)
        return Graph(title, Plan(interp.image, readings).definitions()), errors


class Plan:
    """A plan that is being read."""

    def __init__(self, image: Any, readings: list[Any]) -> None:
        self.walk = Walk(image, READERS, {})
        self.found: list[Found] = []
        for reading in readings:
            self.walk.spans = reading.spans
            reading.spans.default = reading.span
            holder = Cons(reading.form, None)
            reading.spans.note(holder, None, reading.span)
            self.found += self.split(holder, reading.span.source.name, 0)
        for number, each in enumerate(self.found):
            if each.kind in ("function", "action", "step"):
                self.walk.functions[hashable(each.name)] = Key("call", number)

    def split(self, holder: Cons, file: str, depth: int) -> Iterator[Found]:
        """The form in HOLDER, or the definitions and forms that it holds."""
        form = holder.car
        if form.__class__ is not Cons or not isinstance(form.car, Symbol):
            yield Found("loaded", holder, self.walk.spans, file)
            return
        operator = form.car
        if operator in HOLDING:
            for each in holders(after(form, HOLDING[operator] + 1)):
                yield from self.split(each, file, depth)
            return
        expansion = None
        if operator not in DEFINING:
            expansion = self.walk.expanded(form, Scope(None, expansions=depth))
        if expansion is not None:
            yield from self.split(Cons(expansion, None), file, depth + 1)
        else:
            found = Found(DEFINING.get(operator, "loaded"), holder, self.walk.spans, file)
            yield found if found.is_named() else found._replace(kind="loaded")

    def definitions(self) -> list[Definition]:
        """All definitions, in the order of the text; what is done in loading a file stands behind them."""
        defined: list[Definition] = []
        loaded: dict[str, list[Box]] = {}
        for number, each in enumerate(self.found):
            self.walk.spans = each.spans
            if each.kind != "loaded":
                defined.append(self.definition(number, each))
                continue
            boxes = self.walk.read(each.holder, Scope(("loaded", each.file)))
            loaded.setdefault(each.file, []).extend(boxes)
        for file, boxes in loaded.items():
            if boxes:
                name = PurePath(file).name
                box = Box("loaded", [name], tag="when loaded", place=file, parts=numbered(boxes))
                defined.append(Definition(name.lower(), box))
        self.resolve(defined)
        return defined

    def definition(self, number: int, found: Found) -> Definition:
        """One definition, the NUMBERth."""
        if found.kind == "to achieve":
            return self.goal(number, found)
        name = name_text(found.name) if found.name.__class__ is Cons else found.name.name.lower()
        walk, form, scope = self.walk, found.holder.car, Scope(number)
        head = [text_of(walk.spans, form.cdr)] if found.kind == "test" else walk.head(form.cdr)
        box = walk.box("definition", head, form, tag=found.kind, takes=[Key("call", number)])
        rest = after(form, 2 if found.kind == "test" else 3)
        rest, documentation = self.documented(rest)
        if found.kind == "step":
            modifiers, rest = walk.options(rest)
            box.lines += modifiers
            box.parts = parts_of(walk, "ordered", rest, scope)
        else:
            box.parts = walk.body(rest, scope)
        box.title = documentation or box.title
        return Definition(name, box)

    def documented(self, rest: Value) -> tuple[Value, str]:
        """The body in REST without docstring and declarations, and what the docstring says."""
        documentation = ""
        while rest.__class__ is Cons and rest.cdr is not None:
            if rest.car.__class__ is String and not documentation:
                documentation = rest.car.text
            elif rest.car.__class__ is not Cons or rest.car.car is not DECLARE:
                break
            rest = rest.cdr
        return rest, documentation

    def goal(self, number: int, found: Found) -> Definition:
        """TO-ACHIEVE: each method, and the test that chooses it."""
        walk, form, pattern = self.walk, found.holder.car, found.name
        key = Key("achieve", number)
        box = walk.box("goal", [form_text(walk.spans, pattern)], form, tag="to achieve", takes=[key])
        for method in holders(after(form, 2)):
            if method.car.__class__ is Cons:
                steps = walk.sequence(method.car.cdr, Scope(number))
                box.parts.append(led(steps, text_of(walk.spans, method.car)))
        name = pattern.car
        return Definition(name.name.lower() if isinstance(name, Symbol) else name_text(name), box)

    def resolve(self, defined: list[Definition]) -> None:
        """Let those who achieve goals lead to the methods for them."""
        goals = [each for each in enumerate(self.found) if each[1].kind == "to achieve"]
        for definition in defined:
            for box in definition.box.all():
                wanted = [key for key in box.gives if key.kind == "goal"]
                box.gives = [key for key in box.gives if key.kind != "goal"]
                for key in wanted:
                    for goal in goals_in(self.walk.goals[key.of]):  # type: ignore[call-overload]
                        known = [number for number, each in goals if may_match(each.name, goal)]
                        add(box.gives, [Key("achieve", number) for number in known])
