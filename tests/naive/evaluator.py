"""A naive evaluator: walks forms as they stand, in the most obvious way.

What the compiler makes of a program is compared with what this does. It knows
the special forms, some macros and some functions, no more. Every form gives
the list of its values; every jump is an exception that carries its target.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

from eslang.base.lists import Cons, from_items, items
from eslang.base.symbols import Keyword, Symbol, T, Value, truth

GENERAL, ERROR, CONTROL_ERROR = Keyword("GENERAL-FAILURE"), Keyword("ERROR"), Keyword("CONTROL-ERROR")
HOST_CAUSES = (
    "TYPE-ERROR", "CONTROL-ERROR", "UNBOUND-VARIABLE", "UNDEFINED-FUNCTION", "WRONG-NUMBER-OF-ARGUMENTS"
)  # fmt: skip
SECTIONS = ("&OPTIONAL", "&REST", "&KEY", "&AUX")
MISSING = object()


class TooLong(Exception):
    """The program takes more steps than it may."""


class Jump(Exception):
    """A jump to TARGET with VALUES; `failed` once it is made in answer to a failure."""

    def __init__(self, target: Any, values: list[Value], *, failed: bool = False) -> None:
        super().__init__()
        self.target, self.values, self.failed = target, values, failed


class Unanswered(Jump):
    """A failure that nothing answered, on its way out; its values are its cause."""


class HostError(Exception):
    """A function of the host cannot do what it is asked to."""


class Place:
    """Where a jump can go to, while it is live."""

    def __init__(self, tag: Value = None) -> None:
        self.tag, self.live = tag, True


class Macro(NamedTuple):
    """A local macro: a function from arguments to a form."""

    expand: Any


class Parameter(NamedTuple):
    """One parameter of a lambda list."""

    section: str
    name: Symbol
    default: Value
    supplied: Symbol | None


class Environment:
    """A chain of frames: each says what one name of one kind means."""

    def __init__(self, outer: Environment | None, kind: str, name: Value, meaning: Any) -> None:
        self.outer, self.kind, self.name, self.meaning = outer, kind, name, meaning

    def find(self, kind: str, name: Value) -> Environment | None:
        """The innermost frame for NAME."""
        frame: Environment | None = self
        while frame is not None and not (frame.kind == kind and frame.name is name):
            frame = frame.outer
        return frame


class Clauses:
    """One entrance of a form that answers failures: (cause, limit, procedure) of each clause."""

    def __init__(self, outer: Clauses | None, clauses: list[tuple[Value, int, Callable[..., Any]]]) -> None:
        self.outer, self.clauses, self.used, self.place = outer, clauses, [0] * len(clauses), Place()


class Naive:
    """The evaluator, with the values of special variables and the trace that NOTE leaves."""

    def __init__(self, specials: dict[str, Value], steps: int = 20_000) -> None:
        self.specials = dict(specials)
        self.steps = steps
        self.trace: list[Value] = []
        self.catches: list[Place] = []
        self.active: Clauses | None = None

    def run(self, form: Value) -> tuple[str, list[Value]]:
        """What came of FORM: ("values", them) or ("failure", [its cause])."""
        try:
            return "values", self.eval(form, Environment(None, "", None, None))
        except Unanswered as failed:
            return "failure", failed.values

    # --- forms -----------------------------------------------------------------

    def eval(self, form: Value, env: Environment) -> list[Value]:
        """All the values of FORM."""
        self.steps -= 1
        if self.steps < 0:
            raise TooLong
        if isinstance(form, Symbol) and not isinstance(form, Keyword) and form is not T:
            return self.variable(form, env)
        if form.__class__ is not Cons:
            return [form]
        operator, arguments = form.car, items(form.cdr)
        local = env.find("function", operator)
        if local is not None and isinstance(local.meaning, Macro):
            return self.eval(self.apply(local.meaning.expand, arguments)[0], env)
        if local is None and isinstance(operator, Symbol) and operator.name in FORMS:
            return FORMS[operator.name](self, env, *arguments)
        function = self.function_of(operator, env)
        return self.apply(function, [self.one(each, env) for each in arguments])

    def one(self, form: Value, env: Environment) -> Value:
        """The first value of FORM; NIL if it has none."""
        values = self.eval(form, env)
        return values[0] if values else None

    def body(self, forms: Iterable[Value], env: Environment) -> list[Value]:
        """All the values of the last of FORMS."""
        values: list[Value] = [None]
        for form in forms:
            values = self.eval(form, env)
        return values

    # --- variables -------------------------------------------------------------

    def variable(self, symbol: Symbol, env: Environment) -> list[Value]:
        """The value of a variable; all the values of what a symbol macro stands for."""
        if symbol.name in self.specials:
            return [self.specials[symbol.name]]
        frame = env.find("variable", symbol)
        if frame is None:
            return self.signal(Keyword("UNBOUND-VARIABLE"), [symbol])
        return self.eval(frame.meaning.expand, env) if isinstance(frame.meaning, Macro) else [frame.meaning]

    def assign(self, symbol: Symbol, value: Value, env: Environment) -> None:
        """Give a variable another value."""
        frame = env.find("variable", symbol)
        if symbol.name in self.specials:
            self.specials[symbol.name] = value
        elif frame is not None and isinstance(frame.meaning, Macro):
            self.assign(frame.meaning.expand, value, env)
        else:
            assert frame is not None
            frame.meaning = value

    def bind(
        self, pairs: list[tuple[Symbol, Value]], env: Environment, run: Callable[[Environment], Any]
    ) -> Any:
        """What RUN gives where variables are bound all at once, special ones dynamically."""
        saved = [
            (symbol.name, self.specials[symbol.name]) for symbol, _ in pairs if symbol.name in self.specials
        ]
        for symbol, value in pairs:
            if symbol.name in self.specials:
                self.specials[symbol.name] = value
            else:
                env = Environment(env, "variable", symbol, value)
        try:
            return run(env)
        finally:
            self.specials.update(saved)

    # --- functions -------------------------------------------------------------

    def function_of(self, name: Value, env: Environment) -> Any:
        """The function that NAME, or a LAMBDA form, means here."""
        if name.__class__ is Cons:
            return self.lambda_(name.cdr.car, items(name.cdr.cdr), env)
        local = env.find("function", name)
        if local is not None:
            return local.meaning
        if name.name in HIGHER:
            return lambda *arguments: HIGHER[name.name](self, *arguments)
        if name.name in FUNCTIONS:
            return lambda *arguments: [FUNCTIONS[name.name](*arguments)]
        return self.signal(Keyword("UNDEFINED-FUNCTION"), [name])

    def apply(self, function: Value, arguments: list[Value]) -> list[Value]:
        """All the values of FUNCTION for ARGUMENTS."""
        try:
            if not callable(function):
                raise HostError("UNDEFINED-FUNCTION" if isinstance(function, Symbol) else "TYPE-ERROR")
            return function(*arguments)
        except HostError as error:
            return self.signal(Keyword(str(error)), [])

    def lambda_(self, lst: Value, forms: list[Value], env: Environment) -> Callable[..., list[Value]]:
        """The function of a lambda list and a body."""
        parameters = list(parameters_of(lst))

        def call(*given: Value) -> list[Value]:
            check_count(parameters, len(given))
            return self.enter(
                parameters, list(given), list(given), env, lambda inner: self.body(forms, inner)
            )

        return call

    def enter(
        self, parameters: list[Parameter], rest: list[Value], keys: list[Value], env: Environment, run: Any
    ) -> list[Value]:
        """Bind PARAMETERS one after the other, so that defaults see what is before them; then RUN."""
        if not parameters:
            return run(env)
        section, name, default, supplied = parameters[0]
        value = MISSING
        if section == "&REST":
            value = from_items(rest)
        elif section == "&KEY":
            keys = rest
            value = next(
                (v for k, v in zip(keys[::2], keys[1::2], strict=False) if k is Keyword(name.name)), MISSING
            )
        elif section != "&AUX" and rest:
            value, rest = rest[0], rest[1:]
        pairs = [(name, self.one(default, env) if value is MISSING else value)]
        if supplied is not None:
            pairs.append((supplied, truth(value is not MISSING)))
        return self.bind(pairs, env, lambda inner: self.enter(parameters[1:], rest, keys, inner, run))

    # --- failures --------------------------------------------------------------

    def signal(self, cause: Value, arguments: list[Value], *, continuable: bool = False) -> Value:
        """Ask the active clauses from the innermost form outward; a host error cannot continue."""
        form = self.active
        while form is not None:
            for number, (wanted, limit, procedure) in enumerate(form.clauses):
                if form.used[number] < limit and answers(wanted, cause):
                    form.used[number] += 1
                    value = self.answer(form, procedure, arguments)
                    if continuable:
                        return value
                    break
            form = form.outer
        raise Unanswered(None, [cause], failed=True)

    def answer(self, form: Clauses, procedure: Callable[..., Any], arguments: list[Value]) -> Value:
        """The value of a recovery procedure, for which only its form and those outside it are active."""
        saved, self.active = self.active, form
        try:
            values = procedure(*arguments)
            return values[0] if values else None
        except Jump as jump:
            jump.failed = True
            raise
        finally:
            self.active = saved

    def land(self, place: Place, run: Callable[[], list[Value]]) -> list[Value]:
        """The values of RUN, or those of a jump to PLACE."""
        try:
            return run()
        except Jump as jump:
            if jump.target is not place:
                raise
            return jump.values
        finally:
            place.live = False

    def leave(self, place: Place, values: list[Value]) -> list[Value]:
        """Jump to PLACE."""
        if not place.live:
            return self.signal(CONTROL_ERROR, [])
        raise Jump(place, values)


def parameters_of(lst: Value) -> Iterable[Parameter]:
    """The parameters of a lambda list."""
    section = ""
    for element in items(lst):
        if isinstance(element, Symbol) and element.name in SECTIONS:
            section = element.name
        else:
            parts = items(element) if element.__class__ is Cons else [element]
            yield Parameter(section, *[*parts, None, None][:3])


def check_count(parameters: list[Parameter], count: int) -> None:
    """Refuse too few and too many arguments."""
    sections = [parameter.section for parameter in parameters]
    least = sections.count("")
    if count < least or (count > least + sections.count("&OPTIONAL") and not {"&REST", "&KEY"} & {*sections}):
        raise HostError("WRONG-NUMBER-OF-ARGUMENTS")


def answers(wanted: Value, cause: Value) -> bool:
    """True if a clause for WANTED takes a failure of CAUSE; host errors are kinds of :error."""
    return wanted is cause or wanted is GENERAL or (wanted is ERROR and cause.name in HOST_CAUSES)


FORMS: dict[str, Callable[..., list[Value]]] = {}
HIGHER: dict[str, Callable[..., list[Value]]] = {}
FUNCTIONS: dict[str, Callable[..., Value]] = {}


def form(name: str) -> Callable[[Any], Any]:
    """Let a Python function be what the forms called NAME do."""

    def register(function: Any) -> Any:
        FORMS[name] = function
        return function

    return register
