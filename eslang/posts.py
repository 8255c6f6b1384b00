"""Posts: what other threads, and coroutines, may ask of an interpreter at any time.

What is posted is done between two steps, soon; before anything else, if
nothing is at work when it comes. A mistake is found at once, where it is made.
"""

from __future__ import annotations

from eslang.base.border import to_lisp
from eslang.base.calls import spread
from eslang.base.failure import Failure, type_error, unbound_variable
from eslang.base.hints import TYPE_CHECKING, Any, Callable
from eslang.base.running import to_function
from eslang.base.symbols import Symbol, Value
from eslang.constructs.esl.events import signal_event
from eslang.primitives import run_python
from eslang.runtime.events import Event
from eslang.runtime.lives import SPAWNED

if TYPE_CHECKING:
    from eslang.interpreter import Interpreter


def post_signal(session: Interpreter, name: str | Symbol, arguments: tuple[Any, ...]) -> None:
    """Signal the event that the global variable NAME holds. Where no task is alive, nobody waits for it."""
    event = event_called(session, name)
    values = [to_lisp(argument) for argument in arguments]
    if session.runs.lives.count:
        session.scheduler.post(lambda: signal_event(event, *values))


def event_called(session: Interpreter, name: str | Symbol) -> Event:
    """The event of the DEFEVENT for NAME. Raises Failure, as for any other thread nothing is to change."""
    symbol = find(session, name) if isinstance(name, str) else name
    if symbol is None:
        raise unbound_variable(Symbol.intern(str(name).upper(), "ESL-USER"))
    value: Value = getattr(session.image.cell(symbol), "value", None)
    if value is None:
        raise unbound_variable(symbol)
    if not isinstance(value, Event):
        raise type_error(value, Symbol.intern("EVENT", "ESL"), Symbol.intern("SIGNAL", "ESL"))
    return value


def find(session: Interpreter, text: str) -> Symbol | None:
    """The symbol that TEXT names in the current package, if there is one; none is made."""
    package, mark, name = text.upper().rpartition(":")
    where = session.image.package if not mark else session.image.packages.get(package.rstrip(":"))
    symbol, found = where.find(name) if where is not None else (None, False)
    return symbol if found else None


def post_call(session: Interpreter, function: Callable[..., object] | Symbol, *arguments: Any) -> None:
    """Call FUNCTION, or the Lisp function of that name, in a task of its own, which belongs to the run."""
    if session.closed:
        raise Failure("interpreter-closed")
    lives, name = session.runs.lives, "posted"
    if isinstance(function, Symbol):
        name = function.name.lower()
        values = [to_lisp(argument) for argument in arguments]

    def body() -> Value:
        if isinstance(function, Symbol):
            return spread(to_function(function), values)
        return run_python(function, list(arguments), {}, name)

    def begin() -> None:
        task = lives.create(name, body)
        task.is_root = True
        lives.start(task, SPAWNED)

    session.scheduler.post(begin)


def post_later(session: Interpreter, seconds: float, function: Callable[[], object]) -> None:
    """Call FUNCTION when SECONDS have passed, between two steps; if it fails, a task fails with it."""

    def call() -> None:
        try:
            function()
        except Exception as error:
            failed = error  # the name of an `except` is gone afterwards
            post_call(session, lambda: raise_again(failed))

    session.scheduler.set_timer(seconds, lambda: session.scheduler.post(call))


def raise_again(error: Exception) -> None:
    """Raise ERROR."""
    raise error
