"""Walking the forms of a plan: which boxes a form becomes.

What a form becomes is said by readers, one for each operator that matters
(graph_lisp.py, graph_esl.py, graph_scs.py). A form without one that holds
nothing of interest is plain: no boxes, only its text, in the box of whoever
does it.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from typing import Any, NamedTuple

from eslang.base.control import Failed
from eslang.base.image import Image
from eslang.base.lists import Cons
from eslang.base.spans import Spans
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.compile.registry import CL, ESL, SCS
from eslang.compile.signatures import read_signature
from eslang.tools.columns import width
from eslang.tools.graph_model import Box, Key
from eslang.tools.graph_text import LONGEST, WIDEST, form_text, text_of

LANGUAGES = (CL, ESL, SCS)
MOST_LINES = 4  # of plain forms in one box
DEEPEST = 60  # expansions inside one another

Reader = Callable[["Walk", Cons, "Scope"], list[Box]]


class Scope(NamedTuple):
    """What names mean at a place: the definition and the task it is in, local functions, tasks by name."""

    definition: Hashable
    task: Hashable = None
    functions: dict[Value, Key] = {}
    tasks: dict[Value, Hashable] = {}
    expansions: int = 0

    def with_functions(self, functions: dict[Value, Key]) -> Scope:
        """The same, where these local functions are known."""
        return self._replace(functions={**self.functions, **functions})

    def with_tasks(self, tasks: dict[Value, Hashable]) -> Scope:
        """The same, where these names are those of tasks."""
        return self._replace(tasks={**self.tasks, **tasks})


class Read(NamedTuple):
    """A form, the car of its holder, and the boxes that it became; none, if it is plain."""

    holder: Cons
    boxes: list[Box]


class Walk:
    """Walks one plan. FUNCTIONS are its definitions that can be called."""

    def __init__(self, image: Image, readers: dict[Value, Reader], functions: dict[Value, Key]) -> None:
        self.image = image
        self.readers = readers
        self.functions = functions
        self.spans = Spans()  # of the top-level form at hand
        self.goals: list[Value] = []  # that somewhere are to be achieved
        self.tasks = 0

    def new_task(self) -> int:
        """A number that only one task has."""
        self.tasks += 1
        return self.tasks

    # --- forms -------------------------------------------------------------------

    def read(self, holder: Cons, scope: Scope) -> list[Box]:
        """The boxes of the form in HOLDER; none, if it is plain."""
        form = holder.car
        if form.__class__ is not Cons:
            return []
        operator = form.car
        if not isinstance(operator, Symbol):
            return self.whole(holder, self.among(form, scope))
        local = scope.functions.get(operator)
        if local is not None:
            return self.call(holder, local, scope)
        reader = self.readers.get(operator)
        if reader is not None:
            return reader(self, holder, scope)
        key = self.functions.get(operator)
        if key is not None:
            return self.call(holder, key, scope)
        expansion = self.expanded(form, scope)
        if expansion is not None:
            boxes = self.read(Cons(expansion, None), scope._replace(expansions=scope.expansions + 1))
            for box in boxes:
                self.name_place(box, form)
            return boxes
        if operator.package in (ESL, SCS):
            heads = self.heads_of(operator)
            if heads is not None:
                return self.around("around", holder, heads, scope)
        return self.whole(holder, self.among(form.cdr, scope))

    def among(self, rest: Value, scope: Scope) -> list[Box]:
        """The boxes of the forms in REST, which may not be forms at all."""
        return [box for holder in holders(rest) for box in self.read(holder, scope)]

    def whole(self, holder: Cons, boxes: list[Box]) -> list[Box]:
        """BOXES, which are all that matters of the form in HOLDER; calls alone become one box."""
        if not boxes or any(box.parts for box in boxes):
            return boxes
        if len(boxes) > 1 and any(box.kind != "call" for box in boxes):
            return boxes
        box = self.box(boxes[0].kind, [text_of(self.spans, holder)], holder.car)
        for each in boxes:
            add(box.gives, each.gives)
            add(box.takes, each.takes)
        return [box]

    def call(self, holder: Cons, key: Key, scope: Scope) -> list[Box]:
        """A call of a definition of the plan."""
        return [self.act("call", holder, scope, key)]

    def act(self, kind: str, holder: Cons, scope: Scope, *gives: Key) -> Box:
        """A box for a form whose arguments are evaluated before it does what it does."""
        box = self.box(kind, [text_of(self.spans, holder)], holder.car)
        add(box.gives, gives)
        for each in self.among(holder.car.cdr, scope):
            if each.parts or each.kind != "call":
                box.parts.append(each)
            else:
                add(box.gives, each.gives)
        return box

    def box(self, kind: str, lines: list[str], form: Value, **more: Any) -> Box:
        """A box for FORM, which knows where that stands."""
        box = Box(kind, lines, **more)
        self.name_place(box, form)
        return box

    def name_place(self, box: Box, form: Value) -> None:
        """Let BOX tell FORM, and where that stands."""
        span = self.spans.of(form) or self.spans.default
        box.title = form_text(self.spans, form, LONGEST)
        box.place = f"{span.source.name}:{span.line}" if span is not None else ""

    # --- bodies ------------------------------------------------------------------

    def reads(self, rest: Value, scope: Scope) -> list[Read]:
        """The forms in REST, each with its boxes."""
        return [Read(holder, self.read(holder, scope)) for holder in holders(rest)]

    def steps(self, reads: Iterable[Read]) -> list[Box]:
        """The boxes of forms that are done in order; plain ones that follow one another share one."""
        found: list[Box] = []
        plain: list[Cons] = []
        for holder, boxes in reads:
            if boxes:
                found += [*self.plain(plain), *boxes]
                plain = []
            else:
                plain.append(holder)
        return numbered([*found, *self.plain(plain)])

    def body(self, rest: Value, scope: Scope) -> list[Box]:
        """The boxes of the forms in REST, which are done in order."""
        return self.steps(self.reads(rest, scope))

    def plain(self, holders: list[Cons]) -> list[Box]:
        """A box for plain forms, if there are any."""
        if not holders:
            return []
        most = MOST_LINES if len(holders) <= MOST_LINES else MOST_LINES - 1
        lines = [text_of(self.spans, holder) for holder in holders[:most]]
        if len(holders) > most:
            lines.append(f"… {len(holders) - most} more")
        box = self.box("plain", lines, holders[0].car)
        box.title = "\n".join([text_of(self.spans, holder, LONGEST) for holder in holders[:20]])
        return [box]

    def one(self, holder: Cons, scope: Scope) -> Box:
        """One box for the form in HOLDER."""
        return self.together(self.steps([Read(holder, self.read(holder, scope))]), holder.car)

    def sequence(self, rest: Value, scope: Scope) -> Box:
        """One box for the forms in REST."""
        return self.together(self.body(rest, scope), rest)

    def together(self, boxes: list[Box], form: Value) -> Box:
        """BOXES as one."""
        if len(boxes) == 1:
            return boxes[0]
        return self.box("sequence", ["in order" if boxes else "nothing"], form, parts=boxes)

    # --- operators ----------------------------------------------------------------

    def around(self, kind: str, holder: Cons, heads: int, scope: Scope) -> list[Box]:
        """A construct with HEADS arguments, and a body that is done in order."""
        return [self.headed(kind, holder, heads, self.body(after(holder.car, heads + 1), scope))]

    def headed(self, kind: str, holder: Cons, heads: int, parts: list[Box]) -> Box:
        """A box that shows the operator of the form in HOLDER, and its first HEADS arguments."""
        shown = [text_of(self.spans, each) for each in list(holders(holder.car))[: heads + 1]]
        return self.box(kind, joined(shown), holder.car, parts=parts)

    def options(self, rest: Value) -> tuple[list[str], Value]:
        """The keywords at the head of REST with what follows each, and what is behind them."""
        lines = []
        while rest.__class__ is Cons and isinstance(rest.car, Keyword) and rest.cdr.__class__ is Cons:
            lines.append(f":{rest.car.name.lower()} {text_of(self.spans, rest.cdr)}")
            rest = rest.cdr.cdr
        return lines, rest

    def head(self, holder: Cons) -> list[str]:
        """The name in HOLDER, and the arguments behind it, if it takes any."""
        name, arguments = text_of(self.spans, holder), after(holder, 1)
        if arguments is None or arguments.car is None:
            return [name]
        return joined([name, text_of(self.spans, arguments)])

    def heads_of(self, operator: Symbol) -> int | None:
        """How many arguments of OPERATOR, a macro of ours, stand before its body; None: it has none."""
        definition = self.image.cell(operator).definition
        if definition is None or definition.kind != "macro":
            return None
        elements = read_signature(definition.signature)[1:]
        return elements.index("&body") if "&body" in elements else None

    def expanded(self, form: Cons, scope: Scope) -> Value:
        """The expansion of FORM by a macro of the plan; None if there is none, or it comes to nothing."""
        expander = self.image.cell(form.car).macro
        if expander is None or form.car.package in LANGUAGES or scope.expansions > DEEPEST:
            return None
        try:
            return expander(form, None)
        except (Exception, Failed):
            return None


def joined(words: list[str]) -> list[str]:
    """WORDS on one line, if it is not too long; else each on its own."""
    line = " ".join(words)
    return [line] if width(line) <= WIDEST else words


def holders(rest: Value) -> Iterable[Cons]:
    """The conses of REST, as far as it is a list."""
    while rest.__class__ is Cons:
        yield rest
        rest = rest.cdr


def after(form: Value, count: int) -> Value:
    """What of FORM stands behind its first COUNT elements."""
    while count and form.__class__ is Cons:
        form, count = form.cdr, count - 1
    return form if form.__class__ is Cons else None


def numbered(boxes: list[Box]) -> list[Box]:
    """BOXES, which are done in order: where there are several, their lines say so."""
    steps = [box for box in boxes if box.kind != "function"]
    if len(steps) > 1:
        for number, box in enumerate(steps, 1):
            box.edge = str(number)
    return boxes


def add(keys: list[Key], more: Iterable[Key]) -> None:
    """Let KEYS have MORE, each once."""
    keys += [key for key in dict.fromkeys(more) if key not in keys]
