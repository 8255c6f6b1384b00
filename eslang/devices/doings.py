"""What a scenario lets happen: calls with constant arguments, read and checked.

A call names a function that is there before the plan is loaded. Where its
parameters are called DEVICE, HEALTH and COMMAND, the arguments are looked at,
too. Every mistake is a diagnostic at the place where it stands.
"""

from __future__ import annotations

from eslang.base.diagnostics import EslError, error_at
from eslang.base.hints import TYPE_CHECKING, Any, Iterable, NamedTuple
from eslang.base.lists import Cons
from eslang.base.number_kinds import is_number
from eslang.base.shown import shown
from eslang.base.spans import Span, Spans
from eslang.base.suggest import nearest
from eslang.base.symbols import Keyword, Symbol, T, Value
from eslang.base.text import String
from eslang.compile.signatures import arity, read_signature
from eslang.devices.commands import COMMANDS
from eslang.devices.device import HEALTHS

if TYPE_CHECKING:
    from eslang.interpreter import Interpreter

LONGEST = 1e9  # seconds
QUOTE = Symbol.intern("QUOTE", "COMMON-LISP")
MAYBE_SHAPE = "(with-probability p action...)"


class Call(NamedTuple):
    """A function, and what it is called with."""

    function: Symbol
    arguments: tuple[Value, ...]


class Maybe(NamedTuple):
    """What happens with a probability only."""

    probability: float
    doings: list[Call | Maybe]


Doing = Call | Maybe


class Page:
    """One top-level form of a scenario: what is needed to look at it, and to say what is wrong."""

    def __init__(self, agent: Interpreter, spans: Spans, span: Span, devices: dict[Any, None]) -> None:
        self.agent = agent
        self.spans = spans
        self.span = span
        self.devices = devices  # whose names may stand in it

    def malformed(self, message: str, form: Value, hint: str) -> EslError:
        """The diagnostic of a mistake in FORM."""
        return error_at("malformed-scenario", message, self.spans.of(form) or self.span, hint=hint)

    def malformed_at(self, message: str, holder: Value, hint: str | None) -> EslError:
        """The diagnostic of a mistake in the car of the cons HOLDER."""
        return self.wrong_at("malformed-scenario", message, holder, hint)

    def wrong_at(self, name: str, message: str, holder: Value, hint: str | None) -> EslError:
        """The diagnostic called NAME, of a mistake in the car of the cons HOLDER."""
        return error_at(name, message, self.spans.element(holder) or self.span, hint=hint)

    # --- numbers and options -----------------------------------------------------

    def seconds(self, holder: Cons, what: str, *, above_zero: bool = False) -> float:
        """The seconds in the car of HOLDER."""
        value = holder.car
        if not is_number(value) or not 0 <= value <= LONGEST or (above_zero and value == 0):
            least = "above 0" if above_zero else "not below 0"
            message = f"{what} is a number of seconds, {least}, and not `{shown(value)}`"
            raise self.malformed_at(message, holder, f"write {what} such as `12.5`")
        return float(value)

    def probability(self, holder: Cons) -> float:
        """The probability in the car of HOLDER."""
        value = holder.car
        if not is_number(value) or not 0 <= value <= 1:
            message = f"a probability is a number from 0 to 1, and not `{shown(value)}`"
            raise self.malformed_at(message, holder, "write a probability such as `0.05`")
        return float(value)

    def options(self, rest: Value, names: tuple[str, ...]) -> tuple[dict[str, Cons], Value]:
        """The options that REST begins with, each as the cons that holds its value; and what follows."""
        found: dict[str, Cons] = {}
        while rest.__class__ is Cons and isinstance(rest.car, Keyword):
            name = rest.car.name
            if name not in names or name in found:
                near = nearest(name, names) if name not in names else None
                message = f"there is no option `{shown(rest.car)}` here"
                message = f"the option `{shown(rest.car)}` is given twice" if name in found else message
                raise self.malformed_at(message, rest, f"write `:{near.lower()}`" if near else None)
            if rest.cdr.__class__ is not Cons:
                raise self.malformed_at(
                    f"`{shown(rest.car)}` has no value",
                    rest,
                    "write a number behind it",
                )
            found[name] = rest.cdr
            rest = rest.cdr.cdr
        return found, rest

    # --- names -------------------------------------------------------------------

    def check_device(self, holder: Cons, name: Value) -> None:
        """Refuse NAME, in the car of HOLDER, if it is no device."""
        if name in self.devices if isinstance(name, Symbol) else False:
            return
        near = near_name(name, self.devices)
        hint = f"write `{near}`" if near else f"if the plan describes it, write `(devices {shown(name)})`"
        raise self.wrong_at("unknown-device", f"there is no device `{shown(name)}`", holder, hint)

    def check_word(self, holder: Cons, word: Value, words: Iterable[Symbol], kind: str) -> None:
        """Refuse WORD, in the car of HOLDER, if it is none of WORDS."""
        known = list(words)
        if not any(word is each for each in known):
            near = near_name(word, known)
            hint = (
                f"write `{near}`"
                if near
                else f"write one of {' '.join([f'`{shown(each)}`' for each in known])}"
            )
            raise self.malformed_at(f"`{shown(word)}` is no {kind}", holder, hint)


def near_name(name: Value, names: Iterable[Symbol]) -> str | None:
    """The one of NAMES that is nearest to NAME, as it prints; None if all are far."""
    known = {each.name: shown(each) for each in names if isinstance(each, Symbol)}
    return known.get(nearest(name.name, known) or "") if isinstance(name, Symbol) else None


# --- actions -----------------------------------------------------------------------------


def read_doings(page: Page, rest: Value) -> list[Doing]:
    """The actions in the list REST."""
    found: list[Doing] = []
    while rest.__class__ is Cons:
        found.append(read_doing(page, rest))
        rest = rest.cdr
    return found


def read_doing(page: Page, holder: Cons) -> Doing:
    """The action in the car of HOLDER."""
    form = holder.car
    if form.__class__ is not Cons or not isinstance(form.car, Symbol):
        raise page.malformed_at(f"`{shown(form)}` is no action", holder, "write `(function argument...)`")
    if form.car.name == "WITH-PROBABILITY":
        if form.cdr.__class__ is not Cons or form.cdr.cdr.__class__ is not Cons:
            raise page.malformed(
                "`with-probability` needs a probability and actions",
                form,
                f"write `{MAYBE_SHAPE}`",
            )
        return Maybe(page.probability(form.cdr), read_doings(page, form.cdr.cdr))
    return read_call(page, form)


def read_call(page: Page, form: Cons) -> Call:
    """The call that FORM is."""
    signature = signature_of(page, form)
    holders: list[Cons] = []
    rest = form.cdr
    while rest.__class__ is Cons:
        holders.append(rest)
        rest = rest.cdr
    expected = arity(signature)
    if not expected.takes(len(holders)):
        message = f"`{shown(form.car)}` takes {expected.phrase()}, found {len(holders)}"
        raise page.malformed(message, form, f"write `{signature.lower()}`")
    arguments = tuple([constant(page, each) for each in holders])
    for parameter, holder, value in zip(read_signature(signature)[1:], holders, arguments, strict=False):
        if parameter == "device":
            page.check_device(holder, value)
        elif parameter == "health":
            page.check_word(holder, value, HEALTHS, "health")
        elif parameter == "command":
            page.check_word(holder, value, [Keyword(name) for name in COMMANDS], "command")
    return Call(form.car, arguments)


def signature_of(page: Page, form: Cons) -> str:
    """The signature of the function that FORM calls."""
    cells = page.agent.image.cells
    cell = cells.get(form.car)
    if cell is not None and hasattr(cell, "function") and cell.definition is not None:
        return str(cell.definition.signature).lower()
    known = [each for each, other in cells.items() if each is not None and hasattr(other, "function")]
    near = near_name(form.car, [each for each in known if each.package == "ESL" and each.name[0] != "%"])
    hint = f"write `{near}`" if near else "call a function that there is before the plan is loaded"
    raise page.wrong_at("unknown-command", f"there is no command `{shown(form.car)}`", form, hint)


def constant(page: Page, holder: Cons) -> Value:
    """The argument in the car of HOLDER: what means itself, or is quoted."""
    value = holder.car
    if value.__class__ is Cons and value.car is QUOTE and value.cdr.__class__ is Cons:
        return value.cdr.car
    if value is None or value is T or isinstance(value, Keyword) or value.__class__ is String:
        return value
    if value.__class__ is Cons or isinstance(value, Symbol):
        message = f"`{shown(value)}` is not known before the run"
        raise page.malformed_at(
            message,
            holder,
            f"an argument is a constant: write `'{shown(value)}` if that is meant",
        )
    return value
