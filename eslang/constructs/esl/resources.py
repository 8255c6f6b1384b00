"""Resources of which there is so much: power, bandwidth, fuel (beyond ARM §3, which names the need)."""

from __future__ import annotations

from eslang.base.arguments import take_keys
from eslang.base.failure import simple_error, type_error
from eslang.base.hints import Any
from eslang.base.lists import Cons, from_items, lisp_list
from eslang.base.many import many_of
from eslang.base.number_kinds import is_number
from eslang.base.running import running
from eslang.base.shown import shown
from eslang.base.suggest import nearest
from eslang.base.symbols import Keyword, Symbol, T, Value
from eslang.compile.registry import CL, ESL, function, macro
from eslang.constructs.esl.tasks import LAMBDA, QUOTE
from eslang.constructs.shapes import refuse
from eslang.runtime.resources import Resource

DEFINE, HOLD = (Symbol.intern(name, ESL) for name in ("%DEFINE-RESOURCE", "%CALL-WITH-RESOURCE"))
LIST = Symbol.intern("LIST", CL)
RENEWABLE, CONSUMABLE = Keyword("RENEWABLE"), Keyword("CONSUMABLE")
PRIORITY, WAIT = Keyword("PRIORITY"), Keyword("WAIT")


@macro("(define-resource name &key capacity kind)", ESL)
def define_resource(form: Cons, environment: Any) -> Value:
    """Define the resource NAME, of which there is CAPACITY.

    KIND is :renewable, unless given, for what comes back when its holder
    leaves, such as power; or :consumable, for what is used up, such as fuel.
    A resource that is defined anew is as it was at the beginning.

    Returns: NAME.
    Fails:   :type-error if CAPACITY is no real number above 0, or KIND is none
             of the two; :control-error if somebody holds of it.

    Example:
        ? (define-resource power :capacity 120)
        POWER
        ? (resource-left 'power)
        120

    Source: ours; ARM §3 names the need.
    """
    name, options = form.cdr.car, form.cdr.cdr
    return Cons(DEFINE, Cons(lisp_list(QUOTE, name), options))


@function("(%define-resource name &key capacity kind)", ESL)
def make_resource(name: Value, *options: Value) -> Value:
    """Define the resource NAME."""
    capacity, kind = take_keys(options, ("CAPACITY", "KIND"))
    if not isinstance(name, Symbol):
        raise type_error(name, "SYMBOL", Symbol.intern("DEFINE-RESOURCE", ESL))
    if kind not in (None, RENEWABLE, CONSUMABLE):
        raise type_error(kind, "RESOURCE-KIND", Symbol.intern("DEFINE-RESOURCE", ESL))
    known: dict[Symbol, Resource] = running.session.resources
    if name in known and (known[name].holdings or known[name].line):
        raise simple_error(f"the resource {shown(name)} cannot be defined anew: it is held")
    known[name] = Resource(name, amount_of(capacity, "define-resource"), kind is CONSUMABLE)
    return name


def amount_of(value: Value, operator: str) -> Value:
    """VALUE, which is to be an amount."""
    if not is_number(value) or not value > 0:
        raise type_error(value, "POSITIVE-REAL", Symbol.intern(operator.upper(), ESL))
    return value


def resource_named(name: Value) -> Resource:
    """The resource NAME; fails with :error, and the nearest name, if there is none."""
    known: dict[Symbol, Resource] = running.session.resources
    if isinstance(name, Symbol) and name in known:
        return known[name]
    close = nearest(name.name, [each.name for each in known]) if isinstance(name, Symbol) else None
    hint = f"; perhaps it is {close.lower()}" if close is not None else ""
    raise simple_error(f"there is no resource {shown(name)}{hint}")


@macro("(with-resource claim &body body)", ESL)
def with_resource(form: Cons, environment: Any) -> Value:
    """Run BODY while this task holds AMOUNT of a resource.

    It is written (with-resource (NAME AMOUNT) . BODY).
    Who asks for more than is left waits: the more important before the less,
    and otherwise first come, first served. Before BODY may stand :priority and
    a number, 0 unless given. If holders that are less important stand in the
    way, they are interrupted: their bodies fail with :resource-preempted where
    they stand. However BODY is left, what it held is given back; of a
    consumable resource it is used up. With :wait nil it does not wait.

    Returns: the values of BODY.
    Fails:   :resource-exhausted, with NAME, AMOUNT and what is left, if there
             can never be so much, or is not and it does not wait;
             :resource-preempted inside BODY, with NAME and the task that
             needs it; :error if there is no resource NAME.
    Waits:   until AMOUNT is left.

    Example:
        ? (define-resource arm :capacity 1)
        ARM
        ? (task-net (cook (with-resource (arm 1) (sleep 5) :fried))
                    (wash (with-resource (arm 1) (sleep 2) :clean)))
        :FRIED
        :CLEAN
        ? (with-resource (arm 2) :never)
        Failure :RESOURCE-EXHAUSTED, no recovery available.
        Aborted

    Source: ours; ARM §3 names the need. Who is interrupted: decision 33.
    """
    claim, body = form.cdr.car, form.cdr.cdr
    if claim.__class__ is not Cons or claim.cdr is None or claim.cdr.cdr is not None:
        wrong, hint = f"`{shown(claim)}` is no claim on a resource", "write `(name amount)`"
        refuse(environment, "malformed-form", wrong, form.cdr, hint=hint, within="with-resource")
    options: list[Value] = []
    while body is not None and (body.car is PRIORITY or body.car is WAIT) and body.cdr is not None:
        options += [body.car, body.cdr.car]
        body = body.cdr.cdr
    if body is not None and isinstance(body.car, Keyword) and body.cdr is not None:
        wrong, hint = f"`{shown(body.car)}` is no option", "write `:priority number` or `:wait nil`"
        refuse(environment, "malformed-form", wrong, body, hint=hint, within="with-resource")
    call = from_items([LAMBDA, None], body)
    return lisp_list(HOLD, lisp_list(QUOTE, claim.car), claim.cdr.car, lisp_list(LIST, *options), call)


def with_resource_values(name: Value, amount: Value, options: Value, body: Any) -> Value:
    """All the values of BODY."""
    return hold_resource(name, amount, options, many_of(body))


@function("(%call-with-resource name amount options body)", ESL, many=with_resource_values)
def hold_resource(name: Value, amount: Value, options: Value, body: Any) -> Value:
    """Call BODY while AMOUNT of the resource NAME is held."""
    rest = [] if options is None else list(options)
    chosen = dict(zip(rest[::2], rest[1::2], strict=True))
    priority = chosen.get(PRIORITY, 0)
    if not is_number(priority):
        raise type_error(priority, "REAL", Symbol.intern("WITH-RESOURCE", ESL))
    resource = resource_named(name)
    claimed = amount_of(amount, "with-resource")
    return resource.hold(running.session.scheduler, claimed, priority, chosen.get(WAIT, T) is not None, body)


@function("(resource-left name)", ESL)
def resource_left(name: Value) -> Value:
    """Give how much is left of the resource NAME.

    Fails:   :error if there is none.

    Source: ours.
    """
    return resource_named(name).left


@function("(consume name amount)", ESL)
def consume(name: Value, amount: Value) -> Value:
    """Use up AMOUNT of the consumable resource NAME.

    Returns: how much is left.
    Fails:   :resource-exhausted, with NAME, AMOUNT and what is left, if there
             is not so much; :error if NAME is renewable, or no resource.

    Example:
        ? (define-resource fuel :capacity 50 :kind :consumable)
        FUEL
        ? (consume 'fuel 20)
        30
        ? (replenish 'fuel 10)
        40

    Source: ours; ARM §3 names the need.
    """
    return consumable(name).use_up(amount_of(amount, "consume"))


@function("(replenish name amount)", ESL)
def replenish(name: Value, amount: Value) -> Value:
    """Let there be AMOUNT more of the consumable resource NAME.

    There is never more than its capacity.

    Returns: how much is left.
    Fails:   :error if NAME is renewable, or no resource.

    Source: ours; ARM §3 names the need.
    """
    return consumable(name).fill_up(running.session.scheduler, amount_of(amount, "replenish"))


def consumable(name: Value) -> Resource:
    """The resource NAME, which is to be consumable."""
    resource = resource_named(name)
    if not resource.is_consumable:
        raise simple_error(f"the resource {shown(name)} is renewable: it is held, and not used up")
    return resource
