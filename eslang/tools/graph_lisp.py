"""What the forms of Lisp become in a drawing: they show where something of interest stands inside them."""

from __future__ import annotations

from eslang.base.lists import Cons
from eslang.base.symbols import Symbol, Value
from eslang.compile.registry import CL
from eslang.tools.graph_model import Box, Key
from eslang.tools.graph_text import name_text, text_of
from eslang.tools.graph_walk import Reader, Scope, Walk, after, holders, numbered


def nothing(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """What is no form, or defines something."""
    return []


def function(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """FUNCTION: a definition is spoken of, or a body stands there."""
    rest = holder.car.cdr
    if rest.__class__ is not Cons:
        return []
    name = rest.car
    if name.__class__ is Cons and name.car is LAMBDA:
        return walk.read(rest, scope)
    key = scope.functions.get(name) or walk.functions.get(hashable(name))
    return [] if key is None else [walk.act("call", holder, scope, key)]


def template(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """QUASIQUOTE: what is computed inside."""
    boxes: list[Box] = []
    pending = [holder.car.cdr]
    while pending:
        part = pending.pop()
        if part.__class__ is Cons and part.car in UNQUOTES and part.cdr.__class__ is Cons:
            boxes += walk.read(part.cdr, scope)
        elif part.__class__ is Cons:
            pending += [part.cdr, part.car]
    return walk.whole(holder, boxes)


def variable(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """DEFVAR and its like: what is done for the first value."""
    return walk.whole(holder, walk.among(after(holder.car, 2), scope))


def inside(heads: int) -> Reader:
    """What only holds a body behind HEADS arguments."""

    def read(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
        reads = walk.reads(after(holder.car, heads + 1), scope)
        return walk.steps(reads) if any(each.boxes for each in reads) else []

    return read


def let(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """LET: what its variables begin with, if that matters, and the body."""
    first: list[Box] = []
    matters = False
    for binding in holders(after(holder.car, 1).car if after(holder.car, 1) else None):
        form = after(binding.car, 1)
        if form is None or form.car.__class__ is not Cons:
            continue
        boxes = walk.read(form, scope)
        matters = matters or bool(boxes)
        for box in boxes:
            if box.kind == "task":
                scope = scope.with_tasks({binding.car.car: box.gives[0].of})
        if not boxes and form.car.car.__class__ is Symbol and form.car.car.package != CL:
            boxes = walk.plain([form])
        if len(boxes) == 1 and not boxes[0].parts:
            boxes[0].lines = [f"{text_of(walk.spans, binding.car)} ← {text_of(walk.spans, form)}"]
        first += boxes
    reads = walk.reads(after(holder.car, 2), scope)
    if not matters and not any(each.boxes for each in reads):
        return []
    return numbered([*first, *walk.steps(reads)])


def local_functions(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """FLET and LABELS: the functions that matter, and the body."""
    defined = after(holder.car, 1)
    listed = [each for each in holders(defined.car if defined else None) if each.car.__class__ is Cons]
    known = {hashable(each.car.car): Key("call", ("local", walk.new_task())) for each in listed}
    inner = scope.with_functions(known)
    boxes = []
    for each in listed:
        reads = walk.reads(after(each.car, 2), inner if holder.car.car is LABELS else scope)
        name = hashable(each.car.car)
        if any(read.boxes for read in reads):
            parts = walk.steps(reads)
            box = walk.box("function", walk.head(each.car), each.car, tag="local function")
            box.parts, box.takes = parts, [known[name]]
            boxes.append(box)
        else:
            known.pop(name, None)
    reads = walk.reads(after(holder.car, 2), scope.with_functions(known))
    if not boxes and not any(read.boxes for read in reads):
        return []
    return numbered([*walk.steps(reads), *boxes])


def choose(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """IF: its test, and what is done then, or else."""
    form = holder.car
    reads = walk.reads(form.cdr, scope)
    if not any(each.boxes for each in reads):
        return []
    box = walk.headed("branch", holder, 1, asked(reads[0].boxes))
    for read, edge in zip(reads[1:], ("then", "else"), strict=False):
        box.parts.append(led(walk.together(walk.steps([read]), read.holder.car), edge))
    return [box]


def when(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """WHEN and UNLESS: the test, and the body."""
    reads = walk.reads(holder.car.cdr, scope)
    if not any(each.boxes for each in reads):
        return []
    return [walk.headed("branch", holder, 1, [*asked(reads[0].boxes), *walk.steps(reads[1:])])]


def each_of(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """DOLIST and DOTIMES: what they go over, and the body."""
    head = after(holder.car, 1)
    over = walk.among(after(head.car, 1), scope) if head is not None else []
    reads = walk.reads(after(holder.car, 2), scope)
    if not over and not any(each.boxes for each in reads):
        return []
    return [walk.headed("loop", holder, 1, [*(led(box, "over") for box in over), *walk.steps(reads)])]


def cond(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """COND: each test, and what is done then."""
    return clauses(walk, holder, scope, 0)


def case(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """CASE and its like: each of the keys, and what is done then."""
    return clauses(walk, holder, scope, 1)


def clauses(walk: Walk, holder: Cons, scope: Scope, heads: int) -> list[Box]:
    """A choice among clauses behind HEADS arguments; without any, the tests are forms."""
    box = walk.headed("branch", holder, heads, [])
    head = after(holder.car, 1)
    box.parts += asked(walk.read(head, scope)) if heads and head is not None else []
    matters = bool(box.parts)
    for clause in holders(after(holder.car, heads + 1)):
        if clause.car.__class__ is not Cons:
            continue
        tests = walk.read(clause.car, scope) if not heads else []
        reads = walk.reads(clause.car.cdr, scope)
        matters = matters or bool(tests) or any(each.boxes for each in reads)
        box.parts += asked(tests)
        steps = walk.together(walk.steps(reads), clause.car)
        box.parts.append(led(steps, text_of(walk.spans, clause.car)))
    return [box] if matters else []


def either(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """AND and OR: one after the other, until it is decided."""
    reads = walk.reads(holder.car.cdr, scope)
    found = [read for read in reads if read.boxes]
    if len(reads) < 2 or all(box.kind == "call" and not box.parts for read in found for box in read.boxes):
        return walk.whole(holder, [box for read in found for box in read.boxes])
    return [walk.headed("branch", holder, 0, walk.steps(reads))]


def loop(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """LOOP, with whatever words, and DO: what matters inside."""
    simple = all(each.car.__class__ is Cons for each in holders(holder.car.cdr))
    if holder.car.car is LOOP and simple:
        reads = walk.reads(holder.car.cdr, scope)
        if any(read.boxes for read in reads):
            return [walk.headed("loop", holder, 0, walk.steps(reads))]
        return []
    boxes = walk.among(holder.car.cdr, scope)
    if not boxes:
        return []
    return [walk.box("loop", [text_of(walk.spans, holder)], holder.car, parts=numbered(boxes))]


def protect(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """UNWIND-PROTECT: what is done, and what is done behind it in any case."""
    reads = walk.reads(holder.car.cdr, scope)
    if not any(each.boxes for each in reads):
        return []
    behind = walk.together(walk.steps(reads[1:]), holder.car)
    parts = [*walk.steps(reads[:1]), led(behind, "in any case")]
    return [walk.headed("around", holder, 0, parts)]


def asked(boxes: list[Box]) -> list[Box]:
    """BOXES of a test."""
    return [led(box, "test") for box in boxes]


def led(box: Box, edge: str, under: str = "") -> Box:
    """BOX, to which a line with these words leads."""
    box.edge, box.under = edge, under
    return box


def hashable(name: Value) -> Value:
    """NAME, as a table can have it: that of a function may be a list."""
    return name_text(name) if name.__class__ is Cons else name


def named(*names: str) -> list[Symbol]:
    """These symbols of Common Lisp."""
    return [Symbol.intern(name, CL) for name in names]


LAMBDA, LABELS, LOOP = named("LAMBDA", "LABELS", "LOOP")
UNQUOTES = named("UNQUOTE", "UNQUOTE-SPLICING")
READERS: dict[Value, Reader] = {
    **dict.fromkeys(named("QUOTE", "DECLARE", "GO", "DECLAIM"), nothing),
    **dict.fromkeys(named("DEFUN", "DEFMACRO", "DEFSTRUCT", "DEFSETF", "DEFTYPE"), nothing),
    **dict.fromkeys(named("IN-PACKAGE", "DEFPACKAGE"), nothing),
    **dict.fromkeys(named("DEFVAR", "DEFPARAMETER", "DEFCONSTANT"), variable),
    **dict.fromkeys(named("FUNCTION"), function),
    **dict.fromkeys(named("QUASIQUOTE"), template),
    **dict.fromkeys(named("PROGN", "LOCALLY", "TAGBODY"), inside(0)),
    **dict.fromkeys(named("LAMBDA", "BLOCK", "EVAL-WHEN", "MACROLET", "SYMBOL-MACROLET"), inside(1)),
    **dict.fromkeys(named("MULTIPLE-VALUE-BIND", "DESTRUCTURING-BIND"), inside(1)),
    **dict.fromkeys(named("LET", "LET*"), let),
    **dict.fromkeys(named("FLET", "LABELS"), local_functions),
    **dict.fromkeys(named("IF"), choose),
    **dict.fromkeys(named("WHEN", "UNLESS"), when),
    **dict.fromkeys(named("DOLIST", "DOTIMES"), each_of),
    **dict.fromkeys(named("COND"), cond),
    **dict.fromkeys(named("CASE", "ECASE", "CCASE", "TYPECASE", "ETYPECASE", "CTYPECASE"), case),
    **dict.fromkeys(named("AND", "OR"), either),
    **dict.fromkeys(named("LOOP", "DO", "DO*"), loop),
    **dict.fromkeys(named("UNWIND-PROTECT"), protect),
}
