"""Widgets (ESL §2.3): they are operated, they break, and they can be fixed.

Registered through the embedding interface alone, as any device would be. Each
primitive takes, last, the name of a widget; without one it means the widget
whose state is the variable *WIDGET-STATUS* (stdlib/widgets.esl).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from eslang.base.failure import Failure
from eslang.base.symbols import Keyword

if TYPE_CHECKING:
    from eslang.interpreter import Interpreter

OK = Keyword("OK")
STATUS = "esl::*widget-status*"


def install(agent: Interpreter) -> None:
    """Give an interpreter its widgets."""
    named: dict[Any, Any] = {}

    def status(widget: Any) -> Any:
        return agent.value(STATUS) if widget is None else named.get(widget, OK)

    def change(widget: Any, state: Any) -> None:
        if widget is None:
            agent.set_value(STATUS, state)
        else:
            named[widget] = state

    def say(line: str) -> None:
        agent.output.fresh_line()
        agent.output.write(line + "\n")

    @agent.primitive(signature="(esl::operate-widget &optional widget)")
    def operate_widget(widget: Any = None) -> None:
        """Operate WIDGET.

        Returns: NIL.
        Fails:   :widget-broken, with the name of the widget if it has one.

        Example:
            ? (operate-widget)
            OPERATING WIDGET SUCCESSFULLY.
            NIL

        Source: ESL §2.3.
        """
        if status(widget) is not OK:
            raise Failure("widget-broken", *([] if widget is None else [widget]))
        say("OPERATING WIDGET SUCCESSFULLY.")

    @agent.primitive(signature="(esl::break-widget &optional state widget)")
    def break_widget(state: Any = None, widget: Any = None) -> Any:
        """Break WIDGET so that it is in STATE, :broken unless given.

        Returns: STATE.

        Example:
            ? (break-widget :severely-broken)
            :SEVERELY-BROKEN

        Source: ESL §2.3.
        """
        state = Keyword("BROKEN") if state is None else state
        change(widget, state)
        return state

    @agent.primitive(signature="(esl::attempt-widget-fix state &optional widget)")
    def attempt_widget_fix(state: Any, widget: Any = None) -> None:
        """Fix WIDGET, which works if STATE is the state that it is in.

        Returns: NIL.

        Example:
            ? (progn (break-widget) (attempt-widget-fix :broken))
            Widget is fixed.
            NIL

        Source: ESL §2.3.
        """
        if status(widget) is state:
            change(widget, OK)
            say("Widget is fixed.")
        else:
            say("Widget fix didn't work.")

    @agent.primitive(signature="(esl::monitor-widget &optional widget)")
    def monitor_widget(widget: Any = None) -> Any:
        """Wait until WIDGET is broken.

        Returns: the state that it is in then.
        Fails:   :deadlock if it works and nothing runs that could break it.

        Source: ESL §4.4.
        """
        if status(widget) is OK:
            raise Failure("deadlock", "the widget works, and nothing runs that could break it")
        return status(widget)
