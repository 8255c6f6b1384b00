"""Primitives: Python functions that plans call.

A primitive takes and gives Python's values (base/border.py). A Failure that it
raises is a FAIL at the place of the call; any other error is a :python-error
failure there.
"""

from __future__ import annotations

from types import CoroutineType

from eslang.base.border import enter, to_lisp, to_python
from eslang.base.calls import reenter, spread
from eslang.base.diagnostics import error_at
from eslang.base.errors import python_failure
from eslang.base.failure import WRONG_NUMBER_OF_ARGUMENTS, Failure, simple_error
from eslang.base.hints import TYPE_CHECKING, Any
from eslang.base.running import running
from eslang.base.symbols import Keyword, Symbol, Value, lisp_name
from eslang.base.text import String
from eslang.compile.registry import CL, ESL, Definition
from eslang.compile.signatures import Arity, arity, read_signature
from eslang.runtime import failures

if TYPE_CHECKING:
    from eslang.interpreter import Interpreter

COROUTINE, GENERATOR = 0x80, 0x200  # what Python marks the code of an `async def` with, and if it yields


def make_primitive(
    function: Any, name: str | None, signature: str | None, outside: bool, blocking: bool
) -> Definition:
    """The definition of a primitive, named and described as asked, or after the Python function."""
    flags = getattr(getattr(function, "__code__", None), "co_flags", 0)
    if flags & GENERATOR:
        raise TypeError(f"{function.__name__} yields, and gives no result: it cannot be a primitive")
    if flags & COROUTINE and blocking:
        raise TypeError(f"{function.__name__} is an `async def`, which is not run in a thread")
    if signature is None:
        signature = _signature(function, name or lisp_name(function.__name__).lower())
    name = name or str(read_signature(signature)[0])
    shown = signature.replace(name, name.rpartition(":")[2], 1)
    definition = Definition("function", name.upper(), ESL, shown, None)
    definition.documentation = function.__doc__ or ""
    called = name.upper().rpartition(":")[2]
    definition.implementation = _wrapped(
        function, called, arity(signature), _positional(signature), outside, blocking
    )
    return definition


def define_primitive(session: Interpreter, definition: Definition) -> None:
    """Let DEFINITION be that of its name; EslError if that is Common Lisp's."""
    symbol = session.symbol(definition.name)
    if symbol is None or symbol.package == CL:
        raise error_at("redefined-standard-name", f"`{definition.name.lower()}` is Common Lisp's", None)
    cell = session.image.cell(symbol)
    definition.package = symbol.package or ""
    cell.function, cell.definition, cell.macro = definition.implementation, definition, None
    session.defined(symbol)


def _wrapped(
    function: Any, name: str, expected: Arity, positional: int | None, outside: bool, blocking: bool
) -> Any:
    """The Lisp function that calls a Python one across the border."""

    def primitive(*arguments: Value) -> Value:
        if not expected.takes(len(arguments)):
            raise Failure(
                WRONG_NUMBER_OF_ARGUMENTS,
                Symbol.intern(name, ESL),
                String(f"takes {expected.phrase()} but {len(arguments)} were given"),
            )
        running.session.touched += outside
        given = [to_python(argument) for argument in arguments]
        keywords: dict[str, Any] = {}
        if positional is not None:
            keywords = _keywords(list(arguments[positional:]), given[positional:], expected)
            given = given[:positional]
        return run_python(function, given, keywords, name, blocking)

    primitive.__name__ = primitive.__qualname__ = name
    primitive.__doc__ = function.__doc__
    return primitive


def run_python(
    function: Any, given: list[Any], keywords: dict[str, Any], name: str, blocking: bool = False
) -> Value:
    """What FUNCTION gives for the primitive NAME, as Lisp has it; the task waits if that takes time."""
    try:
        if blocking:
            result = running.session.outside.await_blocking(function, given, keywords, name)
        else:
            result = reenter(function, given, keywords) if keywords else spread(function, given)
            if result.__class__ is CoroutineType:
                result = running.session.outside.await_coroutine(result, name)
    except Failure as failure:
        enter(failure)
        return failures.signal(failure, continuable=True)
    except RecursionError:
        raise  # the stack is the plan's as much as the primitive's
    except Exception as error:
        return failures.signal(python_failure(error), continuable=False)
    return to_lisp(result)


def _keywords(names: list[Value], values: list[Any], expected: Arity) -> dict[str, Any]:
    """Python's keyword arguments out of Lisp's."""
    if len(names) % 2:
        raise simple_error("keyword arguments come in pairs; the last has no value", names[-1])
    taken: dict[str, Any] = {}
    for index in range(0, len(names), 2):
        keyword = names[index]
        known = isinstance(keyword, Keyword) and (
            expected.keywords is None or keyword.name in expected.keywords
        )
        if not known:
            raise simple_error("this function has no such keyword argument:", keyword)
        taken.setdefault(keyword.name.lower().replace("-", "_"), values[index + 1])
    return taken


def _positional(signature: str) -> int | None:
    """How many parameters stand before &key; None if there is no &key."""
    elements = [
        element.lower() if isinstance(element, str) else element for element in read_signature(signature)[1:]
    ]
    if "&key" not in elements:
        return None
    return sum(1 for element in elements[: elements.index("&key")] if element != "&optional")


def _signature(function: Any, name: str) -> str:
    """The Lisp signature of a Python function: (grip-force sensor &key scale)."""
    import inspect

    parts = [name]
    section = ""
    for parameter in inspect.signature(function).parameters.values():
        shown = lisp_name(parameter.name).lower()
        wanted = _section(parameter)
        if wanted == "&allow-other-keys":
            parts += ["&key", wanted] if section != "&key" else [wanted]
            continue
        if wanted != section:
            parts.append(wanted)
            section = wanted
        parts.append(shown)
    return f"({' '.join(part for part in parts if part)})"


def _section(parameter: Any) -> str:
    """The lambda list section of a Python parameter."""
    if parameter.kind is parameter.VAR_POSITIONAL:
        return "&rest"
    if parameter.kind is parameter.KEYWORD_ONLY:
        return "&key"
    if parameter.kind is parameter.VAR_KEYWORD:
        return "&allow-other-keys"
    return "" if parameter.default is parameter.empty else "&optional"
