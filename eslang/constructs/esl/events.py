"""Events (ESL §4.1): what tasks wait for, and signal to one another."""

from __future__ import annotations

from eslang.base.failure import type_error
from eslang.base.hints import TYPE_CHECKING, Any
from eslang.base.lists import Cons, from_items, items, lisp_list
from eslang.base.many import pack
from eslang.base.running import running, to_function
from eslang.base.symbols import Symbol, Value
from eslang.compile.registry import CL, ESL, function, macro
from eslang.runtime.events import Arguments, Event, Wait

if TYPE_CHECKING:
    from eslang.runtime.scheduler import Scheduler

DEFVAR, PROGN, QUOTE = (Symbol.intern(name, CL) for name in ("DEFVAR", "PROGN", "QUOTE"))
EVENT, KEEP_EVENT, MAKE_EVENT, SIGNAL, WAIT_FOR_EVENTS = (
    Symbol.intern(name, ESL) for name in ("EVENT", "%KEEP-EVENT", "MAKE-EVENT", "SIGNAL", "WAIT-FOR-EVENTS")
)


@function("(make-event &optional name)", ESL)
def make_event(name: Value = None) -> Event:
    """Make an event, called NAME where it is shown.

    Example:
        ? (make-event 'cup-seen)
        #<EVENT CUP-SEEN>

    Source: ESL §4.1; language reference §4.
    """
    return Event(name)


@macro("(defevent name &optional documentation)", ESL)
def defevent(form: Cons, environment: Any) -> Value:
    """Define the global variable NAME, which holds an event.

    Python code signals it by that name. An event that is there already stays;
    any other value makes way for one.

    Returns: NAME.

    Example:
        ? (defevent obstacle-seen)
        OBSTACLE-SEEN
        ? obstacle-seen
        #<EVENT OBSTACLE-SEEN>

    Source: language reference §4.
    """
    name = form.cdr.car
    if not isinstance(name, Symbol):
        raise type_error(name, "SYMBOL", "defevent")
    quoted = lisp_list(QUOTE, name)
    definition = Cons(DEFVAR, Cons(name, Cons(lisp_list(MAKE_EVENT, quoted), form.cdr.cdr)))
    return lisp_list(PROGN, definition, lisp_list(KEEP_EVENT, quoted))


@function("(%keep-event name)", ESL)
def keep_event(name: Symbol) -> Value:
    """Let the variable NAME hold an event; the one that it holds, if it does. Return NAME."""
    cell = running.session.image.cell(name)
    if not isinstance(cell.value, Event):
        cell.value = Event(name)
    return name


def arguments_of_signal(events: Value, test: Value) -> Arguments:
    """Wait for EVENTS; what came with the signal."""
    scheduler: Scheduler = running.session.scheduler
    listed = events is None or events.__class__ is Cons
    wanted = tuple(map(as_event, items(events))) if listed else (as_event(events),)
    for event in wanted:
        outcome = event.outcome()
        if outcome is not None and test is None:
            return outcome
    task = scheduler.at_work()
    asked = None if test is None else to_function(test)
    arguments: Arguments = scheduler.wait(Wait(task, "events", wanted, wanted, asked))
    return arguments


def wait_for_events_values(events: Value, test: Value = None) -> Value:
    """All the arguments that came with the signal."""
    if events.__class__ is Event and test is None:
        return pack(running.session.scheduler.wait_for(events))
    return pack(arguments_of_signal(events, test))


@function("(wait-for-events events &optional test)", ESL, many=wait_for_events_values)
def wait_for_events(events: Value, test: Value = None) -> Value:
    """Wait until one of EVENTS, an event or a list of them, is signalled.

    With TEST, a function, only a signal whose arguments satisfy it counts;
    TEST is asked in the waiting task. A task is an event: it is signalled by
    SIGNAL, and by its end, which a wait that comes later finds as well; and so
    is a goal.

    Returns: the arguments of the signal, as multiple values.
    Fails:   :deadlock if nothing can signal any of EVENTS.
    Waits:   until one of EVENTS is signalled.

    Example:
        ? (let ((cup-seen (make-event 'cup-seen)))
            (spawn (signal cup-seen :left 3))
            (wait-for-events cup-seen))
        :LEFT
        3

    Source: ESL §4.1. Where TEST is asked: decision 17.
    """
    if events.__class__ is Event and test is None:  # as most are
        arguments = running.session.scheduler.wait_for(events)
    else:
        arguments = arguments_of_signal(events, test)
    return arguments[0] if arguments else None


@function("(signal event &rest arguments)", ESL)
def signal_event(event: Value, *arguments: Value) -> Value:
    """Signal EVENT: all tasks that wait for it are unblocked, with ARGUMENTS.

    A signal that nobody waits for is lost. This task goes on first.

    Returns: NIL.

    Example:
        ? (let ((cup-seen (make-event)))
            (signal cup-seen :nobody-waits))
        NIL

    Source: ESL §4.1.
    """
    if not isinstance(event, Event):
        raise type_error(event, EVENT, SIGNAL)
    scheduler = running.session.scheduler
    waits = scheduler.signal(event, arguments)
    if scheduler.session.hooks.listeners:
        scheduler.lives.tell(
            "signal", event=event, arguments=from_items(list(arguments)), wakes=[wait.task for wait in waits]
        )
    return None


function("(signal-event event &rest arguments)", ESL)(signal_event)


def as_event(value: Value) -> Event:
    """VALUE, which is to be an event."""
    if not isinstance(value, Event):
        raise type_error(value, EVENT, WAIT_FOR_EVENTS)
    return value
