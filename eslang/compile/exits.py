"""Special forms that jump: blocks, tags, loops, catch, and unwind-protect."""

from __future__ import annotations

from eslang.base.lists import Cons
from eslang.base.printer import prin1
from eslang.base.shown import shown
from eslang.base.suggest import nearest
from eslang.base.symbols import Symbol, Value
from eslang.compile.analyser import Analyser
from eslang.compile.core import (
    Block,
    Call,
    Const,
    Exit,
    Go,
    Lambda,
    Node,
    Protect,
    ReturnFrom,
    Tagbody,
    While,
)
from eslang.compile.registry import special_form
from eslang.compile.scope import Scope

CALL_WITH_CATCH = Symbol.intern("%CALL-WITH-CATCH", "COMMON-LISP")
THROW = Symbol.intern("%THROW", "COMMON-LISP")


def leave(scope: Scope, target: Exit) -> bool:
    """Note a jump to TARGET from SCOPE; true if it stays within the procedure."""
    if target.owner is scope.procedure:
        target.jumps += 1
        return True
    target.escapes = True
    scope.mention(target.token)
    return False


@special_form("(block name &body forms)")
def block(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS, which RETURN-FROM may leave by NAME."""
    name = form.cdr.car
    if name is not None and not isinstance(name, Symbol):
        analyser.fail("malformed-form", f"`{shown(name)}` cannot name a block", hint="write a symbol")
    return named_block(analyser, name, form.cdr.cdr, scope)


def named_block(analyser: Analyser, name: Symbol | None, forms: Value, scope: Scope) -> Node:
    """The node of FORMS inside a block called NAME; no block where nothing jumps to it."""
    target = analyser.exit(name, scope)
    inner = scope.inner()
    inner.blocks[name] = target
    scope.procedure.nesting += analyser.block_cost
    body = analyser.body(forms, inner)
    scope.procedure.nesting -= analyser.block_cost
    return Block(analyser.span, target, body) if target.jumps or target.escapes else body


@special_form("(return-from name &optional value)")
def return_from(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Give the values of VALUE from the block called NAME, at once."""
    name = form.cdr.car
    target = scope.find_block(name)
    if target is None:
        names = [symbol.name for frame in scope.frames() for symbol in frame.blocks if symbol is not None]
        close = nearest(prin1(name), names)
        analyser.fail(
            "unknown-block",
            f"no block `{shown(name)}` is around this `return-from`",
            hint=f"write `{close.lower()}`" if close else None,
        )
    value = analyser.nodes(form.cdr.cdr, scope) or [Const(analyser.span, None)]
    return ReturnFrom(analyser.span, target, value[0], leave(scope, target))


@special_form("(tagbody &rest statements)")
def tagbody(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run STATEMENTS in order.

    Those that are symbols or integers are tags for GO.

    Returns: NIL.
    """
    target = analyser.exit(None, scope)
    inner = scope.inner()
    parts: list[list[Cons]] = [[]]
    rest = form.cdr
    while rest is not None:
        statement = rest.car
        if statement.__class__ is Cons:
            parts[-1].append(rest)
        else:
            if statement in inner.tags:
                analyser.fail("duplicate-tag", f"the tag `{shown(statement)}` stands here twice")
            parts.append([])
            inner.tags[statement] = (target, len(parts) - 1)
        rest = rest.cdr
    loops = 1 if len(parts) > 1 else 0
    scope.procedure.loops += loops
    scope.procedure.nesting += analyser.block_cost * loops
    segments = [
        analyser.body_of([analyser.nodes(Cons(holder.car, None), inner)[0] for holder in part])
        for part in parts
    ]
    scope.procedure.loops -= loops
    scope.procedure.nesting -= analyser.block_cost * loops
    return Tagbody(analyser.span, target, segments)


@special_form("(go tag)")
def go(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Continue at TAG of the TAGBODY around this."""
    tag = form.cdr.car
    found = scope.find_tag(tag)
    if found is None:
        analyser.fail("unknown-tag", f"no tag `{shown(tag)}` is around this `go`")
    target, segment = found
    return Go(analyser.span, target, segment, leave(scope, target))


@special_form("(%while test &body forms)")
def while_(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Repeat FORMS while TEST is true; give NIL."""
    return loop_node(analyser, Cons(form.cdr.car, None), form.cdr.cdr, scope)


@special_form("(%loop &body forms)")
def loop(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Repeat FORMS until something jumps out."""
    return loop_node(analyser, None, form.cdr, scope)


def loop_node(analyser: Analyser, test: Value, forms: Value, scope: Scope) -> Node:
    """The node of a loop; variables bound inside it are new each time round."""
    scope.procedure.loops += 1
    scope.procedure.nesting += 1
    condition = analyser.nodes(test, scope)[0] if test is not None else None
    body = analyser.body(forms, scope)
    scope.procedure.loops -= 1
    scope.procedure.nesting -= 1
    return While(analyser.span, condition, body)


def thunk(analyser: Analyser, forms: Value, scope: Scope, name: str) -> Lambda:
    """A procedure without parameters that runs FORMS."""
    procedure = analyser.procedure(name, scope)
    body = analyser.body(forms, scope.inner(procedure))
    return Lambda(analyser.span, procedure, [], [], None, None, False, body)


@special_form("(unwind-protect protected &body cleanup)")
def unwind_protect(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run PROTECTED, then CLEANUP in any case, whatever way PROTECTED is left."""
    scope.procedure.nesting += 2
    body = analyser.nodes(Cons(form.cdr.car, None), scope)[0]
    scope.procedure.nesting -= 2
    return Protect(analyser.span, body, thunk(analyser, form.cdr.cdr, scope, "cleanup"))


@special_form("(catch tag &body forms)")
def catch(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS, which a THROW to TAG leaves, however deep inside."""
    tag = analyser.nodes(Cons(form.cdr.car, None), scope)[0]
    body = thunk(analyser, form.cdr.cdr, scope, "catch")
    return Call(analyser.span, CALL_WITH_CATCH, [tag, body])


@special_form("(throw tag value)")
def throw(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Give all the values of VALUE from the innermost CATCH of TAG.

    Fails: :control-error if there is none.
    """
    tag = analyser.nodes(Cons(form.cdr.car, None), scope)[0]
    return Call(analyser.span, THROW, [tag, thunk(analyser, form.cdr.cdr, scope, "throw")])
