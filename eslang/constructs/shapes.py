"""Saying what is wrong with the shape of a construct, at the place where it is wrong."""

from __future__ import annotations

from eslang.base.failure import control_error
from eslang.base.hints import TYPE_CHECKING, NoReturn
from eslang.base.lists import Cons

if TYPE_CHECKING:
    from eslang.compile.scope import Scope


def refuse(
    environment: Scope | None,
    name: str,
    message: str,
    holder: Cons,
    label: str = "",
    hint: str | None = None,
    within: str = "with-recovery-procedures",
) -> NoReturn:
    """Raise the diagnostic of a part that is not as it should be, in HOLDER's car, WITHIN a form."""
    if environment is None:
        raise control_error(message)
    spans = environment.analyser.spans
    span = spans.element(holder) or spans.of(holder.car) or spans.of(holder)
    environment.analyser.fail(name, message, span, label, hint, f"({within} …)")
