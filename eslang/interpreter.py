"""The interpreter: joins reader, compiler and runtime into one object to hold.

This is the door for embedders (language reference §10) and what tools stand
on. Everything an interpreter has hangs here: one image, one clock, one source
of chance, one output, one set of listeners; two of them never meet.
"""

from __future__ import annotations

import sys

from eslang import aims, library
from eslang.base.border import to_lisp, to_python
from eslang.base.calls import spread
from eslang.base.control import Stop
from eslang.base.diagnostics import Diagnostic
from eslang.base.failure import UNBOUND_VARIABLE, Failure
from eslang.base.hints import TYPE_CHECKING, Any, Callable, F, Iterable, Iterator, overload
from eslang.base.image import Image
from eslang.base.many import values_list
from eslang.base.packages import Package
from eslang.base.printer import prin1
from eslang.base.resolve import resolve_in, symbol_called
from eslang.base.running import running, to_function
from eslang.base.spans import Source, Spans
from eslang.base.symbols import Symbol, Value
from eslang.base.words import SPECIAL_FORMS
from eslang.compile.registry import Definition
from eslang.compile.support import SUPPORT
from eslang.doors import AtWork, Door
from eslang.facts.unify import Patterns
from eslang.lisp.streams import OutputStream, standard_output
from eslang.primitives import define_primitive, make_primitive
from eslang.runtime import failures
from eslang.runtime.bindings import Bindings
from eslang.runtime.chance import make_chance
from eslang.runtime.clock import make_clock
from eslang.runtime.failures import Causes, Dynamic, run_apart
from eslang.runtime.hooks import Hooks, Listener
from eslang.runtime.resources import Resource
from eslang.runtime.runs import Runs
from eslang.texts import Texts

if TYPE_CHECKING:
    from os import PathLike
    from random import Random

    from eslang.compile.toplevel import Compiler
    from eslang.constructs.esl.doubles import Double
    from eslang.facts.query import Facts
    from eslang.knowledge import Knowledge
    from eslang.outside import Outside
    from eslang.reader.reader import Reading
    from eslang.runtime.agenda import Agenda
    from eslang.runtime.locks import PropertyLocks

DEEPEST = 400_000  # Python frames; what is deeper is a :stack-exhausted failure


class Interpreter:
    """One independent ESL system.

    seed: of the source of chance. clock: "real", or "virtual", on which time
    jumps. output: a text stream (default: standard output as it is at each
    writing). shuffle: let chance choose among the tasks that are ready;
    choices: let a function of them do so (its index), or a list of names.
    outside: `call` waits for signals from outside, rather than report a
    deadlock. listeners: callables that get Event objects. facts: a file that
    keeps the facts of the database; those in it are there from the start.
    """

    closed = False
    agenda: Agenda | None = None  # its goals; made when there is one
    _chance: Random | None = None  # this and the following are made when first wanted
    _outside: Outside | None = None
    _database: Facts | None = None
    _knowledge: Knowledge | None = None

    def __init__(
        self,
        *,
        seed: int = 0,
        clock: str = "real",
        output: Any = None,
        shuffle: bool = False,
        choices: Any = None,
        outside: bool = False,
        listeners: Iterable[Listener] = (),
        facts: str | PathLike[str] | None = None,
    ) -> None:
        self.image = Image()
        self.seed = seed
        self.clock = make_clock(clock)
        self.output = OutputStream(output) if output is not None else standard_output()
        self.bindings = Bindings(self.image)
        self.dynamic = Dynamic()  # of the task whose turn it is
        self.causes = Causes()
        self.methods = Patterns()  # of goals: what TO-ACHIEVE has defined
        self.resources: dict[Symbol, Resource] = {}
        self.locks: PropertyLocks | None = None  # made when first wanted
        self.runs = Runs(self, shuffled=shuffle, choices=choices, is_open=outside)
        self.scheduler = self.runs.scheduler
        self.ticks = self.scheduler.ticks
        self.hooks = Hooks(self.clock.now, lambda: self.scheduler.current)
        self.touched = 0  # how often a plan read what may change by itself
        self._library = True  # what is defined now is the library's
        self.support = {**SUPPORT, **self.bindings.support(), **failures.SUPPORT, "%ticks": self.ticks}
        self.texts = Texts(self)
        sys.setrecursionlimit(max(sys.getrecursionlimit(), DEEPEST))
        with self.at_work():
            library.furnish(self)
        self._library = False
        self.image.sealed = True
        if facts is not None:
            from eslang.durable import keep_facts

            keep_facts(self, str(facts))
        self.hooks.listeners.extend(listeners)

    # --- what is there from the start ------------------------------------------

    def defined(self, symbol: Symbol) -> None:
        """Make a name that the library defined external."""
        if self._library:
            library.export(self.image, symbol)

    def compiler(self, name: str) -> Compiler:
        """A compiler for one text; the first one brings the special forms and all of the library along."""
        from eslang.compile.toplevel import Compiler

        self.texts.load_later()
        library.furnish_special_forms(self.image)
        return Compiler(self.image, self.support, name)

    def is_special_form(self, symbol: Symbol) -> bool:
        """True if SYMBOL names a special form."""
        return symbol.package == "COMMON-LISP" and symbol.name in SPECIAL_FORMS

    def is_relation(self, symbol: Symbol) -> bool:
        """True if SYMBOL names a relation of the logical database."""
        return self._database is not None and self._database.is_relation(symbol)

    # --- running ---------------------------------------------------------------

    @property
    def chance(self) -> Random:
        """The source of chance, made when first wanted."""
        if self._chance is None:
            self._chance = make_chance(self.seed)
        return self._chance

    def at_work(self) -> AtWork:
        """Inside it, this interpreter is the one that Lisp functions serve."""
        return AtWork(self)

    def readings(self, source: Source) -> Iterator[Reading]:
        """The top-level forms of a source, each read with the package of the moment."""
        from eslang.reader.reader import read_forms

        self.compiler(source.name)  # brings the special forms, whose names the reader is to find
        return read_forms(source, resolve_in(self.image))

    def evaluate(self, reading: Reading, compiler: Compiler | None = None) -> list[Value]:
        """All the values of a top-level form. Raises Failure, or EslError for a wrong program."""
        compiler = compiler or self.compiler(reading.span.source.name)
        with self.at_work():
            self.texts.note(prin1(reading.form))
            return values_list(self.runs.enter(lambda: self._evaluated(reading, compiler)))

    def _evaluated(self, reading: Reading, compiler: Compiler) -> Value:
        return compiler.run(
            reading.form,
            reading.spans,
            reading.span,
            many=True,
            run=lambda code: run_apart(compiler.unit.load(code)),
        )

    def evaluate_form(self, form: Value, *, many: bool = False) -> Value:
        """EVAL: the value of a form, within the task at work."""
        compiler = self.compiler("<eval>")
        self.texts.note(prin1(form))
        return compiler.run(form, Spans(), None, many=many, run=lambda code: compiler.unit.load(code)())

    # --- the embedder's doors --------------------------------------------------

    def load(self, path: str | PathLike[str]) -> Package:
        """Load a file; the package that was current at its end. Raises Failure, EslError, OSError."""
        with self.door():
            package: Package = self.runs.enter(lambda: self.texts.load_file(str(path), run_apart))
            return package

    def eval(self, text: str, name: str = "<eval>") -> Any:
        """The value of the last form in TEXT, as Python has it. Raises Failure, EslError."""
        with self.door():
            return to_python(self.runs.enter(lambda: self.texts.run(Source(name, text))))

    def call(self, name: str | Symbol, *arguments: Any) -> Any:
        """Call a function by name (or a function itself); runs until it ends. Raises Failure."""
        with self.door():
            return to_python(self.runs.run(self._calling(name, arguments)))

    def _calling(self, name: str | Symbol, arguments: tuple[Any, ...]) -> Callable[[], Value]:
        designator: Any = self.symbol(name) if isinstance(name, str) else name
        values = [to_lisp(argument) for argument in arguments]
        return lambda: spread(to_function(designator), values)

    async def call_async(self, name: str | Symbol, *arguments: Any) -> Any:
        """The same as a task, within the running asyncio loop; if this is cancelled, the task is aborted."""
        guest = self.outside.at_call()
        return await guest.call(str(name).lower(), self._calling(name, arguments))

    def signal(self, name: str | Symbol, *arguments: Any) -> None:
        """Signal the event named by a DEFEVENT; from any thread. Raises Failure if NAME is none."""
        from eslang.posts import post_signal

        post_signal(self, name, arguments)

    def post(self, function: Callable[..., object] | Symbol, *arguments: Any) -> None:
        """Call FUNCTION, Python's or the Lisp function of a symbol, in a task of its own; from any thread."""
        from eslang.posts import post_call

        post_call(self, function, *arguments)

    def after(self, seconds: float, function: Callable[[], object]) -> None:
        """Call FUNCTION, which is not to wait, when SECONDS have passed on the clock; no run waits for it.

        Not from any thread: call it where the tasks are, in a primitive, say, or between two calls.
        """
        from eslang.posts import post_later

        post_later(self, seconds, function)

    def symbol(self, text: str) -> Symbol | None:
        """The symbol that TEXT names in the current package, as the reader would read it."""
        return symbol_called(text, resolve_in(self.image))

    add_goal = aims.add_goal
    drop_goal = aims.drop_goal
    goals = property(aims.goals_of)

    def value(self, name: str) -> Any:
        """The value of a global variable, as Python has it. Raises Failure(:unbound-variable)."""
        symbol = self.symbol(name)
        try:
            return to_python(self.image.cell(symbol).value)
        except AttributeError:
            raise Failure(UNBOUND_VARIABLE, symbol) from None

    def set_value(self, name: str, value: Any) -> None:
        """Give a global variable a value."""
        self.image.cell(self.symbol(name)).value = to_lisp(value)

    @overload
    def primitive(self, function: F) -> F: ...

    @overload
    def primitive(
        self,
        *,
        name: str | None = ...,
        signature: str | None = ...,
        blocking: bool = ...,
        outside: bool = ...,
    ) -> Callable[[F], F]: ...

    def primitive(
        self,
        function: Any = None,
        *,
        name: str | None = None,
        signature: str | None = None,
        blocking: bool = False,
        outside: bool = True,
    ) -> Any:
        """Make a Python function a Lisp function; name and signature from Python's unless given.

        Raising Failure in it is (fail ...); any other error is a :python-error failure.
        What it gives may change by itself, as a sensor does, unless OUTSIDE is False: a
        condition that calls it is looked at again and again as real time passes. An `async
        def` is awaited, and BLOCKING lets it run in a thread: its task waits, others go on.
        """

        def register(made: Any) -> Any:
            define_primitive(self, make_primitive(made, name, signature, outside, blocking))
            return made

        return register if function is None else register(function)

    def double(self, name: str) -> Double:
        """Let a double stand in for a function, which need not be there (docs/how-to/test-a-plan.md)."""
        from eslang.constructs.esl.doubles import Double

        return Double(self.image.cell(self.symbol(name))).install()

    def to_python(self, value: Value) -> Any:
        """A Lisp value as Python has it."""
        return to_python(value)

    def to_lisp(self, value: Any) -> Value:
        """A Python value as Lisp has it."""
        return to_lisp(value)

    def definition(self, symbol: Symbol) -> Definition | None:
        """What is known of a name, for people: signature, documentation, place."""
        self.compiler("<names>")
        definition: Definition | None = self.image.cell(symbol).definition
        return definition

    def check(self, paths: Iterable[str | PathLike[str]]) -> list[Diagnostic]:
        """What can be known of a program, the files in order, without running it."""
        with self.at_work():
            return self.texts.check(map(str, paths))

    def interrupt(self, reason: str = "interrupted", code: int = 130) -> None:
        """Stop what runs, soon, with its cleanups; safe to call from a signal handler."""
        if self.runs.lives.count or running.session is self:
            self.ticks.stop(Stop(reason, code))
            self.scheduler.post(lambda: None)  # whoever rests is to look

    def door(self) -> Door:
        """Inside it, this interpreter is at work for Python code. Raises Failure if it is closed."""
        if self.closed:
            raise Failure("interpreter-closed")
        return Door(self)

    @property
    def outside(self) -> Outside:
        """What goes on outside for its tasks, made when first wanted."""
        if self._outside is None:
            from eslang.outside import Outside

            self._outside = Outside(self)
        return self._outside

    @property
    def database(self) -> Facts:
        """Its logical database, made when first wanted."""
        if self._database is None:
            from eslang.database import make_database

            self._database = make_database(self)
        return self._database

    @property
    def facts(self) -> Knowledge:
        """Its facts for Python code: add, remove, query, subscribe."""
        if self._knowledge is None:
            from eslang.knowledge import Knowledge

            self._knowledge = Knowledge(self)
        return self._knowledge

    # --- ends --------------------------------------------------------------------

    def finish(self) -> None:
        """Wait for what was spawned, and abort the daemons. Raises a failure nobody saw."""
        with self.door():
            if self._outside is not None:
                self._outside.check_plain()
            self.runs.finish()

    async def finish_async(self) -> None:
        """The same within the running asyncio loop."""
        await self.outside.at_call().finish()

    def close(self) -> None:
        """Abort what runs, with its cleanups, and end; nothing can be called on it afterwards."""
        if self.closed:
            return
        self.runs.check_outside()
        self.scheduler.is_open = False  # a cleanup that waits in vain is not waited for
        try:
            with self.at_work():
                self.runs.abort_all()
        finally:
            self.closed = True
            if self._outside is not None:
                self._outside.close()
            self.runs.let_go()
            if self._database is not None and self._database.journal is not None:
                self._database.journal.close()

    async def close_async(self) -> None:
        """The same within the running asyncio loop, which goes on meanwhile."""
        if not self.closed:
            await self.outside.at_call().close()
            self.close()

    def __enter__(self) -> Interpreter:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    async def __aenter__(self) -> Interpreter:
        return self

    async def __aexit__(self, *error: object) -> None:
        await self.close_async()
