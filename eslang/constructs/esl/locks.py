"""Property locks (ARM §4): what tasks maintain while they do something.

The kernel of it is in runtime/locks.py and runtime/maintenance.py; here is
what they have to be told: what a property is, whether it holds, and how it is
achieved and recovered. WITHOUT-PROPERTY-LOCK-FAILURES and
WITH-AUTOMATIC-RECOVERIES are ESL (stdlib/locks.esl).
"""

from __future__ import annotations

from eslang.base.failure import type_error
from eslang.base.hints import TYPE_CHECKING, Any, Callable
from eslang.base.lists import Cons, from_items, items, lisp_list
from eslang.base.many import many_of
from eslang.base.running import running, to_function
from eslang.base.shown import shown
from eslang.base.symbols import Symbol, Value
from eslang.compile.registry import ESL, function, macro, variable
from eslang.constructs.conditions import CONNECTIVES, holds_p, is_written, term_form
from eslang.constructs.esl.tasks import LAMBDA, LIST
from eslang.constructs.shapes import refuse
from eslang.constructs.watching import Inquiry
from eslang.facts.unify import is_variable, unifiable

if TYPE_CHECKING:
    from eslang.runtime.claims import Property, Sight
    from eslang.runtime.locks import PropertyLocks

MAINTAIN, ACHIEVE_PROPERTY, RECOVERY_FUNCTION, WITH, WAIT = (
    Symbol.intern(name, ESL)
    for name in (
        "%MAINTAIN",
        "ACHIEVE-PROPERTY",
        "*RECOVERY-FUNCTION*",
        "WITH-MAINTAINED-PROPERTIES",
        "WAIT-FOR-RECOVERY",
    )
)
ANY = Symbol.intern("?_", ESL)

variable(
    "*recovery-function*",
    ACHIEVE_PROPERTY,
    """The function that restores a violated property, which is its argument.

    It has done so if the property holds when it has ended. It is called in a
    task of its own, so that its global value counts.

    Source: ARM §4, Automatic Recoveries.
    """,
    ESL,
)


@macro("(with-maintained-properties properties &body body)", ESL)
def with_maintained_properties(form: Cons, environment: Any) -> Value:
    """Run BODY while all PROPERTIES, each (NAME ARGUMENT... VALUE), hold.

    The task subscribes to a lock for each of them. If no other task has
    subscribed to it, it is the owner, and achieves the property; if others
    have, who want values that unify with VALUE, it waits until their owner
    has done so. When an owner is aborted meanwhile, or leaves, the next
    subscriber owns the lock. All PROPERTIES are taken at once, or none, and
    are achieved in their order; the locks are released however BODY is left.

    A property that becomes false afterwards is violated: all its subscribers
    fail, where they stand. Those who stay, as WITH-AUTOMATIC-RECOVERIES does,
    have it recovered by *RECOVERY-FUNCTION*.

    PROPERTIES are not evaluated, but for #?variables in them, and what is
    quoted or backquoted; one property need not be in a list.

    Returns: the values of BODY.
    Fails:   :property-lock-unavailable if another task wants a value that does
             not unify, with the property, the other one, and the task;
             :condition-not-achieved if the owner's ACHIEVE fails, with the
             property, and the cause and arguments of that; :type-error if one
             of PROPERTIES is none. And inside BODY :maintained-property-violation,
             and :unrecoverable-property-violation, with the property.
    Waits:   until PROPERTIES have been achieved.

    Example:
        ? (defproperty lamp (where state))
        LAMP
        ? (to-achieve (lamp ?where ?state)
            (t (sleep 1) (assert '(lamp #?where #?state))))
        (LAMP ?WHERE ?STATE)
        ? (with-maintained-properties ((lamp hall :on))
            (db-query '(lamp hall ?state)))
        Attempting to achieve (LAMP HALL :ON)
        (LAMP HALL :ON) achieved.
        (((?STATE . :ON)))

    Source: ARM §4. What is held when: decision 30; recoveries: decision 31.
    """
    properties, body = form.cdr.car, form.cdr.cdr
    alone = properties is not None and (
        properties.__class__ is not Cons or properties.car.__class__ is not Cons
    )
    holder = form.cdr if alone else properties
    wanted = []
    while holder.__class__ is Cons:
        if not is_property_form(holder.car):
            wrong = f"`{shown(holder.car)}` is no property"
            hint = "write `(name argument... value)`"
            within = "with-maintained-properties"
            refuse(environment, "malformed-form", wrong, holder, hint=hint, within=within)
        wanted.append(term_form(holder.car))
        holder = None if alone else holder.cdr
    return lisp_list(MAINTAIN, Cons(LIST, from_items(wanted)), from_items([LAMBDA, None], body))


def is_property_form(form: Value) -> bool:
    """True if FORM is written as a property, or as something that gives one."""
    if form.__class__ is not Cons or form.cdr.__class__ is not Cons:
        return False
    return isinstance(form.car, Symbol) and form.car not in CONNECTIVES


def maintain_values(properties: Value, body: Any) -> Value:
    """All the values of the body."""
    return maintaining(properties, many_of(body))


@function("(%maintain properties body)", ESL, many=maintain_values)
def maintain(properties: Value, body: Any) -> Value:
    """Call BODY while PROPERTIES are maintained."""
    return maintaining(properties, body)


def maintaining(properties: Value, body: Callable[[], Value]) -> Value:
    """What BODY gives while PROPERTIES are maintained."""
    wanted = [property_of(each) for each in items(properties)]
    return locks_of(running.session).maintain(wanted, body)


@function("(wait-for-recovery property)", ESL)
def wait_for_recovery(wanted: Value) -> Value:
    """Wait until PROPERTY, which this task maintains, holds again.

    It does not wait if PROPERTY was not violated, or holds already. A procedure that answers
    :maintained-property-violation so lets the body go on where it stood.

    Returns: NIL.
    Fails:   :unrecoverable-property-violation, with PROPERTY, and the cause and
             arguments with which its recovery failed, if it cannot be
             restored; :type-error if it is no property.
    Waits:   until PROPERTY is restored, or that has failed.

    Source: ARM §4, Automatic Recoveries.
    """
    locks_of(running.session).keeper.wait_for_recovery(property_of(wanted, WAIT))
    return None


def locks_of(session: Any) -> PropertyLocks:
    """The property locks of SESSION, made when first wanted."""
    if session.locks is None:
        from eslang.runtime.maintenance import make_locks

        session.locks = make_locks(
            session.scheduler,
            achieve=lambda wanted: to_function(ACHIEVE_PROPERTY)(wanted.form),
            compatible=lambda one, other: unifiable(value_of(one), value_of(other)),
            observe=observe,
            recover=recover,
        )
    locks: PropertyLocks = session.locks
    return locks


def property_of(form: Value, operator: Symbol = WITH) -> Property:
    """The property with a value that FORM says; fails with :type-error if that is none."""
    from eslang.facts.terms import code_of
    from eslang.runtime.claims import Property

    if not is_property_form(form) or is_written(form):
        raise type_error(form, Symbol.intern("PROPERTY", ESL), operator)
    *parts, value = items(form)
    if any(map(has_variable, parts)):
        raise type_error(form, Symbol.intern("PROPERTY", ESL), operator)
    code = ANY if is_variable(value) else code_of(value)
    return Property(tuple(map(code_of, parts)), code, form, shown(form))


def has_variable(term: Value) -> bool:
    """True if TERM is, or has, a logic variable."""
    pending = [term]
    while pending:
        part = pending.pop()
        if part.__class__ is Cons:
            pending += [part.car, part.cdr]
        elif is_variable(part):
            return True
    return False


def value_of(wanted: Property) -> Value:
    """The value that is WANTED."""
    return items(wanted.form)[-1]


def observe(wanted: Property, changed: Callable[[], None]) -> Sight:
    """Whether WANTED holds; a change of the facts that this rests on calls CHANGED."""
    from eslang.runtime.claims import Sight

    dynamic = running.session.dynamic
    inquiry = Inquiry(lambda change: changed())
    outer, dynamic.logical = dynamic.logical, dynamic.logical._replace(inquiry=inquiry)
    try:
        holds = holds_p(wanted.form) is not None
        if inquiry.is_overtaken:
            changed()
        return Sight(holds, inquiry.end, inquiry.asked_lisp)
    except BaseException:
        inquiry.end()
        raise
    finally:
        dynamic.logical = outer


def recover(wanted: Property) -> Value:
    """Have the user's function restore WANTED."""
    session = running.session
    return to_function(session.image.cell(RECOVERY_FUNCTION).value)(wanted.form)
