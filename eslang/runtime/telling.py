"""What listeners hear of recovery procedures and cleanups.

Apart from failures.py, which decides what happens; here it is only told. The
callers ask first whether anybody listens.
"""

from __future__ import annotations

from eslang.base.control import Abort, Retry, Unwind
from eslang.base.failure import Failure
from eslang.base.hints import Any
from eslang.runtime.story import as_place, place_here, place_raised


def tell_recovery(session: Any, clause: Any, used: int, failure: Failure) -> None:
    """Tell that the procedure of CLAUSE, which was USED so often before, is called for FAILURE."""
    hooks = session.hooks
    if not session.dynamic.quiet:
        left = None if clause.limit is None else clause.limit - used - 1
        raised = place_raised(failure) if hooks.listeners else None
        hooks.tell("recovery", as_place(clause.place), failure=failure, left=left, raised=raised)


def tell_recovery_end(session: Any, failure: Failure, came: Any, continuable: bool) -> None:
    """Tell that a procedure called for FAILURE has ended: a value CAME of it, or a jump."""
    if not session.dynamic.quiet:
        session.hooks.tell("recovery-ended", failure=failure, how=how_ended(came, continuable))


def how_ended(came: Any, continuable: bool) -> str:
    """How a procedure ended of which CAME a value or a jump, in a word."""
    if isinstance(came, Retry):
        return "retry"
    if isinstance(came, Abort):
        return "abort"
    if isinstance(came, Unwind):
        return "left"
    return "continued" if continuable else "declined"


def tell_taken(session: Any, clause: Any, failure: Failure) -> None:
    """Tell that CLAUSE, one of HANDLER-CASE or HANDLER-BIND, has taken FAILURE, and left its form."""
    if not session.dynamic.quiet:
        session.hooks.tell(
            "failure-taken", as_place(clause.place), failure=failure, raised=place_raised(failure)
        )


def tell_cleanup(session: Any) -> None:
    """Tell that a cleanup begins, where the current task stands."""
    if not session.dynamic.quiet:
        session.hooks.tell("cleanup-started", place_here())


def tell_cleanup_end(session: Any, left: bool) -> None:
    """Tell that a cleanup has ended; LEFT, if a jump left it."""
    if not session.dynamic.quiet:
        session.hooks.tell("cleanup-ended", left=left)
