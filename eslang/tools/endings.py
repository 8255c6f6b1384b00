"""How a run ends: what it has spawned goes on to its end, or is aborted where the run has failed."""

from __future__ import annotations

from eslang.base.control import Stop
from eslang.base.diagnostics import EslError
from eslang.base.failure import Failure
from eslang.base.hints import Any, Callable

QUIT = "quit"  # the reason of a Stop that the plan itself wanted


def to_the_end(interp: Any, work: Callable[[], object]) -> None:
    """Do WORK, then wait for what it has spawned; a failure that nobody saw is raised.

    If any of it fails or is stopped, all that still runs is aborted, with its cleanups.
    """
    with interp.at_work():
        try:
            work()
            interp.runs.finish()
        except (Failure, EslError, Stop):
            interp.runs.abort_all()
            raise
