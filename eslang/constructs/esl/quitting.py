"""QUIT: the end of the whole run, said by a plan.
Source: ours; the papers end their runs from outside.
"""

from __future__ import annotations

from eslang.base.control import Stop
from eslang.base.failure import type_error
from eslang.base.running import running
from eslang.base.symbols import Value
from eslang.compile.registry import ESL, function


@function("(quit &optional (code 0))", ESL)
def quit_run(code: Value = 0) -> Value:
    """End the run, with its cleanup procedures; the command exits with CODE.

    At the prompt, it ends the conversation.

    Fails:   :type-error, if CODE is no whole number from 0 to 255.

    Source: ours; the papers end their runs from outside.
    """
    if code.__class__ is not int or not 0 <= code <= 255:
        raise type_error(code, "UNSIGNED-BYTE", "quit")
    running.session.scheduler.lives.tell("run-stopped", reason="quit", code=code)
    raise Stop("quit", code)
